// Where points lie: axes, the grid of pixels that they span, and the window of it that a diagram covers.
#pragma once

#include <cstddef>
#include <cstdint>

#include "vorocl/export.h"

namespace vorocl {

struct Internal;

/// The label of a pixel that has no nearest seed (there are no seeds, or no wave reached it).
constexpr std::uint32_t no_label = 0xffffffffu;

/// A position. In the units of the data where it is a seed's point, in pixels where a measure says so: pixel
/// i of an axis covers [i, i + 1), its centre is i + 0.5. A plane is the one slice of pixels of its grid: in
/// pixels z is 0.5 in its middle.
struct Point {
  double x = 0;
  double y = 0;
  double z = 0;
};

/// How far apart two pixel centres are, computed in integers on every device.
enum class Metric {
  euclidean,     ///< L2 (compared as dx * dx + dy * dy)
  manhattan,     ///< L1: |dx| + |dy|
  great_circle,  ///< on the globe, for exact diagrams of longitudes and latitudes: see exact_diagram()
};

/// Which pixels a wave looks at besides the pixel itself.
enum class Neighbourhood {
  moore,        ///< the 8 neighbours at the step; in a volume 26
  von_neumann,  ///< the 4 neighbours at the step that share a row or a column with it; in a volume 6
};

/// Some of the axes of a grid, such as those that are periodic: a bit for each.
enum class Axes { none = 0, x = 1, y = 2, xy = 3, z = 4, xz = 5, yz = 6, xyz = 7 };

/// Whether an axis is among them.
constexpr bool has_x(Axes axes) { return (static_cast<unsigned>(axes) & 1u) != 0; }
constexpr bool has_y(Axes axes) { return (static_cast<unsigned>(axes) & 2u) != 0; }
constexpr bool has_z(Axes axes) { return (static_cast<unsigned>(axes) & 4u) != 0; }

/// The axes, from what is said of each.
constexpr Axes axes_of(bool x, bool y, bool z = false) {
  return static_cast<Axes>((x ? 1 : 0) + (y ? 2 : 0) + (z ? 4 : 0));
}

/// One axis of a grid: how many pixels there are, and which stretch of the data they cover. The one place
/// where a coordinate becomes a pixel.
///
/// An axis is open, ends at its last pixel and counts pixels along the coordinate, unless it is said
/// otherwise: `Axis(1024, -1, 1).reversed().closed()`.
class VOROCL_API Axis {
 public:
  static constexpr std::int64_t max_pixels = 2147483647;  ///< past it a squared distance leaves 63 bits
  static constexpr int max_spacing = 64;                  ///< the most units that spaced() takes

  /// An axis whose unit is the pixel: it covers [0, pixels). Throws Error unless `pixels` is in
  /// [1, max_pixels].
  explicit Axis(std::int64_t pixels);

  /// An axis that covers [from, to) of the data. If both are equal, this one coordinate has the middle pixel.
  /// Throws Error too unless both are finite, from <= to, and they are neither so far apart nor so near that
  /// double has no scale for them.
  Axis(std::int64_t pixels, double from, double to);

  /// The same axis, which repeats: coordinates wrap into [from, to), distances go the shorter way round, and
  /// cells reach across the ends. Throws Error if from == to.
  Axis periodic() const;

  /// The same axis with its first pixel at `to`: such as rows of an image whose coordinate points up.
  Axis reversed() const;

  /// The same axis, where the coordinate `to` falls in the last pixel and not behind it. A periodic axis
  /// stays as it is: `to` is `from` there.
  Axis closed() const;

  /// The same axis, along which distances count each pixel as `spacing` units. Slices of a microscope that
  /// lie four pixels apart have Axis(90).spaced(4). Throws Error unless `spacing` is in [1, max_spacing].
  Axis spaced(int spacing) const;

  std::int64_t pixels() const { return pixels_; }
  int spacing() const { return spacing_; }
  double from() const { return from_; }
  double to() const { return to_; }
  bool is_periodic() const { return periodic_; }
  bool is_reversed() const { return reversed_; }
  bool is_closed() const { return closed_; }

  /// Whether a coordinate is in [from, to], or the axis is periodic and it is finite.
  bool covers(double coordinate) const;

  /// The pixel of a coordinate, as a whole number: floor((coordinate - from) * pixels / (to - from)), in this
  /// order of operations, so that rounding is the same everywhere; floor(coordinate) where the unit is the
  /// pixel. Counted from the other end if reversed, brought into [0, pixels) if periodic; else it may lie
  /// outside. NaN or infinite if the coordinate is.
  double pixel(double coordinate) const {
    return is_position(coordinate) ? floor_of(coordinate) : mapped_pixel(coordinate);
  }

  /// The position of a coordinate in pixels. Its floor is pixel(), except where rounding moves it across a
  /// pixel's end. The middle of the axis if its ends are equal. NaN or infinite if the coordinate is.
  double position(double coordinate) const {
    return is_position(coordinate) ? coordinate : mapped_position(coordinate);
  }

  /// As position(), rounded to 1/4096 of a pixel as exact diagrams take points (Snap::none), and never out of
  /// the pixel of the coordinate.
  double rounded_position(double coordinate) const;

  /// How many periods a coordinate lies beyond [from, to): floor((coordinate - from) / (to - from)), as its
  /// pixel is found. 0 if the axis is not periodic.
  double periods_beyond(double coordinate) const;

  /// The coordinate of a position in pixels, of pixel(i) + 0.5 for the centre of pixel i.
  double coordinate(double position) const;

  friend bool operator==(const Axis& a, const Axis& b) {
    return a.pixels_ == b.pixels_ && a.from_ == b.from_ && a.to_ == b.to_ && a.in_pixels_ == b.in_pixels_ &&
           a.periodic_ == b.periodic_ && a.reversed_ == b.reversed_ && a.closed_ == b.closed_ &&
           a.spacing_ == b.spacing_;
  }
  friend bool operator!=(const Axis& a, const Axis& b) { return !(a == b); }

 private:
  friend class Snapping;
  friend struct Internal;

  /// What rounded_position() adds to `pixel`, that of the coordinate, as a whole number of 1/4096 of it.
  double fraction_in(double pixel, double coordinate) const;

  /// Whether a coordinate is the position, as most are where the unit is the pixel.
  bool is_position(double coordinate) const {
    return in_pixels_ && !reversed_ && coordinate >= 0 && coordinate < to_;
  }

  /// std::floor() without a call, which it is where the processor is not known.
  static double floor_of(double number) {
    constexpr double no_fractions_from = 4503599627370496.0;  // 2^52
    // Written so that a NaN comes back.
    if (!(number < no_fractions_from && number > -no_fractions_from)) return number;
    const auto whole = static_cast<double>(static_cast<std::int64_t>(number));
    return whole > number ? whole - 1 : whole;
  }

  double mapped_pixel(double coordinate) const;
  double mapped_position(double coordinate) const;
  double unreversed_pixel(double coordinate) const;
  double offset_in_period(double coordinate) const;
  double position_in_period(double coordinate) const;

  std::int64_t pixels_;
  double from_, to_;
  bool in_pixels_;  // the unit is the pixel
  bool periodic_ = false, reversed_ = false, closed_ = false;
  int spacing_ = 1;
};

/// The pixels that there are: three axes, x to the right, y down, z from slice to slice; pixel (0, 0, 0) at
/// the top left of the first slice. It may be far larger than what a diagram can hold, which covers a Window
/// of it. A grid of one slice is a plane, one of several is a volume, whose pixels are voxels too. Any axes
/// may be periodic, and any may be spaced (Axis::spaced()): distances are in units of the spacing then, and
/// measures of cells count pixels.
///
/// Volumes, and planes with an axis that is spaced, are taken by all but methods that flood other than jump
/// flooding, exact diagrams by the Manhattan metric or great circles, vertices(), motions at random, tiles
/// and windows of a part of the grid, which throw Error for them. exact_cells() takes volumes, but no axis
/// that is spaced; nor do weights.
class VOROCL_API Grid {
 public:
  Grid(const Axis& x, const Axis& y, const Axis& z = Axis(1)) : x_(x), y_(y), z_(z) {}

  /// A grid whose unit is the pixel. Throws as Axis.
  Grid(std::int64_t width, std::int64_t height, Axes periodic = Axes::none)
      : Grid(width, height, 1, periodic) {}
  Grid(std::int64_t width, std::int64_t height, std::int64_t depth, Axes periodic = Axes::none);

  /// The same grid as that of a box which is tilted in its plane: a parallelogram with the edges (width, 0)
  /// and (tilt, height), in the units of the data. What repeats at the same x without a tilt does so `tilt`
  /// further along x one period of y onward. The grid is the rectangle that has the same points. Any tilt is
  /// taken; those that differ by whole periods of x are the same, and that of 0 is none. Throws Error unless
  /// it is finite, and unless x and y are periodic if there is one.
  ///
  /// The box of a volume, a parallelepiped, has the edges (width, 0, 0), (tilt, height, 0) and (xz, yz,
  /// depth), as LAMMPS's has. Its tilts stay as they are, and each asks that the two axes in its name are
  /// periodic.
  ///
  /// Exact diagrams, their measures and exact cells know tilted grids. Methods that flood, motions at random,
  /// relaxation, distance transforms and tiles throw Error.
  Grid tilted(double tilt, double xz = 0, double yz = 0) const;

  const Axis& x() const { return x_; }
  const Axis& y() const { return y_; }
  const Axis& z() const { return z_; }
  std::int64_t width() const { return x_.pixels(); }
  std::int64_t height() const { return y_.pixels(); }
  std::int64_t depth() const { return z_.pixels(); }
  bool is_volume() const { return depth() > 1; }
  bool is_spaced() const { return x_.spacing() > 1 || y_.spacing() > 1 || z_.spacing() > 1; }

  Axes periodic() const { return axes_of(x_.is_periodic(), y_.is_periodic(), z_.is_periodic()); }
  std::uint64_t pixels() const {
    return static_cast<std::uint64_t>(width()) * static_cast<std::uint64_t>(height()) *
           static_cast<std::uint64_t>(depth());
  }

  /// The tilt, in a plane brought to at most half a period of x; 0 without one.
  double tilt() const { return tilt_; }
  double tilt_xz() const { return tilt_xz_; }
  double tilt_yz() const { return tilt_yz_; }
  bool is_tilted() const { return tilt_ != 0 || tilt_xz_ != 0 || tilt_yz_ != 0; }
  bool is_tilted_plane() const { return is_tilted() && !is_volume(); }

  /// The tilts as diagrams have them, in 1/4096 of a pixel.
  struct Shifts {
    std::int64_t xy = 0;          ///< so far along x lies what repeats, height() rows further down
    std::int64_t xz = 0, yz = 0;  ///< so far along x and y lies what repeats, depth() slices further on
  };

  /// Brought to at most half a period each, which is the same box. Rounded once, so that images are sums of
  /// what is here and of whole periods.
  Shifts shifts() const;

  /// A point as it repeats in the periods along y and z, which the axes then take: the point itself but in a
  /// tilted grid, where it is moved by the tilts for each period that it lies beyond.
  Point in_box(Point point) const {
    if (tilt_xz_ != 0 || tilt_yz_ != 0) {
      const double periods = z_.periods_beyond(point.z);
      point = {point.x - tilt_xz_ * periods, point.y - tilt_yz_ * periods, point.z};
    }
    if (tilt_ != 0) point.x -= tilt_ * y_.periods_beyond(point.y);
    return point;
  }

  /// The point, in the units of the data, of a position in pixels from the grid's first one.
  Point point(const Point& position) const {
    return {x_.coordinate(position.x), y_.coordinate(position.y), z_.coordinate(position.z)};
  }

  friend bool operator==(const Grid& a, const Grid& b) {
    return a.x_ == b.x_ && a.y_ == b.y_ && a.z_ == b.z_ && a.tilt_ == b.tilt_ && a.tilt_xz_ == b.tilt_xz_ &&
           a.tilt_yz_ == b.tilt_yz_;
  }
  friend bool operator!=(const Grid& a, const Grid& b) { return !(a == b); }

 private:
  Axis x_, y_, z_;
  double tilt_ = 0, tilt_xz_ = 0, tilt_yz_ = 0;
};

/// A box of a grid's pixels: what a diagram covers, or a tile of it.
///
/// Along a periodic axis a window may begin anywhere and cross the end of the period; a window that is longer
/// than the period shows each pixel at most once, where the grid has it, and no labels beside. Of a tilted
/// plane a window shows any part, whose rows of pixels beyond the grid lie between pixels of the grid.
/// Diagrams of volumes, and of grids with an axis that is spaced, take the window that shows all.
class VOROCL_API Window {
 public:
  static constexpr std::int64_t max_side = 32768;        ///< of a diagram: past it a label's way is too long
  static constexpr std::uint64_t max_pixels = 1u << 30;  ///< of a diagram

  /// Of a volume, or with an axis that is spaced: its sides, in units of the spacing; and the bits of the
  /// whole numbers below its voxels along each of them, added up. A periodic side counts twice.
  static constexpr std::int64_t max_side_of_volume = 16384;
  static constexpr int max_bits_of_volume = 31;  ///< such as 2048 x 1024 x 1024 voxels

  /// All pixels of a grid.
  Window(const Grid& grid);

  /// The pixels from column x, row y and slice z of a grid on. Throws Error unless the sides are from 1 to
  /// Axis::max_pixels and the window lies in the grid (along a periodic axis: it may lie anywhere, but along
  /// y in a tilted grid it must begin less than a period from the grid's first row).
  Window(const Grid& grid, std::int64_t x, std::int64_t y, std::int64_t z, std::int64_t width,
         std::int64_t height, std::int64_t depth);

  /// As above, with all slices.
  Window(const Grid& grid, std::int64_t x, std::int64_t y, std::int64_t width, std::int64_t height)
      : Window(grid, x, y, 0, width, height, grid.depth()) {}

  const Grid& grid() const { return grid_; }

  /// The first column, row and slice; along a periodic axis in [0, pixels) unless the window is longer than
  /// the period, or this is the row of a tilted grid.
  std::int64_t x() const { return x_; }
  std::int64_t y() const { return y_; }
  std::int64_t z() const { return z_; }

  std::int64_t width() const { return width_; }
  std::int64_t height() const { return height_; }
  std::int64_t depth() const { return depth_; }
  std::int64_t longest_side() const {
    const std::int64_t of_a_slice = width_ > height_ ? width_ : height_;
    return of_a_slice > depth() ? of_a_slice : depth();
  }
  std::uint64_t pixels() const {
    return static_cast<std::uint64_t>(width_) * static_cast<std::uint64_t>(height_) *
           static_cast<std::uint64_t>(depth());
  }

  /// Whether it is all of its grid.
  bool is_whole() const {
    return x_ == 0 && y_ == 0 && z_ == 0 && width_ == grid_.width() && height_ == grid_.height() &&
           depth_ == grid_.depth();
  }

  /// The axes along which it shows exactly one period: its cells reach across its border. In a plane z is
  /// none of them. Of a tilted plane x and y or none: if the window has all rows of the grid, from the first
  /// one on, and all columns.
  Axes periodic() const {
    if (grid_.is_tilted_plane()) {
      const bool shows_all = width_ == grid_.width() && height_ == grid_.height() && y_ == 0;
      return shows_all ? Axes::xy : Axes::none;
    }
    return axes_of(grid_.x().is_periodic() && width_ == grid_.width(),
                   grid_.y().is_periodic() && height_ == grid_.height(),
                   grid_.z().is_periodic() && depth_ == grid_.depth() && grid_.is_volume());
  }

  friend bool operator==(const Window& a, const Window& b) {
    return a.grid_ == b.grid_ && a.x_ == b.x_ && a.y_ == b.y_ && a.z_ == b.z_ && a.width_ == b.width_ &&
           a.height_ == b.height_ && a.depth_ == b.depth_;
  }
  friend bool operator!=(const Window& a, const Window& b) { return !(a == b); }

 private:
  Grid grid_;
  std::int64_t x_ = 0, y_ = 0, z_ = 0, width_, height_, depth_;
};

}  // namespace vorocl
