// Turns OpenCL's error codes into the library's exception.
//
// The bindings are used without their own exceptions, so that the library behaves the same whatever CL_HPP_*
// settings its users compile with.
#pragma once

#include <CL/opencl.hpp>
#include <string>

#include "vorocl/error.hpp"

namespace vorocl {

/// Throws Error("<what> failed: ...") unless the code is CL_SUCCESS.
void check(cl_int code, const std::string& what);

}  // namespace vorocl
