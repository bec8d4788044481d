// Seeds: points on the pixels of a grid, on the device.
#pragma once

#include <cstdint>
#include <initializer_list>
#include <optional>
#include <vector>

#include "vorocl/device.hpp"
#include "vorocl/export.h"
#include "vorocl/grid.hpp"
#include "vorocl/opencl.hpp"
#include "vorocl/own_state.hpp"
#include "vorocl/points.hpp"

namespace vorocl {

struct SeedsState;

/// What becomes of a point outside the grid, along an axis that is not periodic.
enum class Outside {
  count,   ///< it is a seed, which owns those of the grid's pixels that are nearest to it
  absent,  ///< its seed is absent
  refuse,  ///< BadPoint
};

/// What becomes of a point within its pixel.
enum class Snap {
  to_pixels,  ///< its seed lies at the pixel's centre: of those in one pixel the lowest id owns the cell
  none,       ///< exact diagrams take the point itself, rounded to 1/4096 of a pixel along each axis
};

/// How points become seeds, in all frames.
struct SeedsOptions {
  Outside outside = Outside::count;
  Snap snap = Snap::none;
};

/// The seeds of a diagram, in their present frame. A seed's id is its index in the caller's list. A seed may
/// be absent: it has an id and no cell. A seed lies in the pixel of its point (Axis::pixel()). Seeds that
/// share a pixel are allowed: the lowest id owns the cell, the others have empty cells.
///
/// With Snap::none an exact diagram is exact for the points themselves, each rounded to 1/4096 of a pixel of
/// the grid, once and never out of its pixel: several of one pixel may own pixels then, and measures take the
/// same positions. Flooding methods snap, so that all measures of a flooded diagram take the centres of the
/// pixels (Report::snapped()): what judges it by an exact diagram wants that of seeds with Snap::to_pixels.
/// random(), from_mask() and random_step() make whole pixels; points that seeds of random() and from_mask()
/// move to later are taken as with Snap::none.
///
/// Points with weights (Points::weighted()) are those of power diagrams. Exact diagrams and exact cells know
/// them, of points on the host, by the Euclidean metric. Diagrams need Snap::none and pixels that are squares
/// or cubes in the units of the data, to 1 %, and round weights to 2^-11 squared pixels. They may differ by
/// at most 2^20 squared pixels, unless the grid is so small that a seed that lies farther behind owns no
/// pixel. Where all are the same they are none. Seeds that own no pixel are usual there, and need not lie in
/// their cells; measures take distances as without weights. Motions at random, relaxation, tiles and methods
/// that flood throw Error.
///
/// Points are in the units of the data; along periodic axes they wrap. Exact diagrams and the measures know
/// seeds outside a diagram's window, and every window of a grid; flooding methods need a window that is the
/// whole grid, which is not tilted, and holds all seeds, and periods of at most 32,000 pixels.
///
/// In a volume, and in a plane with an axis that is spaced, all seeds lie in the grid: points outside it are
/// absent or refused, with Outside::count too.
///
/// Memory: on the device 4 bytes per seed and frame that is remembered, 8 more of points with Snap::none, 16
/// of those in volumes, and those of its point where that came from the caller; two or three times as much in
/// a loop over frames. Where a diagram's window does not hold all seeds 8 more, and 12 for each seed and
/// image that may own a pixel, which the host finds. On the host 16 or 24 bytes per seed whose point came
/// from there, and 16 more where the host places it. A weight takes 8 bytes on the host, and 4 there and on
/// the device once a diagram is made.
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
  /// From points on the host. The options hold for all frames. Throws BadPoint naming the first point that is
  /// NaN, infinite, refused, or counts and is 2^31 pixels or more away from a pixel of the grid along an
  /// axis, before any device work. No points at all are allowed. Throws Error if the grid is a volume and the
  /// points have no z, or if the weight of a point that is there is not finite.
  Seeds(const Device& device, const Grid& grid, const Points& points, const SeedsOptions& options = {});
  Seeds(const Device& device, const Grid& grid, std::initializer_list<Point> points,
        const SeedsOptions& options = {});

  /// From the caller's buffers, which are read when the device comes to it. Throws Error if a buffer is too
  /// small, of another context or not readable by kernels, or the points' buffer is null.
  ///
  /// On a grid that one diagram can show whole, a kernel places the points. The call returns at once, and the
  /// BadPoint that names a bad one comes at the wait of every diagram and result that is made from this
  /// frame. But where points may lie outside and count, the call waits to know whether one does, and throws
  /// BadPoint itself.
  ///
  /// The host reads and places points if one lies outside and counts, on larger grids, along periods of more
  /// than 32,000 pixels, and where the device has no doubles (cl_khr_fp64): the call waits.
  Seeds(const Device& device, const Grid& grid, const PointBuffer& points, const SeedsOptions& options = {});

  /// From an image of the grid's size, row-major: each non-zero pixel is a seed; ids in row-major order. That
  /// of a volume is slice after slice.
  /// Throws Error if the size is another or the grid is larger than a diagram can be.
  static Seeds from_mask(const Device& device, const Grid& grid, const std::vector<std::uint8_t>& mask);

  /// As above, from a byte per pixel in a buffer of the same context. Waits, for the number of seeds.
  static Seeds from_mask(const Device& device, const Grid& grid, const cl::Buffer& mask);

  /// `count` uniformly random pixels, made on the device (Philox-4x32-10 keyed by the rng seed and the seed's
  /// id): the same on every device. Several seeds may fall on one pixel. Throws Error if the grid is larger
  /// than a diagram can be.
  static Seeds random(const Device& device, const Grid& grid, std::size_t count, std::uint64_t rng_seed);

  /// The same seeds once more, to be moved on their own. Enqueues and returns.
  Seeds clone() const;

  /// Moves the seeds to new points: a new frame. The number of seeds may change: ids past the end are absent.
  /// Checks as the constructor. Seeds with weights go to points with weights. If it throws, the seeds are
  /// where they were.
  void move_to(const Points& points);
  void move_to(std::initializer_list<Point> points);
  void move_to(const PointBuffer& points);

  /// As above, on another grid, such as the box of a simulation that changes.
  void move_to(const Grid& grid, const Points& points);

  const Device& device() const;
  const Grid& grid() const;
  std::size_t size() const;

  /// The seeds that are not absent. Where points came in a buffer, this may wait for the device.
  std::size_t alive() const;

  /// How many seeds lie outside the grid.
  std::size_t outside() const;

  /// The greatest way of a seed that is in the last frame and in this one, along an axis, in pixels, the
  /// shorter way round along a periodic axis, from pixel to pixel: the paper's d_max. 0 in the first frame
  /// and after a move to another grid. After random_step() its bound. May wait, for the device finds it.
  double displacement() const;

  /// The points as they were given, or the centres of their pixels where they were made or moved by kernels;
  /// none for a seed that is absent. Waits where the device has them. Throws BadPoint if a point of
  /// the caller's buffer was bad.
  std::vector<std::optional<Point>> read() const;

  /// The seeds' positions in pixels from the grid's first one, as diagrams take them: the centres of their
  /// pixels, or whole numbers of 1/4096 with Snap::none. As read().
  std::vector<std::optional<Point>> read_pixels() const;

  /// Throws BadPoint if a point of the caller's buffer was bad. Waits for it.
  void check() const;

 private:
  friend struct Internal;
  explicit Seeds(OwnState<SeedsState> state);
  SeedsState& state() const;
  OwnState<SeedsState> state_;
};

}  // namespace vorocl
