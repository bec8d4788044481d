// How the diagram of a frame stands in the picture and in the data, and what a pixel is in the units of the
// data: the one place that knows the scale of what is measured.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <set>
#include <string>
#include <vector>

#include "formats/raster.hpp"
#include "vorocl/grid.hpp"

namespace vorocl::command {

/// The pixels of a picture along an axis, in data units.
struct AxisScale {
  Axis axis = Axis(1);  ///< of pixels, as without bounds
  double begin = 0;     ///< its first pixel in the picture

  double at(double pixels) const { return axis.coordinate(pixels - begin); }
  double length() const { return axis.to() - axis.from(); }
  double pixels() const { return static_cast<double>(axis.pixels()); }
  double side_of_pixel() const { return length() / pixels(); }
};

/// So much of the data for so many pixels. A quotient of its own would round twice: 116 pixels of 10 / 100
/// are 11.6, and 116 * 0.1 is 11.600000000000001.
struct Ratio {
  double data = 1, pixels = 1;

  double of(double count) const { return count * data / pixels; }
};

/// The least rectangle around pixels; in a volume the least box around voxels.
struct Extent {
  double left, top, right, bottom;
  double front = 0, back = 0;  ///< of a box
};

/// Positions, areas and lengths of pixels, in data units where there are bounds. A length has a scale only
/// where pixels are squares, and voxels cubes or spaced as they are long: elsewhere lengths stay in pixels.
///
/// In a volume an area is the volume of voxels, and a border between cells is a number of their faces, which
/// has a scale where voxels are cubes.
class Units {
 public:
  /// Pixels.
  Units() = default;

  /// An axis without an extent, has no scale: then all stays in pixels.
  Units(const AxisScale& x, const AxisScale& y, bool square) : Units({x, y, {}}, square, false) {}

  /// Of a volume, whose distances are one length in data units if it has a scale.
  Units(const Grid& volume, bool has_scale)
      : Units({AxisScale{volume.x()}, AxisScale{volume.y()}, AxisScale{volume.z()}}, has_scale, true) {}

  /// Degrees, of a map; distances are kilometres, and areas those of cells, which Measures has.
  static Units of_globe(const Grid& map) {
    Units units({AxisScale{map.x()}, AxisScale{map.y()}, {}}, false, false);
    units.is_globe_ = units.length_in_data_ = true;
    units.length_unit_ = "km";
    return units;
  }

  /// Voxels, and for distances the units by which axes are spaced.
  static Units of_voxels(const Grid& volume) {
    Units units;
    units.length_unit_ = spacing_unit({AxisScale{volume.x()}, AxisScale{volume.y()}, AxisScale{volume.z()}});
    return units;
  }

  /// Of a position in pixels of the picture.
  Point position(const Point& pixels) const { return {x_.at(pixels.x), y_.at(pixels.y), z_.at(pixels.z)}; }

  /// The extent of an area from its first column and row to its last ones: in data units to the edges behind
  /// these.
  Extent extent(const Extent& pixels) const {
    const double behind = area_in_data_ ? 1 : 0;
    return {x_.at(pixels.left),           y_.at(pixels.top),
            x_.at(pixels.right + behind), y_.at(pixels.bottom + behind),
            z_.at(pixels.front),          z_.at(pixels.back + behind)};
  }

  double area(double pixels) const { return area_.of(pixels); }
  double length(double pixels) const { return length_.of(pixels); }
  double border(double edges) const { return border_.of(edges); }
  std::vector<float> lengths(std::vector<float> pixels) const {
    if (!length_in_data_) return pixels;
    for (float& length : pixels) length = static_cast<float>(this->length(static_cast<double>(length)));
    return pixels;
  }

  bool are_of_data() const { return area_in_data_; }
  bool is_of_volume() const { return is_volume_; }

  /// "data" or "px"; of lengths in a volume whose axes are spaced "spacing 1:1:4".
  const char* of_area() const { return is_globe_ ? "km^2" : area_in_data_ ? "data" : "px"; }
  const char* of_length() const { return length_unit_.c_str(); }

  /// Whether positions are in data units and lengths are not, for pixels are no squares there.
  bool lengths_stay_in_pixels() const { return area_in_data_ && !length_in_data_; }

  /// The first line of a table with these columns: where lengths stay in pixels beside positions in data
  /// units, the names of their columns say so.
  std::string header(const std::vector<std::string>& columns) const {
    const std::set<std::string> borders =
        is_volume_ ? std::set<std::string>{"surface", "area"} : std::set<std::string>{"perimeter", "length"};
    const auto in_pixels = [&](const std::string& column) {
      return area_in_data_ && ((borders.count(column) > 0 && !border_in_data_) ||
                               (column == "largest_distance" && !length_in_data_));
    };
    std::string text;
    for (const std::string& column : columns)
      text += (text.empty() ? "" : ",") + column + (in_pixels(column) ? "_px" : "");
    return text + "\n";
  }

  /// The same as titles have them: "data units^2", "px".
  const char* area_title() const {
    return is_globe_ ? "km^2" : area_in_data_ ? (is_volume_ ? "data units^3" : "data units^2") : "px";
  }
  const char* length_title() const { return length_in_data_ && !is_globe_ ? "data units" : of_length(); }

 private:
  static std::string spacing_unit(const std::array<AxisScale, 3>& axes) {
    std::string text;
    for (const AxisScale& axis : axes)
      text += (text.empty() ? "spacing " : ":") + std::to_string(axis.axis.spacing());
    return text == "spacing 1:1:1" ? "px" : text;
  }

  Units(const std::array<AxisScale, 3>& axes, bool has_scale, bool is_volume)
      : is_volume_(is_volume), length_unit_(spacing_unit(axes)) {
    double units = 1;  // of a spacing, in a pixel
    for (const AxisScale& axis : axes) {
      if (axis.side_of_pixel() == 0) return;
      units *= axis.axis.spacing();
    }
    x_ = axes[0];
    y_ = axes[1];
    z_ = axes[2];
    area_ = {x_.length() * y_.length() * z_.length(), x_.pixels() * y_.pixels() * z_.pixels()};
    area_in_data_ = true;
    if (!has_scale) return;
    // The sides differ by the rounding of the picture's height alone.
    length_ = is_volume_ ? Ratio{std::cbrt(area_.data), std::cbrt(area_.pixels * units)}
                         : Ratio{std::sqrt(area_.data), std::sqrt(area_.pixels)};
    length_in_data_ = true;
    length_unit_ = "data";
    if (units > 1) return;
    border_ = is_volume_ ? Ratio{length_.data * length_.data, length_.pixels * length_.pixels} : length_;
    border_in_data_ = true;
  }

  AxisScale x_, y_, z_;
  Ratio area_, length_, border_;
  bool is_globe_ = false, is_volume_ = false, area_in_data_ = false, length_in_data_ = false,
       border_in_data_ = false;
  std::string length_unit_ = "px";
};

/// A diagram has the pixels of the picture in which there are labels: all of them, or those of a simulation
/// box. The picture of a volume is a slice of it.
struct View {
  Raster picture;    ///< what files and pictures show
  Window window;     ///< of the diagram
  int x = 0, y = 0;  ///< its first pixel in the picture
  std::int64_t first_x = 0,
               first_y = 0;  ///< the first pixel of the window's grid, from the window's first one
  Units units = {};

  /// The diagram's.
  Size size() const { return Size(window); }

  bool fills_picture() const { return size() == picture.size; }

  bool is_volume() const { return window.grid().is_volume(); }

  /// A position in pixels of the grid, in pixels of the diagram.
  Point from_grid(const Point& of_grid) const {
    return {of_grid.x + static_cast<double>(first_x), of_grid.y + static_cast<double>(first_y), of_grid.z};
  }

  /// A position in pixels of the diagram, in the view's units.
  Point position(const Point& of_diagram) const {
    return units.position({of_diagram.x + x, of_diagram.y + y, of_diagram.z});
  }

  /// The picture of values by pixel of the diagram, with another value beyond them: these values where they
  /// fill it, else made in `room`.
  template <typename T>
  const std::vector<T>& in_picture(const std::vector<T>& values, T beyond, std::vector<T>& room) const {
    if (fills_picture()) return values;
    const std::ptrdiff_t width = picture.size.width(), own_width = size().width();
    room.assign(picture.size.pixels(), beyond);
    for (std::ptrdiff_t row = 0; row < size().height(); ++row) {
      const auto first = values.begin() + row * own_width;
      std::copy(first, first + own_width, room.begin() + (y + row) * width + x);
    }
    return room;
  }

  /// The diagram's part of values by pixel of the picture.
  template <typename T>
  std::vector<T> in_diagram(const std::vector<T>& values) const {
    if (fills_picture()) return values;
    const std::ptrdiff_t width = picture.size.width();
    std::vector<T> result;
    result.reserve(size().pixels());
    for (std::ptrdiff_t row = y; row < y + size().height(); ++row) {
      const auto first = values.begin() + row * width + x;
      result.insert(result.end(), first, first + size().width());
    }
    return result;
  }
};

}  // namespace vorocl::command
