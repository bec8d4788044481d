#include "vorocl/report.hpp"

#include "runtime/opencl_error.hpp"
#include "runtime/process.hpp"

namespace vorocl {

double Report::milliseconds() const {
  if (last_() == nullptr) return 0;
  refuse_fork_of(process_);
  check(clWaitForEvents(1, &last_()), "waiting for a diagram");
  cl_ulong start = 0, end = 0;
  // A queue without profiling has no times: that is no error of the diagram's.
  if (clGetEventProfilingInfo(first_(), CL_PROFILING_COMMAND_START, sizeof start, &start, nullptr) !=
          CL_SUCCESS ||
      clGetEventProfilingInfo(last_(), CL_PROFILING_COMMAND_END, sizeof end, &end, nullptr) != CL_SUCCESS) {
    return 0;
  }
  return static_cast<double>(end - start) * 1e-6;
}

}  // namespace vorocl
