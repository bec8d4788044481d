#include "vorocl/device.hpp"

#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <optional>
#include <utility>

#include "device_state.hpp"
#include "opencl_error.hpp"

namespace vorocl {

namespace {

struct Candidate {
  DeviceDescription description;
  cl::Platform platform;
  cl::Device device;
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
std::string unusable_because(const cl::Device& device) {
  if (device.getInfo<CL_DEVICE_AVAILABLE>() != CL_TRUE) return "it is not available";
  if (device.getInfo<CL_DEVICE_COMPILER_AVAILABLE>() != CL_TRUE) return "it has no OpenCL C compiler";
  const std::string version = device.getInfo<CL_DEVICE_OPENCL_C_VERSION>();  // "OpenCL C 1.2 ..."
  if (version.compare(0, 11, "OpenCL C 1.") == 0 && version.compare(0, 12, "OpenCL C 1.2") < 0) {
    return "it has " + version.substr(0, 12) + " and OpenCL C 1.2 is needed";
  }
  return "";
}

std::string type_name(cl_device_type type) {
  if (type & CL_DEVICE_TYPE_GPU) return "GPU";
  return type & CL_DEVICE_TYPE_CPU ? "CPU" : "accelerator";
}

std::vector<Candidate> find_candidates() {
  std::vector<Candidate> candidates;
  std::vector<cl::Platform> platforms;
  // The loader returns an error code of its own where there is no platform at all.
  if (cl::Platform::get(&platforms) != CL_SUCCESS) return candidates;
  for (std::size_t p = 0; p < platforms.size(); ++p) {
    std::vector<cl::Device> devices;
    if (platforms[p].getDevices(CL_DEVICE_TYPE_ALL, &devices) != CL_SUCCESS)
      continue;  // a platform without devices
    for (std::size_t d = 0; d < devices.size(); ++d) {
      DeviceDescription description;
      description.platform_index = p;
      description.device_index = d;
      description.platform = platforms[p].getInfo<CL_PLATFORM_NAME>();
      description.name = devices[d].getInfo<CL_DEVICE_NAME>();
      description.type = type_name(devices[d].getInfo<CL_DEVICE_TYPE>());
      description.opencl_version = devices[d].getInfo<CL_DEVICE_VERSION>();
      description.driver_version = devices[d].getInfo<CL_DRIVER_VERSION>();
      description.compute_units = devices[d].getInfo<CL_DEVICE_MAX_COMPUTE_UNITS>();
      description.global_memory = devices[d].getInfo<CL_DEVICE_GLOBAL_MEM_SIZE>();
      description.max_allocation = devices[d].getInfo<CL_DEVICE_MAX_MEM_ALLOC_SIZE>();
      description.why_not = unusable_because(devices[d]);
      candidates.push_back({description, platforms[p], devices[d]});
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
    best->description.reason =
        request.empty() ? preference(best->description).second : "\"" + request + "\" was asked for";
  }
  return best;
}

std::string effective_request(const std::string& request) {
  const char* const variable = std::getenv("VOROCL_DEVICE");
  return request.empty() && variable != nullptr ? variable : request;
}

std::string listing(const std::vector<Candidate>& candidates) {
  std::string text;
  for (const Candidate& candidate : candidates) {
    const DeviceDescription& device = candidate.description;
    text += "\n  " + std::to_string(device.platform_index) + ":" + std::to_string(device.device_index) +
            "  " + device.platform + ": " + device.name;
    if (!device.why_not.empty()) text += " (cannot be used: " + device.why_not + ")";
  }
  return text;
}

Tuning default_tuning(const cl::Device& device) {
  Tuning tuning;
  if ((device.getInfo<CL_DEVICE_TYPE>() & CL_DEVICE_TYPE_CPU) != 0) {
    // As many lanes as the CPU's registers hold, and a work-group that walks along a row.
    const auto lanes = static_cast<int>(device.getInfo<CL_DEVICE_NATIVE_VECTOR_WIDTH_INT>());
    while (tuning.vector_width < 16 && tuning.vector_width * 2 <= lanes) tuning.vector_width *= 2;
    tuning.group_width = 64;
    tuning.group_height = 1;
  }
  return tuning;
}

}  // namespace

Device Device::select(const std::string& request) {
  const std::vector<Candidate> candidates = find_candidates();
  if (candidates.empty()) {
    throw Error(
        "no OpenCL platform was found; install a driver: NVIDIA's for its GPUs, or PoCL for the CPU (on "
        "Debian and "
        "Ubuntu: apt-get install pocl-opencl-icd)");
  }
  const std::string wanted = effective_request(request);
  const std::optional<Candidate> chosen = choose(candidates, wanted);
  if (!chosen) {
    throw Error((wanted.empty() ? "no OpenCL device can be used"
                                : "no usable OpenCL device matches \"" + wanted + "\"") +
                "; there are:" + listing(candidates));
  }
  cl_int code = CL_SUCCESS;
  const cl::Context context(chosen->device, nullptr, nullptr, nullptr, &code);
  check(code, "making a context on " + chosen->description.name);
  const cl::CommandQueue queue(context, chosen->device, CL_QUEUE_PROFILING_ENABLE, &code);
  check(code, "making a queue on " + chosen->description.name);
  return Device(context, queue);
}

std::vector<DeviceDescription> Device::list(const std::string& request) {
  const std::vector<Candidate> candidates = find_candidates();
  const std::optional<Candidate> chosen = choose(candidates, effective_request(request));
  std::vector<DeviceDescription> devices;
  for (const Candidate& candidate : candidates) {
    const bool selected = chosen && candidate.device() == chosen->device();
    devices.push_back(selected ? chosen->description : candidate.description);
  }
  return devices;
}

Device::Device(const cl::Context& context, const cl::CommandQueue& queue)
    : state_(std::make_shared<State>()) {
  if (context() == nullptr || queue() == nullptr)
    throw Error("a Device needs a context and a queue; one is null");
  if (queue.getInfo<CL_QUEUE_CONTEXT>()() != context()) throw Error("the queue belongs to another context");
  if ((queue.getInfo<CL_QUEUE_PROPERTIES>() & CL_QUEUE_OUT_OF_ORDER_EXEC_MODE_ENABLE) != 0) {
    throw Error("the queue is out of order; VoroCL needs an in-order queue");
  }
  state_->context = context;
  state_->queue = queue;
  state_->device = queue.getInfo<CL_QUEUE_DEVICE>();
  tuning_ = default_tuning(state_->device);
}

const cl::Context& Device::context() const { return state_->context; }
const cl::CommandQueue& Device::queue() const { return state_->queue; }
const cl::Device& Device::cl_device() const { return state_->device; }
const Tuning& Device::tuning() const { return tuning_; }
std::string Device::name() const { return state_->device.getInfo<CL_DEVICE_NAME>(); }
std::string Device::driver_version() const { return state_->device.getInfo<CL_DRIVER_VERSION>(); }

std::string Device::platform_name() const {
  return cl::Platform(state_->device.getInfo<CL_DEVICE_PLATFORM>()).getInfo<CL_PLATFORM_NAME>();
}

Device Device::with_tuning(const Tuning& tuning) const {
  const int width = tuning.vector_width;
  if (width < 1 || width > 16 || (width & (width - 1)) != 0) {
    throw Error("a vector width of " + std::to_string(width) +
                " is not possible; it must be 1, 2, 4, 8 or 16");
  }
  const std::size_t items = tuning.group_width * tuning.group_height;
  const std::size_t most = state_->device.getInfo<CL_DEVICE_MAX_WORK_GROUP_SIZE>();
  if (items < 1 || items > most) {
    throw Error("a work-group of " + std::to_string(tuning.group_width) + " x " +
                std::to_string(tuning.group_height) + " is not possible; " + name() + " allows 1 to " +
                std::to_string(most) + " work-items");
  }
  Device tuned = *this;
  tuned.tuning_ = tuning;
  return tuned;
}

void Device::finish() const { check(state_->queue.finish(), "waiting for " + name()); }

}  // namespace vorocl
