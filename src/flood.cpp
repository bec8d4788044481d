#include "flood.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "buffer.hpp"

namespace vorocl {

namespace {

constexpr int row_interval = 8;                          // of the rows in which far pixels are counted
constexpr std::uint32_t farther_than_any = 0x80000000u;  // the distance to an empty label, at least

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
  diagram_.kernel("seeds.cl", "mark_seeds")
      .over_items(count, seeds_.positions(), count, memory_.seeded, grid.width());
  last_event_ = diagram_.kernel("jump_flooding.cl", "seed_wave", {metric_, wave.neighbourhood})
                    .over_grid(memory_.seeded, memory_.front, grid.width(), grid.height(), wave.step);
}

void Flood::advance_labels() {
  const Grid& grid = diagram_.grid;
  const auto count = static_cast<cl_uint>(seeds_.size());
  begins_with(
      diagram_.kernel("dynamic_jump_flooding.cl", "advance_labels")
          .over_grid(diagram_.labels, seeds_.positions(), count, memory_.front, grid.width(), grid.height()));
  stamp_seeds();
}

void Flood::stamp_seeds() {
  start_ = {0, false};
  const auto count = static_cast<cl_uint>(seeds_.size());
  diagram_.kernel("dynamic_jump_flooding.cl", "stamp_positions")
      .over_items(count, seeds_.positions(), count, memory_.front, diagram_.grid.width());
}

LabelDistances Flood::measure_labels(int enough) {
  const Grid& grid = diagram_.grid;
  const auto count = static_cast<cl_uint>(seeds_.size());
  const auto rows = static_cast<std::size_t>(grid.height());
  diagram_.reserve(memory_.farthest, rows * sizeof(std::uint32_t));
  begins_with(fill(diagram_.device, memory_.farthest, cl_uint{0}, rows));
  diagram_.kernel("dynamic_jump_flooding.cl", "measure_labels", {metric_})
      .over_grid(diagram_.labels, seeds_.positions(), count, memory_.front, grid.width(), grid.height(),
                 as_distance(enough, metric_), memory_.farthest);
  stamp_seeds();
  LabelDistances distances;
  const auto farthest = download<std::uint32_t>(diagram_.device, memory_.farthest, rows);
  const std::uint32_t greatest = *std::max_element(farthest.begin(), farthest.end());
  if (greatest < farther_than_any) {
    distances.greatest = std::max(in_pixels(greatest, metric_), static_cast<double>(enough));
  }
  if (previous()->counted) {
    const auto far_pixels = download<std::uint32_t>(diagram_.device, memory_.far_pixels, rows);
    const auto counted_rows = (rows + row_interval - 1) / row_interval;
    distances.far = std::accumulate(far_pixels.begin(), far_pixels.end(), 0.0) /
                    static_cast<double>(counted_rows * static_cast<std::size_t>(grid.width()));
  }
  return distances;
}

void Flood::count_far_pixels() {
  counting_ = true;
  const auto rows = static_cast<std::size_t>(diagram_.grid.height());
  diagram_.reserve(memory_.far_pixels, rows * sizeof(std::uint32_t));
  begins_with(fill(diagram_.device, memory_.far_pixels, cl_uint{0}, rows));
}

std::uint32_t Flood::near() const {
  constexpr double half_pi = 1.5707963267948966;
  const double pixels_per_seed = static_cast<double>(diagram_.grid.pixels()) /
                                 static_cast<double>(std::max<std::size_t>(seeds_.alive(), 1));
  return static_cast<std::uint32_t>(metric_ == Metric::euclidean ? pixels_per_seed
                                                                 : std::sqrt(half_pi * pixels_per_seed));
}

void Flood::wave(const Wave& wave) {
  if (start_.first_step == 0) start_.first_step = wave.step;
  const Grid& grid = diagram_.grid;
  last_event_ = diagram_.kernel("jump_flooding.cl", "wave", {metric_, wave.neighbourhood})
                    .over_grid(memory_.front, memory_.back, grid.width(), grid.height(), wave.step);
  std::swap(memory_.front, memory_.back);
}

void Flood::clear_last_change() { fill(diagram_.device, memory_.flag, cl_int{0}, 1); }

void Flood::reporting_wave(Neighbourhood neighbourhood, int number) {
  const Grid& grid = diagram_.grid;
  last_event_ =
      diagram_.kernel("standard_flooding.cl", "reporting_wave", {metric_, neighbourhood})
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
    diagram_.kernel("seeds.cl", name)
        .over_items(count, seeds_.positions(), count, memory_.back, grid.width());
  }
  if (start_.first_step == 0) start_.first_step = wave.step;
  const KernelOptions options = {metric_, wave.neighbourhood};
  last_event_ = counting_ ? diagram_.kernel("jump_flooding.cl", "counting_last_wave", options)
                                .over_grid(memory_.front, memory_.back, diagram_.labels, grid.width(),
                                           grid.height(), wave.step, row_interval, near(), memory_.far_pixels)
                          : diagram_.kernel("jump_flooding.cl", "last_wave", options)
                                .over_grid(memory_.front, memory_.back, diagram_.labels, grid.width(),
                                           grid.height(), wave.step);
}

bool Flood::some_unlabelled() {
  fill(diagram_.device, memory_.flag, cl_int{0}, 1);
  diagram_.kernel("dynamic_jump_flooding.cl", "find_unlabelled")
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
  for (std::size_t i = 0; i + 1 < plan.size(); ++i) wave(plan[i]);
  last_wave(plan.empty() ? none : plan.back());
}

Report Flood::commit(std::size_t waves, int age) {
  return filling_.commit(static_cast<int>(waves), first_event_, last_event_, age, counting_, start_);
}

}  // namespace vorocl
