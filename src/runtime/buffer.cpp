#include "runtime/buffer.hpp"

#include <algorithm>
#include <cstdio>

#include "runtime/opencl_info.hpp"

namespace vorocl {

namespace {

std::string readable(std::size_t bytes) {
  char text[32];
  const double mebibytes = static_cast<double>(bytes) / (1 << 20);
  std::snprintf(text, sizeof text, "%.1f MiB", mebibytes);
  return text;
}

cl::Buffer make_buffer(const Device& device, cl_mem_flags flags, std::size_t bytes,
                       const std::string& purpose, std::size_t held, void* values = nullptr) {
  const std::size_t largest = device_info<cl_ulong>(device.cl_device()(), CL_DEVICE_MAX_MEM_ALLOC_SIZE);
  const std::size_t all = device_info<cl_ulong>(device.cl_device()(), CL_DEVICE_GLOBAL_MEM_SIZE);
  // Asked here, because drivers allocate lazily: what does not fit would fail at some later launch.
  if (bytes > largest || held + bytes > all) {
    throw Error("too little device memory for " + purpose + ": it needs " + readable(bytes) +
                    (held > 0 ? " besides the " + readable(held) + " in use" : "") + ", and " +
                    device.name() + " has " + readable(all) + ", at most " + readable(largest) +
                    " in one buffer; use fewer pixels or seeds, or another device",
                ErrorKind::device_memory);
  }
  cl_int code = CL_SUCCESS;
  cl::Buffer buffer(
      clCreateBuffer(device.context()(), flags, std::max<std::size_t>(bytes, 4), values, &code));
  check(code, [&] { return "allocating " + readable(bytes) + " for " + purpose + " on " + device.name(); });
  return buffer;
}

}  // namespace

cl::Buffer allocate(const Device& device, std::size_t bytes, const std::string& purpose, std::size_t held) {
  return make_buffer(device, CL_MEM_READ_WRITE, bytes, purpose, held);
}

cl::Buffer allocate_with(const Device& device, const void* bytes, std::size_t count,
                         const std::string& purpose) {
  // OpenCL reads the values, though it takes them as if it wrote them.
  return make_buffer(device, CL_MEM_READ_WRITE | CL_MEM_COPY_HOST_PTR, count, purpose, 0,
                     const_cast<void*>(bytes));
}

cl::Buffer allocate_mappable(const Device& device, std::size_t bytes, const std::string& purpose) {
  return make_buffer(device, CL_MEM_READ_WRITE | CL_MEM_ALLOC_HOST_PTR, bytes, purpose, 0);
}

void WorkingMemory::reserve(cl::Buffer& buffer, std::size_t bytes) {
  const std::size_t present = buffer() == nullptr ? 0 : size_of(buffer);
  if (present > 0 && present >= bytes) return;
  held_ -= present;
  buffer = cl::Buffer();
  buffer = allocate(device_, bytes, purpose_, held_);
  held_ += size_of(buffer);
}

bool shares_memory(const Device& device) {
  return device_info<cl_bool>(device.cl_device()(), CL_DEVICE_HOST_UNIFIED_MEMORY) == CL_TRUE;
}

cl::Buffer buffer_at(const Device& device, void* memory, std::size_t bytes, const std::string& purpose) {
  return make_buffer(device, CL_MEM_READ_WRITE | CL_MEM_USE_HOST_PTR, bytes, purpose, 0, memory);
}

void synchronise(const Device& device, const cl::Buffer& buffer, std::size_t bytes) {
  cl_int code = CL_SUCCESS;
  const cl::CommandQueue& queue = device.queue();
  void* const mapped =
      clEnqueueMapBuffer(queue(), buffer(), CL_TRUE, CL_MAP_READ, 0, bytes, 0, nullptr, nullptr, &code);
  check(code, "mapping a buffer");
  check(clEnqueueUnmapMemObject(queue(), buffer(), mapped, 0, nullptr, nullptr), "unmapping a buffer");
}

cl::Event copy(const Device& device, const cl::Buffer& from, const cl::Buffer& to, std::size_t bytes,
               std::size_t first_from, std::size_t first_to) {
  cl::Event event;
  check(
      clEnqueueCopyBuffer(device.queue()(), from(), to(), first_from, first_to, bytes, 0, nullptr, &event()),
      "copying a buffer");
  Internal::state(device).enqueued(event);
  return event;
}

std::size_t size_of(const cl::Buffer& buffer) {
  return info<std::size_t>(clGetMemObjectInfo, buffer(), CL_MEM_SIZE);
}

void check_foreign_buffer(const Device& device, const cl::Buffer& buffer, std::size_t bytes,
                          const std::string& name, Access access) {
  if (buffer() == nullptr) throw Error(name + " is null");
  if (info<cl_mem_object_type>(clGetMemObjectInfo, buffer(), CL_MEM_TYPE) != CL_MEM_OBJECT_BUFFER) {
    throw Error(name + " is an OpenCL object of another kind, not a buffer");
  }
  if (info<cl_context>(clGetMemObjectInfo, buffer(), CL_MEM_CONTEXT) != device.context()()) {
    throw Error(name + " belongs to another OpenCL context than the device");
  }
  if (size_of(buffer) < bytes) {
    throw Error(name + " holds " + std::to_string(size_of(buffer)) + " bytes; " + std::to_string(bytes) +
                " are needed");
  }
  const auto flags = info<cl_mem_flags>(clGetMemObjectInfo, buffer(), CL_MEM_FLAGS);
  if ((flags & CL_MEM_WRITE_ONLY) != 0)
    throw Error(name + " is write-only for kernels, and they must read it");
  if (access == Access::read_and_write && (flags & CL_MEM_READ_ONLY) != 0) {
    throw Error(name + " is read-only for kernels, and they must write it");
  }
}

bool overlap(const cl::Buffer& one, const cl::Buffer& other, std::size_t bytes) {
  const auto memory_of = [](const cl::Buffer& buffer) {
    const auto whole = info<cl_mem>(clGetMemObjectInfo, buffer(), CL_MEM_ASSOCIATED_MEMOBJECT);
    return whole != nullptr ? whole : buffer();
  };
  const auto start_of = [](const cl::Buffer& buffer) {
    return info<std::size_t>(clGetMemObjectInfo, buffer(), CL_MEM_OFFSET);
  };
  const std::size_t start = start_of(one), other_start = start_of(other);
  return memory_of(one) == memory_of(other) && start < other_start + bytes && other_start < start + bytes;
}

}  // namespace vorocl
