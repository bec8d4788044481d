// Devices, and the grids and reports that say sizes and times.
#include <nanobind/stl/vector.h>

#include "module.hpp"

namespace vorocl::python {

namespace {

Device adopt(std::uintptr_t context, std::uintptr_t queue) {
  return {retained<cl::Context>(context), retained<cl::CommandQueue>(queue)};
}

Grid make_grid(std::int64_t width, std::int64_t height, bool periodic_x, bool periodic_y) {
  const Periodic periodic =
      periodic_x ? (periodic_y ? Periodic::xy : Periodic::x) : (periodic_y ? Periodic::y : Periodic::none);
  return {width, height, periodic};
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
      .def_ro("reason", &DeviceDescription::reason)
      .def("__repr__", [](const nb::handle& self) {
        return shown(self, {"platform", "name", "type", "compute_units", "selected", "why_not"});
      });
  module.def("list_devices", &Device::list, nb::arg("request"), without_gil());

  nb::class_<Grid>(module, "Grid")
      .def(nb::new_(&make_grid), nb::arg("width"), nb::arg("height"), nb::arg("periodic_x"),
           nb::arg("periodic_y"))
      .def_prop_ro("width", &Grid::width)
      .def_prop_ro("height", &Grid::height)
      .def_prop_ro("periodic_x", &Grid::periodic_x)
      .def_prop_ro("periodic_y", &Grid::periodic_y);

  nb::class_<Report>(module, "Report")
      .def_prop_ro("waves", &Report::waves)
      .def_prop_ro("milliseconds", &Report::milliseconds, without_gil())
      .def_prop_ro("host_milliseconds", &Report::host_milliseconds)
      .def("__repr__", [](const nb::handle& self) {
        return shown(self, {"waves", "host_milliseconds"});  // milliseconds would wait
      });
}

}  // namespace vorocl::python
