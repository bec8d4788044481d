// The box of a frame as its file states it, and the place of particles in it.
#pragma once

#include <cstdint>
#include <utility>

#include "formats/trajectory/line_reader.hpp"
#include "formats/trajectory/trajectory.hpp"

namespace vorocl::command {

/// What is beyond a side of a box: its other side, nothing that a particle can enter, or more room.
enum class Side { periodic, wall, open };

/// The low and the high side of an axis: both are periodic, or none is.
using Sides = std::pair<Side, Side>;

/// One axis of a box.
struct BoxAxis {
  double low;
  double high;
  Sides sides;

  bool periodic() const { return sides.first == Side::periodic; }
  double length() const { return high - low; }
};

/// A parallelogram with the edges (x.length(), 0) and (tilt, y.length()), whose lower left corner is
/// (x.low, y.low); in a volume a parallelepiped, whose third edge is (xz, yz, z.length()).
class SimulationBox {
 public:
  /// Throws Error, at the reader's line, for bounds in the wrong order, a periodic axis of no length, and a
  /// tilt where not both axes are periodic: only then a rectangle holds the same particles. Of z nothing is
  /// asked, which planes leave out: see check_volume().
  SimulationBox(const LineReader& lines, const BoxAxis& x, const BoxAxis& y, const BoxAxis& z,
                double tilt = 0, double xz = 0, double yz = 0);

  /// Throws Error, at the reader's line, for what is wrong of z.
  void check_volume(const LineReader& lines) const;

  /// Throws Error, at the reader's line, if the third edge is not along z: seen along z there is no plane
  /// then.
  void check_plane(const LineReader& lines) const;

  /// Says that the box was turned in its plane about its corner until its first edge lay along x, `flipped`
  /// if its second one was turned round with it; by how much is where that edge pointed.
  void turn(Point direction, bool flipped);

  /// Where a particle of the box lies when that is turned back.
  Point turned(Point position) const;

  /// A position given in lengths of the edges, in data units.
  Point from_scaled(Point scaled) const;

  /// Where a particle is drawn: wrapped into the box on a periodic axis; unchanged on another axis, where an
  /// open side of the box grows to hold it. Throws Error, at the reader's line, for a particle outside a
  /// wall. In a plane z stays.
  Point place(const LineReader& lines, std::uint32_t id, Point position, bool is_volume);

  /// Whether a side gives way to particles, in a volume one of z too.
  bool grows(bool is_volume) const {
    const bool along_z = z_.sides.first == Side::open || z_.sides.second == Side::open;
    return box_.open_x0 || box_.open_x1 || box_.open_y0 || box_.open_y1 || (is_volume && along_z);
  }

  /// The rectangle that holds all particles placed so far.
  const Box& extent() const { return box_; }

 private:
  BoxAxis x_;
  BoxAxis y_;
  BoxAxis z_;
  double tilt_;
  Point direction_ = {1, 0};  // of the file's first edge
  bool is_flipped_ = false;
  Box box_;
};

/// The edges of a box in three dimensions.
struct Edges {
  double a[3];
  double b[3];
  double c[3];
};

/// The box with these edges, turned in its plane until the first lies along x. Throws Error, at the reader's
/// line, unless the first two lie in the xy plane, and where SimulationBox does.
SimulationBox box_from_edges(const LineReader& lines, const Edges& edges, Point origin, Sides x, Sides y,
                             Sides z);

/// Whether a length is so small beside another that it can be an error of rounding.
bool is_negligible(double length, double beside);

}  // namespace vorocl::command
