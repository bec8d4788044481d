// Labels or distances as a NumPy array, in whose file each row of a tile has its place.
#include "formats/npy.hpp"
#include "formats/planes/placed_file.hpp"
#include "formats/planes/plane_file.hpp"

namespace vorocl::command {

namespace {

class NpyPlane : public PlaneFile {
 public:
  NpyPlane(const std::string& path, const Tiling& tiling, PlaneValues values)
      : window_(tiling.window()),
        values_(values),
        header_((values == PlaneValues::labels
                     ? npy_header<std::uint32_t>
                     : npy_header<float>)({size(window_.height()), size(window_.width())})),
        file_(path, header_.size() + bytes_of_values(tiling)) {}

  void open() override {
    file_.open();
    write_header();
  }

  void open_part(const std::optional<KeptTiles>& kept) override {
    file_.open_part(kept);
    write_header();
  }

  std::string part_path() const override { return file_.part_path(); }
  void join() override { file_.join(); }

  WrittenTile write(const TileLabels& tile) override {
    const std::size_t row_bytes = size(tile.tile.width()) * sizeof no_label;
    const char* values = static_cast<const char*>(values_of(tile, values_));
    for (int row = 0; row < tile.tile.height(); ++row, values += row_bytes) {
      const std::size_t first =
          size(tile.tile.y() + row - window_.y()) * size(window_.width()) + size(tile.tile.x() - window_.x());
      file_.write(header_.size() + first * sizeof no_label, values, row_bytes);
    }
    return {tile.number, 0};
  }

  void sync() override { file_.sync(); }
  void finish() override { file_.finish(); }

 private:
  static std::size_t size(std::int64_t count) { return static_cast<std::size_t>(count); }
  void write_header() { file_.write(0, header_.data(), header_.size()); }

  Window window_;
  PlaneValues values_;
  std::string header_;
  PlacedFile file_;
};

}  // namespace

std::unique_ptr<PlaneFile> npy_plane(const std::string& path, const Tiling& tiling, PlaneValues values) {
  return std::make_unique<NpyPlane>(path, tiling, values);
}

}  // namespace vorocl::command
