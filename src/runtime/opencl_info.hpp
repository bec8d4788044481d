// Asks OpenCL about its objects.
#pragma once

#include <cstddef>
#include <string>
#include <type_traits>

#include "runtime/opencl_error.hpp"
#include "vorocl/device.hpp"
#include "vorocl/opencl.hpp"

namespace vorocl {

/// What a clGet...Info function (`ask`) tells about an object: a number or handle of the type T that OpenCL
/// documents, or a text. Throws Error if it tells nothing.
template <typename T, typename Ask, typename Object>
T info(Ask ask, const Object& object, cl_uint name) {
  T value{};
  if constexpr (std::is_same_v<T, std::string>) {
    std::size_t size = 0;
    check(ask(object, name, 0, nullptr, &size), "asking OpenCL for a text");
    value.resize(size);
    check(ask(object, name, size, value.data(), nullptr), "asking OpenCL for a text");
    value.resize(value.find_last_not_of('\0') + 1);
  } else {
    // A handle is a pointer whose own size is meant.
    check(ask(object, name, sizeof(T), &value, nullptr),  // NOLINT(bugprone-sizeof-expression)
          "asking OpenCL for a value");
  }
  return value;
}

/// A property of a device.
template <typename T>
T device_info(cl_device_id device, cl_device_info name) {
  return info<T>(clGetDeviceInfo, device, name);
}

/// How many compute units it has.
inline std::size_t units_of(const Device& device) {
  return device_info<cl_uint>(device.cl_device()(), CL_DEVICE_MAX_COMPUTE_UNITS);
}

}  // namespace vorocl
