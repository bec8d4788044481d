// One frame of seeds, as the diagrams and results that were made from it remember it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <vector>

#include "core/placement.hpp"
#include "core/point_placement.hpp"
#include "vorocl/device.hpp"
#include "vorocl/error.hpp"
#include "vorocl/grid.hpp"
#include "vorocl/opencl.hpp"

namespace vorocl {

/// What the device finds out about points in the caller's buffers, read back when somebody asks. One for each
/// frame that came in such buffers.
class PointCheck {
 public:
  PointCheck(const Device& device, const Grid& grid);

  /// Four uint32 that seeds.cl fills: the least index of a bad point, or no_label; the bits of its x and y;
  /// how many seeds are absent.
  const cl::Buffer& found() const { return found_; }

  /// Enqueues that nothing is found yet, of points on a grid.
  void reset(const Grid& grid);

  /// The bad point, if there is one. Waits for the device at its first call.
  const std::optional<BadPoint>& bad_point() const;

  /// How many seeds are absent. Waits likewise.
  std::size_t absent() const;

 private:
  void read() const;

  Device device_;
  Grid grid_;
  cl::Buffer found_;
  mutable std::mutex mutex_;  // a frame may be remembered by objects of several threads
  mutable bool known_ = false;
  mutable std::optional<BadPoint> bad_point_;
  mutable std::size_t absent_ = 0;
};

/// How far seeds went from frame to frame, as far as the host knows without asking the device.
struct Way {
  double last = 0;            // along an axis, in pixels, in the last move
  double all = 0;             // the sum over the moves of this stretch
  std::uint64_t stretch = 0;  // a new one begins with each move that only the device knows
};

struct Marks;

/// The placements of a frame in windows that were asked for.
class Placements;

/// Nothing of it changes, but that placements are made when they are first asked for.
struct SeedsFrame {
  Device device;
  Grid grid;
  std::size_t size = 0;
  std::size_t absent = 0;    // known to the host; not those that the check counts
  std::size_t outside = 0;   // the grid
  std::uint64_t owner = 0;   // the Seeds object it is of: no two have the same number
  std::uint64_t losses = 0;  // how many frames, up to this one, may have lost a seed of the frame before
  Way way = {};
  std::shared_ptr<const PointCheck> points = nullptr;  // none unless the points came in the caller's buffer
  bool counted_there = false;                          // the check counts seeds that are absent

  /// The points as they were given, by id; null where the device has placed the seeds.
  std::shared_ptr<const std::vector<Point>> given = nullptr;

  /// The pixels, by id, counted from the grid's first one; null where the device has placed the seeds.
  std::shared_ptr<const std::vector<PlanePosition>> pixels = nullptr;

  /// Where in these pixels the points lie; null if the seeds are snapped to the centres of an untilted
  /// grid's.
  std::shared_ptr<const std::vector<Fraction>> fractions = nullptr;

  /// The marks whose numbers are the ids; null unless the seeds were made from a mask.
  std::shared_ptr<const Marks> marks = nullptr;

  /// Whether its points are not snapped: an engine may do that.
  bool is_off_centre = false;

  /// All of the grid in a diagram, made with the frame; null if that is not possible, or needs outer seeds.
  std::shared_ptr<const Placement> whole = nullptr;

  /// The frame before (which does not remember its own), where the host does not know how far the seeds went.
  std::shared_ptr<const SeedsFrame> before = nullptr;

  std::shared_ptr<Placements> placements = nullptr;  // of other windows, and of points

  /// Whether a seed may be absent, as far as the host knows.
  bool may_lack_some() const { return absent > 0 || counted_there; }

  /// The seeds that are there. Waits for the device if it counts them. A bad point is not absent.
  std::size_t alive() const;

  /// Throws BadPoint if there was one. May wait for the device.
  void check() const;

  /// Where the seeds lie in a window of the grid, of which these pixels are shown. Made at the first
  /// question; then the host waits if the device has placed the seeds.
  std::shared_ptr<const Placement> place_in(const Window& window, const PixelGrid& shown) const;

  /// The same of points with fractions.
  std::shared_ptr<const PointPlacement> place_points_in(const Window& window, const PixelGrid& shown) const;

  /// The greatest way of a seed along an axis to this frame from an earlier one. May wait.
  double way_from(const SeedsFrame& earlier) const;

  /// The same from the frame before.
  double way_of_last_move() const;

  /// The position in pixels of a plane's seed in this pixel: of its point, or the pixel's centre.
  Point position(std::size_t id, const PlanePosition& pixel) const {
    const Fraction& in = fractions ? (*fractions)[id] : centre_of_pixel;
    return {pixel.s[0] + static_cast<double>(in.x) / fractions_of_pixel,
            pixel.s[1] + static_cast<double>(in.y) / fractions_of_pixel, 0.5};
  }

  /// The pixels, from the device where the host has none. Waits.
  std::vector<PlanePosition> read_pixels() const;

  /// The positions in pixels from the grid's first one, as diagrams take them; none for a seed that is
  /// absent. Waits.
  std::vector<std::optional<Point>> read_positions() const;
};

std::shared_ptr<Placements> no_placements();

/// The greatest way along an axis between the pixels of one frame and another, for seeds present in both.
/// `some_absent`: whether there may be others.
double greatest_way(const Grid& grid, const std::vector<PlanePosition>& from,
                    const std::vector<PlanePosition>& to, bool some_absent);

/// Throws Error if seeds lie outside a diagram's window, or across the ends of its periods, or the grid is
/// tilted, for something
/// ("jump flooding") that does not know them.
void refuse_outer_seeds(const Placement& placement, const SeedsFrame& frame, const char* what);

}  // namespace vorocl
