#include "vorocl/fields.hpp"

#include <type_traits>

#include "globe/globe.hpp"
#include "measures/field.hpp"
#include "runtime/buffer.hpp"

namespace vorocl {

template <typename T>
const cl::Buffer& Field<T>::values() const {
  return buffer_of(state_, &FieldState<T>::values);
}

template <typename T>
std::vector<T> Field<T>::read() const {
  if (!state_ || state_->empty()) return {};
  std::vector<T> values(state_->of->grid.pixels());
  read(values.data());
  return values;
}

template <typename T>
void Field<T>::read(T* values) const {
  if (!state_ || state_->empty()) return;
  const MeasuredDiagram& of = *state_->of;
  of.check();
  if constexpr (std::is_same_v<T, std::int32_t>) {
    if (of.is_far() && download<cl_uint>(of.device, state_->too_long, 1).front() != 0) {
      throw Error("a distance is past 31 bits, for some seeds lie too far away; ask for a field of floats");
    }
  }
  download(of.device, state_->values, of.grid.pixels(), values);
}

template class Field<std::int32_t>;
template class Field<float>;
template class Field<std::uint8_t>;
template class Field<std::uint32_t>;

Report distance_field(const Diagram& diagram, Field<std::int32_t>& field) {
  Measuring<FieldState<std::int32_t>> measuring(field);
  FieldState<std::int32_t>& state = measuring.state();
  MeasuredDiagram of = cells_of(diagram);
  if (of.points && of.seeds->are_points()) {
    throw Error(
        "distances to points within their pixels, and in tilted grids, are no whole numbers; ask for a field "
        "of floats, or snap the seeds to pixels of a grid that is not tilted");
  }
  state.make_room_for(of);
  make_room(state.too_long, of.device, sizeof(cl_uint));
  if (of.is_far()) fill(of.device, state.too_long, cl_uint{0}, 1);
  const cl::Event event = state.kernel(of, "integer_distances", of.options())
                              .over_grid(diagram.labels(), of.positions(), of.count(), of.lattice(),
                                         of.size(), state.values, state.too_long);
  return measuring.commit(std::move(of), event, event);
}

Report distance_field(const Diagram& diagram, Field<float>& field) {
  Measuring<FieldState<float>> measuring(field);
  FieldState<float>& state = measuring.state();
  MeasuredDiagram of = cells_of(diagram, OnGlobe::yes);
  state.make_room_for(of);
  if (of.metric == Metric::great_circle) {
    const GlobePixels pixels(of.device, of.window);
    const cl::Event event =
        state.kernels
            .get(without_vectors(of.device), "globe/globe.cl", "globe_distances", of.grid.without_periods())
            .over_items(of.grid.pixels(), diagram.labels(), of.seeds->on_globe()->directions, of.count(),
                        pixels.columns, pixels.rows, of.grid.width(), of.grid.height(),
                        static_cast<cl_float>(2 * earth_radius), state.values);
    return measuring.commit(std::move(of), event, event);
  }
  const cl::Event event =
      state.kernel(of, "float_distances", of.options())
          .over_grid(diagram.labels(), of.positions(), of.count(), of.lattice(), of.size(), state.values);
  return measuring.commit(std::move(of), event, event);
}

Report border_mask(const Diagram& diagram, Field<std::uint8_t>& mask) {
  Measuring<FieldState<std::uint8_t>> measuring(mask);
  FieldState<std::uint8_t>& state = measuring.state();
  MeasuredDiagram of = labels_of(diagram);
  state.make_room_for(of);
  const cl::Event event = state.kernel(of, "mark_borders", {})
                              .over_grid(diagram.labels(), state.values, of.size(), of.shifts_in_pixels());
  return measuring.commit(std::move(of), event, event);
}

}  // namespace vorocl
