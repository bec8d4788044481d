// Images on the host, as files hold them: labels, and where the pixels lie in the data.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "vorocl/grid.hpp"

namespace vorocl::command {

/// The sides of an image in pixels: of one that a diagram can have.
class Size {
 public:
  static constexpr int max_side = static_cast<int>(Window::max_side);

  /// Throws Error unless both sides are in [1, max_side] and there are at most Window::max_pixels.
  Size(std::int64_t width, std::int64_t height);

  /// That of a window, or of a slice of a grid.
  explicit Size(const Window& window) : Size(window.width(), window.height()) {}
  explicit Size(const Grid& grid) : Size(grid.width(), grid.height()) {}

  int width() const { return width_; }
  int height() const { return height_; }
  int longest_side() const { return width_ > height_ ? width_ : height_; }
  std::size_t pixels() const { return static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_); }
  bool holds(const Point& point) const {
    return point.x >= 0 && point.x < width_ && point.y >= 0 && point.y < height_;
  }

  /// A grid of this size.
  Grid grid(Axes periodic = Axes::none) const { return {width_, height_, periodic}; }

  friend bool operator==(const Size& a, const Size& b) {
    return a.width_ == b.width_ && a.height_ == b.height_;
  }
  friend bool operator!=(const Size& a, const Size& b) { return !(a == b); }

 private:
  int width_, height_;
};

/// The sides in pixels: "64 x 32 x 16"; of one slice "64 x 32".
std::string sides_of(const Grid& grid);

/// A rectangle in data units, or a box.
struct Bounds {
  double x0 = 0;
  double y0 = 0;
  double x1 = 0;
  double y1 = 0;
  double z0 = 0;  ///< of a volume, as z1
  double z1 = 0;

  bool is_box() const { return z0 < z1; }
};

/// An image of labels, or a volume of them.
struct LabelImage {
  Size size;
  std::vector<std::uint32_t> labels;  // row-major, slice after slice
  std::int64_t depth = 1;             // of a volume more

  Grid grid() const { return {size.width(), size.height(), depth}; }
};

/// How much each pixel of an image weighs.
struct DensityImage {
  Size size;
  std::vector<float> values;  // row-major
};

/// A coordinate reference system of the EPSG's registry.
struct Crs {
  int code = 0;  ///< EPSG:code
  bool is_geographic = false;
  std::string name;
};

/// What a GeoTIFF says of where its pixels lie, tag by tag.
struct GeoTags {
  std::vector<double> scale, tie_points, transformation;  ///< 3, 6 for each point, 16, or none
  std::vector<std::uint16_t> keys;                        ///< of the coordinate reference system
  std::vector<double> key_doubles;
  std::string key_texts;
};

/// The rectangle that an image shows, in data units, and whether its y axis points up.
struct Georeference {
  Bounds bounds;
  bool y_up = false;
  std::optional<Crs> crs;
  std::optional<GeoTags> tags = std::nullopt;  ///< of the mask's file, which .tif files have instead
};

/// Where the pixels of a mask's file lie from this pixel on, if it says so.
std::optional<Georeference> georeference_of(const std::optional<GeoTags>& mask, std::int64_t x = 0,
                                            std::int64_t y = 0);

/// The pixels of an image file or the voxels of a volume's, and where they lie in the data; without that
/// these are in pixels.
struct Raster {
  Raster(const Size& pixels, std::int64_t slices = 1) : size(pixels), depth(slices) {}
  Raster(const Size& pixels, const Georeference& place, std::int64_t slices = 1)
      : size(pixels), depth(slices), georeference(place) {}

  bool is_volume() const { return depth > 1; }

  Size size;  ///< of a slice
  std::int64_t depth;
  std::optional<Georeference> georeference = std::nullopt;
};

}  // namespace vorocl::command
