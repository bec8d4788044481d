// OpenCL calls that fail on request: this program's own definitions of the calls that the library makes stand
// before the loader's, and pass on to it. To be included in one source of a test program.
#pragma once

#include <atomic>
#include <string>

#include "vorocl/opencl.hpp"

namespace vorocl {

/// Which call fails. Calls are counted from 1 once it is set; 0: none. And how many were kernels to launch or
/// buffers to fill.
struct Fault {
  std::atomic<int> fails_at{0};
  std::atomic<int> calls{0};
  std::atomic<int> enqueued{0};

  void set(int call) {
    calls = enqueued = 0;
    fails_at = call;
  }

  bool comes(const char* name) {
    const std::string call(name);
    enqueued += call == "clEnqueueNDRangeKernel" || call == "clEnqueueFillBuffer" ? 1 : 0;
    return ++calls == fails_at;
  }
};

inline Fault& fault() {
  static Fault only;
  return only;
}

inline bool call_fails(const char* name) { return fault().comes(name); }

}  // namespace vorocl

#include "faulty_calls.hpp"

VOROCL_FAULTY_CALL(clGetEventInfo,
                   (cl_event event, cl_event_info name, size_t size, void* value, size_t* used),
                   (event, name, size, value, used))
