#include "buffer.hpp"

#include <algorithm>
#include <cstdio>

namespace vorocl {

namespace {

std::string readable(std::size_t bytes) {
  char text[32];
  const double mebibytes = static_cast<double>(bytes) / (1 << 20);
  std::snprintf(text, sizeof text, "%.1f MiB", mebibytes);
  return text;
}

}  // namespace

cl::Buffer allocate(const Device& device, std::size_t bytes, const std::string& purpose, std::size_t held) {
  const std::size_t largest = device.cl_device().getInfo<CL_DEVICE_MAX_MEM_ALLOC_SIZE>();
  const std::size_t all = device.cl_device().getInfo<CL_DEVICE_GLOBAL_MEM_SIZE>();
  // Asked here, because drivers allocate lazily: what does not fit would fail at some later launch.
  if (bytes > largest || held + bytes > all) {
    throw Error("too little device memory for " + purpose + ": it needs " + readable(bytes) +
                (held > 0 ? " besides the " + readable(held) + " in use" : "") + ", and " + device.name() +
                " has " + readable(all) + ", at most " + readable(largest) +
                " in one buffer; use a smaller grid or another device");
  }
  cl_int code = CL_SUCCESS;
  cl::Buffer buffer(device.context(), CL_MEM_READ_WRITE, std::max<std::size_t>(bytes, 4), nullptr, &code);
  check(code, "allocating " + readable(bytes) + " for " + purpose + " on " + device.name());
  return buffer;
}

}  // namespace vorocl
