// What the measurements of a diagram share: their buffers, and the blocks that their work-items
// walk through (see runs.cl).
#pragma once

#include <memory>

#include "core/diagram_state.hpp"
#include "vorocl/opencl.hpp"
#include "vorocl/report.hpp"

namespace vorocl {

/// Makes the buffer of a result, unless there is one of this device that is large enough.
void make_room(cl::Buffer& buffer, const Device& device, std::size_t bytes);

/// The frames that a measurement depends on: a bad point in either makes it wrong.
struct MeasuredFrames {
  std::shared_ptr<const SeedsFrame> seeds;   // that were measured; null where a measurement takes none
  std::shared_ptr<const SeedsFrame> labels;  // that the diagram was made from; null if no engine made it

  /// Throws BadPoint if either had one. May wait for the device.
  void check() const;
};

/// Those of a diagram, and of seeds that fit it. Throws Error if they do not.
MeasuredFrames frames_of(const Diagram& diagram);
MeasuredFrames frames_of(const Seeds& seeds, const Diagram& diagram);

/// What all results of cells hold: the frames that were measured, and the kernels that measured them. There
/// are no frames before the first measurement, and while one is being made: a result that failed is empty.
struct Measured {
  MeasuredFrames frames;
  KernelSet kernels;

  bool empty() const { return !frames.seeds; }
  std::size_t size() const { return empty() ? 0 : frames.seeds->size; }
};

/// A buffer of a result, null if it is empty.
template <typename State>
const cl::Buffer& buffer_of(const std::unique_ptr<State>& state, cl::Buffer State::*buffer) {
  static const cl::Buffer none;
  return state && !state->empty() ? (*state).*buffer : none;
}

/// The blocks of a grid, one per work-item.
class Blocks {
 public:
  Blocks(const Device& device, const Grid& grid);

  /// Blocks have 2^wide columns and 2^high rows.
  int wide() const { return wide_; }
  int high() const { return high_; }
  std::size_t count() const { return count_; }

  /// Enqueues a kernel that starts with take_block().
  template <typename... Arguments>
  cl::Event run(KernelSet& kernels, const char* file, const char* name, const KernelOptions& options,
                const Arguments&... arguments) const {
    return kernels.get(device_, file, name, grid_, options).over_items(count_, arguments...);
  }

 private:
  Device device_;
  Grid grid_;
  int wide_, high_;
  std::size_t count_;
};

/// Starts what was enqueued since the stopwatch was made, and reports it.
Report report_of(const Stopwatch& stopwatch, const Device& device, const cl::Event& first,
                 const cl::Event& last);

}  // namespace vorocl
