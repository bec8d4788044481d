// One frame of seeds, as the diagrams and results that were made from it remember it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>

#include "core/outer_seeds.hpp"
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

  /// Enqueues that nothing is found yet.
  void reset();

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

/// Nothing of it changes.
struct SeedsFrame {
  Device device;
  Grid grid;
  std::size_t size = 0;
  std::size_t absent = 0;        // known to the host; not those that the check counts
  std::uint64_t owner = 0;       // the Seeds object it is of: no two have the same number
  std::uint64_t vanishings = 0;  // how many frames, up to this one, may have lost a seed of the frame before
  std::shared_ptr<const PointCheck> points = nullptr;  // none unless the points came in the caller's buffer
  bool marked = false;                                 // a buffer said which seeds are present
  std::shared_ptr<const OuterSeeds> outer = nullptr;   // none: all seeds lie in the pixels

  /// The seeds that are there. Waits for the device if they are marked. A bad point is not absent.
  std::size_t alive() const;

  /// Throws BadPoint if there was one. May wait for the device.
  void check() const;

  /// Throws Error if there are outer seeds, for something ("jump flooding") that does not know them.
  void refuse_outer_seeds(const char* what) const;
};

}  // namespace vorocl
