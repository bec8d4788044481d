#include "flooding/flood.hpp"

#include <algorithm>
#include <numeric>
#include <utility>

#include "runtime/buffer.hpp"
#include "runtime/metric.hpp"

namespace vorocl {

namespace {

constexpr int row_interval = 8;                          // of the rows in which far pixels are counted
constexpr std::uint32_t farther_than_any = 0x80000000u;  // the distance to an empty label, at least

std::size_t measured_rows(const PixelGrid& grid) {
  return static_cast<std::size_t>((grid.height() + row_interval - 1) / row_interval);
}

std::uint32_t as_distance(int pixels, Metric metric) {
  return static_cast<std::uint32_t>(std::min(as_compared(metric, pixels), farther_than_any - 1.0));
}

}  // namespace

Flood::Flood(const Seeds& seeds, Diagram& diagram, Metric metric, const char* method)
    : diagram_(Internal::state(diagram)),
      filling_(seeds, diagram, metric, method),
      grid_(filling_.placement().grid),
      positions_(*filling_.placement().positions),
      count_(static_cast<cl_uint>(filling_.seeds().size)),
      metric_(metric),
      memory_(diagram_.workspace<FloodWorkspace>()) {
  refuse_outer_seeds(filling_.placement(), filling_.seeds(), "flooding");
  if (!diagram_.window.is_whole()) {
    throw Error(
        "the diagram's window is a part of its grid, which flooding cannot take; only exact diagrams do");
  }
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
  filling_.kernel("flooding/dynamic_jump_flooding.cl", "stamp_positions")
      .over_items(count_, positions_, count_, memory_.front, grid_.width());
}

cl::Event Flood::measure_labels(std::uint32_t near) {
  const std::size_t rows = measured_rows(grid_);
  for (cl::Buffer* const buffer : {&memory_.greatest, &memory_.far_pixels}) {
    diagram_.reserve(*buffer, rows * sizeof(std::uint32_t));
    begins_with(fill(diagram_.device, *buffer, cl_uint{0}, rows));
  }
  return filling_.kernel("flooding/dynamic_jump_flooding.cl", "measure_labels")
      .over_grid(diagram_.labels, positions_, count_, grid_.width(), grid_.height(), row_interval, near,
                 memory_.greatest, memory_.far_pixels);
}

LabelDistances Flood::label_distances(int enough) {
  const std::size_t rows = measured_rows(grid_);
  LabelDistances distances;
  distances.margin = row_interval;
  // Of labels that no flood made, those of now have to do.
  if (!previous()->far_counted) count_far_pixels();
  const auto far_pixels = download<std::uint32_t>(diagram_.device, memory_.far_pixels, rows);
  distances.far = std::accumulate(far_pixels.begin(), far_pixels.end(), 0.0) /
                  static_cast<double>(rows * static_cast<std::size_t>(grid_.width()));
  measure_labels(as_distance(enough, metric_));
  const auto greatest = download<std::uint32_t>(diagram_.device, memory_.greatest, rows);
  const std::uint32_t most = *std::max_element(greatest.begin(), greatest.end());
  if (most < farther_than_any) {
    distances.greatest = most == 0 ? enough : in_pixels(metric_, most);
  }
  return distances;
}

void Flood::count_far_pixels() {
  const double pixels_per_seed = static_cast<double>(grid_.pixels()) / static_cast<double>(seeds().alive());
  last_event_ = measure_labels(static_cast<std::uint32_t>(radius_of_area(metric_, pixels_per_seed)));
  far_counted_ = true;
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
  // The back image is free now: it takes the ids that the wave looks up, behind the label of an empty pixel.
  fill(diagram_.device, memory_.back, no_label, 1);
  for (const char* const name : {"clear_ids", "stamp_ids"}) {
    filling_.kernel("core/seeds.cl", name)
        .over_items(count_, positions_, count_, memory_.back, grid_.width());
  }
  if (start_.first_step == 0) start_.first_step = wave.step;
  last_event_ =
      filling_.kernel("flooding/jump_flooding.cl", "last_wave", wave.neighbourhood)
          .over_grid(memory_.front, memory_.back, diagram_.labels, grid_.width(), grid_.height(), wave.step);
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
  return filling_.commit(static_cast<int>(waves), first_event_, last_event_, age, far_counted_, start_);
}

}  // namespace vorocl
