// Device memory: allocation that says how much is needed and there is, and typed transfers.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "runtime/device_state.hpp"
#include "runtime/opencl_error.hpp"
#include "runtime/process.hpp"
#include "vorocl/device.hpp"

namespace vorocl {

/// The bytes of a number of 32 bits.
inline constexpr std::size_t word = sizeof(cl_uint);

/// A buffer of at least `bytes` (and at least 4, for OpenCL has no empty buffers). `held` counts the bytes
/// that the caller holds already. Throws Error that names the purpose if the device cannot hold it.
cl::Buffer allocate(const Device& device, std::size_t bytes, const std::string& purpose,
                    std::size_t held = 0);

/// As above, with these bytes, or values, in it. Waits for no command. Throws Error too if there are none.
cl::Buffer allocate_with(const Device& device, const void* bytes, std::size_t count,
                         const std::string& purpose);
template <typename T>
cl::Buffer allocate_with(const Device& device, const std::vector<T>& values, const std::string& purpose) {
  return allocate_with(device, values.data(), values.size() * sizeof(T), purpose);
}

/// As above, where the host can map it without a copy.
cl::Buffer allocate_mappable(const Device& device, std::size_t bytes, const std::string& purpose);

/// Counts buffers that grow and are kept.
class WorkingMemory {
 public:
  /// Of a purpose, beside bytes that are held already.
  WorkingMemory(const Device& device, std::string purpose, std::size_t held)
      : device_(device), purpose_(std::move(purpose)), held_(held) {}

  /// Makes a buffer have at least so many bytes. Throws Error, saying how much is needed and there is, if the
  /// device cannot hold it besides what is held.
  void reserve(cl::Buffer& buffer, std::size_t bytes);

 private:
  Device device_;
  std::string purpose_;
  std::size_t held_;
};

/// Whether kernels and the host work in the same memory.
bool shares_memory(const Device& device);

/// A buffer in the host's memory, which must stay there until its last command is done. What is there counts
/// for nothing; what kernels wrote is there once synchronise() was called.
cl::Buffer buffer_at(const Device& device, void* memory, std::size_t bytes, const std::string& purpose);
void synchronise(const Device& device, const cl::Buffer& buffer, std::size_t bytes);

/// Calls a function that lets kernels use memory of the host's, which is the caller's to free when it is
/// done: it waits for the device itself, and here if it throws before.
template <typename Function>
auto with_host_memory(const Device& device, Function function) {
  try {
    return function();
  } catch (...) {
    try {
      device.finish();
    } catch (const Error&) {  // the first error is the one to report
    }
    throw;
  }
}

/// What the caller's buffer is for.
enum class Access { read, read_and_write };

/// The bytes of a buffer.
std::size_t size_of(const cl::Buffer& buffer);

/// Throws Error, naming the buffer ("the buffer of points"), if the device's kernels cannot use `bytes` of
/// it: it is null, no buffer, of another context, too small or made for another access.
void check_foreign_buffer(const Device& device, const cl::Buffer& buffer, std::size_t bytes,
                          const std::string& name, Access access);

/// Whether the first `bytes` of two buffers, which may be parts of one buffer, have some in common. (Not
/// every driver refuses to copy such parts.)
bool overlap(const cl::Buffer& one, const cl::Buffer& other, std::size_t bytes);

/// Fills `count` values; returns the command's event.
template <typename T>
cl::Event fill(const Device& device, const cl::Buffer& buffer, T value, std::size_t count) {
  cl::Event event;
  check(clEnqueueFillBuffer(device.queue()(), buffer(), &value, sizeof(T), 0, count * sizeof(T), 0, nullptr,
                            &event()),
        "filling a buffer");
  Internal::state(device).enqueued(event);
  return event;
}

/// Copies bytes of a buffer, by default the first ones, to another one; returns the command's event.
cl::Event copy(const Device& device, const cl::Buffer& from, const cl::Buffer& to, std::size_t bytes,
               std::size_t first_from = 0, std::size_t first_to = 0);

/// Copies to the device. Waits, so that the caller may reuse the values.
template <typename T>
void upload(const Device& device, const cl::Buffer& buffer, const std::vector<T>& values) {
  if (values.empty()) return;
  check(clEnqueueWriteBuffer(device.queue()(), buffer(), CL_TRUE, 0, values.size() * sizeof(T), values.data(),
                             0, nullptr, nullptr),
        "writing a buffer");
}

/// Values on their way to the device: they stay here until they are there, so that the host need not wait.
template <typename T>
class Upload {
 public:
  using Values = std::shared_ptr<const std::vector<T>>;

  Upload() = default;
  ~Upload() {
    // If the device fails, it says so where somebody waits for what it makes of the values. But where the
    // wait alone fails, it may still read them.
    if (copied_() == nullptr || process_number() != process_)
      return;  // a forked child would wait without end
    if (clWaitForEvents(1, &copied_()) != CL_SUCCESS) clFinish(queue_());
  }
  Upload(const Upload&) = delete;
  Upload& operator=(const Upload&) = delete;

  /// Enqueues that the values are copied to the start of a buffer. Waits for the last ones.
  void start(const Device& device, const cl::Buffer& buffer, std::vector<T>&& values) {
    start(device, buffer, std::make_shared<const std::vector<T>>(std::move(values)));
  }

  /// The same of values that somebody else has besides.
  void start(const Device& device, const cl::Buffer& buffer, Values values) {
    keep(device, std::move(values));
    if (values_->empty()) return;
    check(clEnqueueWriteBuffer(queue_(), buffer(), CL_FALSE, 0, values_->size() * sizeof(T), values_->data(),
                               0, nullptr, &copied_()),
          "writing a buffer");
    Internal::state(device).enqueued(copied_);
  }

  /// Keeps values that the device reads where they are, until it has done what `read()` enqueues.
  template <typename Read>
  void start_where_they_are(const Device& device, Values values, Read read) {
    keep(device, std::move(values));
    copied_ = with_host_memory(device, read);
  }

 private:
  void keep(const Device& device, Values values) {
    const cl::CommandQueue& queue = device.queue();  // refuses a forked child
    if (copied_() != nullptr) check(clWaitForEvents(1, &copied_()), "waiting for values to be copied");
    copied_ = cl::Event();
    values_ = std::move(values);
    queue_ = queue;
    process_ = process_number();
  }

  Values values_;
  cl::CommandQueue queue_;
  cl::Event copied_;
  std::int64_t process_ = 0;  // that enqueued the copy
};

/// Copies `count` values from the device to where they fit, or to a vector. Waits.
template <typename T>
void download(const Device& device, const cl::Buffer& buffer, std::size_t count, T* values) {
  if (count == 0) return;
  check(clEnqueueReadBuffer(device.queue()(), buffer(), CL_TRUE, 0, count * sizeof(T), values, 0, nullptr,
                            nullptr),
        "reading a buffer");
}
template <typename T>
std::vector<T> download(const Device& device, const cl::Buffer& buffer, std::size_t count) {
  std::vector<T> values(count);
  download(device, buffer, count, values.data());
  return values;
}

}  // namespace vorocl
