// Seeds: points snapped to the pixels of a grid, on the device.
#pragma once

#include <CL/opencl.hpp>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "vorocl/device.hpp"
#include "vorocl/export.hpp"
#include "vorocl/grid.hpp"

namespace vorocl {

/// The seeds of a diagram. A seed's id is its index in the caller's list. Seeds that share a pixel are
/// allowed: the lowest id owns the cell, the others have empty cells. Needs 4 bytes of device memory a seed.
/// Copies share the positions: random_step() moves them all; move_to() leaves the others' counts behind, so
/// call it for one of them alone.
class VOROCL_API Seeds {
 public:
  /// From points in pixel units. Throws Error naming the first point that is NaN, infinite or outside the
  /// grid (a point at x = width is outside), before any device work. No points at all are allowed.
  Seeds(const Device& device, const Grid& grid, const std::vector<Point>& points);

  /// From `count` pairs (x, y) of float in pixel units in the caller's buffer, which is read when the queue
  /// gets there. Throws Error if the buffer is null, too small or of another context. The points are checked
  /// on the device: the Error that names a bad one comes at the next wait (Diagram::read(), Diagram::wait()).
  Seeds(const Device& device, const Grid& grid, const cl::Buffer& points, std::size_t count);

  /// From an image of the grid's size, row-major: each non-zero pixel is a seed; ids in row-major order.
  static Seeds from_mask(const Device& device, const Grid& grid, const std::vector<std::uint8_t>& mask);

  /// `count` uniformly random pixels, made on the device (Philox-4x32-10 keyed by the rng seed and the seed's
  /// id): the same on every device. Several seeds may fall on one pixel.
  static Seeds random(const Device& device, const Grid& grid, std::size_t count, std::uint64_t rng_seed);

  /// Moves the seeds to new points, for the diagrams that follow. A seed without a point is absent until it
  /// gets one again. The number of seeds may change: ids past the end are absent. Checks as the constructor.
  void move_to(const std::vector<std::optional<Point>>& points);

  /// As above, from `count` pairs of float in the caller's buffer; no seed is absent.
  void move_to(const cl::Buffer& points, std::size_t count);

  const Device& device() const { return device_; }
  const Grid& grid() const { return grid_; }
  std::size_t size() const { return size_; }

  /// The seeds that are not absent.
  std::size_t alive() const { return alive_; }

  /// How often a move_to() has made a seed absent that was there before.
  std::uint64_t vanishings() const { return vanishings_; }

  /// One uint32 a seed: y << 16 | x of its pixel, or 0x80008000 if it is absent; and one more such value at
  /// the end.
  const cl::Buffer& positions() const { return positions_; }

  /// The centres of the seeds' pixels, (NaN, NaN) for a seed that is absent. Waits. Throws Error if a point
  /// of the caller's buffer was bad.
  std::vector<Point> read() const;

  /// Throws Error if a point of the caller's buffer was bad. Waits for it.
  void check() const;

 private:
  struct DeferredCheck;
  Seeds(const Device& device, const Grid& grid, std::size_t size);
  void resize(std::size_t size);
  void upload(std::vector<std::uint32_t> positions);
  void snap_on_device(const cl::Buffer& points);

  Device device_;
  Grid grid_;
  std::size_t size_ = 0;
  std::size_t alive_ = 0;
  std::uint64_t vanishings_ = 0;
  cl::Buffer positions_;
  std::vector<bool> present_;                // by id
  std::shared_ptr<DeferredCheck> deferred_;  // null unless the points came in the caller's buffer
};

}  // namespace vorocl
