#include "flood.hpp"

#include <utility>

#include "buffer.hpp"
#include "seeds_state.hpp"

namespace vorocl {

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
  diagram_.kernel("dynamic_jump_flooding.cl", "stamp_positions")
      .over_items(count, seeds_.positions(), count, memory_.front, grid.width());
}

void Flood::wave(const Wave& wave) {
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
  last_event_ =
      diagram_.kernel("jump_flooding.cl", "last_wave", {metric_, wave.neighbourhood})
          .over_grid(memory_.front, memory_.back, diagram_.labels, grid.width(), grid.height(), wave.step);
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

Report Flood::commit(std::size_t waves, int age) {
  return filling_.commit(static_cast<int>(waves), first_event_, last_event_, age);
}

}  // namespace vorocl
