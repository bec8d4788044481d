// What all copies of a Device share.
#pragma once

#include <map>
#include <mutex>
#include <string>

#include "runtime/internal.hpp"
#include "runtime/process.hpp"
#include "vorocl/opencl.hpp"

namespace vorocl {

/// How large a device lets a work-group be. A group over a list of items has all of them in the first
/// dimension.
struct GroupLimits {
  std::size_t items = 0, rows = 0;

  bool allow(std::size_t width, std::size_t height) const {
    return width >= 1 && height >= 1 && height <= rows && width <= items / height;
  }
};

struct DeviceState {
  cl::Context context;
  cl::CommandQueue queue;
  cl::Device device;
  GroupLimits limits;
  const std::int64_t process = process_number();  // which has the driver's threads
  std::string build_options;                      // behind the library's own, for all programs

  std::mutex programs_mutex;                    // held while a program is looked up or built
  std::map<std::string, cl::Program> programs;  // by file and build options

  /// Counts a command that was enqueued. Waits until no more than two batches of commands are in
  /// flight: PoCL takes longer to enqueue a command the more there are, and the host may run ahead by hours.
  void enqueued(const cl::Event& command);

  /// The time that this thread has spent in such waits, which host_milliseconds() leaves out.
  static double& milliseconds_waited();

 private:
  static constexpr int batch = 64;
  std::mutex flight_mutex_;
  int commands_ = 0;        // of the present batch
  cl::Event end_of_batch_;  // the last command of the batch before it
};

}  // namespace vorocl
