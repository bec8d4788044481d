// Fields of labels: looked up in a table, and near their seeds.
#include <algorithm>
#include <cmath>
#include <string>

#include "measures/field.hpp"
#include "runtime/buffer.hpp"
#include "runtime/metric.hpp"

namespace vorocl {

namespace {

using LabelState = FieldState<std::uint32_t>;

/// Looks labels up in a table of one entry per seed.
Report map_by(Measuring<LabelState>& measuring, MeasuredDiagram&& of, const Diagram& diagram,
              const cl::Buffer& table) {
  LabelState& state = measuring.state();
  const cl_uint count = of.count();
  state.make_room_for(of);
  make_room(state.table, of.device, (std::size_t{count} + 1) * sizeof(cl_uint));
  const cl::Event first = state.kernel(of, "copy_table", of.options_without_metric())
                              .over_items(std::size_t{count} + 1, of.positions(), count, table, state.table);
  const cl::Event last = state.kernels.get(of.device, "core/tiles.cl", "name_labels", of.grid)
                             .over_grid(diagram.labels(), state.table, count, of.grid.width(),
                                        static_cast<cl_int>(of.grid.rows()), state.values);
  return measuring.commit(std::move(of), first, last);
}

/// The greatest compared distance of no more than so many pixels. Roots are rounded: a distance of
/// std::sqrt(13) takes in pixels whose squared distance is 13.
cl_long greatest_compared(const MeasuredDiagram& of, double pixels) {
  constexpr double past_all = 9e18;
  const double units = of.units_of_pixel();
  const double compared = as_compared(of.metric, pixels * units);
  if (compared >= past_all) return static_cast<cl_long>(past_all);
  auto greatest = static_cast<cl_long>(compared);
  const auto reaches = [&](cl_long distance) {
    return in_pixels(of.metric, static_cast<double>(distance)) / units <= pixels;
  };
  while (reaches(greatest + 1)) ++greatest;
  while (!reaches(greatest)) --greatest;
  return greatest;
}

}  // namespace

Report map_labels(const Diagram& diagram, const cl::Buffer& table, Field<std::uint32_t>& field) {
  Measuring<LabelState> measuring(field);
  MeasuredDiagram of = cells_of(diagram, OnGlobe::yes);
  check_foreign_buffer(of.device, table, of.count() * sizeof(cl_uint),
                       "the table of " + std::to_string(of.count()) + " labels", Access::read);
  return map_by(measuring, std::move(of), diagram, table);
}

Report map_labels(const Diagram& diagram, const std::vector<std::uint32_t>& table,
                  Field<std::uint32_t>& field) {
  Measuring<LabelState> measuring(field);
  MeasuredDiagram of = cells_of(diagram, OnGlobe::yes);
  if (table.size() < of.count()) {
    throw Error("the table has " + std::to_string(table.size()) + " entries; it must have " +
                std::to_string(of.count()) + ", one for each seed");
  }
  // A new buffer takes them without waiting for the commands that still use the last one.
  const cl::Buffer entries =
      of.count() > 0 ? allocate_with(of.device, table, "the table of labels") : of.positions();
  return map_by(measuring, std::move(of), diagram, entries);
}

Report expand_labels(const Diagram& diagram, double distance, Field<std::uint32_t>& field) {
  Measuring<LabelState> measuring(field);
  LabelState& state = measuring.state();
  MeasuredDiagram of = cells_of(diagram);
  // Written so that a NaN fails.
  if (!(distance >= 0)) {
    throw Error("labels cannot expand to a distance of " + std::to_string(distance) +
                " pixels; 0 is the least");
  }
  state.make_room_for(of);
  const cl::Event event = state.kernel(of, "expand_labels", of.options())
                              .over_grid(diagram.labels(), of.positions(), of.count(), of.lattice(),
                                         of.size(), greatest_compared(of, distance), state.values);
  return measuring.commit(std::move(of), event, event);
}

}  // namespace vorocl
