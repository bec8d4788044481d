#include "vorocl/grid.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <sstream>
#include <string>

#include "core/placement.hpp"
#include "runtime/pixel_grid.hpp"
#include "vorocl/error.hpp"

namespace vorocl {

namespace {

std::string stretch_text(double from, double to) {
  std::ostringstream text;
  text << "an axis from " << from << " to " << to;
  return text.str();
}

/// A scale in pixels per unit and in units per axis; an axis without extent needs none.
bool has_scale(double extent) {
  constexpr auto most = static_cast<double>(Axis::max_pixels);
  return extent == 0 || (std::isfinite(extent * most) && std::isfinite(most / extent));
}

std::int64_t checked_pixels(std::int64_t pixels) {
  if (pixels >= 1 && pixels <= Axis::max_pixels) return pixels;
  throw Error("an axis has " + std::to_string(pixels) + " pixels; it must have from 1 to " +
              std::to_string(Axis::max_pixels));
}

/// Where a window begins along an axis. Throws Error if it does not lie in the grid. In a tilted grid a row
/// that is a period away lies between other pixels.
std::int64_t checked_begin(const Axis& axis, const char* name, std::int64_t begin, std::int64_t length,
                           bool keeps_periods = false) {
  const std::int64_t pixels = axis.pixels();
  if (length < 1 || length > Axis::max_pixels) {
    throw Error("the window has " + std::to_string(length) + " pixels along " + name +
                "; it must have from 1 to " + std::to_string(Axis::max_pixels));
  }
  if (keeps_periods) {
    if (begin > -pixels && begin < pixels) return begin;
    throw Error("the window begins at " + std::string(name) + " = " + std::to_string(begin) +
                "; the grid is tilted, so it must begin less than its " + std::to_string(pixels) +
                " pixels from 0");
  }
  if (axis.is_periodic()) {
    if (length > pixels) return begin % pixels;
    return (begin % pixels + pixels) % pixels;
  }
  if (begin < 0 || begin > pixels - length) {
    throw Error("the window has " + std::to_string(length) + " pixels from " + name + " = " +
                std::to_string(begin) + " on; the grid has " + std::to_string(pixels) +
                " along that axis, which is not periodic");
  }
  return begin;
}

}  // namespace

// --- Axis ---

Axis::Axis(std::int64_t pixels)
    : pixels_(checked_pixels(pixels)), from_(0), to_(static_cast<double>(pixels)), in_pixels_(true) {}

Axis::Axis(std::int64_t pixels, double from, double to)
    : pixels_(checked_pixels(pixels)), from_(from), to_(to), in_pixels_(false) {
  // Written so that a NaN fails.
  if (!(from <= to)) throw Error(stretch_text(from, to) + " is not possible; it must begin before it ends");
  if (!has_scale(to - from)) {
    throw Error(stretch_text(from, to) + " is too long, or too short, to compute with");
  }
}

Axis Axis::periodic() const {
  if (from_ == to_) throw Error(stretch_text(from_, to_) + " has no extent, so that it cannot repeat");
  Axis axis = *this;
  axis.periodic_ = true;
  return axis;
}

Axis Axis::reversed() const {
  Axis axis = *this;
  axis.reversed_ = !reversed_;
  return axis;
}

Axis Axis::closed() const {
  Axis axis = *this;
  axis.closed_ = true;
  return axis;
}

Axis Axis::spaced(int spacing) const {
  if (spacing < 1 || spacing > max_spacing) {
    throw Error("a spacing of " + std::to_string(spacing) + " is not possible; it must be from 1 to " +
                std::to_string(max_spacing));
  }
  Axis axis = *this;
  axis.spacing_ = spacing;
  return axis;
}

bool Axis::covers(double coordinate) const {
  return periodic_ ? std::isfinite(coordinate) : coordinate >= from_ && coordinate <= to_;
}

double Axis::offset_in_period(double coordinate) const {
  const double period = to_ - from_;
  double offset = coordinate - from_;
  if (!(offset >= 0 && offset < period)) {
    offset = std::fmod(offset, period);
    if (offset < 0) offset += period;
  }
  return offset;
}

double Axis::position_in_period(double coordinate) const {
  const double offset = offset_in_period(coordinate);
  return in_pixels_ ? offset : offset * static_cast<double>(pixels_) / (to_ - from_);
}

double Axis::periods_beyond(double coordinate) const {
  if (!periodic_) return 0;
  return std::nearbyint((coordinate - from_ - offset_in_period(coordinate)) / (to_ - from_));
}

double Axis::unreversed_pixel(double coordinate) const {
  const auto count = static_cast<double>(pixels_);
  if (periodic_) {
    // What is just below the period can be rounded up to its end.
    const double pixel = floor_of(position_in_period(coordinate));
    return pixel >= count ? count - 1 : pixel;
  }
  if (from_ == to_) {
    if (coordinate == from_) return floor_of(count / 2);
    if (!std::isfinite(coordinate)) return coordinate;
    return coordinate < from_ ? -1 : count;
  }
  const double pixel = floor_of(in_pixels_ ? coordinate : (coordinate - from_) * count / (to_ - from_));
  // What is just below the end can be rounded up to it.
  return coordinate < to_ || (closed_ && coordinate == to_) ? std::min(pixel, count - 1) : pixel;
}

double Axis::mapped_pixel(double coordinate) const {
  const double pixel = unreversed_pixel(coordinate);
  return reversed_ ? static_cast<double>(pixels_ - 1) - pixel : pixel;
}

double Axis::mapped_position(double coordinate) const {
  const auto count = static_cast<double>(pixels_);
  double along = coordinate;
  if (periodic_) {
    along = position_in_period(coordinate);
  } else if (from_ == to_) {
    if (coordinate == from_) along = std::floor(count / 2) + 0.5;
  } else if (!in_pixels_) {
    along = (coordinate - from_) * count / (to_ - from_);
  }
  return reversed_ ? count - along : along;
}

double Axis::rounded_position(double coordinate) const {
  const double first = pixel(coordinate);
  return first + fraction_in(first, coordinate) / fractions_of_pixel;
}

double Axis::fraction_in(double pixel, double coordinate) const {
  const double parts = std::nearbyint((position(coordinate) - pixel) * fractions_of_pixel);
  return std::clamp(parts, 0.0, fractions_of_pixel - 1.0);
}

double Axis::coordinate(double position) const {
  const auto count = static_cast<double>(pixels_);
  const double along = reversed_ ? count - position : position;
  return in_pixels_ ? along : from_ + along * (to_ - from_) / count;
}

// --- Grid and Window ---

namespace {
Axis axis_of_pixels(std::int64_t pixels, bool periodic) {
  return periodic ? Axis(pixels).periodic() : Axis(pixels);
}
}  // namespace

Grid::Grid(std::int64_t width, std::int64_t height, std::int64_t depth, Axes periodic)
    : Grid(axis_of_pixels(width, has_x(periodic)), axis_of_pixels(height, has_y(periodic)),
           axis_of_pixels(depth, has_z(periodic))) {}

namespace {
/// `from` leans along `axis` by a tilt.
void check_tilt(double tilt, const Axis& from, const Axis& axis, const char* names) {
  constexpr double most_periods = 1024;
  if (!std::isfinite(tilt)) throw Error("the tilt must be a finite number");
  if (tilt == 0) return;
  if (!from.is_periodic() || !axis.is_periodic()) {
    throw Error("a tilted box must be periodic in " + std::string(names));
  }
  if (std::abs(tilt) > most_periods * (axis.to() - axis.from())) {
    throw Error("a tilt in " + std::string(names) + " is longer than 1024 periods: take the whole ones off");
  }
}
}  // namespace

Grid Grid::tilted(double tilt, double xz, double yz) const {
  Grid grid = *this;
  grid.tilt_ = tilt;
  grid.tilt_xz_ = xz;
  grid.tilt_yz_ = yz;
  if (grid.is_tilted_plane()) {
    if (xz != 0 || yz != 0) throw Error("a plane is tilted by xy alone; xz and yz are tilts of volumes");
    const double period = x_.to() - x_.from(), reduced = std::remainder(tilt, period);
    grid.tilt_ = 2 * reduced == -period ? -reduced : reduced;
  }
  check_tilt(grid.tilt_, y_, x_, "x and y");
  check_tilt(xz, z_, x_, "x and z");
  check_tilt(yz, z_, y_, "y and z");
  return grid;
}

Grid::Shifts Grid::shifts() const {
  // In periods of the axis that each leans along.
  const auto period = [](const Axis& axis) { return axis.to() - axis.from(); };
  const auto less_whole_ones = [](double periods) { return std::remainder(periods, 1); };
  const auto in_units = [](double periods, const Axis& axis, const Axis& from) {
    const auto units = static_cast<std::int64_t>(
        std::nearbyint(periods * static_cast<double>(axis.pixels()) * fractions_of_pixel));
    return axis.is_reversed() == from.is_reversed() ? units : -units;
  };
  const auto in_periods = [&](double tilt, const Axis& axis) { return tilt == 0 ? 0 : tilt / period(axis); };
  const double xy = in_periods(tilt_, x_), yz = in_periods(tilt_yz_, y_);
  const double rows = yz - less_whole_ones(yz);  // whole periods of y, each of which leans along x
  const double xz = in_periods(tilt_xz_, x_) - rows * xy;
  return {in_units(less_whole_ones(xy), x_, y_), in_units(less_whole_ones(xz), x_, z_),
          in_units(less_whole_ones(yz), y_, z_)};
}

Window::Window(const Grid& grid)
    : grid_(grid), width_(grid.width()), height_(grid.height()), depth_(grid.depth()) {}

Window::Window(const Grid& grid, std::int64_t x, std::int64_t y, std::int64_t z, std::int64_t width,
               std::int64_t height, std::int64_t depth)
    : grid_(grid),
      x_(checked_begin(grid.x(), "x", x, width)),
      y_(checked_begin(grid.y(), "y", y, height, grid.is_tilted_plane())),
      z_(checked_begin(grid.z(), "z", z, depth)),
      width_(width),
      height_(height),
      depth_(depth) {}

// --- PixelGrid ---

namespace {

int checked_side(std::int64_t side, const char* name) {
  if (side <= Window::max_side) return static_cast<int>(side);
  throw Error("the " + std::string(name) + " of the diagram's window is " + std::to_string(side) +
              "; it must be from 1 to " + std::to_string(Window::max_side) +
              " pixels: take a window of the grid, or tiles");
}

using Sides = std::array<std::int64_t, 3>;

Sides sides_of(const Grid& grid) { return {grid.width(), grid.height(), grid.depth()}; }
Sides spacing_of(const Grid& grid) { return {grid.x().spacing(), grid.y().spacing(), grid.z().spacing()}; }

/// "8 x 8 x 3", of a plane "8 x 8".
std::string sides_text(const Sides& sides) {
  return std::to_string(sides[0]) + " x " + std::to_string(sides[1]) +
         (sides[2] > 1 ? " x " + std::to_string(sides[2]) : "");
}

/// " spaced 1 x 1 x 4"; nothing unless an axis is spaced.
std::string spacing_text(const Sides& spacing) {
  if (spacing == Sides{1, 1, 1}) return "";
  return " spaced " + std::to_string(spacing[0]) + " x " + std::to_string(spacing[1]) + " x " +
         std::to_string(spacing[2]);
}

/// "8 x 8 x 3 voxels", and how they are spaced.
std::string voxels_text(const Grid& grid) {
  return sides_text(sides_of(grid)) + " voxels" + spacing_text(spacing_of(grid));
}

/// The bits of the whole numbers below this one.
int bits_below(std::int64_t side) {
  int bits = 0;
  while (std::int64_t{1} << bits < side) ++bits;
  return bits;
}

/// The bits that the coordinates of an axis take in a voxel's position: see VoxelBits.
int bits_of(std::int64_t side, bool is_periodic) {
  return bits_below(side + (is_periodic ? side / 2 * 2 : 0));
}
int bits_of(const Axis& axis) { return bits_of(axis.pixels(), axis.is_periodic()); }

bool fits_in_a_volume(const Grid& grid) {
  const auto is_short = [](const Axis& axis) {
    const std::int64_t most = Window::max_side_of_volume;
    return axis.pixels() * axis.spacing() <= (axis.is_periodic() ? most / 2 : most);
  };
  return is_short(grid.x()) && is_short(grid.y()) && is_short(grid.z()) &&
         bits_of(grid.x()) + bits_of(grid.y()) + bits_of(grid.z()) <= Window::max_bits_of_volume;
}

void check_volume(const Grid& grid) {
  if (fits_in_a_volume(grid)) return;
  const bool is_spaced = grid.is_spaced();
  throw Error(
      "a volume of " + voxels_text(grid) + periodic_text(grid.periodic()) +
      " is too large: its sides can have " + (is_spaced ? "16384 units of the spacing" : "16384 voxels") +
      ", and a voxel's place must fit in 31 bits, as in 2048 x 1024 x 1024; a periodic side can have " +
      (is_spaced ? "8192 units" : "8192 voxels") +
      ", and takes a bit more; take fewer voxels, or cut the volume into parts that overlap");
}

}  // namespace

PixelGrid::PixelGrid(const Window& window)
    : PixelGrid(checked_side(window.width(), "width"), checked_side(window.height(), "height"),
                window.periodic()) {
  if (vorocl::has_voxels(window.grid())) {
    if (!window.is_whole()) refuse_volume(window.grid(), "a window of a part");
    check_volume(window.grid());
    depth_ = static_cast<int>(window.depth());
    spacing_ = {window.grid().x().spacing(), window.grid().y().spacing(), window.grid().z().spacing()};
  } else if (window.pixels() > Window::max_pixels) {
    throw Error("a diagram of " + std::to_string(width_) + " x " + std::to_string(height_) +
                " has too many pixels; at most 2^30 (such as 32768 x 32768) are possible");
  }
}

VoxelBits::VoxelBits(const PixelGrid& grid)
    : x(bits_of(grid.width(), grid.periodic_x())),
      y(bits_of(grid.height(), grid.periodic_y())),
      z(bits_of(grid.depth(), grid.periodic_z())) {
  constexpr int usual_x = 11, usual_y = 10, usual_z = 10;  // so that one program serves most volumes
  if (x > usual_x || y > usual_y || z > usual_z) return;
  x = usual_x;
  y = usual_y;
  z = usual_z;
}

bool has_voxels(const Grid& grid) { return grid.is_volume() || grid.is_spaced(); }

bool fits_in_a_diagram(const Grid& grid) {
  if (has_voxels(grid)) return fits_in_a_volume(grid);
  return grid.width() <= Window::max_side && grid.height() <= Window::max_side &&
         grid.pixels() <= Window::max_pixels;
}

void refuse_volume(const Grid& grid, const char* what) {
  if (!has_voxels(grid)) return;
  throw Error("the grid is a " +
              (grid.is_volume() ? "volume of " + voxels_text(grid) : "plane of " + size_text(grid)) +
              ", which " + what + " cannot take: it is for planes" +
              (grid.is_volume() ? "" : " that are not spaced"));
}

void refuse_tilted(const Grid& grid, const char* what) {
  if (!grid.is_tilted()) return;
  throw Error("the grid is tilted, which " + std::string(what) + " cannot take; exact diagrams do");
}

std::string periodic_text(Axes axes) {
  std::string text;
  for (const char* const axis : {has_x(axes) ? "x" : "", has_y(axes) ? "y" : "", has_z(axes) ? "z" : ""}) {
    if (*axis != 0) text += (text.empty() ? "" : " and ") + std::string(axis);
  }
  return text.empty() ? "" : ", periodic in " + text;
}

std::string size_text(const Grid& grid) {
  return sides_text(sides_of(grid)) + spacing_text(spacing_of(grid)) + periodic_text(grid.periodic());
}

std::string size_text(const PixelGrid& pixels) {
  const auto [x, y, z] = pixels.spacing();
  return sides_text({pixels.width(), pixels.height(), pixels.depth()}) + spacing_text({x, y, z}) +
         periodic_text(pixels.periodic());
}

}  // namespace vorocl
