#include "vorocl/fields.hpp"

#include <optional>
#include <utility>

#include "buffer.hpp"
#include "measurement.hpp"

namespace vorocl {

template <typename T>
struct FieldState {
  std::optional<Device> device;  // none: it is empty
  std::size_t pixels = 0;
  MeasuredFrames frames;
  KernelSet kernels;
  cl::Buffer values;

  bool empty() const { return !device; }
};

namespace {

template <typename T>
FieldState<T>& emptied(Field<T>& field) {
  FieldState<T>& state = Internal::result(field);
  state.device.reset();
  return state;
}

/// Fills a field by one kernel: `launch` gets the kernel and the values.
template <typename T, typename Launch>
Report fill_field(FieldState<T>& state, const Diagram& diagram, const MeasuredFrames& frames,
                  const char* name, const KernelOptions& options, Launch launch) {
  const Stopwatch stopwatch;
  const Device& device = diagram.device();
  const Grid& grid = diagram.grid();
  make_room(state.values, device, grid.pixels() * sizeof(T));
  const cl::Event event = launch(state.kernels.get(device, "fields.cl", name, grid, options), state.values);
  Report report = report_of(stopwatch, device, event, event);
  state.frames = frames;
  state.pixels = grid.pixels();
  state.device = device;
  return report;
}

template <typename T>
Report fill_distances(const Seeds& seeds, const Diagram& diagram, Field<T>& field, Metric metric,
                      const char* name) {
  const Grid& grid = diagram.grid();
  FieldState<T>& state = emptied(field);
  return fill_field(state, diagram, frames_of(seeds, diagram), name, {metric},
                    [&](Kernel& kernel, const cl::Buffer& values) {
                      return kernel.over_grid(diagram.labels(), seeds.positions(),
                                              static_cast<cl_uint>(seeds.size()), values, grid.width(),
                                              grid.height());
                    });
}

}  // namespace

Report distance_field(const Seeds& seeds, const Diagram& diagram, Field<std::int32_t>& field, Metric metric) {
  return fill_distances(seeds, diagram, field, metric, "integer_distances");
}

Report distance_field(const Seeds& seeds, const Diagram& diagram, Field<float>& field, Metric metric) {
  return fill_distances(seeds, diagram, field, metric, "float_distances");
}

Report border_mask(const Diagram& diagram, Field<std::uint8_t>& mask) {
  const Grid& grid = diagram.grid();
  return fill_field(emptied(mask), diagram, frames_of(diagram), "mark_borders", {},
                    [&](Kernel& kernel, const cl::Buffer& values) {
                      return kernel.over_grid(diagram.labels(), values, grid.width(), grid.height());
                    });
}

template <typename T>
Field<T>::Field() = default;
template <typename T>
Field<T>::~Field() = default;
template <typename T>
Field<T>::Field(Field&& other) noexcept = default;
template <typename T>
Field<T>& Field<T>::operator=(Field&& other) noexcept = default;

template <typename T>
const cl::Buffer& Field<T>::values() const {
  return buffer_of(state_, &FieldState<T>::values);
}

template <typename T>
std::vector<T> Field<T>::read() const {
  if (!state_ || state_->empty()) return {};
  std::vector<T> values(state_->pixels);
  read(values.data());
  return values;
}

template <typename T>
void Field<T>::read(T* values) const {
  if (!state_ || state_->empty()) return;
  state_->frames.check();
  download(*state_->device, state_->values, state_->pixels, values);
}

template class Field<std::int32_t>;
template class Field<float>;
template class Field<std::uint8_t>;

}  // namespace vorocl
