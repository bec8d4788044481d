#include "flooding/flood.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "core/seeds_state.hpp"
#include "runtime/buffer.hpp"

namespace vorocl {

namespace {

constexpr int row_interval = 8;                          // of the rows in which far pixels are counted
constexpr std::uint32_t farther_than_any = 0x80000000u;  // the distance to an empty label, at least

std::size_t measured_rows(const Grid& grid) {
  return static_cast<std::size_t>((grid.height() + row_interval - 1) / row_interval);
}

double in_pixels(std::uint32_t distance, Metric metric) {
  return metric == Metric::euclidean ? std::sqrt(distance) : distance;
}

std::uint32_t as_distance(int pixels, Metric metric) {
  const auto length = static_cast<std::uint32_t>(pixels);
  return std::min(metric == Metric::euclidean ? length * length : length, farther_than_any - 1);
}

}  // namespace

Flood::Flood(const Seeds& seeds, Diagram& diagram, Metric metric)
    : seeds_(seeds),
      diagram_(Internal::state(diagram)),
      filling_(seeds, diagram),
      metric_(metric),
      memory_(diagram_.workspace<FloodWorkspace>()) {
  Internal::state(seeds).frame()->refuse_outer_seeds("flooding");
  const std::size_t pixels = diagram_.grid.pixels() + 2 * guard;
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
  const Grid& grid = diagram_.grid;
  const auto count = static_cast<cl_uint>(seeds_.size());
  begins_with(fill(diagram_.device, memory_.seeded, cl_uchar{0}, grid.pixels() + 2 * guard));
  diagram_.kernel("core/seeds.cl", "mark_seeds")
      .over_items(count, seeds_.positions(), count, memory_.seeded, grid.width());
  last_event_ = diagram_.kernel("flooding/jump_flooding.cl", "seed_wave", {metric_, wave.neighbourhood})
                    .over_grid(memory_.seeded, memory_.front, grid.width(), grid.height(), wave.step);
}

void Flood::advance_labels() {
  start_ = {0, false};
  const Grid& grid = diagram_.grid;
  const auto count = static_cast<cl_uint>(seeds_.size());
  begins_with(
      diagram_.kernel("flooding/dynamic_jump_flooding.cl", "advance_labels")
          .over_grid(diagram_.labels, seeds_.positions(), count, memory_.front, grid.width(), grid.height()));
  diagram_.kernel("flooding/dynamic_jump_flooding.cl", "stamp_positions")
      .over_items(count, seeds_.positions(), count, memory_.front, grid.width());
}

cl::Event Flood::measure_labels(std::uint32_t near) {
  const Grid& grid = diagram_.grid;
  const std::size_t rows = measured_rows(grid);
  for (cl::Buffer* const buffer : {&memory_.greatest, &memory_.far_pixels}) {
    diagram_.reserve(*buffer, rows * sizeof(std::uint32_t));
    begins_with(fill(diagram_.device, *buffer, cl_uint{0}, rows));
  }
  return diagram_.kernel("flooding/dynamic_jump_flooding.cl", "measure_labels", {metric_})
      .over_grid(diagram_.labels, seeds_.positions(), static_cast<cl_uint>(seeds_.size()), grid.width(),
                 grid.height(), row_interval, near, memory_.greatest, memory_.far_pixels);
}

LabelDistances Flood::label_distances(int enough) {
  const Grid& grid = diagram_.grid;
  const std::size_t rows = measured_rows(grid);
  LabelDistances distances;
  distances.margin = row_interval;
  // Of labels that no flood made, those of now have to do.
  if (!previous()->far_counted) count_far_pixels();
  const auto far_pixels = download<std::uint32_t>(diagram_.device, memory_.far_pixels, rows);
  distances.far = std::accumulate(far_pixels.begin(), far_pixels.end(), 0.0) /
                  static_cast<double>(rows * static_cast<std::size_t>(grid.width()));
  measure_labels(as_distance(enough, metric_));
  const auto greatest = download<std::uint32_t>(diagram_.device, memory_.greatest, rows);
  const std::uint32_t most = *std::max_element(greatest.begin(), greatest.end());
  if (most < farther_than_any) {
    distances.greatest = most == 0 ? enough : in_pixels(most, metric_);
  }
  return distances;
}

void Flood::count_far_pixels() {
  constexpr double half_pi = 1.5707963267948966;
  const double pixels_per_seed =
      static_cast<double>(diagram_.grid.pixels()) / static_cast<double>(seeds_.alive());
  const double near = metric_ == Metric::euclidean ? pixels_per_seed : std::sqrt(half_pi * pixels_per_seed);
  last_event_ = measure_labels(static_cast<std::uint32_t>(near));
  far_counted_ = true;
}

void Flood::wave(const Wave& wave) {
  if (start_.first_step == 0) start_.first_step = wave.step;
  const Grid& grid = diagram_.grid;
  last_event_ = diagram_.kernel("flooding/jump_flooding.cl", "wave", {metric_, wave.neighbourhood})
                    .over_grid(memory_.front, memory_.back, grid.width(), grid.height(), wave.step);
  std::swap(memory_.front, memory_.back);
}

void Flood::clear_last_change() { fill(diagram_.device, memory_.flag, cl_int{0}, 1); }

void Flood::reporting_wave(Neighbourhood neighbourhood, int number) {
  const Grid& grid = diagram_.grid;
  last_event_ =
      diagram_.kernel("flooding/standard_flooding.cl", "reporting_wave", {metric_, neighbourhood})
          .over_grid(memory_.front, memory_.back, grid.width(), grid.height(), number, memory_.flag);
  std::swap(memory_.front, memory_.back);
}

int Flood::last_change() { return download<cl_int>(diagram_.device, memory_.flag, 1).front(); }

void Flood::last_wave(const Wave& wave) {
  const Grid& grid = diagram_.grid;
  const auto count = static_cast<cl_uint>(seeds_.size());
  // The back image is free now: it takes the ids that the wave looks up, behind the label of an empty pixel.
  fill(diagram_.device, memory_.back, no_label, 1);
  for (const char* const name : {"clear_ids", "stamp_ids"}) {
    diagram_.kernel("core/seeds.cl", name)
        .over_items(count, seeds_.positions(), count, memory_.back, grid.width());
  }
  if (start_.first_step == 0) start_.first_step = wave.step;
  last_event_ =
      diagram_.kernel("flooding/jump_flooding.cl", "last_wave", {metric_, wave.neighbourhood})
          .over_grid(memory_.front, memory_.back, diagram_.labels, grid.width(), grid.height(), wave.step);
}

bool Flood::some_unlabelled() {
  fill(diagram_.device, memory_.flag, cl_int{0}, 1);
  diagram_.kernel("flooding/dynamic_jump_flooding.cl", "find_unlabelled")
      .over_grid(diagram_.labels, diagram_.grid.width(), diagram_.grid.height(), memory_.flag);
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
