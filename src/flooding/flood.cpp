#include "flooding/flood.hpp"

#include <utility>

#include "runtime/buffer.hpp"
#include "runtime/metric.hpp"

namespace vorocl {

namespace {

constexpr int row_interval = 8;  // of the rows in which labels are measured
constexpr int rows_of_item = 8;  // how many of those one work-item takes

std::size_t divided_up(int number, int by) { return static_cast<std::size_t>((number + by - 1) / by); }

}  // namespace

void refuse_what_floods_cannot_take(const Filling& filling, const DiagramState& diagram) {
  refuse_volume(diagram.window.grid(), "flooding");
  refuse_seeds_beyond(filling.placement(), filling.seeds(), "flooding");
  if (!diagram.window.is_whole()) {
    throw Error(
        "the diagram's window is a part of its grid, which flooding cannot take; only diagrams of the method "
        "exact do");
  }
}

cl::Event label_by_last_wave(Filling& filling, const DiagramState& diagram, const cl::Buffer& image,
                             const cl::Buffer& ids, const Wave& wave) {
  const PixelGrid& grid = filling.placement().grid;
  const cl::Buffer& positions = *filling.placement().positions;
  const auto count = static_cast<cl_uint>(filling.seeds().size);
  for (const char* const name : {"clear_ids", "stamp_ids"}) {
    filling.kernel("core/seeds.cl", name)
        .over_items(count + 1, positions, count, ids, grid.width(), grid.height());
  }
  return filling.kernel("flooding/jump_flooding.cl", "last_wave", wave.neighbourhood)
      .over_grid(image, ids, diagram.labels, grid.width(), grid.height(), wave.step);
}

Flood::Flood(const Seeds& seeds, Diagram& diagram, Metric metric, const char* method)
    : diagram_(Internal::state(diagram)),
      filling_(seeds, diagram, metric, method),
      grid_(filling_.placement().grid),
      positions_(*filling_.placement().positions),
      count_(static_cast<cl_uint>(filling_.seeds().size)),
      metric_(metric),
      memory_(diagram_.workspace<FloodWorkspace>()) {
  refuse_what_floods_cannot_take(filling_, diagram_);
  const std::size_t pixels = grid_.pixels() + 2 * guard;
  diagram_.reserve(memory_.front, pixels * sizeof(std::uint32_t));
  diagram_.reserve(memory_.back, pixels * sizeof(std::uint32_t));
  diagram_.reserve(memory_.seeded, pixels);
  diagram_.reserve(memory_.flag, sizeof(cl_int));
}

void Flood::begins_with(const cl::Event& event) {
  if (first_event_() == nullptr) first_event_ = event;
}

void Flood::first_wave(const Wave& wave) {
  start_ = {wave.step, true};
  begins_with(fill(diagram_.device, memory_.seeded, cl_uchar{0}, grid_.pixels() + 2 * guard));
  filling_.kernel("core/seeds.cl", "mark_seeds")
      .over_items(count_, positions_, count_, memory_.seeded, grid_.width());
  last_event_ = filling_.kernel("flooding/jump_flooding.cl", "seed_wave", wave.neighbourhood)
                    .over_grid(memory_.seeded, memory_.front, grid_.width(), grid_.height(), wave.step);
}

void Flood::advance_labels() {
  start_ = {0, false};
  begins_with(
      filling_.kernel("flooding/dynamic_jump_flooding.cl", "advance_labels")
          .over_grid(diagram_.labels, positions_, count_, memory_.front, grid_.width(), grid_.height()));
  filling_.kernel("core/seeds.cl", "stamp_positions")
      .over_items(count_, positions_, count_, memory_.front, grid_.width(), grid_.height());
}

LabelDistances Flood::label_distances() {
  const int width = grid_.width(), height = grid_.height(), rows = row_interval * rows_of_item;
  constexpr std::size_t words = 2;
  diagram_.reserve(memory_.found, words * sizeof(cl_uint));
  begins_with(fill(diagram_.device, memory_.found, cl_uint{0}, words));
  const double pixels_per_seed = static_cast<double>(grid_.pixels()) / std::max(count_, 1u);
  const auto enough =
      static_cast<cl_uint>(std::min(radius_of_area(metric_, 4 * pixels_per_seed), 2147483647.0));
  Kernel& kernel = filling_.kernel("flooding/dynamic_jump_flooding.cl", "measure_labels");
  kernel.over_items(divided_up(width, static_cast<int>(kernel.vector_width())) * divided_up(height, rows),
                    diagram_.labels, positions_, count_, width, height, row_interval, rows, enough,
                    memory_.found);
  const auto found = download<cl_uint>(diagram_.device, memory_.found, words);
  return {in_pixels(metric_, std::max(found[0], enough)), found[1], row_interval};
}

void Flood::wave(const Wave& wave) {
  if (start_.first_step == 0) start_.first_step = wave.step;
  last_event_ = filling_.kernel("flooding/jump_flooding.cl", "wave", wave.neighbourhood)
                    .over_grid(memory_.front, memory_.back, grid_.width(), grid_.height(), wave.step);
  std::swap(memory_.front, memory_.back);
}

void Flood::clear_last_change() { fill(diagram_.device, memory_.flag, cl_int{0}, 1); }

void Flood::reporting_wave(Neighbourhood neighbourhood, int number) {
  last_event_ =
      filling_.kernel("flooding/standard_flooding.cl", "reporting_wave", neighbourhood)
          .over_grid(memory_.front, memory_.back, grid_.width(), grid_.height(), number, memory_.flag);
  std::swap(memory_.front, memory_.back);
}

int Flood::last_change() { return download<cl_int>(diagram_.device, memory_.flag, 1).front(); }

void Flood::last_wave(const Wave& wave) {
  if (start_.first_step == 0) start_.first_step = wave.step;
  last_event_ = label_by_last_wave(filling_, diagram_, memory_.front, memory_.back, wave);
}

bool Flood::some_unlabelled() {
  fill(diagram_.device, memory_.flag, cl_int{0}, 1);
  filling_.kernel("flooding/dynamic_jump_flooding.cl", "find_unlabelled")
      .over_grid(diagram_.labels, grid_.width(), grid_.height(), memory_.flag);
  return download<cl_int>(diagram_.device, memory_.flag, 1).front() != 0;
}

void Flood::run(const Plan& plan) {
  // A plan of less than two waves has none to fuse the stamping or the ids with.
  first_wave(plan.empty() ? none : plan.front());
  for (std::size_t i = 1; i + 1 < plan.size(); ++i) wave(plan[i]);
  last_wave(plan.size() < 2 ? none : plan.back());
}

void Flood::run_from_labels(const Plan& plan) {
  advance_labels();
  for (std::size_t i = 0; i + 1 < plan.size(); ++i) wave(plan[i]);
  last_wave(plan.empty() ? none : plan.back());
}

Report Flood::commit(std::size_t waves, int age) {
  return filling_.commit(static_cast<int>(waves), first_event_, last_event_, age, start_);
}

}  // namespace vorocl
