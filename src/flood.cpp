#include "flood.hpp"

#include <algorithm>
#include <utility>

#include "buffer.hpp"
#include "kernel.hpp"

namespace vorocl {

Flood::Flood(const Seeds& seeds, Diagram& diagram, Metric metric)
    : seeds_(seeds), diagram_(diagram), metric_(metric) {
  const std::size_t pixels = diagram.grid().pixels() + 2 * guard;
  front_ = diagram.scratch(Diagram::Scratch::packed_front, pixels * sizeof(std::uint32_t));
  back_ = diagram.scratch(Diagram::Scratch::packed_back, pixels * sizeof(std::uint32_t));
  seeded_ = diagram.scratch(Diagram::Scratch::seeded, pixels);
  diagram.begin(seeds);  // last: a diagram that there is no memory for keeps what it holds
}

void Flood::first_wave(const Wave& wave) {
  const Device& device = diagram_.device();
  const Grid& grid = diagram_.grid();
  first_event_ = fill(device, seeded_, cl_uchar{0}, grid.pixels() + 2 * guard);
  Kernel(device, "seeds.cl", "mark_seeds", grid)
      .over_items(seeds_.size(), seeds_.positions(), static_cast<cl_uint>(seeds_.size()), seeded_,
                  grid.width());
  last_event_ = Kernel(device, "jump_flooding.cl", "seed_wave", grid, {metric_, wave.neighbourhood})
                    .over_grid(seeded_, front_, grid.width(), grid.height(), wave.step);
}

void Flood::advance_labels() {
  const Device& device = diagram_.device();
  const Grid& grid = diagram_.grid();
  const auto count = static_cast<cl_uint>(seeds_.size());
  first_event_ =
      Kernel(device, "dynamic_jump_flooding.cl", "advance_labels", grid)
          .over_grid(diagram_.labels(), seeds_.positions(), count, front_, grid.width(), grid.height());
  Kernel(device, "dynamic_jump_flooding.cl", "stamp_positions", grid)
      .over_items(count, seeds_.positions(), count, front_, grid.width());
}

void Flood::wave(const Wave& wave) {
  const Grid& grid = diagram_.grid();
  last_event_ = Kernel(diagram_.device(), "jump_flooding.cl", "wave", grid, {metric_, wave.neighbourhood})
                    .over_grid(front_, back_, grid.width(), grid.height(), wave.step);
  std::swap(front_, back_);
}

void Flood::reporting_wave(Neighbourhood neighbourhood, int number, const cl::Buffer& last_change) {
  const Grid& grid = diagram_.grid();
  last_event_ =
      Kernel(diagram_.device(), "standard_flooding.cl", "reporting_wave", grid, {metric_, neighbourhood})
          .over_grid(front_, back_, grid.width(), grid.height(), number, last_change);
  std::swap(front_, back_);
}

void Flood::last_wave(const Wave& wave) {
  const Device& device = diagram_.device();
  const Grid& grid = diagram_.grid();
  // The back image is free now: it takes the ids that the wave looks up, behind the label of an empty pixel.
  fill(device, back_, no_label, 1);
  const auto count = static_cast<cl_uint>(seeds_.size());
  for (const char* const name : {"clear_ids", "stamp_ids"}) {
    Kernel(device, "seeds.cl", name, grid).over_items(count, seeds_.positions(), count, back_, grid.width());
  }
  last_event_ = Kernel(device, "jump_flooding.cl", "last_wave", grid, {metric_, wave.neighbourhood})
                    .over_grid(front_, back_, diagram_.labels(), grid.width(), grid.height(), wave.step);
}

Report Flood::report(int waves) const {
  check(clFlush(diagram_.device().queue()()), "starting the diagram");
  const std::chrono::duration<double, std::milli> host = std::chrono::steady_clock::now() - started_;
  return {waves, first_event_, last_event_, host.count()};
}

}  // namespace vorocl
