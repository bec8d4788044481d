#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <optional>
#include <vector>

#include "app/outputs/plane_writer.hpp"
#include "formats/files.hpp"
#include "formats/images/pictures.hpp"
#include "formats/planes/placed_file.hpp"
#include "vorocl/picture.hpp"

namespace vorocl::command {

namespace {

/// The picture's pixels along an axis.
struct PictureAxis {
  std::int64_t pixels;  // of the plane
  std::int64_t step;

  std::int64_t count() const { return (pixels + step - 1) / step; }

  /// The plane's pixel that a pixel of the picture shows.
  std::int64_t shown(std::int64_t sample) const { return std::min(sample * step + step / 2, pixels - 1); }

  /// The first pixel of the picture that shows none before this one.
  std::int64_t first_from(std::int64_t pixel) const {
    const std::int64_t sample = std::min(pixel / step, count());
    return sample < count() && shown(sample) < pixel ? sample + 1 : sample;
  }
};

class PlaneMap : public PlacedFile {
 public:
  PlaneMap(const std::string& path, const Window& window, const PictureAxis& x, const PictureAxis& y)
      : PlacedFile(path, static_cast<std::uint64_t>(x.count() * y.count()) * sizeof no_label),
        window_(window),
        x_(x),
        y_(y) {}

  void open_part(const std::optional<KeptTiles>& kept) override {
    stays_ = true;
    std::error_code ignored;
    is_finished_ = kept && kept->is_complete && !std::filesystem::exists(part_path(), ignored);
    is_finished_ ? static_cast<void>(open_to_read(output().path())) : PlacedFile::open_part(kept);
  }

  void join() override {
    stays_ = true;
    PlacedFile::join();
  }

  WrittenTile write(const TileLabels& labels) override {
    const Window& tile = labels.tile;
    const std::int64_t left = tile.x() - window_.x(), top = tile.y() - window_.y();
    const std::int64_t first = x_.first_from(left), end = x_.first_from(left + tile.width());
    std::vector<std::uint32_t> row;
    for (std::int64_t y = y_.first_from(top); y < y_.first_from(top + tile.height()); ++y) {
      row.clear();
      const std::uint32_t* const shown = labels.labels + (y_.shown(y) - top) * tile.width();
      for (std::int64_t x = first; x < end; ++x) row.push_back(shown[x_.shown(x) - left]);
      write_at(static_cast<std::uint64_t>(y * x_.count() + first) * sizeof no_label, row.data(),
               row.size() * sizeof no_label);
    }
    return {labels.number, 0};
  }

  void finish() override {
    if (is_finished_) return;
    const Grid grid(x_.count(), y_.count());
    std::vector<std::uint32_t> labels(grid.pixels());
    read_at(0, labels.data(), labels.size() * sizeof no_label);
    write_picture(output(), color_by_id(labels, grid));
    if (stays_) unlink(part_path().c_str());
  }

 private:
  Window window_;
  PictureAxis x_, y_;
  bool stays_ = false;
  bool is_finished_ = false;
};

}  // namespace

std::unique_ptr<PlaneFile> plane_map(const std::string& path, const Tiling& tiling) {
  const Window& window = tiling.window();
  const std::int64_t step = (window.longest_side() - 1) / longest_side_of_map + 1;
  return std::make_unique<PlaneMap>(path, window, PictureAxis{window.width(), step},
                                    PictureAxis{window.height(), step});
}

}  // namespace vorocl::command
