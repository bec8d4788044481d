#include "vorocl/fields.hpp"

#include <optional>

#include "buffer.hpp"
#include "measurement.hpp"

namespace vorocl {

template <typename T>
struct FieldState : Measured {
  // A mask has no seeds, so the field keeps these itself.
  std::optional<Device> device;
  std::size_t pixels = 0;  // 0: it is empty
  cl::Buffer values;
};

namespace {

/// Fills a field by one kernel: `launch` gets the kernel and the values.
template <typename T, typename Launch>
Report fill_field(const Diagram& diagram, const std::shared_ptr<const SeedsFrame>& seeds, Field<T>& field,
                  const char* name, const KernelOptions& options, Launch launch) {
  const Stopwatch stopwatch;
  FieldState<T>& state = Internal::result(field);
  state.pixels = 0;
  const Device& device = diagram.device();
  const Grid& grid = diagram.grid();
  make_room(state.values, device, grid.pixels() * sizeof(T));
  const cl::Event event = launch(state.kernels.get(device, "fields.cl", name, grid, options), state.values);
  state.device = device;
  state.seeds = seeds;
  state.pixels = grid.pixels();
  return report_of(stopwatch, device, event, event);
}

template <typename T>
Report fill_distances(const Seeds& seeds, const Diagram& diagram, Field<T>& field, Metric metric,
                      const char* name) {
  const Grid& grid = diagram.grid();
  return fill_field(diagram, frame_of(seeds, diagram), field, name, {metric},
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
  return fill_field(diagram, nullptr, mask, "mark_borders", {},
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
  return state_ ? state_->values : no_buffer();
}

template <typename T>
std::vector<T> Field<T>::read() const {
  if (!state_ || state_->pixels == 0) return {};
  if (state_->seeds) state_->seeds->check();
  return download<T>(*state_->device, state_->values, state_->pixels);
}

template class Field<std::int32_t>;
template class Field<float>;
template class Field<std::uint8_t>;

}  // namespace vorocl
