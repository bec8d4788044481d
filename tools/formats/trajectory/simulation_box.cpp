#include "formats/trajectory/simulation_box.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <charconv>
#include <cmath>

namespace vorocl::command {

namespace {

void check(const LineReader& lines, const BoxAxis& axis, char name) {
  const double length = axis.length();
  if (axis.high < axis.low || !std::isfinite(length)) {
    throw lines.error(
        fmt::format("the box reaches from {} to {} in {}: these are no bounds", axis.low, axis.high, name));
  }
  if (axis.periodic() && length == 0) {
    throw lines.error(fmt::format("the box is periodic in {}, but has no length there", name));
  }
}

double unscaled(const BoxAxis& axis, double scaled) {
  const double value = axis.low + scaled * axis.length();
  // Rounding must not move a particle on a wall beyond it.
  return scaled >= 0 && scaled <= 1 ? std::clamp(value, axis.low, axis.high) : value;
}

/// Into [low, high) by whole lengths; returns how many were taken off.
double wrap(const BoxAxis& axis, double& value) {
  if (value >= axis.low && value < axis.high) return 0;
  const double length = axis.length();
  const double distance = value - axis.low;
  double rest = std::fmod(distance, length);
  if (rest < 0) rest += length;
  const double turns = std::round((distance - rest) / length);
  value = axis.low + rest;
  if (value >= axis.high) value = axis.low;  // a value just below low can be rounded up to high
  return turns;
}

/// The number as a dump shows it by default, in six digits.
double as_printed(double value) {
  char text[32];
  const auto end = std::to_chars(text, text + sizeof(text), value, std::chars_format::general, 6).ptr;
  std::from_chars(text, end, value);
  return value;
}

/// A particle within a wall can be printed beyond it, but never beyond the wall as it would be printed.
bool is_outside(double value, double wall, bool low) {
  return low ? value < std::min(wall, as_printed(wall)) : value > std::max(wall, as_printed(wall));
}

/// Makes an axis that is not periodic hold the value: moves the box's sides if they are open, or, by no more
/// than was lost in printing, the value.
void hold(const LineReader& lines, std::uint32_t id, const BoxAxis& axis, char name, double& value,
          double& box_low, double& box_high) {
  if (value >= axis.low && value <= axis.high) return;
  const bool low = value < axis.low;
  const double bound = low ? axis.low : axis.high;
  if ((low ? axis.sides.first : axis.sides.second) == Side::open) {
    box_low = std::min(box_low, value);
    box_high = std::max(box_high, value);
  } else if (is_outside(value, bound, low)) {
    throw lines.error(
        fmt::format("particle {0} is at {1} = {2}, outside the fixed wall at {1} = {3}; correct it, or "
                    "give this side of the box the flag s (shrink-wrapped)",
                    id, name, value, bound));
  } else {
    value = bound;
  }
}

}  // namespace

bool is_negligible(double length, double beside) { return std::abs(length) <= 1e-9 * std::abs(beside); }

SimulationBox::SimulationBox(const LineReader& lines, const BoxAxis& x, const BoxAxis& y, const BoxAxis& z,
                             double tilt, double xz, double yz)
    : x_(x), y_(y), z_(z), tilt_(tilt) {
  static_cast<Bounds&>(box_) = {x.low, y.low, x.high, y.high, z.low, z.high};
  box_.periodic_x = x.periodic();
  box_.periodic_y = y.periodic();
  box_.periodic_z = z.periodic();
  box_.tilt = tilt;
  box_.xz = is_negligible(xz, x.length()) ? 0 : xz;
  box_.yz = is_negligible(yz, y.length()) ? 0 : yz;
  box_.open_x0 = x.sides.first == Side::open;
  box_.open_x1 = x.sides.second == Side::open;
  box_.open_y0 = y.sides.first == Side::open;
  box_.open_y1 = y.sides.second == Side::open;
  check(lines, x, 'x');
  check(lines, y, 'y');
  if (x.periodic() && y.periodic()) return;
  if (!is_negligible(tilt, x.length())) {
    throw lines.error(
        "the box is tilted but not periodic in both x and y; only a periodic one has images that are "
        "shifted");
  }
  tilt_ = box_.tilt = 0;
}

void SimulationBox::check_volume(const LineReader& lines) const {
  check(lines, z_, 'z');
  const bool is_tilted = box_.xz != 0 || box_.yz != 0;
  const bool repeats = z_.periodic() && (box_.xz == 0 || x_.periodic()) && (box_.yz == 0 || y_.periodic());
  if (!is_tilted || repeats) return;
  throw lines.error(
      fmt::format("the box is tilted in z (xz = {}, yz = {}), but not periodic along both axes of each tilt",
                  box_.xz, box_.yz));
}

void SimulationBox::check_plane(const LineReader& lines) const {
  if (box_.xz == 0 && box_.yz == 0) return;
  throw lines.error("the box is tilted in z (xz, yz); planes take a tilt xy alone");
}

void SimulationBox::turn(Point direction, bool flipped) {
  direction_ = direction;
  is_flipped_ = flipped;
  constexpr double degrees = 57.29577951308232;
  box_.turned = std::atan2(direction.y, direction.x) * degrees;
}

Point SimulationBox::turned(Point position) const {
  if (direction_.y == 0 && direction_.x > 0) return position;
  const double x = position.x - x_.low, y = position.y - y_.low;
  return {x_.low + (x * direction_.x + y * direction_.y), y_.low + (y * direction_.x - x * direction_.y),
          position.z};
}

Point SimulationBox::from_scaled(Point scaled) const {
  if (is_flipped_) scaled.y = 1 - scaled.y;
  return {unscaled(x_, scaled.x) + scaled.y * tilt_ + scaled.z * box_.xz,
          unscaled(y_, scaled.y) + scaled.z * box_.yz, unscaled(z_, scaled.z)};
}

Point SimulationBox::place(const LineReader& lines, std::uint32_t id, Point position, bool is_volume) {
  if (is_volume && z_.periodic()) {
    const double turns = wrap(z_, position.z);
    position.x -= turns * box_.xz;
    position.y -= turns * box_.yz;
  } else if (is_volume) {
    hold(lines, id, z_, 'z', position.z, box_.z0, box_.z1);
  }
  if (y_.periodic()) {
    // The copies of the tilted box above it are shifted in x.
    position.x -= wrap(y_, position.y) * tilt_;
  } else {
    hold(lines, id, y_, 'y', position.y, box_.y0, box_.y1);
  }
  if (x_.periodic()) {
    wrap(x_, position.x);
  } else {
    hold(lines, id, x_, 'x', position.x, box_.x0, box_.x1);
  }
  return position;
}

SimulationBox box_from_edges(const LineReader& lines, const Edges& edges, Point origin, Sides x, Sides y,
                             Sides z) {
  const auto& [a, b, c] = edges;
  const double length = std::max(std::hypot(a[0], a[1]), std::hypot(b[0], b[1]));
  if (!is_negligible(a[2], length) || !is_negligible(b[2], length)) {
    throw lines.error("the box is turned out of its plane; its first two edges must lie in the xy plane");
  }
  const double side = is_negligible(a[1], a[0]) ? std::abs(a[0]) : std::hypot(a[0], a[1]);
  const Point direction = side == 0                   ? Point{1, 0}
                          : is_negligible(a[1], a[0]) ? Point{std::copysign(1.0, a[0]), 0}
                                                      : Point{a[0] / side, a[1] / side};
  double tilt = b[0] * direction.x + b[1] * direction.y, height = b[1] * direction.x - b[0] * direction.y;
  if (is_negligible(tilt, side)) tilt = 0;
  const bool flipped = height < 0;
  if (flipped) {  // the lattice is that of the opposite edge, from its end on
    origin.x += b[0];
    origin.y += b[1];
    tilt = -tilt;
    height = -height;
    std::swap(y.first, y.second);
  }
  SimulationBox box(lines, {origin.x, origin.x + side, x}, {origin.y, origin.y + height, y},
                    {origin.z, origin.z + c[2], z}, tilt, c[0] * direction.x + c[1] * direction.y,
                    c[1] * direction.x - c[0] * direction.y);
  box.turn(direction, flipped);
  return box;
}

}  // namespace vorocl::command
