// vorocl devices: what there is, what would be picked, and why.
#include <fmt/format.h>

#include <memory>
#include <nlohmann/json.hpp>

#include "app/commands/commands.hpp"
#include "app/options/options.hpp"
#include "vorocl/device.hpp"

namespace vorocl::command {

namespace {

struct DevicesOptions {
  std::string device;
  bool json = false;
};

void print_json(const std::vector<DeviceDescription>& devices) {
  auto list = nlohmann::ordered_json::array();
  for (const DeviceDescription& device : devices) {
    list.push_back({{"index", fmt::format("{}:{}", device.platform_index, device.device_index)},
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
  fmt::print("{}\n", nlohmann::ordered_json{{"devices", list}}.dump());
}

void print_text(const DeviceDescription& device) {
  constexpr double mebibyte = 1 << 20;
  fmt::print("{}:{}  {}\n", device.platform_index, device.device_index, device.name);
  fmt::print("     platform  {}\n", device.platform);
  fmt::print("     version   {}, driver {}\n", device.opencl_version, device.driver_version);
  fmt::print("     type      {}, {} compute units\n", device.type, device.compute_units);
  fmt::print("     memory    {:.0f} MiB, {:.0f} MiB in one buffer\n",
             static_cast<double>(device.global_memory) / mebibyte,
             static_cast<double>(device.max_allocation) / mebibyte);
  if (!device.why_not.empty()) fmt::print("     cannot be used: {}\n", device.why_not);
  if (device.selected) fmt::print("     selected: {}\n", device.reason);
}

void run(const DevicesOptions& options) {
  Device::select(options.device);  // for its reasons where there is nothing to select
  const std::vector<DeviceDescription> devices = Device::list(options.device);
  if (options.json) {
    print_json(devices);
  } else {
    for (const DeviceDescription& device : devices) print_text(device);
  }
}

}  // namespace

void add_devices(CLI::App& app) {
  const auto options = std::make_shared<DevicesOptions>();
  CLI::App* const command =
      app.add_subcommand("devices", "List the OpenCL devices and the one that would be used");
  add_device_option(*command, options->device);
  add_json_option(*command, options->json);
  command->callback([options] { run(*options); });
}

}  // namespace vorocl::command
