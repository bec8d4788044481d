#include "vorocl/fields.hpp"

#include "buffer.hpp"
#include "measurement.hpp"

namespace vorocl {

namespace {

template <typename T>
Report fill_distances(const Seeds& seeds, const Diagram& diagram, Field<T>& field, Metric metric,
                      const char* kernel) {
  const Stopwatch stopwatch;
  diagram.check_fits(seeds);
  const Device& device = diagram.device();
  const Grid& grid = diagram.grid();
  field.prepare(device, grid, seeds);
  const cl::Event event =
      Kernel(device, "fields.cl", kernel, grid, {metric})
          .over_grid(diagram.labels(), seeds.positions(), static_cast<cl_uint>(seeds.size()), field.values(),
                     grid.width(), grid.height());
  return stopwatch.report(device, event, event);
}

}  // namespace

Report distance_field(const Seeds& seeds, const Diagram& diagram, Field<std::int32_t>& field, Metric metric) {
  return fill_distances(seeds, diagram, field, metric, "integer_distances");
}

Report distance_field(const Seeds& seeds, const Diagram& diagram, Field<float>& field, Metric metric) {
  return fill_distances(seeds, diagram, field, metric, "float_distances");
}

Report border_mask(const Diagram& diagram, Field<std::uint8_t>& mask) {
  const Stopwatch stopwatch;
  const Device& device = diagram.device();
  const Grid& grid = diagram.grid();
  mask.prepare(device, grid, std::nullopt);
  const cl::Event event = Kernel(device, "fields.cl", "mark_borders", grid)
                              .over_grid(diagram.labels(), mask.values(), grid.width(), grid.height());
  return stopwatch.report(device, event, event);
}

template <typename T>
void Field<T>::prepare(const Device& device, const Grid& grid, const std::optional<Seeds>& seeds) {
  make_room(values_, device, grid.pixels() * sizeof(T));
  device_ = device;
  seeds_ = seeds;
  pixels_ = grid.pixels();
}

template <typename T>
std::vector<T> Field<T>::read() const {
  if (!device_) return {};
  if (seeds_) seeds_->check();
  return download<T>(*device_, values_, pixels_);
}

template class Field<std::int32_t>;
template class Field<float>;
template class Field<std::uint8_t>;

}  // namespace vorocl
