#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <optional>
#include <vector>

#include "app/outputs/plane_summary.hpp"
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

class PlaneMap : public PlaneFile {
 public:
  PlaneMap(const std::string& path, const Window& window)
      : window_(window),
        step_((window.longest_side() - 1) / longest_side_of_map + 1),
        x_{window.width(), step_},
        y_{window.height(), step_},
        output_(path),
        labels_(path, static_cast<std::uint64_t>(x_.count() * y_.count()) * sizeof no_label) {}

  void open() override { labels_.open(); }

  void open_part(const std::optional<KeptTiles>& kept) override {
    stays_ = true;
    std::error_code ignored;
    is_finished_ = kept && kept->is_complete && !std::filesystem::exists(part_path(), ignored);
    is_finished_ ? static_cast<void>(open_to_read(output_.path())) : labels_.open_part(kept);
  }

  std::string part_path() const override { return labels_.part_path(); }

  void join() override {
    stays_ = true;
    labels_.join();
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
      labels_.write(static_cast<std::uint64_t>(y * x_.count() + first) * sizeof no_label, row.data(),
                    row.size() * sizeof no_label);
    }
    return {labels.number, 0};
  }

  void sync() override { labels_.sync(); }

  void finish() override {
    if (is_finished_) return;
    const Grid grid(x_.count(), y_.count());
    std::vector<std::uint32_t> labels(grid.pixels());
    labels_.read(0, labels.data(), labels.size() * sizeof no_label);
    write_picture(output_, color_by_id(labels, grid));
    if (stays_) unlink(part_path().c_str());
  }

 private:
  Window window_;
  std::int64_t step_;
  PictureAxis x_, y_;
  OutputFile output_;
  PlacedFile labels_;
  bool stays_ = false;
  bool is_finished_ = false;
};

}  // namespace

std::unique_ptr<PlaneFile> plane_map(const std::string& path, const Tiling& tiling) {
  return std::make_unique<PlaneMap>(path, tiling.window());
}

}  // namespace vorocl::command
