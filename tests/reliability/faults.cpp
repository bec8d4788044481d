// A library to preload into the command (LD_PRELOAD), in which calls fail on request. VOROCL_FAULT is "KIND
// N", or "KIND N on" where all later calls of the kind fail as well. KIND is an OpenCL call, "event" (an
// event that ends with an error), "new" (in the command's own code, while it works), or "open", "write",
// "pwrite", "fallocate", "fsync" (or of a whole disk) and "rename" of files that are not complete. With
// "compiler 1" SIGINT comes when the driver's compiler first completes a file, and such files are gone from
// then on. VOROCL_FAULT_COUNTS names a file for a line "KIND CALLS" of each kind at the end.
#include <fcntl.h>
#include <link.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstdarg>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <new>
#include <utility>

#include "faulty_calls.hpp"

namespace {

/// The fault that the environment asks for, and how many calls of each kind came.
struct Request {
  char kind[40] = "";
  int number = 0;
  bool stays = false;
  std::atomic<bool> has_begun{false};
  struct Count {
    const char* kind;
    std::atomic<int> calls;
  };
  std::array<Count, 40> counts = {};

  Request() {
    char mode[8] = "";
    const char* const text = std::getenv("VOROCL_FAULT");
    if (text != nullptr && std::sscanf(text, "%39s %d %7s", kind, &number, mode) >= 2)
      stays = mode[0] != '\0';
  }
  ~Request() {
    const char* const path = std::getenv("VOROCL_FAULT_COUNTS");
    FILE* const file = path != nullptr ? std::fopen(path, "w") : nullptr;
    if (file == nullptr) return;
    for (const Count& count : counts) {
      if (count.kind != nullptr) std::fprintf(file, "%s %d\n", count.kind, count.calls.load());
    }
    std::fclose(file);
  }

  /// Allocates nothing: it is asked by operator new, too. That counts from the first other call on: before,
  /// libraries start, and CLI11 ends the process where there is no memory.
  bool comes(const char* call) {
    if (std::strcmp(call, "new") != 0) has_begun = true;
    if (!has_begun) return false;
    for (Count& count : counts) {
      if (count.kind == nullptr) count.kind = call;
      if (std::strcmp(count.kind, call) != 0) continue;
      const int calls = ++count.calls;
      return std::strcmp(kind, call) == 0 && (calls == number || (stays && calls > number));
    }
    return false;
  }
};

Request& request() {
  static Request only;
  return only;
}

/// Also what a run that can be resumed leaves.
bool is_temporary(const char* path) {
  return std::strstr(path, ".vorocl-") != nullptr || std::strstr(path, ".part") != nullptr ||
         std::strstr(path, ".journal") != nullptr;
}

bool is_temporary(int file) {
  std::array<char, 40> link{};
  std::snprintf(link.data(), link.size(), "/proc/self/fd/%d", file);
  std::array<char, 4096> path{};
  return readlink(link.data(), path.data(), path.size() - 1) > 0 && is_temporary(path.data());
}

bool fails(const char* call, bool counts) {
  if (!counts || !request().comes(call)) return false;
  errno = ENOSPC;
  return true;
}

/// Whether an address is in the code of the command itself, and not in that of a library.
bool is_ours(const void* address) {
  static const auto range = [] {
    std::pair<std::uintptr_t, std::uintptr_t> found;
    dl_iterate_phdr(
        [](dl_phdr_info* info, std::size_t, void* result) {
          for (int i = 0; i < info->dlpi_phnum; ++i) {
            const auto& part = info->dlpi_phdr[i];
            if (part.p_type != PT_LOAD || (part.p_flags & PF_X) == 0) continue;
            const std::uintptr_t begin = info->dlpi_addr + part.p_vaddr;
            *static_cast<decltype(found)*>(result) = {begin, begin + part.p_memsz};
          }
          return 1;  // the command comes first
        },
        &found);
    return found;
  }();
  const auto place = reinterpret_cast<std::uintptr_t>(address);
  return place >= range.first && place < range.second;
}

}  // namespace

bool vorocl::call_fails(const char* name) { return request().comes(name); }

// --- OpenCL calls besides those of faulty_calls.cpp ---

VOROCL_FAULTY_CALL(clGetPlatformIDs, (cl_uint room, cl_platform_id* platforms, cl_uint* count),
                   (room, platforms, count))
VOROCL_FAULTY_CALL(clGetPlatformInfo,
                   (cl_platform_id platform, cl_platform_info name, size_t room, void* value, size_t* size),
                   (platform, name, room, value, size))
VOROCL_FAULTY_CALL(clGetDeviceIDs,
                   (cl_platform_id platform, cl_device_type type, cl_uint room, cl_device_id* devices,
                    cl_uint* count),
                   (platform, type, room, devices, count))
VOROCL_FAULTY_MAKER(cl_context, clCreateContext,
                    (const cl_context_properties* properties, cl_uint count, const cl_device_id* devices,
                     void(CL_CALLBACK* notify)(const char*, const void*, size_t, void*), void* data,
                     cl_int* code),
                    (properties, count, devices, notify, data, code))
VOROCL_FAULTY_MAKER(cl_command_queue, clCreateCommandQueue,
                    (cl_context context, cl_device_id device, cl_command_queue_properties properties,
                     cl_int* code),
                    (context, device, properties, code))
VOROCL_FAULTY_CALL(clEnqueueBarrierWithWaitList,
                   (cl_command_queue queue, cl_uint count, const cl_event* waits, cl_event* event),
                   (queue, count, waits, event))
VOROCL_FAULTY_CALL(clGetEventProfilingInfo,
                   (cl_event event, cl_profiling_info name, size_t room, void* value, size_t* size),
                   (event, name, room, value, size))
VOROCL_FAULTY_CALL(clGetCommandQueueInfo,
                   (cl_command_queue queue, cl_command_queue_info name, size_t room, void* value,
                    size_t* size),
                   (queue, name, room, value, size))

VOROCL_FAULTY cl_int CL_API_CALL clGetEventInfo(cl_event event, cl_event_info name, size_t room, void* value,
                                                size_t* size) {
  static const auto next = vorocl::loaders<decltype(clGetEventInfo)>("clGetEventInfo");
  if (vorocl::call_fails("clGetEventInfo")) return CL_OUT_OF_RESOURCES;
  const cl_int code = next(event, name, room, value, size);
  if (code == CL_SUCCESS && name == CL_EVENT_COMMAND_EXECUTION_STATUS && vorocl::call_fails("event")) {
    *static_cast<cl_int*>(value) = CL_OUT_OF_RESOURCES;
  }
  return code;
}

// --- memory ---

/// While libraries are loaded they start, with our copies of what all of them have of the standard library's
/// templates.
static thread_local bool loads_library = false;

VOROCL_FAULTY void* dlopen(const char* path, int mode) {
  static const auto next = vorocl::loaders<void*(const char*, int)>("dlopen");
  loads_library = true;
  void* const library = next(path, mode);
  loads_library = false;
  return library;
}

__attribute__((visibility("default"))) void* operator new(std::size_t size) {
  if (!loads_library && is_ours(__builtin_return_address(0)) && request().comes("new"))
    throw std::bad_alloc();
  if (void* const memory = std::malloc(size > 0 ? size : 1)) return memory;
  throw std::bad_alloc();
}

// --- files ---

VOROCL_FAULTY int open(const char* path, int flags, ...) {
  static const auto next = vorocl::loaders<int(const char*, int, ...)>("open");
  std::va_list arguments;
  va_start(arguments, flags);
  const mode_t mode = (flags & O_CREAT) != 0 ? va_arg(arguments, mode_t) : 0;
  va_end(arguments);
  return fails("open", is_temporary(path)) ? -1 : next(path, flags, mode);
}
VOROCL_FAULTY ssize_t write(int file, const void* bytes, std::size_t count) {
  static const auto next = vorocl::loaders<ssize_t(int, const void*, std::size_t)>("write");
  return fails("write", is_temporary(file)) ? -1 : next(file, bytes, count);
}
VOROCL_FAULTY ssize_t pwrite(int file, const void* bytes, std::size_t count, off_t place) {
  static const auto next = vorocl::loaders<ssize_t(int, const void*, std::size_t, off_t)>("pwrite");
  return fails("pwrite", is_temporary(file)) ? -1 : next(file, bytes, count, place);
}
VOROCL_FAULTY int posix_fallocate(int file, off_t place, off_t count) {
  static const auto next = vorocl::loaders<int(int, off_t, off_t)>("posix_fallocate");
  return fails("fallocate", is_temporary(file)) ? ENOSPC : next(file, place, count);
}
VOROCL_FAULTY int syncfs(int file) noexcept {
  static const auto next = vorocl::loaders<int(int)>("syncfs");
  return fails("fsync", is_temporary(file)) ? -1 : next(file);
}
VOROCL_FAULTY int fsync(int file) {
  static const auto next = vorocl::loaders<int(int)>("fsync");
  return fails("fsync", is_temporary(file)) ? -1 : next(file);
}
VOROCL_FAULTY int rename(const char* from, const char* to) noexcept {
  static const auto next = vorocl::loaders<int(const char*, const char*)>("rename");
  if (std::strcmp(request().kind, "compiler") == 0 && std::strstr(from, ".cl.tmp") != nullptr) {
    static std::atomic<bool> has_come{false};
    if (!has_come.exchange(true)) std::raise(SIGINT);
    errno = ENOENT;
    return -1;
  }
  return fails("rename", is_temporary(from)) ? -1 : next(from, to);
}
