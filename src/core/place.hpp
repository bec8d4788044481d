// Where points lie to 1/4096 pixel, as everything behind the seeds takes them; and the kernel that places
// them (kernels/core/place.cl).
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "runtime/kernel.hpp"
#include "vorocl/grid.hpp"
#include "vorocl/opencl.hpp"
#include "vorocl/seeds.hpp"

namespace vorocl {

__extension__ using Int128 = __int128;

/// A pixel has so many units along each axis.
constexpr int fractions_of_pixel = 4096;

/// A position in the plane, in 1/4096 pixel, or another unit where it is said; of 64 bits, so that sums do
/// not overflow.
struct Place {
  std::int64_t x = 0, y = 0;

  friend bool operator==(const Place& a, const Place& b) { return a.x == b.x && a.y == b.y; }
  friend bool operator!=(const Place& a, const Place& b) { return !(a == b); }
  friend Place operator+(const Place& a, const Place& b) { return {a.x + b.x, a.y + b.y}; }
  friend Place operator-(const Place& a, const Place& b) { return {a.x - b.x, a.y - b.y}; }
};

/// The place of a seed that is absent.
constexpr Place absent_place = {INT64_MIN, 0};

inline bool is_absent(const Place& place) { return place.x == absent_place.x; }

constexpr std::int64_t in_fractions(std::int64_t pixels) { return pixels * fractions_of_pixel; }
constexpr std::int64_t centre_of(std::int64_t pixel) { return in_fractions(pixel) + fractions_of_pixel / 2; }

/// The pixel that holds a position along an axis.
constexpr std::int64_t pixel_of(std::int64_t at) {
  return (at >= 0 ? at : at - (fractions_of_pixel - 1)) / fractions_of_pixel;
}

/// The shorter way round a period; a period of 0 is none. Of two ways of half a period the positive one.
constexpr std::int64_t shorter_way(std::int64_t way, std::int64_t period) {
  if (period == 0) return way;
  way %= period;
  if (2 * way > period) return way - period;
  return 2 * way <= -period ? way + period : way;
}

/// What an axis is, as kernels get it besides its ends and its pixels: bits of kernels/core/place_sizes.cl.
cl_int kind_of(const Axis& axis);

/// Whether a device places points as the host does: it has doubles. With VOROCL_PLACE_ON=host in the
/// environment none does.
bool places_points(const Device& device);

/// Points on the host as they were given, by id.
struct GivenPoints {
  std::shared_ptr<const std::vector<double>> numbers;  // of point after point; absent: x is no number
  int dimensions = 2;

  Point point(const Grid& grid, std::size_t id) const {
    const double* const at = numbers->data() + id * static_cast<std::size_t>(dimensions);
    return {at[0], at[1], dimensions == 2 ? grid.z().from() : at[2]};
  }
};

/// Points on the device as they were given, by id.
struct PointsThere {
  std::shared_ptr<const cl::Buffer> points;  // `dimensions` numbers each
  std::size_t count = 0;
  bool are_doubles = true;  // or floats
  int dimensions = 2;
};

/// Which points are absent, besides those outside the grid.
struct Absence {
  cl::Buffer marks = {};  // one byte per seed, 0 if it is; null: ...
  bool of_nans = false;   // ... those whose x is no number are, or none
};

/// How many int32 the kernels get of a place: x and y; with voxels x, y, z and one that is not used.
cl_int numbers_of_place(const Grid& grid);

/// Enqueues that points are placed in all of a grid, which must fit in a diagram; returns its event.
/// `positions` are as Placement has them. `places`, which may be null, are in 1/4096 pixel from the grid's
/// first one on, by id and one more that is absent, each of numbers_of_place(). `found` is what PointCheck
/// reads.
cl::Event place_on_grid(const Device& device, KernelSet& kernels, const Grid& grid, Outside outside,
                        const PointsThere& points, const Absence& absence, const cl::Buffer& positions,
                        const cl::Buffer& places, const cl::Buffer& found);

/// The points, on the host. Waits.
GivenPoints read_points(const Device& device, const PointsThere& points);

}  // namespace vorocl
