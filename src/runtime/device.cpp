#include "vorocl/device.hpp"

#include <algorithm>
#include <cctype>
#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <mutex>
#include <optional>
#include <utility>

#include "runtime/device_state.hpp"
#include "runtime/first_launches.hpp"
#include "runtime/opencl_info.hpp"
#include "runtime/process.hpp"

namespace vorocl {

namespace {

struct Candidate {
  DeviceDescription description;
  cl_device_id device;
};

std::string lower(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text;
}

bool contains(const std::string& text, const std::string& part) {
  return lower(text).find(lower(part)) != std::string::npos;
}

/// Why kernels cannot be built or run there; empty if they can.
std::string unusable_because(cl_device_id device) {
  if (device_info<cl_bool>(device, CL_DEVICE_AVAILABLE) != CL_TRUE) return "it is not available";
  if (device_info<cl_bool>(device, CL_DEVICE_COMPILER_AVAILABLE) != CL_TRUE)
    return "it has no OpenCL C compiler";
  const auto version = device_info<std::string>(device, CL_DEVICE_OPENCL_C_VERSION);  // "OpenCL C 1.2 ..."
  if (version.compare(0, 11, "OpenCL C 1.") == 0 && version.compare(0, 12, "OpenCL C 1.2") < 0) {
    return "it has " + version.substr(0, 12) + " and OpenCL C 1.2 is needed";
  }
  return "";
}

std::string type_name(cl_device_type type) {
  if (type & CL_DEVICE_TYPE_GPU) return "GPU";
  return type & CL_DEVICE_TYPE_CPU ? "CPU" : "accelerator";
}

std::vector<cl_platform_id> find_platforms() {
  cl_uint count = 0;
  // The loader returns an error code of its own where there is no platform at all.
  if (clGetPlatformIDs(0, nullptr, &count) != CL_SUCCESS) return {};
  std::vector<cl_platform_id> platforms(count);
  check(clGetPlatformIDs(count, platforms.data(), nullptr), "listing the OpenCL platforms");
  return platforms;
}

std::vector<cl_device_id> find_devices(cl_platform_id platform) {
  cl_uint count = 0;
  if (clGetDeviceIDs(platform, CL_DEVICE_TYPE_ALL, 0, nullptr, &count) != CL_SUCCESS)
    return {};  // it has none
  std::vector<cl_device_id> devices(count);
  check(clGetDeviceIDs(platform, CL_DEVICE_TYPE_ALL, count, devices.data(), nullptr),
        "listing the OpenCL devices");
  return devices;
}

DeviceDescription describe(cl_platform_id platform, cl_device_id device) {
  DeviceDescription description;
  description.platform = info<std::string>(clGetPlatformInfo, platform, CL_PLATFORM_NAME);
  description.name = device_info<std::string>(device, CL_DEVICE_NAME);
  description.type = type_name(device_info<cl_device_type>(device, CL_DEVICE_TYPE));
  description.opencl_version = device_info<std::string>(device, CL_DEVICE_VERSION);
  description.driver_version = device_info<std::string>(device, CL_DRIVER_VERSION);
  description.compute_units = device_info<cl_uint>(device, CL_DEVICE_MAX_COMPUTE_UNITS);
  description.global_memory = device_info<cl_ulong>(device, CL_DEVICE_GLOBAL_MEM_SIZE);
  description.max_allocation = device_info<cl_ulong>(device, CL_DEVICE_MAX_MEM_ALLOC_SIZE);
  description.why_not = unusable_because(device);
  return description;
}

/// The names of the drivers that the loader knows of, with commas between them.
std::string installed_drivers() {
  const char* const named = std::getenv("OCL_ICD_VENDORS");
  const std::filesystem::path folder = named != nullptr ? named : "/etc/OpenCL/vendors";
  std::string names;
  std::error_code code;
  for (std::filesystem::directory_iterator file(folder, code), end; !code && file != end;
       file.increment(code)) {
    if (file->path().extension() != ".icd") continue;
    names += (names.empty() ? "" : ", ") + file->path().stem().string();
  }
  return names;
}

/// PoCL ends the process where its variable is set but empty.
void refuse_what_ends_pocl() {
  const char* const cache = std::getenv("POCL_CACHE_DIR");
  if (cache == nullptr || *cache != '\0') return;
  if (const std::string drivers = installed_drivers(); !drivers.empty() && !contains(drivers, "pocl")) return;
  throw Error(
      "POCL_CACHE_DIR is set but empty, and PoCL ends the process for that: unset it, or let it name a "
      "folder",
      ErrorKind::device);
}

std::vector<Candidate> find_candidates() {
  // The loader (ocl-icd) and PoCL set themselves up when they are first asked, without a lock: threads that
  // ask at the same time see no platform, or crash.
  static std::mutex first_contact;
  const std::lock_guard<std::mutex> lock(first_contact);
  static const std::int64_t process = process_number();
  refuse_fork_of(process);
  refuse_what_ends_pocl();
  std::vector<Candidate> candidates;
  const std::vector<cl_platform_id> platforms = find_platforms();
  for (std::size_t p = 0; p < platforms.size(); ++p) {
    const std::vector<cl_device_id> devices = find_devices(platforms[p]);
    for (std::size_t d = 0; d < devices.size(); ++d) {
      candidates.push_back({describe(platforms[p], devices[d]), devices[d]});
      candidates.back().description.platform_index = p;
      candidates.back().description.device_index = d;
    }
  }
  return candidates;
}

/// The library's own order, least first, and its reason.
std::pair<int, std::string> preference(const DeviceDescription& device) {
  // A simulator calls itself a GPU, and is for who asks for it by name.
  if (contains(device.platform, "oclgrind")) return {4, "there is nothing but a simulator"};
  if (device.type == "GPU" && contains(device.platform, "nvidia")) return {0, "an NVIDIA GPU comes first"};
  if (device.type == "GPU") return {1, "there is no NVIDIA GPU, and another GPU comes next"};
  if (device.type == "CPU") return {2, "there is no GPU"};
  return {3, "there is neither GPU nor CPU"};
}

bool matches(const DeviceDescription& device, const std::string& request) {
  const std::string indices =
      std::to_string(device.platform_index) + ":" + std::to_string(device.device_index);
  return request == indices || contains(device.platform, request) || contains(device.name, request);
}

/// The candidate to take, with its reason filled in; none if nothing matches the request.
std::optional<Candidate> choose(const std::vector<Candidate>& candidates, const std::string& request) {
  std::optional<Candidate> best;
  for (const Candidate& candidate : candidates) {
    const DeviceDescription& device = candidate.description;
    if (!device.why_not.empty() || (!request.empty() && !matches(device, request))) continue;
    if (!best || preference(device).first < preference(best->description).first) best = candidate;
  }
  if (best) {
    best->description.selected = true;
    best->description.asked_for = !request.empty();
    best->description.reason =
        request.empty() ? preference(best->description).second : "\"" + request + "\" was asked for";
  }
  return best;
}

std::string effective_request(const std::string& request) {
  return request.empty() ? environment("VOROCL_DEVICE") : request;
}

/// "0:0 Portable Computing Language: pthread-...; 1:0 ..."
std::string list_of(const std::vector<Candidate>& candidates) {
  std::string text;
  for (const Candidate& candidate : candidates) {
    const DeviceDescription& device = candidate.description;
    text += (text.empty() ? "" : "; ") + std::to_string(device.platform_index) + ":" +
            std::to_string(device.device_index) + " " + device.platform + ": " + device.name;
    if (!device.why_not.empty()) text += " (cannot be used: " + device.why_not + ")";
  }
  return text;
}

/// Where there is no platform: none of the drivers is installed, or none could start. The loader does not say
/// why; what is known to stop them is looked at.
Error no_platform() {
  const std::string drivers = installed_drivers();
  if (drivers.empty()) {
    return Error(
        "no OpenCL platform was found; install a driver: NVIDIA's for its GPUs, or PoCL for the CPU (on "
        "Debian and Ubuntu: apt-get install pocl-opencl-icd; for Python without root: pip install "
        "intel-opencl-rt intel-cmplr-lib-rt)",
        ErrorKind::device);
  }
  std::string text = "no OpenCL driver could start, of those that are installed (" + drivers + ")";
  if (const auto limit = address_space_limit()) {
    text +=
        "; the address space is limited to " + std::to_string(*limit >> 20) + " MiB: raise it (ulimit -v)";
  }
  if (const char* const devices = std::getenv("POCL_DEVICES"); devices != nullptr) {
    text += std::string("; POCL_DEVICES is \"") + devices +
            "\", and PoCL does not start if that names no device that it knows: unset it";
  }
  if (const std::string cache = trouble_with_cache_of_pocl(); !cache.empty()) text += "; " + cache;
  return Error(text, ErrorKind::device);
}

GroupLimits group_limits(cl_device_id device) {
  std::vector<std::size_t> sizes(device_info<cl_uint>(device, CL_DEVICE_MAX_WORK_ITEM_DIMENSIONS));
  check(clGetDeviceInfo(device, CL_DEVICE_MAX_WORK_ITEM_SIZES, sizes.size() * sizeof(std::size_t),
                        sizes.data(), nullptr),
        "asking for the sizes of work-groups");
  return {std::min(device_info<std::size_t>(device, CL_DEVICE_MAX_WORK_GROUP_SIZE), sizes.at(0)),
          sizes.at(1)};
}

Tuning default_tuning(cl_device_id device, const GroupLimits& limits) {
  Tuning tuning;
  if ((device_info<cl_device_type>(device, CL_DEVICE_TYPE) & CL_DEVICE_TYPE_CPU) != 0) {
    // As many lanes as the CPU's registers hold, and a work-group that walks along a row.
    const auto lanes = static_cast<int>(device_info<cl_uint>(device, CL_DEVICE_NATIVE_VECTOR_WIDTH_INT));
    while (tuning.vector_width < 16 && tuning.vector_width * 2 <= lanes) tuning.vector_width *= 2;
    tuning.group_width = 64;
    tuning.group_height = 1;
  } else {
    tuning.shape = Shape::group;
  }
  while (tuning.group_height > 1 && !limits.allow(tuning.group_width, tuning.group_height))
    tuning.group_height /= 2;
  while (tuning.group_width > 1 && !limits.allow(tuning.group_width, tuning.group_height))
    tuning.group_width /= 2;
  if (tuning.patch_items > limits.items) tuning.shape = Shape::vector;
  return tuning;
}

}  // namespace

void DeviceState::enqueued(const cl::Event& command) {
  cl::Event older;
  {
    const std::lock_guard<std::mutex> lock(flight_mutex_);
    last_ = command;
    if (++commands_ < batch) return;
    commands_ = 0;
    older = end_of_batch_;
    end_of_batch_ = command;
  }
  if (older() == nullptr) return;
  const auto start = std::chrono::steady_clock::now();
  check(clWaitForEvents(1, &older()), "waiting for earlier commands");
  milliseconds_waited() +=
      std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
}

void DeviceState::launched(const LaunchKind& kind, const cl::Event& launch) {
  cl::Event before;
  {
    const std::lock_guard<std::mutex> lock(flight_mutex_);
    if (kinds_.insert(kind).second) before = last_;
  }
  if (before() != nullptr) FirstLaunches::add(before, launch);
  enqueued(launch);
}

double& DeviceState::milliseconds_waited() {
  thread_local double milliseconds = 0;
  return milliseconds;
}

Device Device::select(const std::string& request) {
  const std::vector<Candidate> candidates = find_candidates();
  if (candidates.empty()) throw no_platform();
  const std::string wanted = effective_request(request);
  const std::optional<Candidate> chosen = choose(candidates, wanted);
  if (!chosen) {
    throw Error((wanted.empty() ? "no OpenCL device can be used"
                                : "no usable OpenCL device matches \"" + wanted + "\"") +
                    "; there is " + list_of(candidates),
                ErrorKind::device);
  }
  cl_int code = CL_SUCCESS;
  const cl::Context context(clCreateContext(nullptr, 1, &chosen->device, nullptr, nullptr, &code));
  check(code, [&] { return "making a context on " + chosen->description.name; });
  const cl::CommandQueue queue(
      clCreateCommandQueue(context(), chosen->device, CL_QUEUE_PROFILING_ENABLE, &code));
  check(code, [&] { return "making a queue on " + chosen->description.name; });
  return Device(context, queue);
}

std::vector<DeviceDescription> Device::list(const std::string& request) {
  const std::vector<Candidate> candidates = find_candidates();
  const std::optional<Candidate> chosen = choose(candidates, effective_request(request));
  std::vector<DeviceDescription> devices;
  for (const Candidate& candidate : candidates) {
    const bool selected = chosen && candidate.device == chosen->device;
    devices.push_back(selected ? chosen->description : candidate.description);
  }
  return devices;
}

Device::Device(const cl::Context& context, const cl::CommandQueue& queue)
    : state_(std::make_shared<DeviceState>()) {
  if (context() == nullptr || queue() == nullptr)
    throw Error("a Device needs a context and a queue; one is null");
  if (info<cl_context>(clGetCommandQueueInfo, queue(), CL_QUEUE_CONTEXT) != context()) {
    throw Error("the queue belongs to another context");
  }
  const auto properties =
      info<cl_command_queue_properties>(clGetCommandQueueInfo, queue(), CL_QUEUE_PROPERTIES);
  if ((properties & CL_QUEUE_OUT_OF_ORDER_EXEC_MODE_ENABLE) != 0) {
    throw Error("the queue is out of order; VoroCL needs an in-order queue");
  }
  state_->context = context;
  state_->queue = queue;
  const auto device = info<cl_device_id>(clGetCommandQueueInfo, queue(), CL_QUEUE_DEVICE);
  state_->device = cl::Device(device, true);
  state_->limits = group_limits(device);
  tuning_ = default_tuning(device, state_->limits);
}

const cl::Context& Device::context() const { return state_->context; }
cl::CommandQueue& Device::queue() const {
  refuse_fork_of(state_->process);
  return state_->queue;
}
const cl::Device& Device::cl_device() const { return state_->device; }
const Tuning& Device::tuning() const { return tuning_; }
std::string Device::name() const { return device_info<std::string>(cl_device()(), CL_DEVICE_NAME); }
std::string Device::driver_version() const {
  return device_info<std::string>(cl_device()(), CL_DRIVER_VERSION);
}

std::string Device::platform_name() const {
  const auto platform = device_info<cl_platform_id>(cl_device()(), CL_DEVICE_PLATFORM);
  return info<std::string>(clGetPlatformInfo, platform, CL_PLATFORM_NAME);
}

void Device::on_compiling(const std::function<void()>& notice) const {
  const std::lock_guard<std::mutex> lock(state_->programs_mutex);
  state_->on_compiling = notice;
}

Device Device::with_tuning(const Tuning& tuning) const {
  const int width = tuning.vector_width;
  if (width < 1 || width > 16 || (width & (width - 1)) != 0) {
    throw Error("a vector width of " + std::to_string(width) +
                " is not possible; it must be 1, 2, 4, 8 or 16");
  }
  const GroupLimits& limits = state_->limits;
  if (!limits.allow(tuning.group_width, tuning.group_height)) {
    throw Error("a work-group of " + std::to_string(tuning.group_width) + " x " +
                std::to_string(tuning.group_height) + " is not possible; " + name() + " allows 1 to " +
                std::to_string(limits.items) + " work-items in 1 to " + std::to_string(limits.rows) +
                " rows");
  }
  const std::size_t patch = tuning.patch_items;
  if (tuning.shape == Shape::group &&
      (patch < 32 || patch > 256 || (patch & (patch - 1)) != 0 || patch > limits.items)) {
    throw Error("a patch cannot be labelled by " + std::to_string(patch) +
                " work-items; they must be 32, 64, 128 or 256, and " + name() + " allows " +
                std::to_string(limits.items));
  }
  Device tuned = *this;
  tuned.tuning_ = tuning;
  return tuned;
}

void Device::finish() const {
  const cl_int code = clFinish(queue()());
  if (code == CL_SUCCESS) return;
  // Where the wait alone fails, commands go on, and those who hear of it free what these write to.
  cl::Event behind_all;
  if (clEnqueueMarkerWithWaitList(queue()(), 0, nullptr, &behind_all()) == CL_SUCCESS)
    clWaitForEvents(1, &behind_all());
  check(code, [&] { return "waiting for " + name(); });
}

void Device::wait_for(const std::vector<cl::Event>& events) const {
  std::vector<cl_event> handles;
  for (const cl::Event& event : events) {
    if (event() == nullptr) throw Error("an event to wait for is null");
    if (info<cl_context>(clGetEventInfo, event(), CL_EVENT_CONTEXT) != context()()) {
      throw Error("an event to wait for belongs to another OpenCL context than the device");
    }
    handles.push_back(event());
  }
  if (handles.empty()) return;
  check(
      clEnqueueBarrierWithWaitList(queue()(), static_cast<cl_uint>(handles.size()), handles.data(), nullptr),
      [&] { return "enqueueing a wait on " + name(); });
}

}  // namespace vorocl
