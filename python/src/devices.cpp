// Devices, and the grids and reports that say sizes and times.
#include <nanobind/stl/optional.h>
#include <nanobind/stl/vector.h>

#include "checks/known_answers.hpp"
#include "module.hpp"

namespace vorocl::python {

namespace {

Device adopt(std::uintptr_t context, std::uintptr_t queue) {
  return {retained<cl::Context>(context), retained<cl::CommandQueue>(queue)};
}

/// A grid of at most as many pixels as a diagram has: here a diagram shows all of it. `bounds` are (x0, y0,
/// x1, y1), of a volume (x0, y0, z0, x1, y1, z1); `spacing` is along x, y and z.
Grid make_grid(std::int64_t width, std::int64_t height, std::int64_t depth, bool periodic_x, bool periodic_y,
               bool periodic_z, const std::vector<int>& spacing, double tilt,
               const std::optional<std::vector<double>>& bounds, bool y_up, bool closed) {
  const std::size_t bounded = bounds ? bounds->size() / 2 : 0;
  const auto axis = [&](std::size_t i, std::int64_t pixels, bool periodic) {
    Axis made = i < bounded ? Axis(pixels, bounds->at(i), bounds->at(bounded + i)) : Axis(pixels);
    if (closed) made = made.closed();
    made = made.spaced(spacing.at(i));
    return periodic ? made.periodic() : made;
  };
  const Axis y = axis(1, height, periodic_y);
  const Grid grid =
      Grid(axis(0, width, periodic_x), y_up ? y.reversed() : y, axis(2, depth, periodic_z)).tilted(tilt);
  const std::int64_t most_along = grid.is_volume() ? Window::max_side_of_volume : Window::max_side;
  const std::uint64_t most =
      grid.is_volume() ? std::uint64_t{1} << Window::max_bits_of_volume : Window::max_pixels;
  if (width <= most_along && height <= most_along && depth <= most_along && grid.pixels() <= most)
    return grid;
  if (grid.is_volume()) {
    throw Error("the volume has " + std::to_string(width) + " x " + std::to_string(height) + " x " +
                std::to_string(depth) + " voxels; at most 16,384 along a side and 2^31 in all are possible");
  }
  throw Error("the grid has " + std::to_string(width) + " x " + std::to_string(height) +
              " pixels; at most 32,768 along a side and 2^30 in all are possible");
}

}  // namespace

void bind_devices(nb::module_& module) {
  nb::class_<Device>(module, "Device")
      .def_static("select", &Device::select, nb::arg("request"), without_gil())
      .def_static("adopt", adopt, nb::arg("context"), nb::arg("queue"), without_gil())
      .def("same_as", &Device::same_as, nb::arg("other"))
      .def("finish", &Device::finish, without_gil())
      .def_prop_ro("name", &Device::name)
      .def_prop_ro("platform", &Device::platform_name)
      .def_prop_ro("driver_version", &Device::driver_version);

  nb::class_<DeviceDescription>(module, "DeviceDescription")
      .def_ro("platform_index", &DeviceDescription::platform_index)
      .def_ro("device_index", &DeviceDescription::device_index)
      .def_ro("platform", &DeviceDescription::platform)
      .def_ro("name", &DeviceDescription::name)
      .def_ro("type", &DeviceDescription::type)
      .def_ro("opencl_version", &DeviceDescription::opencl_version)
      .def_ro("driver_version", &DeviceDescription::driver_version)
      .def_ro("compute_units", &DeviceDescription::compute_units)
      .def_ro("global_memory", &DeviceDescription::global_memory)
      .def_ro("max_allocation", &DeviceDescription::max_allocation)
      .def_ro("why_not", &DeviceDescription::why_not)
      .def_ro("selected", &DeviceDescription::selected)
      .def_ro("asked_for", &DeviceDescription::asked_for)
      .def_ro("reason", &DeviceDescription::reason)
      .def("__repr__", [](const nb::handle& self) {
        return shown(self, {"platform", "name", "type", "compute_units", "selected", "why_not"});
      });
  module.def("list_devices", &Device::list, nb::arg("request"), without_gil());

  module.def("most_preparation_parts", &most_preparation_parts);
  module.def(
      "prepare_programs",
      [](const Device& device, std::size_t index, std::size_t count) {
        return prepare_programs(device, {index, count});
      },
      nb::arg("device"), nb::arg("index"), nb::arg("count"), without_gil());

  module.def("count_known_answers", [] { return command::known_answers().size(); });
  module.def("wrong_answers", command::wrong_answers, nb::arg("device"), nb::arg("only"), without_gil());

  nb::class_<Grid>(module, "Grid")
      .def(nb::new_(&make_grid), nb::arg("width"), nb::arg("height"), nb::arg("depth"), nb::arg("periodic_x"),
           nb::arg("periodic_y"), nb::arg("periodic_z"), nb::arg("spacing"), nb::arg("tilt"),
           nb::arg("bounds").none(), nb::arg("y_up"), nb::arg("closed"));

  nb::class_<Report>(module, "Report")
      .def_prop_ro("waves", &Report::waves)
      .def_prop_ro("milliseconds", &Report::milliseconds, without_gil())
      .def_prop_ro("host_milliseconds", &Report::host_milliseconds)
      .def_prop_ro("snapped", &Report::snapped)
      .def("__repr__", [](const nb::handle& self) {
        return shown(self, {"milliseconds", "waves", "host_milliseconds"});  // waits
      });
}

}  // namespace vorocl::python
