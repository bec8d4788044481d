// One frame of seeds, as the diagrams and results that were made from it remember it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "core/placement.hpp"
#include "core/snapping.hpp"
#include "vorocl/device.hpp"
#include "vorocl/error.hpp"
#include "vorocl/grid.hpp"
#include "vorocl/opencl.hpp"

namespace vorocl {

/// What the device finds out about points in the caller's buffers, read back when somebody asks. One for each
/// frame that came in such buffers.
class PointCheck {
 public:
  explicit PointCheck(const Device& device);

  /// What the kernel fills: see kernels/core/place_sizes.cl.
  const cl::Buffer& found() const { return found_; }

  /// Enqueues that nothing is found yet. Lets go of the points.
  void reset(const Snapping& snapping);

  /// Takes the bad point from these.
  void read_from(const PointsThere& points) { points_ = points; }

  /// The bad point, if there is one. Waits for the device at its first call.
  const std::optional<BadPoint>& bad_point() const;

  /// How many seeds are absent, and outside the grid where they count. Waits likewise.
  std::size_t absent() const;
  std::size_t outside() const;

 private:
  void read() const;

  Device device_;
  cl::Buffer found_;
  std::optional<Snapping> snapping_;
  PointsThere points_;
  mutable std::mutex mutex_;  // a frame may be remembered by objects of several threads
  mutable bool known_ = false;
  mutable std::optional<BadPoint> bad_point_;
  mutable std::size_t absent_ = 0, outside_ = 0;
};

/// How far seeds went from frame to frame, as far as the host knows without asking the device.
struct Way {
  double last = 0;            // along an axis, in pixels, in the last move
  double all = 0;             // the sum over the moves of this stretch
  std::uint64_t stretch = 0;  // a new one begins with each move that only the device knows
};

struct Marks;
struct GlobeSeeds;

/// What weights are to diagrams: by id, how far each lies below the greatest one, in 2^-11 squared pixels.
struct Lags {
  std::vector<cl_int> of_seeds;
  cl::Buffer there;  // the same on the device
};

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

  GivenPoints given = {};  // none where they came in a buffer, or seeds were made or moved otherwise
  PointsThere there = {};  // a copy of those that came in a buffer; likewise

  /// The places, by id, from the grid's first pixel on; null where the device has placed the seeds.
  std::shared_ptr<const std::vector<Place>> listed = nullptr;

  /// The marks whose numbers are the ids; null unless the seeds were made from a mask.
  std::shared_ptr<const Marks> marks = nullptr;

  std::shared_ptr<const std::vector<double>> weights = nullptr;  // by id; null: none were given

  /// Whether its points are not snapped: an engine may do that.
  bool is_off_centre = false;

  /// Whether diagrams take the places of the seeds: those of points, and all in a tilted grid, where images
  /// do not lie in the middle of pixels. Else the seeds lie in the middle of theirs.
  bool are_points() const { return is_off_centre || grid.is_tilted(); }

  /// All of the grid in a diagram, made with the frame; null if that is not possible, or goes beyond it.
  std::shared_ptr<const Placement> whole = nullptr;

  /// The frame before (which does not remember its own), where the host does not know how far the seeds went.
  std::shared_ptr<const SeedsFrame> before = nullptr;

  std::shared_ptr<Placements> placements = nullptr;  // of other windows, and of points

  /// The seeds that are there. Waits for the device if it counts them. A bad point is not absent.
  std::size_t alive() const;

  /// Throws BadPoint if there was one. May wait for the device.
  void check() const;

  /// Where the seeds lie in a window of the grid that shows these pixels. Made at the first question, from
  /// places() where the window is not the whole grid.
  std::shared_ptr<const Placement> place_in(const Window& window, const PixelGrid& shown) const;

  /// The same as places, where are_points() or the frame goes beyond the window.
  std::shared_ptr<const PointPlacement> place_points_in(const Window& window, const PixelGrid& shown) const;

  /// Null without weights, and if all are the same. Throws Error if diagrams cannot take them.
  std::shared_ptr<const Lags> lags() const;

  /// The seeds on the globe: see globe/globe.hpp.
  std::shared_ptr<const GlobeSeeds> on_globe() const;

  /// The greatest way of a seed along an axis to this frame from an earlier one. May wait.
  double way_from(const SeedsFrame& earlier) const;

  /// The same from the frame before.
  double way_of_last_move() const;

  /// The places of seeds in a plane. The host finds those of the points that it has, and waits for the device
  /// where it has none.
  std::shared_ptr<const std::vector<Place>> places() const;

  /// The positions in pixels from the grid's first one, as diagrams take them; none for a seed that is
  /// absent. Waits.
  std::vector<std::optional<Point>> read_positions() const;

  /// The points as they were given, or the places of seeds that have none; likewise.
  std::vector<std::optional<Point>> read_given() const;
};

std::shared_ptr<Placements> no_placements();

/// Throws Error if the seeds have weights, for something ("jump flooding") that does not know them.
void refuse_weights(const SeedsFrame& frame, const std::string& what);

/// Adds the places of points on the host to a list. Those that count have been checked.
void add_places(const Grid& grid, const GivenPoints& points, std::size_t count, Snap snap,
                std::vector<Place>& places);

/// The greatest way along an axis between the pixels of one frame and another, for seeds present in both.
double greatest_way(const Grid& grid, const std::vector<Place>& from, const std::vector<Place>& to);

/// A place in pixels.
inline Point in_pixels(const Place& place) {
  constexpr double units = fractions_of_pixel;
  return {static_cast<double>(place.x) / units, static_cast<double>(place.y) / units, 0.5};
}

/// Throws Error if seeds lie outside a diagram's window, or across the ends of its periods, or the grid is
/// tilted, for something
/// ("jump flooding") that does not know them.
void refuse_seeds_beyond(const Placement& placement, const SeedsFrame& frame, const char* what);

}  // namespace vorocl
