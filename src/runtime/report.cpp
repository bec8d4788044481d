#include "vorocl/report.hpp"

#include <algorithm>
#include <optional>

#include "runtime/opencl_error.hpp"
#include "runtime/process.hpp"

namespace vorocl {

namespace {

/// The device's time of an event, in nanoseconds; none where the queue does not profile, which is no error of
/// the diagram's.
std::optional<cl_ulong> time_of(const cl::Event& event, cl_profiling_info which) {
  cl_ulong time = 0;
  if (clGetEventProfilingInfo(event(), which, sizeof time, &time, nullptr) != CL_SUCCESS) return {};
  return time;
}

}  // namespace

double Report::milliseconds() const {
  if (last_() == nullptr) return 0;
  refuse_fork_of(process_);
  check(clWaitForEvents(1, &last_()), "waiting for a diagram");
  const auto start = time_of(first_, CL_PROFILING_COMMAND_START),
             end = time_of(last_, CL_PROFILING_COMMAND_END);
  if (!start || !end) return 0;
  cl_ulong time = *end - *start;
  for (const auto& [before, launch] : first_launches_) {
    const auto ended = time_of(before, CL_PROFILING_COMMAND_END);
    const auto launched = time_of(launch, CL_PROFILING_COMMAND_START);
    if (!ended || !launched) continue;
    const cl_ulong from = std::max(*ended, *start);
    if (*launched > from) time -= *launched - from;
  }
  return static_cast<double>(time) * 1e-6;
}

}  // namespace vorocl
