// vorocl devices: the OpenCL devices, which of them would be picked, and why.
#include <fmt/format.h>

#include <memory>

#include "app/commands/commands.hpp"
#include "app/options/common_options.hpp"
#include "app/terminal/console.hpp"
#include "app/terminal/json.hpp"
#include "vorocl/device.hpp"

namespace vorocl::command {

namespace {

struct DevicesOptions {
  std::string device;
  bool json = false;
};

Json list_of(const std::vector<DeviceDescription>& devices) {
  std::vector<Json> list;
  for (const DeviceDescription& device : devices) {
    list.push_back(Json::Members{{"index", fmt::format("{}:{}", device.platform_index, device.device_index)},
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
  print("{}:{}  {}\n", device.platform_index, device.device_index, device.name);
  print("     platform  {}\n", device.platform);
  print("     version   {}, driver {}\n", device.opencl_version, device.driver_version);
  print("     type      {}, {} compute units\n", device.type, device.compute_units);
  print("     memory    {:.0f} MiB, {:.0f} MiB in one buffer\n",
        static_cast<double>(device.global_memory) / mebibyte,
        static_cast<double>(device.max_allocation) / mebibyte);
  if (!device.why_not.empty()) print("     cannot be used: {}\n", device.why_not);
  if (device.selected) print("     selected: {}\n", device.reason);
}

void run(const DevicesOptions& options) {
  Device::select(options.device);  // throws, with the reason, if no device can be used
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
  add_json_option(command, options->json);
  command.set_work([options] { run(*options); });
}

}  // namespace vorocl::command
