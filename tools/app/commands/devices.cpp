// vorocl devices: the OpenCL devices, which of them would be picked, and why; and whether they are right.
#include <fmt/format.h>

#include <memory>
#include <nlohmann/json.hpp>

#include "app/commands/commands.hpp"
#include "app/options/option_groups.hpp"
#include "app/terminal/console.hpp"
#include "app/terminal/end_of_run.hpp"
#include "checks/known_answers.hpp"
#include "vorocl/device.hpp"

namespace vorocl::command {

namespace {

struct DevicesOptions {
  std::string device;
  bool check = false;
  bool json = false;
};

std::string index_of(const DeviceDescription& device) {
  return fmt::format("{}:{}", device.platform_index, device.device_index);
}

Json list_of(const std::vector<DeviceDescription>& devices) {
  std::vector<Json> list;
  list.reserve(devices.size());
  for (const DeviceDescription& device : devices) {
    list.push_back(Json{{"index", index_of(device)},
                        {"platform", device.platform},
                        {"name", device.name},
                        {"type", device.type},
                        {"opencl_version", device.opencl_version},
                        {"driver_version", device.driver_version},
                        {"compute_units", device.compute_units},
                        {"global_memory", device.global_memory},
                        {"max_allocation", device.max_allocation},
                        {"selected", device.selected},
                        {"reason", device.selected ? device.reason : device.why_not}});
  }
  return list;
}

void print_text(const DeviceDescription& device) {
  constexpr double mebibyte = 1 << 20;
  print("{}  {}\n", index_of(device), device.name);
  print("     platform  {}\n", device.platform);
  print("     version   {}, driver {}\n", device.opencl_version, device.driver_version);
  print("     type      {}, {} compute units\n", device.type, device.compute_units);
  print("     memory    {:.0f} MiB, {:.0f} MiB in one buffer\n",
        static_cast<double>(device.global_memory) / mebibyte,
        static_cast<double>(device.max_allocation) / mebibyte);
  if (!device.why_not.empty()) print("     cannot be used: {}\n", device.why_not);
  if (device.selected) print("     selected: {}\n", device.reason);
}

/// The one that was asked for, or those that can be used.
std::vector<DeviceDescription> devices_to_check(const std::string& request) {
  std::vector<DeviceDescription> devices;
  for (const DeviceDescription& device : Device::list(request)) {
    if (device.asked_for) return {device};
    if (device.why_not.empty()) devices.push_back(device);
  }
  return devices;
}

/// Throws Error, after all is printed, if a diagram was wrong.
void check(const DevicesOptions& options) {
  const std::size_t all = known_answers().size();
  std::vector<Json> list;
  std::string errors;
  for (const DeviceDescription& device : devices_to_check(options.device)) {
    const Device checked = Device::select(index_of(device));
    const FinishAtEnd finish(checked);
    const std::vector<std::string> wrong = wrong_answers(checked);
    list.push_back(Json{{"index", index_of(device)},
                        {"platform", device.platform},
                        {"name", device.name},
                        {"checked", all},
                        {"wrong", wrong}});
    if (!options.json) {
      print("{}  {}\n", index_of(device), device.name);
      for (const std::string& answer : wrong) print("     wrong: {}\n", answer);
      print("     {} of {} known diagrams are right\n", all - wrong.size(), all);
    }
    if (!wrong.empty()) {
      errors += fmt::format("{}{} gets {} of {} known diagrams wrong", errors.empty() ? "" : "; ",
                            device.name, wrong.size(), all);
    }
  }
  if (options.json) print_json({{"devices", list}});
  if (!errors.empty()) throw Error(errors + "; take another device or another version of its driver");
}

void run(const DevicesOptions& options) {
  Device::select(options.device);  // throws, with the reason, if no device can be used
  if (options.check) return check(options);
  const std::vector<DeviceDescription> devices = Device::list(options.device);
  if (options.json) {
    print_json({{"devices", list_of(devices)}});
  } else {
    for (const DeviceDescription& device : devices) print_text(device);
  }
}

}  // namespace

void add_devices(CommandLine& line) {
  const auto options = std::make_shared<DevicesOptions>();
  Command command = line.add("devices", "List the OpenCL devices and the one that would be used");
  add_device_option(command, options->device);
  command.add("--check", options->check,
              "Make small diagrams whose labels are known; exit code 1 if one is wrong");
  add_json_option(command, options->json);
  command.set_work([options] { run(*options); });
}

}  // namespace vorocl::command
