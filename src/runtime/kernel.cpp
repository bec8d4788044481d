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

std::string spacing_of_volume(const PixelGrid& grid) {
  if (!grid.is_spaced()) return "";
  const auto [x, y, z] = grid.spacing();
  return " -DVOROCL_SPACING_X=" + std::to_string(x) + " -DVOROCL_SPACING_Y=" + std::to_string(y) +
         " -DVOROCL_SPACING_Z=" + std::to_string(z);
}

std::string bits_of_volume(const PixelGrid& grid) {
  if (!grid.has_voxels()) return "";
  const VoxelBits bits(grid);
  return " -DVOROCL_DIMENSIONS=3 -DVOROCL_BITS_X=" + std::to_string(bits.x) +
         " -DVOROCL_BITS_Y=" + std::to_string(bits.y) + " -DVOROCL_BITS_Z=" + std::to_string(bits.z);
}

std::string periodic_axes(const PixelGrid& grid, bool any_axes) {
  if (any_axes) return grid.is_periodic() ? " -DVOROCL_PERIODIC=1" : "";
  return std::string(grid.periodic_x() ? " -DVOROCL_PERIODIC_X" : "") +
         (grid.periodic_y() ? " -DVOROCL_PERIODIC_Y" : "") +
         (grid.periodic_z() ? " -DVOROCL_PERIODIC_Z" : "");
}

std::string build_options(int vector_width, const PixelGrid& grid, const KernelOptions& options) {
  return "-cl-std=CL1.2 -DVOROCL_WIDTH=" + std::to_string(vector_width) +
         " -DVOROCL_GUARD=" + std::to_string(guard) + build_option(options.metric) +
         (options.neighbourhood == Neighbourhood::moore ? " -DVOROCL_NEIGHBOURS=9"
                                                        : " -DVOROCL_NEIGHBOURS=5") +
         (options.extent >= Extent::far ? " -DVOROCL_FAR" : "") +
         (options.extent == Extent::fractions ? " -DVOROCL_FRACTIONS" : "") +
         (options.weighted ? " -DVOROCL_WEIGHTED" : "") + (options.flat ? " -DVOROCL_FLAT" : "") +
         (options.tilted ? " -DVOROCL_TILTED" : "") + periodic_axes(grid, options.any_axes) +
         bits_of_volume(grid) + spacing_of_volume(grid);
}

std::size_t round_up(std::size_t count, std::size_t multiple) {
  return (count + multiple - 1) / multiple * multiple;
}

}  // namespace

Device without_vectors(const Device& device) {
  Tuning tuning = device.tuning();
  tuning.vector_width = 1;
  return device.with_tuning(tuning);
}

Kernel::Kernel(const Device& device, const char* file, const char* name, const PixelGrid& grid,
               const KernelOptions& options)
    : device_(device),
      file_(file),
      name_(name),
      grid_(grid),
      options_(options),
      vector_width_(vector_width_for(device, grid)) {
  program_ = program_for(device, file, build_options(vector_width_, grid, options))();
  cl_int code = CL_SUCCESS;
  kernel_ = cl::Kernel(clCreateKernel(program_, name, &code));
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
  const std::size_t local[] = {tuning.group_width, tuning.group_height};
  const std::size_t global[] = {round_up(vectors, local[0]), round_up(grid_.rows(), local[1])};
  return enqueue(2, global, local);
}

cl::Event Kernel::enqueue_over_items(std::size_t count) {
  const std::size_t usual = device_.tuning().group_width * device_.tuning().group_height;
  const std::size_t local = group_ != 0 ? group_ : usual;
  const std::size_t global = round_up(count, local);
  return enqueue(1, &global, &local);
}

cl::Event Kernel::enqueue(cl_uint dimensions, const std::size_t* global, const std::size_t* local) {
  cl::Event event;
  check(clEnqueueNDRangeKernel(device_.queue()(), kernel_(), dimensions, nullptr, global, local, 0, nullptr,
                               &event()),
        [&] {
          return "launching " + std::string(name_) + " on " + device_.name() + " in groups of " +
                 std::to_string(dimensions > 1 ? local[0] * local[1] : local[0]) + group_limit_text();
        });
  note_launch(event, dimensions, global, local);
  return event;
}

std::string Kernel::group_limit_text() const {
  const cl_device_id device = device_.cl_device()();
  std::size_t most = 0;
  cl_ulong memory = 0, memory_there = 0;
  const bool known = clGetKernelWorkGroupInfo(kernel_(), device, CL_KERNEL_WORK_GROUP_SIZE, sizeof most,
                                              &most, nullptr) == CL_SUCCESS &&
                     clGetKernelWorkGroupInfo(kernel_(), device, CL_KERNEL_LOCAL_MEM_SIZE, sizeof memory,
                                              &memory, nullptr) == CL_SUCCESS &&
                     clGetDeviceInfo(device, CL_DEVICE_LOCAL_MEM_SIZE, sizeof memory_there, &memory_there,
                                     nullptr) == CL_SUCCESS;
  if (!known) return "";
  return " (of which it takes at most " + std::to_string(most) + " there, with " + std::to_string(memory) +
         " of " + std::to_string(memory_there) + " bytes of local memory)";
}

void Kernel::note_launch(const cl::Event& event, cl_uint dimensions, const std::size_t* global,
                         const std::size_t* local) {
  // PoCL compiles a kernel for each size of groups, and apart for launches that are long along some axis.
  constexpr std::size_t is_long = 0xffff;
  LaunchKind kind = {program_, name_, {local[0], 1}, global[0] >= is_long};
  if (dimensions > 1) {
    kind.group[1] = local[1];
    kind.is_long = kind.is_long || global[1] >= is_long;
  }
  DeviceState& state = Internal::state(device_);
  kind == last_kind_ ? state.enqueued(event) : state.launched(kind, event);
  last_kind_ = kind;
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
