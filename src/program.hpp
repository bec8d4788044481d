// Builds OpenCL programs from the embedded kernels, once per device and options.
#pragma once

#include <string>

#include "vorocl/device.hpp"
#include "vorocl/opencl.hpp"

namespace vorocl {

/// The program of a kernel file ("jump_flooding.cl") and all that it includes, from the device's cache or
/// built now. Safe from several threads. Throws Error with device, options and log if the build fails; the
/// log's lines are those of the .cl files.
cl::Program program_for(const Device& device, const std::string& file, const std::string& options);

}  // namespace vorocl
