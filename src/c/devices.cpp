// The C functions of devices.
#include <vector>

#include "calls.hpp"

using namespace vorocl;

struct vorocl_device_list {
  std::vector<DeviceDescription> devices;
};

namespace {
std::string text(const char* request) { return request == nullptr ? "" : request; }
}  // namespace

vorocl_status vorocl_device_select(const char* request, vorocl_device** device) {
  return make_object(device, "device", [&] { return vorocl_device(Device::select(text(request))); });
}

vorocl_status vorocl_device_adopt(cl_context context, cl_command_queue queue, vorocl_device** device) {
  return make_object(device, "device", [&] {
    given(context, "context");
    given(queue, "queue");
    return vorocl_device(Device(cl::Context(context, true), cl::CommandQueue(queue, true)));
  });
}

void vorocl_device_free(vorocl_device* device) { delete device; }

vorocl_status vorocl_device_name(const vorocl_device* device, const char** name) {
  return answer(name, "name", [&] { return given(device, "device").name.c_str(); });
}

vorocl_status vorocl_device_platform_name(const vorocl_device* device, const char** name) {
  return answer(name, "name", [&] { return given(device, "device").platform_name.c_str(); });
}

vorocl_status vorocl_device_driver_version(const vorocl_device* device, const char** version) {
  return answer(version, "version", [&] { return given(device, "device").driver_version.c_str(); });
}

vorocl_status vorocl_device_context(const vorocl_device* device, cl_context* context) {
  return answer(context, "context", [&] { return of(device).context()(); });
}

vorocl_status vorocl_device_queue(const vorocl_device* device, cl_command_queue* queue) {
  return answer(queue, "queue", [&] { return of(device).queue()(); });
}

vorocl_status vorocl_device_id(const vorocl_device* device, cl_device_id* id) {
  return answer(id, "id", [&] { return of(device).cl_device()(); });
}

vorocl_status vorocl_device_wait_for(const vorocl_device* device, size_t count, const cl_event* events) {
  return guarded([&] {
    if (count > 0) given(events, "events");
    std::vector<cl::Event> all;
    for (std::size_t i = 0; i < count; ++i) all.emplace_back(events[i], true);
    of(device).wait_for(all);
  });
}

vorocl_status vorocl_device_finish(const vorocl_device* device) {
  return guarded([&] { of(device).finish(); });
}

vorocl_status vorocl_device_tuning(const vorocl_device* device, vorocl_tuning* tuning) {
  return guarded([&] {
    const Tuning& from = of(device).tuning();
    given(tuning, "tuning") = {from.vector_width, from.group_width, from.group_height,
                               from.shape == Shape::group ? VOROCL_GROUP : VOROCL_VECTOR, from.patch_items};
  });
}

vorocl_status vorocl_device_with_tuning(const vorocl_device* device, const vorocl_tuning* tuning,
                                        vorocl_device** tuned) {
  return make_object(tuned, "tuned", [&] {
    const vorocl_tuning& to = given(tuning, "tuning");
    if (to.shape != VOROCL_GROUP && to.shape != VOROCL_VECTOR) refuse("shape", to.shape);
    const Shape shape = to.shape == VOROCL_GROUP ? Shape::group : Shape::vector;
    return vorocl_device(
        of(device).with_tuning({to.vector_width, to.group_width, to.group_height, shape, to.patch_items}));
  });
}

// --- the list ---

vorocl_status vorocl_device_list_create(const char* request, vorocl_device_list** list) {
  return make_object(list, "list", [&] { return vorocl_device_list{Device::list(text(request))}; });
}

void vorocl_device_list_free(vorocl_device_list* list) { delete list; }

vorocl_status vorocl_device_list_count(const vorocl_device_list* list, size_t* count) {
  return answer(count, "count", [&] { return given(list, "list").devices.size(); });
}

vorocl_status vorocl_device_list_get(const vorocl_device_list* list, size_t index,
                                     vorocl_device_description* description) {
  return guarded([&] {
    const DeviceDescription& from = at(given(list, "list").devices, index, "devices");
    vorocl_device_description& to = given(description, "description");
    to.platform_index = from.platform_index;
    to.device_index = from.device_index;
    to.platform = from.platform.c_str();
    to.name = from.name.c_str();
    to.type = from.type.c_str();
    to.opencl_version = from.opencl_version.c_str();
    to.driver_version = from.driver_version.c_str();
    to.compute_units = from.compute_units;
    to.global_memory = from.global_memory;
    to.max_allocation = from.max_allocation;
    to.why_not = from.why_not.c_str();
    to.selected = from.selected ? 1 : 0;
    to.reason = from.reason.c_str();
  });
}
