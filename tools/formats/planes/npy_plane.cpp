// Labels or distances as a NumPy array, in whose file each row of a tile has its place.
#include "formats/npy.hpp"
#include "formats/planes/placed_file.hpp"

namespace vorocl::command {

namespace {

std::size_t size(std::int64_t count) { return static_cast<std::size_t>(count); }

class NpyPlane : public PlacedFile {
 public:
  NpyPlane(const std::string& path, const Tiling& tiling, PlaneValues values, const std::string& header)
      : PlacedFile(path, header.size() + bytes_of_values(tiling), header),
        window_(tiling.window()),
        values_(values) {}

  WrittenTile write(const TileLabels& tile) override {
    const std::size_t row_bytes = size(tile.tile.width()) * sizeof no_label;
    const char* values = static_cast<const char*>(values_of(tile, values_));
    for (int row = 0; row < tile.tile.height(); ++row, values += row_bytes) {
      const std::size_t first =
          size(tile.tile.y() + row - window_.y()) * size(window_.width()) + size(tile.tile.x() - window_.x());
      write_at(header_bytes() + first * sizeof no_label, values, row_bytes);
    }
    return {tile.number, 0};
  }

 private:
  Window window_;
  PlaneValues values_;
};

}  // namespace

std::unique_ptr<PlaneFile> npy_plane(const std::string& path, const Tiling& tiling, PlaneValues values) {
  const auto header = values == PlaneValues::labels ? npy_header<std::uint32_t> : npy_header<float>;
  const Window& window = tiling.window();
  return std::make_unique<NpyPlane>(path, tiling, values,
                                    header({size(window.height()), size(window.width())}));
}

}  // namespace vorocl::command
