// Turns OpenCL's error codes into the library's exception.
//
// The library calls OpenCL's C functions and checks each code. Of the C++ bindings it uses the handles alone
// (cl::Buffer and its kin, which count references): what else the bindings define are inline functions that
// behave differently with each CL_HPP_* setting, and in a static library the linker may take its user's copy
// of them, which may throw cl::Error, or the other way round. Handles are the same whatever the settings.
#pragma once

#include <string>

#include "vorocl/error.hpp"
#include "vorocl/opencl.hpp"

namespace vorocl {

/// Throws Error("<what> failed: ...") of the code's kind.
[[noreturn]] void fail(cl_int code, const std::string& what);

/// Throws as fail() unless the code is CL_SUCCESS. `what` is a text, or a function that makes it where that
/// would cost time on each call.
inline void check(cl_int code, const char* what) {
  if (code != CL_SUCCESS) fail(code, what);
}
template <typename Describe, typename = decltype(std::string(std::declval<Describe>()()))>
void check(cl_int code, Describe what) {
  if (code != CL_SUCCESS) fail(code, what());
}

}  // namespace vorocl
