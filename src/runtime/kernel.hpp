// Kernels ready to launch, over the vectors of a grid or over a list of items, and the sets of them that
// objects keep.
#pragma once

#include <array>
#include <cstddef>
#include <deque>
#include <string>
#include <type_traits>
#include <vector>

#include "runtime/device_state.hpp"
#include "runtime/opencl_error.hpp"
#include "runtime/pixel_grid.hpp"
#include "vorocl/device.hpp"
#include "vorocl/opencl.hpp"

namespace vorocl {

/// Spare values before and behind the pixels of an image that waves read at an offset (see vector.cl).
constexpr std::size_t guard = 16;

/// Where seeds lie: in pixels of the grid, or also in those outside it, or at places within pixels
/// (kernels/core/units.cl). Distances take 32 bits in the grid, else 64.
enum class Extent { grid, far, fractions };

/// What kernels are specialised for when they are built, besides the vector width and, unless they take these
/// as an argument, the grid's periodic axes. Kernels that read no distance or no neighbours are the same for
/// all.
struct KernelOptions {
  Metric metric = Metric::euclidean;
  Neighbourhood neighbourhood = Neighbourhood::moore;
  Extent extent = Extent::grid;
  bool weighted = false;  // of exact diagrams: see kernels/exact/place.cl
  bool any_axes = false;  // kernels take the periodic axes as an argument, if there are any
  bool flat = false;      // of exact diagrams of voxels: there is one slice of them
  bool tilted = false;    // of exact diagrams: see kernels/core/lattice.cl

  friend bool operator==(const KernelOptions& a, const KernelOptions& b) {
    return a.metric == b.metric && a.neighbourhood == b.neighbourhood && a.extent == b.extent &&
           a.weighted == b.weighted && a.any_axes == b.any_axes && a.flat == b.flat && a.tilted == b.tilted;
  }
};

/// The same device for kernels that have no vectors of pixels, or vectors of their own: one program of them
/// serves every width.
Device without_vectors(const Device& device);

/// One kernel with its arguments. A launch sets the buffers, and those numbers that have changed since the
/// last one. Never shared between threads: an OpenCL kernel object holds its arguments.
class Kernel {
 public:
  /// The kernel `name` of a kernel file, built for the device's vector width, or less where a row is shorter
  /// than that. The texts must outlive the kernel.
  Kernel(const Device& device, const char* file, const char* name, const PixelGrid& grid,
         const KernelOptions& options = {});

  /// The pixels of a vector.
  std::size_t vector_width() const { return static_cast<std::size_t>(vector_width_); }

  /// Work-groups of this many items for over_items(), however few the items are. (PoCL
  /// compiles a kernel again for each size.)
  Kernel& in_groups_of(std::size_t items) {
    group_ = items;
    return *this;
  }

  /// Enqueues one work-item per vector of every row, of a volume of those of all slices, with these
  /// arguments. Work-items outside the grid must return.
  template <typename... Arguments>
  cl::Event over_grid(const Arguments&... arguments) {
    set_arguments(0, arguments...);
    return enqueue_over_grid();
  }

  /// Enqueues `count` work-items (rounded up: those past the count must return), with these arguments.
  /// Enqueues nothing for a count of 0.
  template <typename... Arguments>
  cl::Event over_items(std::size_t count, const Arguments&... arguments) {
    if (count == 0) return {};
    set_arguments(0, arguments...);
    return enqueue_over_items(count);
  }

 private:
  friend class KernelSet;

  /// A number as it was set. (A buffer would have to be held as long, so that no other one can have its
  /// address: the caller's too, and a diagram's that is gone.)
  struct Number {
    std::array<unsigned char, 32> bytes = {};
    std::size_t size = 0;  // 0: not set yet
  };

  bool is_for(const Device& device, const PixelGrid& grid) const;

  /// For errors: how many work-items a group can have, and how much of the local memory it takes.
  std::string group_limit_text() const;

  void set_arguments(std::size_t) {}
  template <typename First, typename... Rest>
  void set_arguments(std::size_t index, const First& first, const Rest&... rest) {
    if constexpr (std::is_same_v<First, cl::Buffer>) {
      set_argument(index, &first(), sizeof(cl_mem));
    } else {
      static_assert(std::is_arithmetic_v<First> || std::is_union_v<First>,
                    "a number or a vector such as cl_uint2");
      set_number(index, &first, sizeof(First));
    }
    set_arguments(index + 1, rest...);
  }
  void set_argument(std::size_t index, const void* value, std::size_t size);
  void set_number(std::size_t index, const void* value, std::size_t size);
  cl::Event enqueue_over_grid();
  cl::Event enqueue_over_items(std::size_t count);
  cl::Event enqueue(cl_uint dimensions, const std::size_t* global, const std::size_t* local);
  void note_launch(const cl::Event& event, cl_uint dimensions, const std::size_t* global,
                   const std::size_t* local);

  Device device_;
  const char* file_;
  const char* name_;
  PixelGrid grid_;
  KernelOptions options_;
  int vector_width_;              // pixels that one work-item computes
  std::size_t group_ = 0;         // work-items of a group over items; 0: the usual ones
  cl_program program_ = nullptr;  // which the device keeps
  cl::Kernel kernel_;
  LaunchKind last_kind_;
  std::vector<Number> numbers_;  // by the index of the argument
};

/// The kernels that an object launches again and again.
class KernelSet {
 public:
  /// The kernel, made at its first use, and anew when the device or the grid is another than the last time.
  Kernel& get(const Device& device, const char* file, const char* name, const PixelGrid& grid,
              const KernelOptions& options = {});

 private:
  std::deque<Kernel> kernels_;  // references to its elements stay valid
};

}  // namespace vorocl
