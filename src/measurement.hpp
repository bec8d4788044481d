// What the measurements of a diagram share: their buffers, and the blocks that their work-items
// walk through (see runs.cl).
#pragma once

#include <string>

#include "diagram_state.hpp"
#include "vorocl/opencl.hpp"
#include "vorocl/report.hpp"

namespace vorocl {

/// Makes the buffer of a result, unless there is one of this device that is large enough.
void make_room(cl::Buffer& buffer, const Device& device, std::size_t bytes);

/// What all results hold: the frame of the seeds that was measured, and the kernels that measured it. Null
/// before the first measurement, and while one is being made: a result that failed is empty.
struct Measured {
  std::shared_ptr<const SeedsFrame> seeds;
  KernelSet kernels;

  std::size_t size() const { return seeds ? seeds->size : 0; }
};

/// The frame of seeds that fit the diagram. Throws Error if they do not.
std::shared_ptr<const SeedsFrame> frame_of(const Seeds& seeds, const Diagram& diagram);

/// What an accessor of an empty result returns.
const cl::Buffer& no_buffer();

/// The blocks of a grid, one per work-item.
class Blocks {
 public:
  Blocks(const Device& device, const Grid& grid);

  /// Blocks have 2^wide columns and 2^high rows: at most 512 of each, and 2^15 pixels (see cells.cl).
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
