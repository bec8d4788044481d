// The OpenCL device that everything else runs on: selection, tuning, and the cache of built programs.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "vorocl/export.h"
#include "vorocl/opencl.hpp"

namespace vorocl {

struct DeviceState;

/// How the kernels of exact diagrams and of distance transforms are cut.
enum class Shape {
  vector,  ///< a work-item labels bins or rows of pixels in vectors, for CPUs
  group,   ///< a work-group labels a square of pixels, a box of voxels or a band of lines together, for GPUs
};

/// How kernels are shaped for a device. Results never depend on it, only speed does.
struct Tuning {
  int vector_width = 1;          ///< pixels of a row that one work-item computes: 1, 2, 4, 8 or 16
  std::size_t group_width = 32;  ///< work-items of a work-group along a row ...
  std::size_t group_height = 8;  ///< ... and across rows
  Shape shape = Shape::vector;   ///< of exact diagrams and distance transforms
  std::size_t patch_items = 64;  ///< fewest work-items of a work-group of Shape::group: 32, 64, 128 or 256
};

/// One OpenCL device of this machine, as `vorocl devices` lists it.
struct DeviceDescription {
  std::size_t platform_index = 0;
  std::size_t device_index = 0;  ///< within its platform; "platform:device" selects it
  std::string platform;
  std::string name;
  std::string type;  ///< "GPU", "CPU" or "accelerator"
  std::string opencl_version;
  std::string driver_version;
  unsigned compute_units = 0;
  std::size_t global_memory = 0;   ///< bytes
  std::size_t max_allocation = 0;  ///< bytes, the largest single buffer
  std::string why_not;             ///< why VoroCL cannot use it; empty if it can
  bool selected = false;           ///< Device::select() would take it ...
  std::string reason;              ///< ... and why
  bool asked_for = false;          ///< it is selected because the request or VOROCL_DEVICE says so
};

/// A context, an in-order queue and the programs built for them.
///
/// Threads: copies share all of it, and several threads may use it and its copies at once, as long as each
/// has its own Seeds, Diagrams and results.
///
/// Lifetime: everything made on a device keeps what it needs of it.
///
/// Ordering: all work goes to the one queue, in the order of the calls. At most 128 commands are in flight:
/// a call that would enqueue more waits until older ones are done, because drivers slow down as their queues
/// grow. So do not hold the queue back (by wait_for()) with an event that the same thread completes only
/// after it has enqueued many frames.
class VOROCL_API Device {
 public:
  /// Picks a device: the `request`, else what the environment variable VOROCL_DEVICE says (an empty one, as
  /// an empty request, says nothing), else an NVIDIA GPU, another GPU, a CPU (PoCL), in this order. A request
  /// is a case-insensitive part of a platform's or a device's name, or "platform:device" indices. Throws
  /// Error, which lists what there is, if nothing matches.
  static Device select(const std::string& request = "");

  /// All devices of all platforms, with the one that select(request) would take marked. Empty without a
  /// platform.
  static std::vector<DeviceDescription> list(const std::string& request = "");

  /// Adopts the caller's context and queue (both are retained). Throws Error if either is null, if they do
  /// not belong together or if the queue is out of order. Device times are 0 unless the queue has profiling
  /// enabled.
  Device(const cl::Context& context, const cl::CommandQueue& queue);

  // Without moves: a device is never empty.
  Device(const Device&) = default;
  Device& operator=(const Device&) = default;
  ~Device() = default;

  const cl::Context& context() const;

  /// The one queue. Throws Error in a forked child. cl::EnqueueArgs takes no const one: do not assign to it.
  cl::CommandQueue& queue() const;
  const cl::Device& cl_device() const;
  std::string name() const;
  std::string platform_name() const;
  std::string driver_version() const;

  /// The default tuning of the device's class, unless with_tuning() changed it.
  const Tuning& tuning() const;

  /// The same device, queue and program cache with other kernel shapes. Throws Error if one cannot be.
  Device with_tuning(const Tuning& tuning) const;

  /// Calls `notice` once, when the driver's compiler has taken long for a program: it will for others, and
  /// the caller waits for some seconds. After prepare_programs() (vorocl/preparation.hpp) it does not. The
  /// call comes in the middle of one that needs the program, and must not use the device.
  void on_compiling(const std::function<void()>& notice) const;

  /// Waits until all that was enqueued is done.
  void finish() const;

  /// Lets all that is enqueued from now on wait for events of other queues of the context, on the device:
  /// returns at once. Throws Error if an event is null or of another context.
  void wait_for(const std::vector<cl::Event>& events) const;

  /// True if both use one queue (whatever their tuning).
  bool same_as(const Device& other) const { return queue()() == other.queue()(); }

 private:
  friend struct Internal;
  std::shared_ptr<DeviceState> state_;
  Tuning tuning_;
};

}  // namespace vorocl
