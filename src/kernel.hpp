// A kernel ready to launch: over the runs of a grid, or over a list of items.
#pragma once

#include <CL/opencl.hpp>
#include <cstddef>
#include <string>
#include <type_traits>

#include "opencl_error.hpp"
#include "vorocl/device.hpp"
#include "vorocl/grid.hpp"

namespace vorocl {

/// Spare values before and behind the pixels of an image that waves read at an offset (see vector.cl).
constexpr std::size_t guard = 16;

/// What kernels are specialised for when they are built, besides the vector width. Kernels that read no
/// distance or no neighbours are the same for all.
struct KernelOptions {
  Metric metric = Metric::euclidean;
  Neighbourhood neighbourhood = Neighbourhood::moore;
};

/// Made per call, never shared between threads: an OpenCL kernel object holds its arguments.
class Kernel {
 public:
  /// The kernel `name` of a kernel file, built for the device's vector width, or less where a row is shorter
  /// than that.
  Kernel(const Device& device, const std::string& file, const std::string& name, const Grid& grid,
         const KernelOptions& options = {});

  /// Work-groups of this many items for over_items(), however few the items are. (PoCL
  /// compiles a kernel again for each size.)
  Kernel& in_groups_of(std::size_t items) {
    group_ = items;
    return *this;
  }

  /// Enqueues one work-item a run of every row, with these arguments. Work-items outside the grid must
  /// return.
  template <typename... Arguments>
  cl::Event over_grid(const Arguments&... arguments) {
    set_arguments(0, arguments...);
    return enqueue_over_grid();
  }

  /// Enqueues `count` work-items (rounded up: those past the count must return), with these arguments.
  /// Enqueues nothing for a count of 0.
  template <typename... Arguments>
  cl::Event over_items(std::size_t count, const Arguments&... arguments) {
    set_arguments(0, arguments...);
    return enqueue_over_items(count);
  }

 private:
  void set_arguments(cl_uint) {}
  template <typename First, typename... Rest>
  void set_arguments(cl_uint index, const First& first, const Rest&... rest) {
    check(set_argument(index, first), "setting argument " + std::to_string(index) + " of " + name_);
    set_arguments(index + 1, rest...);
  }
  cl_int set_argument(cl_uint index, const cl::Buffer& buffer) {
    return clSetKernelArg(kernel_(), index, sizeof(cl_mem), &buffer());
  }
  template <typename T>
  cl_int set_argument(cl_uint index, const T& value) {
    static_assert(std::is_arithmetic_v<T> || std::is_union_v<T>, "a number or a vector such as cl_uint2");
    return clSetKernelArg(kernel_(), index, sizeof(T), &value);
  }
  cl::Event enqueue_over_grid();
  cl::Event enqueue_over_items(std::size_t count);
  cl::Event enqueue(cl_uint dimensions, const std::size_t* global, const std::size_t* local);

  Device device_;
  std::string name_;
  Grid grid_;
  int run_width_;          // pixels that one work-item computes
  std::size_t group_ = 0;  // work-items of a group over items; 0: the usual ones, less for few items
  cl::Kernel kernel_;
};

}  // namespace vorocl
