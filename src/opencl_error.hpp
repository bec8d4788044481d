// Turns OpenCL's error codes into the library's exception.
//
// The library calls OpenCL's C functions and checks each code. Of the C++ bindings it uses the handles alone
// (cl::Buffer and its kin, which count references): what else the bindings define are inline functions that
// behave differently with each CL_HPP_* setting, and in a static library the linker may take its user's copy
// of them, which may throw cl::Error, or the other way round. Handles are the same whatever the settings.
#pragma once

#include <CL/opencl.hpp>
#include <string>

#include "vorocl/error.hpp"

namespace vorocl {

/// Throws Error("<what> failed: ...") unless the code is CL_SUCCESS.
void check(cl_int code, const std::string& what);

}  // namespace vorocl
