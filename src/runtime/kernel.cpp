#include "runtime/kernel.hpp"

#include <cstring>

#include "runtime/device_state.hpp"
#include "runtime/metric.hpp"
#include "runtime/program.hpp"

namespace vorocl {

namespace {

int vector_width_for(const Device& device, const PixelGrid& grid) {
  int width = device.tuning().vector_width;
  while (width > grid.width()) width /= 2;
  return width;
}

/// Whether there may be two images of a seed in the surroundings of a bin: see exact/sizes.cl.
bool has_short_period(const PixelGrid& grid) {
  constexpr int surroundings = 64;
  return (grid.periodic_x() && grid.width() < surroundings) ||
         (grid.periodic_y() && grid.height() < surroundings);
}

std::string build_options(int vector_width, const PixelGrid& grid, const KernelOptions& options) {
  return "-cl-std=CL1.2 -DVOROCL_WIDTH=" + std::to_string(vector_width) +
         " -DVOROCL_GUARD=" + std::to_string(guard) + build_option(options.metric) +
         (options.neighbourhood == Neighbourhood::moore ? " -DVOROCL_NEIGHBOURS=9"
                                                        : " -DVOROCL_NEIGHBOURS=5") +
         (options.extent != Extent::grid ? " -DVOROCL_OUTER_SEEDS" : "") +
         (options.extent == Extent::far ? " -DVOROCL_FAR" : "") +
         (grid.periodic_x() ? " -DVOROCL_PERIODIC_X" : "") +
         (grid.periodic_y() ? " -DVOROCL_PERIODIC_Y" : "") +
         (has_short_period(grid) ? " -DVOROCL_SHORT_PERIOD" : "");
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

Kernel::Kernel(const Device& device, const char* file, const char* name, const PixelGrid& grid,
               const KernelOptions& options)
    : device_(device),
      file_(file),
      name_(name),
      grid_(grid),
      options_(options),
      vector_width_(vector_width_for(device, grid)) {
  const cl::Program program = program_for(device, file, build_options(vector_width_, grid, options));
  cl_int code = CL_SUCCESS;
  kernel_ = cl::Kernel(clCreateKernel(program(), name, &code));
  check(code, [&] { return "making the kernel " + std::string(name_); });
}

void Kernel::set_argument(std::size_t index, const void* value, std::size_t size) {
  check(clSetKernelArg(kernel_(), static_cast<cl_uint>(index), size, value),
        [&] { return "setting argument " + std::to_string(index) + " of " + name_; });
}

void Kernel::set_number(std::size_t index, const void* value, std::size_t size) {
  if (index >= numbers_.size()) numbers_.resize(index + 1);
  Number& number = numbers_[index];
  if (number.size == size && std::memcmp(number.bytes.data(), value, size) == 0) return;
  number.size = 0;  // until it is set: a failure leaves it unknown
  set_argument(index, value, size);
  std::memcpy(number.bytes.data(), value, size);
  number.size = size;
}

cl::Event Kernel::enqueue_over_grid() {
  const Tuning& tuning = device_.tuning();
  const auto width = static_cast<std::size_t>(vector_width_);
  const std::size_t vectors = (static_cast<std::size_t>(grid_.width()) + width - 1) / width;
  const auto rows = static_cast<std::size_t>(grid_.height());
  const std::size_t local[] = {group_size(tuning.group_width, vectors),
                               group_size(tuning.group_height, rows)};
  const std::size_t global[] = {round_up(vectors, local[0]), round_up(rows, local[1])};
  return enqueue(2, global, local);
}

cl::Event Kernel::enqueue_over_items(std::size_t count) {
  const std::size_t usual = device_.tuning().group_width * device_.tuning().group_height;
  const std::size_t local = group_ != 0 ? group_ : group_size(usual, count);
  const std::size_t global = round_up(count, local);
  return enqueue(1, &global, &local);
}

cl::Event Kernel::enqueue(cl_uint dimensions, const std::size_t* global, const std::size_t* local) {
  cl::Event event;
  check(clEnqueueNDRangeKernel(device_.queue()(), kernel_(), dimensions, nullptr, global, local, 0, nullptr,
                               &event()),
        [&] { return "launching " + std::string(name_) + " on " + device_.name(); });
  Internal::state(device_).enqueued(event);
  return event;
}

bool Kernel::is_for(const Device& device, const PixelGrid& grid) const {
  const Tuning &own = device_.tuning(), &other = device.tuning();
  return grid_ == grid && device_.same_as(device) && own.vector_width == other.vector_width &&
         own.group_width == other.group_width && own.group_height == other.group_height;
}

Kernel& KernelSet::get(const Device& device, const char* file, const char* name, const PixelGrid& grid,
                       const KernelOptions& options) {
  for (Kernel& kernel : kernels_) {
    if (std::strcmp(kernel.name_, name) != 0 || std::strcmp(kernel.file_, file) != 0) continue;
    if (!(kernel.options_ == options)) continue;
    if (!kernel.is_for(device, grid)) kernel = Kernel(device, file, name, grid, options);
    return kernel;
  }
  kernels_.emplace_back(device, file, name, grid, options);
  return kernels_.back();
}

}  // namespace vorocl
