// Whether a device computes with doubles.
#pragma once

#include <string>

#include "runtime/opencl_info.hpp"
#include "vorocl/device.hpp"

namespace vorocl {

inline bool has_doubles(const Device& device) {
  const auto extensions = device_info<std::string>(device.cl_device()(), CL_DEVICE_EXTENSIONS);
  return extensions.find("cl_khr_fp64") != std::string::npos;
}

}  // namespace vorocl
