#include "kernel.hpp"

#include <algorithm>

#include "program.hpp"

namespace vorocl {

namespace {

int run_width_for(const Device& device, const Grid& grid) {
  int width = device.tuning().vector_width;
  while (width > grid.width()) width /= 2;
  return width;
}

std::string build_options(int run_width, const KernelOptions& options) {
  return "-cl-std=CL1.2 -DVOROCL_WIDTH=" + std::to_string(run_width) +
         " -DVOROCL_GUARD=" + std::to_string(guard) +
         (options.metric == Metric::euclidean ? " -DVOROCL_EUCLIDEAN" : " -DVOROCL_MANHATTAN") +
         (options.neighbourhood == Neighbourhood::moore ? " -DVOROCL_NEIGHBOURS=9"
                                                        : " -DVOROCL_NEIGHBOURS=5");
}

std::size_t round_up(std::size_t count, std::size_t multiple) {
  return (count + multiple - 1) / multiple * multiple;
}

/// The wanted size, halved while that still covers the count: a small launch needs no large group.
std::size_t group_size(std::size_t wanted, std::size_t count) {
  while (wanted % 2 == 0 && wanted / 2 >= count) wanted /= 2;
  return wanted;
}

}  // namespace

Kernel::Kernel(const Device& device, const std::string& file, const std::string& name, const Grid& grid,
               const KernelOptions& options)
    : device_(device), name_(name), grid_(grid), run_width_(run_width_for(device, grid)) {
  cl_int code = CL_SUCCESS;
  kernel_ = cl::Kernel(
      clCreateKernel(program_for(device, file, build_options(run_width_, options))(), name.c_str(), &code));
  check(code, "making the kernel " + name);
}

cl::Event Kernel::enqueue_over_grid() {
  const Tuning& tuning = device_.tuning();
  const auto width = static_cast<std::size_t>(run_width_);
  const std::size_t runs = (static_cast<std::size_t>(grid_.width()) + width - 1) / width;
  const auto rows = static_cast<std::size_t>(grid_.height());
  const std::size_t local[] = {group_size(tuning.group_width, runs), group_size(tuning.group_height, rows)};
  const std::size_t global[] = {round_up(runs, local[0]), round_up(rows, local[1])};
  return enqueue(2, global, local);
}

cl::Event Kernel::enqueue_over_items(std::size_t count) {
  if (count == 0) return {};
  const std::size_t usual = device_.tuning().group_width * device_.tuning().group_height;
  const std::size_t local = group_ != 0 ? group_ : group_size(usual, count);
  const std::size_t global = round_up(count, local);
  return enqueue(1, &global, &local);
}

cl::Event Kernel::enqueue(cl_uint dimensions, const std::size_t* global, const std::size_t* local) {
  cl::Event event;
  check(clEnqueueNDRangeKernel(device_.queue()(), kernel_(), dimensions, nullptr, global, local, 0, nullptr,
                               &event()),
        "launching " + name_ + " on " + device_.name());
  return event;
}

}  // namespace vorocl
