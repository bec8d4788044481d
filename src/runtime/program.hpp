// Builds OpenCL programs from the embedded kernels, once per device and options.
#pragma once

#include <string>

#include "vorocl/device.hpp"
#include "vorocl/opencl.hpp"

namespace vorocl {

/// The program of a kernel file ("flooding/jump_flooding.cl") and all that it includes: the one that the
/// device has, or that of a kept binary (binary_cache.hpp), or one built now. Safe from several threads.
/// Throws Error with device, options and log if the build fails; the log's lines are those of the .cl files.
/// Behind the options go those of the device (DeviceState).
///
/// For who debugs a kernel, three variables of the environment are read at each build: VOROCL_KERNEL_DIR, a
/// folder whose files replace the embedded kernels; VOROCL_BUILD_OPTIONS, which go behind the library's own;
/// VOROCL_DUMP_DIR, a folder where each program is written, as its source (.cl) and as the driver's binary
/// (.bin).
cl::Program program_for(const Device& device, const std::string& file, const std::string& options);

/// Keeps the binaries of all programs that the device has, for later processes. PoCL's hold the kernels that
/// were launched as they were specialised for it; it compiles each kernel once more to answer. Returns how
/// many are kept: none on devices whose drivers keep them. Throws Error if a file cannot be written.
std::size_t keep_programs(const Device& device);

/// The text of a kernel file with all that it includes.
std::string with_includes(const std::string& file, const std::string& text);

}  // namespace vorocl
