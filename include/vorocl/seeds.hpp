// Seeds: points snapped to the pixels of a grid, on the device.
#pragma once

#include <cstdint>
#include <initializer_list>
#include <memory>
#include <optional>
#include <vector>

#include "vorocl/device.hpp"
#include "vorocl/export.h"
#include "vorocl/grid.hpp"
#include "vorocl/opencl.hpp"

namespace vorocl {

struct SeedsState;

/// The seeds of a diagram, in their present frame. A seed's id is its index in the caller's list. A seed may
/// be absent: it has an id and no cell. Seeds that share a pixel are allowed: the lowest id owns the cell,
/// the others have empty cells. Needs 4 bytes of device memory per seed, 8 from the first move_to() on.
///
/// The grid is a window of the plane. Points outside it are seeds too, which own those of its pixels that are
/// nearest to them. With a Domain the plane repeats. Exact diagrams and the measures know such seeds;
/// flooding methods, random_step(), relax() and energy() refuse them. A frame that has some needs 8 bytes per
/// seed more, and up to 15 for each outer seed and image that may own a pixel, which the host finds and
/// sorts.
///
/// Threads: one thread at a time.
///
/// Lifetime: diagrams and results remember the frame that they were made from, not the object: it may be
/// moved, changed or destroyed at once after an engine was called. Seeds that were moved from throw Error
/// whatever they are asked.
///
/// Ordering: points are read, and seeds moved, in the order of the calls on the device's queue.
class VOROCL_API Seeds {
 public:
  /// From points in pixel units from the grid's corner. Throws BadPoint naming the first point that is NaN,
  /// infinite or 2^31 pixels or more away from a pixel of the grid along an axis, before any device work. Of
  /// a grid that is periodic itself all points must lie in it. No points at all are allowed.
  Seeds(const Device& device, const Grid& grid, const std::vector<Point>& points);
  Seeds(const Device& device, const Grid& grid, std::initializer_list<Point> points);

  /// As above; a seed without a point is absent.
  Seeds(const Device& device, const Grid& grid, const std::vector<std::optional<Point>>& points);

  /// As above, in a plane that repeats: points are brought into the domain along its periodic axes. Pixels
  /// outside the domain along such an axis have no label. Throws Error too if the grid is periodic itself, a
  /// side of the domain is not in [1, 2^31], or the domain reaches 2^31 pixels or more away from a pixel.
  Seeds(const Device& device, const Grid& grid, const std::vector<Point>& points, const Domain& domain);
  Seeds(const Device& device, const Grid& grid, const std::vector<std::optional<Point>>& points,
        const Domain& domain);

  /// From `count` pairs (x, y) of float in pixel units in the caller's buffer. `present` says which seeds
  /// there are: one byte per seed, 0 for a seed that is absent, whose point is not looked at; a null buffer
  /// says that all are there. The points must lie in the grid. Both buffers are read when the device comes to
  /// it. Throws Error if a buffer is
  /// too small, of another context or not readable by kernels, or the points' buffer is null. The points are
  /// checked on the device: the BadPoint that names a bad one comes at the wait of every diagram and result
  /// that is made from this frame.
  Seeds(const Device& device, const Grid& grid, const cl::Buffer& points, std::size_t count,
        const cl::Buffer& present = cl::Buffer());

  /// From an image of the grid's size, row-major: each non-zero pixel is a seed; ids in row-major order.
  static Seeds from_mask(const Device& device, const Grid& grid, const std::vector<std::uint8_t>& mask);

  /// `count` uniformly random pixels, made on the device (Philox-4x32-10 keyed by the rng seed and the seed's
  /// id): the same on every device. Several seeds may fall on one pixel.
  static Seeds random(const Device& device, const Grid& grid, std::size_t count, std::uint64_t rng_seed);

  ~Seeds();
  Seeds(Seeds&& other) noexcept;
  Seeds& operator=(Seeds&& other) noexcept;

  /// The same seeds once more, to be moved on their own. Copies on the device. Enqueues and returns.
  Seeds clone() const;

  /// Moves the seeds to new points: a new frame. The number of seeds may change: ids past the end are absent.
  /// Checks as the constructor. If it throws, the seeds are where they were.
  void move_to(const std::vector<Point>& points);
  void move_to(std::initializer_list<Point> points);

  /// As above; a seed without a point is absent until it gets one again.
  void move_to(const std::vector<std::optional<Point>>& points);

  /// As above, in a plane that repeats. The domain may be another one in each frame, or none.
  void move_to(const std::vector<Point>& points, const Domain& domain);
  void move_to(const std::vector<std::optional<Point>>& points, const Domain& domain);

  /// As above, from buffers as the constructor takes them.
  void move_to(const cl::Buffer& points, std::size_t count, const cl::Buffer& present = cl::Buffer());

  const Device& device() const;
  const Grid& grid() const;
  std::size_t size() const;

  /// The axes along which the plane repeats: the grid's, or the domain's.
  Periodic periodic() const;

  /// The seeds that are not absent. Where a buffer said which are present, this waits for the device.
  std::size_t alive() const;

  /// How many seeds lie outside the grid's pixels.
  std::size_t outside() const;

  /// One uint32 per seed: y << 16 | x of its pixel, or 0x80008000 if it is absent or outside the grid; and
  /// one more such value at the end. Valid until the seeds are moved: move_to() writes into another buffer,
  /// random_step() into this one.
  const cl::Buffer& positions() const;

  /// The centres of the seeds' pixels; none for a seed that is absent. Waits. Throws BadPoint if a point of
  /// the caller's buffer was bad.
  std::vector<std::optional<Point>> read() const;

  /// Throws BadPoint if a point of the caller's buffer was bad. Waits for it.
  void check() const;

 private:
  friend struct Internal;
  explicit Seeds(std::unique_ptr<SeedsState> state);
  SeedsState& state() const;
  std::unique_ptr<SeedsState> state_;
};

}  // namespace vorocl
