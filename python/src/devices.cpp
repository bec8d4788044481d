// Devices, and the grids and reports that say sizes and times.
#include <nanobind/stl/optional.h>
#include <nanobind/stl/tuple.h>
#include <nanobind/stl/vector.h>

#include <tuple>

#include "checks/known_answers.hpp"
#include "module.hpp"

namespace vorocl::python {

namespace {

Device adopt(std::uintptr_t context, std::uintptr_t queue) {
  return {retained<cl::Context>(context), retained<cl::CommandQueue>(queue)};
}

/// The fields of vorocl.DeviceDescription.
auto list(const std::string& request) {
  const auto fields_of = [](const DeviceDescription& found) {
    return std::tuple(found.platform_index, found.device_index, found.platform, found.name, found.type,
                      found.opencl_version, found.driver_version, found.compute_units, found.global_memory,
                      found.max_allocation, found.why_not, found.selected, found.asked_for, found.reason);
  };
  std::vector<decltype(fields_of(DeviceDescription()))> all;
  for (const DeviceDescription& found : Device::list(request)) all.push_back(fields_of(found));
  return all;
}

/// A grid of at most as many pixels as a diagram has: here a diagram shows all of it. `bounds` are (x0, y0,
/// x1, y1), of a volume (x0, y0, z0, x1, y1, z1); `spacing` is along x, y and z; `tilts`
/// are xy, xz and yz.
Grid make_grid(std::int64_t width, std::int64_t height, std::int64_t depth, bool periodic_x, bool periodic_y,
               bool periodic_z, const std::vector<int>& spacing, const std::vector<double>& tilts,
               const std::optional<std::vector<double>>& bounds, bool y_up, bool closed) {
  const std::size_t bounded = bounds ? bounds->size() / 2 : 0;
  const auto axis = [&](std::size_t i, std::int64_t pixels, bool periodic) {
    Axis made = i < bounded ? Axis(pixels, bounds->at(i), bounds->at(bounded + i)) : Axis(pixels);
    if (closed) made = made.closed();
    made = made.spaced(spacing.at(i));
    return periodic ? made.periodic() : made;
  };
  const Axis y = axis(1, height, periodic_y);
  const Grid grid = Grid(axis(0, width, periodic_x), y_up ? y.reversed() : y, axis(2, depth, periodic_z))
                        .tilted(tilts.at(0), tilts.at(1), tilts.at(2));
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

  module.def("list_devices", list, nb::arg("request"), without_gil());

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
           nb::arg("periodic_y"), nb::arg("periodic_z"), nb::arg("spacing"), nb::arg("tilts"),
           nb::arg("bounds").none(), nb::arg("y_up"), nb::arg("closed"));

  nb::class_<Report>(module, "Report", "What filling a diagram took: see `Diagram.fill`.")
      .def_prop_ro("waves", &Report::waves)
      .def_prop_ro("milliseconds", &Report::milliseconds, without_gil())
      .def_prop_ro("host_milliseconds", &Report::host_milliseconds)
      .def_prop_ro("snapped", &Report::snapped)
      .def("__repr__", [](const Report& self) {
        return nb::str("Report(milliseconds={!r}, waves={!r}, host_milliseconds={!r})")
            .format(self.milliseconds(), self.waves(), self.host_milliseconds());  // waits
      });
}

}  // namespace vorocl::python
