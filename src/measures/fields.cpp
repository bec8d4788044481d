#include "vorocl/fields.hpp"

#include <optional>
#include <utility>

#include "core/seeds_state.hpp"
#include "measures/measurement.hpp"
#include "runtime/buffer.hpp"

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
                  const char* file, const char* name, const KernelOptions& options, Launch launch) {
  const Stopwatch stopwatch;
  const Device& device = diagram.device();
  const Grid& grid = diagram.grid();
  make_room(state.values, device, grid.pixels() * sizeof(T));
  const cl::Event event = launch(state.kernels.get(device, file, name, grid, options), state.values);
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
  return fill_field(state, diagram, frames_of(seeds, diagram), "measures/fields.cl", name, {metric},
                    [&](Kernel& kernel, const cl::Buffer& values) {
                      return kernel.over_grid(diagram.labels(), seeds.positions(),
                                              static_cast<cl_uint>(seeds.size()), values, grid.width(),
                                              grid.height());
                    });
}

/// As fill_distances(), where there are outer seeds: kernels that take these, and more arguments.
template <typename T, typename... More>
Report fill_plane_distances(const Seeds& seeds, const Diagram& diagram, FieldState<T>& state, Metric metric,
                            const char* name, const More&... more) {
  const Grid& grid = diagram.grid();
  const MeasuredFrames frames = frames_of(seeds, diagram);
  const OuterSeeds& outer = *frames.seeds->outer;
  return fill_field(
      state, diagram, frames, "measures/plane_fields.cl", name, {metric, Neighbourhood::moore, outer.extent},
      [&](Kernel& kernel, const cl::Buffer& values) {
        return kernel.over_grid(diagram.labels(), outer.seeds, static_cast<cl_uint>(seeds.size()),
                                outer.periods, values, grid.width(), grid.height(), more...);
      });
}

bool has_outer_seeds(const Seeds& seeds) { return Internal::state(seeds).frame()->outer != nullptr; }

}  // namespace

Report distance_field(const Seeds& seeds, const Diagram& diagram, Field<std::int32_t>& field, Metric metric) {
  if (!has_outer_seeds(seeds)) return fill_distances(seeds, diagram, field, metric, "integer_distances");
  FieldState<std::int32_t>& state = emptied(field);
  const Device& device = diagram.device();
  const cl::Buffer too_long = allocate(device, sizeof(cl_uint), "the check of the distances");
  fill(device, too_long, cl_uint{0}, 1);
  Report report = fill_plane_distances(seeds, diagram, state, metric, "integer_plane_distances", too_long);
  if (download<cl_uint>(device, too_long, 1).front() != 0) {
    emptied(field);
    throw Error("a distance is past 31 bits, for some seeds lie too far away; ask for a field of floats");
  }
  return report;
}

Report distance_field(const Seeds& seeds, const Diagram& diagram, Field<float>& field, Metric metric) {
  if (!has_outer_seeds(seeds)) return fill_distances(seeds, diagram, field, metric, "float_distances");
  return fill_plane_distances(seeds, diagram, emptied(field), metric, "float_plane_distances");
}

Report border_mask(const Diagram& diagram, Field<std::uint8_t>& mask) {
  const Grid& grid = diagram.grid();
  return fill_field(emptied(mask), diagram, frames_of(diagram), "measures/fields.cl", "mark_borders", {},
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
