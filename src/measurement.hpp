// What the measurements of a diagram share: their buffers, and the blocks that their work-items
// walk through (see runs.cl).
#pragma once

#include <CL/opencl.hpp>
#include <chrono>
#include <string>

#include "kernel.hpp"
#include "vorocl/diagram.hpp"
#include "vorocl/report.hpp"
#include "vorocl/seeds.hpp"

namespace vorocl {

/// Makes the buffer of a result, unless there is one of this device that is large enough.
void make_room(cl::Buffer& buffer, const Device& device, std::size_t bytes);

/// The blocks of a grid, one a work-item.
class Blocks {
 public:
  Blocks(const Device& device, const Grid& grid);

  /// Blocks have 2^wide columns and 2^high rows: at most 512 of each, and 2^15 pixels (see cells.cl).
  int wide() const { return wide_; }
  int high() const { return high_; }
  std::size_t count() const { return count_; }

  /// Enqueues a kernel that starts with take_block().
  template <typename... Arguments>
  cl::Event run(const char* file, const char* name, const Arguments&... arguments) const {
    return Kernel(device_, file, name, grid_).over_items(count_, arguments...);
  }

  /// As above, for a metric.
  template <typename... Arguments>
  cl::Event run(Metric metric, const char* file, const char* name, const Arguments&... arguments) const {
    return Kernel(device_, file, name, grid_, {metric}).over_items(count_, arguments...);
  }

 private:
  Device device_;
  Grid grid_;
  int wide_, high_;
  std::size_t count_;
};

/// Runs from its making to the report of what was enqueued in between.
class Stopwatch {
 public:
  Report report(const Device& device, const cl::Event& first, const cl::Event& last) const;

 private:
  std::chrono::steady_clock::time_point started_ = std::chrono::steady_clock::now();
};

}  // namespace vorocl
