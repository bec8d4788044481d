// What all copies of a Device share.
#pragma once

#include <array>
#include <functional>
#include <map>
#include <mutex>
#include <set>
#include <string>
#include <tuple>

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

struct BuiltProgram {
  cl::Program program;
  std::string binary_key;  // see binary_cache.hpp
  bool is_kept = false;    // a file has its binary
};

/// What launches have in common for which a driver makes one binary of a kernel.
struct LaunchKind {
  cl_program program = nullptr;
  std::string kernel;
  std::array<std::size_t, 2> group = {};
  bool is_long = false;

  auto members() const { return std::tie(program, kernel, group, is_long); }
  friend bool operator==(const LaunchKind& a, const LaunchKind& b) { return a.members() == b.members(); }
  friend bool operator<(const LaunchKind& a, const LaunchKind& b) { return a.members() < b.members(); }
};

struct DeviceState {
  cl::Context context;
  cl::CommandQueue queue;
  cl::Device device;
  GroupLimits limits;
  const std::int64_t process = process_number();  // which has the driver's threads
  std::string build_options;                      // behind the library's own, for all programs

  std::mutex programs_mutex;                     // held while a program is looked up or built
  std::map<std::string, BuiltProgram> programs;  // by file and build options
  std::function<void()> on_compiling;            // see Device::on_compiling()

  /// Counts a command that was enqueued. Waits until no more than two batches of commands are in
  /// flight: PoCL takes longer to enqueue a command the more there are, and the host may run ahead by hours.
  void enqueued(const cl::Event& command);

  /// The same for a launch, which may be the first one of its kind: see FirstLaunches.
  void launched(const LaunchKind& kind, const cl::Event& launch);

  /// The time that this thread has spent in such waits, which host_milliseconds() leaves out.
  static double& milliseconds_waited();

 private:
  static constexpr int batch = 64;
  std::mutex flight_mutex_;
  int commands_ = 0;            // of the present batch
  cl::Event end_of_batch_;      // the last command of the batch before it
  cl::Event last_;              // the last command of all
  std::set<LaunchKind> kinds_;  // of launches so far
};

}  // namespace vorocl
