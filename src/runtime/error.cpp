#include "vorocl/error.hpp"

#include <cstdio>
#include <string>

#include "runtime/opencl_error.hpp"

namespace vorocl {

namespace {

std::string error_name(cl_int code) {
  switch (code) {
    case CL_DEVICE_NOT_AVAILABLE:
      return "device not available";
    case CL_COMPILER_NOT_AVAILABLE:
      return "no compiler for this device";
    case CL_MEM_OBJECT_ALLOCATION_FAILURE:
      return "out of device memory";
    case CL_OUT_OF_RESOURCES:
      return "out of device resources (device memory, or what a work-group takes)";
    case CL_OUT_OF_HOST_MEMORY:
      return "out of host memory";
    case CL_INVALID_VALUE:
      return "invalid value";
    case CL_INVALID_CONTEXT:
      return "invalid context";
    case CL_INVALID_COMMAND_QUEUE:
      return "invalid command queue";
    case CL_INVALID_MEM_OBJECT:
      return "invalid buffer";
    case CL_INVALID_BUFFER_SIZE:
      return "invalid buffer size";
    case CL_INVALID_KERNEL_NAME:
      return "no such kernel";
    case CL_INVALID_BUILD_OPTIONS:
      return "invalid build options";
    case CL_INVALID_WORK_ITEM_SIZE:
      return "invalid size of a work-group's dimension";
    case CL_INVALID_WORK_GROUP_SIZE:
      return "invalid work-group size";
    default:
      return "OpenCL error";
  }
}

ErrorKind kind_of(cl_int code) {
  switch (code) {
    case CL_MEM_OBJECT_ALLOCATION_FAILURE:
    case CL_OUT_OF_RESOURCES:
      return ErrorKind::device_memory;
    case CL_OUT_OF_HOST_MEMORY:
      return ErrorKind::host_memory;
    case CL_INVALID_BUILD_OPTIONS:
      return ErrorKind::kernel_build;
    default:
      return ErrorKind::device;
  }
}

}  // namespace

void fail(cl_int code, const std::string& what) {
  throw Error(what + " failed: " + error_name(code) + " (" + std::to_string(code) + ")", kind_of(code));
}

namespace {
std::string short_text(double number) {
  char text[32];
  std::snprintf(text, sizeof text, "%.15g", number);
  return text;
}
}  // namespace

BadPoint::BadPoint(std::size_t index, const Point& point, const std::string& what)
    : Error("point " + std::to_string(index) + " (" + short_text(point.x) + ", " + short_text(point.y) +
                (point.z != 0 ? ", " + short_text(point.z) : "") + ") " + what,
            ErrorKind::bad_point),
      index_(index),
      point_(point) {}

}  // namespace vorocl
