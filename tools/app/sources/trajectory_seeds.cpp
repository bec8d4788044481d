#include "app/sources/trajectory_seeds.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <unordered_map>
#include <utility>

#include "app/sources/periodic_step.hpp"
#include "app/sources/seed_input.hpp"
#include "app/terminal/console.hpp"
#include "app/terminal/usage_error.hpp"

namespace vorocl::command {

namespace {

/// Along a periodic axis the bounds repeat.
bool holds(const Bounds& bounds, const Point& point, const Grid& grid) {
  return (grid.periodic_x() || (point.x >= bounds.x0 && point.x <= bounds.x1)) &&
         (grid.periodic_y() || (point.y >= bounds.y0 && point.y <= bounds.y1));
}

/// By particle, the slot that has what files and pictures say of it: its own, but that of particles on one
/// pixel the first, which has the lowest id, exchanges with the one in the lowest slot, whose label the pixel
/// carries.
std::vector<std::uint32_t> slots_by_cell(const std::vector<Point>& pixels, const ParticleSlots& slots) {
  std::vector<std::uint32_t> by_cell = slots.of_ids();
  std::unordered_map<std::int64_t, std::size_t> first;  // of the particles on each pixel
  for (std::size_t i = 0; i < pixels.size(); ++i) {
    constexpr std::int64_t columns = std::int64_t{1} << 32;  // of a plane
    const auto pixel = static_cast<std::int64_t>(std::floor(pixels[i].y)) * columns +
                       static_cast<std::int64_t>(std::floor(pixels[i].x));
    std::uint32_t& lowest = by_cell[first.emplace(pixel, i).first->second];
    if (by_cell[i] < lowest) std::swap(by_cell[i], lowest);
  }
  return by_cell;
}

/// What the particles have, by slot; `absent` where there is none.
template <typename T>
std::vector<T> by_slot(const std::vector<T>& of_particles, const std::vector<std::uint32_t>& slots,
                       std::size_t size, T absent) {
  std::vector<T> result(size, absent);
  for (std::size_t i = 0; i < of_particles.size(); ++i) result[slots[i]] = of_particles[i];
  return result;
}

}  // namespace

TrajectorySeeds::TrajectorySeeds(const SeedOptions& options, int start)
    : path_(options.trajectory),
      given_bounds_(options.bounds),
      told_axes_(options.periodic),
      outside_(options.outside.value_or(Outside::count)),
      y_up_(points_up(options)) {
  if (!options.size && options.width == 0) {
    throw UsageError("--size WxH or --width W is required with --trajectory");
  }
  reader_ = open_trajectory(path_, options.value_column);
  std::optional<Bounds> bounds;
  while (number_ < start) {
    if (!read()) {
      throw Error(fmt::format("{}: there is no frame {}; the last one of the file is {}, counted from 0",
                              path_, start, number_));
    }
    bounds = bounds_of_frame();
  }
  has_domain_ = given_bounds_ && frame_.box;
  grid_ = make_grid(options, bounds);
  take_frame(bounds);
}

bool TrajectorySeeds::next() {
  if (!read()) return false;
  take_frame(bounds_of_frame());
  return true;
}

bool TrajectorySeeds::read() {
  if (!reader_->next(frame_)) return false;
  ++number_;
  return true;
}

std::optional<Bounds> TrajectorySeeds::bounds_of_frame() {
  if (given_bounds_) return given_bounds_;
  if (frame_.box) return Bounds{frame_.box->x0, frame_.box->y0, frame_.box->x1, frame_.box->y1};
  if (!first_bounds_ && !frame_.positions.empty()) first_bounds_ = bounding_box(frame_.positions);
  return first_bounds_;
}

Periodic TrajectorySeeds::axes_of_frame() const {
  if (told_axes_ || !frame_.box) return told_axes_.value_or(Periodic::none);
  const bool y = frame_.box->periodic_y && frame_.box->tilt == 0;
  if (frame_.box->periodic_x) return y ? Periodic::xy : Periodic::x;
  return y ? Periodic::y : Periodic::none;
}

void TrajectorySeeds::check_tilt() const {
  if (!frame_.box || frame_.box->tilt == 0) return;
  if (told_axes_ && has_y(*told_axes_)) {
    throw Error(path_ + ": the box is tilted, so what is drawn of it repeats in x only; give --periodic x");
  }
  if (!told_axes_) {
    print_note("the box is tilted: the diagram is periodic in x only, and cells end at its border in y");
  }
}

Grid TrajectorySeeds::make_grid(const SeedOptions& options, const std::optional<Bounds>& bounds) const {
  check_tilt();
  const Periodic axes = has_domain_ ? Periodic::none : axes_of_frame();
  if (options.size) return {options.size->width(), options.size->height(), axes};
  if (!bounds) {
    throw Error(path_ +
                ": the frame has neither a box nor particles to tell the height by: give --size "
                "instead of --width, or --bounds");
  }
  try {
    return grid_of_width(*bounds, options.width, axes);
  } catch (const Error& error) {
    throw Error(path_ + ": " + error.what());
  }
}

Mapping TrajectorySeeds::mapping_of_frame(const Bounds& bounds) const {
  Mapping mapping;
  mapping.bounds = bounds;
  mapping.closed = !given_bounds_ || outside_ == Outside::refuse;
  mapping.y_up = y_up_;
  mapping.outside = outside_;
  mapping.periodic = axes_of_frame();
  if (has_domain_ && frame_.box) {
    mapping.period = Bounds{frame_.box->x0, frame_.box->y0, frame_.box->x1, frame_.box->y1};
  } else if (has_domain_ && mapping.periodic != Periodic::none) {
    throw Error("there is no box to say what repeats along the axes of --periodic; give --periodic none");
  }
  return mapping;
}

void TrajectorySeeds::take_frame(const std::optional<Bounds>& bounds) {
  if (!has_domain_ && axes_of_frame() != grid_->periodic()) {
    throw Error(
        fmt::format("{}: the box of frame {} is periodic along other axes than that of the first frame; "
                    "give --periodic none, x, y or xy for all frames",
                    path_, number_));
  }
  MappedPoints mapped;
  Periods periods;
  if (bounds) {
    const bool must_be_inside = outside_ == Outside::refuse || grid_->periodic() != Periodic::none;
    if (must_be_inside && !has_domain_) check_inside(*bounds);
    try {
      mapped = map_points(frame_.positions, mapping_of_frame(*bounds), *grid_);
    } catch (const Error& error) {
      throw Error(fmt::format("{}: frame {}: {}", path_, number_, error.what()));
    }
    if (frame_.box) periods = periods_in_pixels(*frame_.box, *bounds, *grid_, y_up_);
    if (!scales_checked_) warn_of_scales(*bounds, *grid_);
    if (!scales_checked_ && given_bounds_) note_outside(mapped.outside, frame_.ids.size(), *bounds);
    scales_checked_ = true;
  }
  const std::vector<Point>& pixels = mapped.pixels;
  slots_.update(frame_.ids);
  std::vector<std::optional<Point>> points(slots_.size());
  max_displacement_ = 0;
  for (std::size_t i = 0; i < pixels.size(); ++i) {
    const std::uint32_t slot = slots_.of_ids()[i];
    points[slot] = pixels[i];
    // A slot that was taken holds the same particle still.
    if (slot < points_.size() && points_[slot]) {
      max_displacement_ = std::max(max_displacement_, displacement(*points_[slot], pixels[i], periods));
    }
  }
  points_ = std::move(points);
  domain_ = mapped.domain;
  outside_grid_ = mapped.outside;
  const std::vector<std::uint32_t> by_cell = slots_by_cell(pixels, slots_);
  ids_ = by_slot(frame_.ids, by_cell, slots_.size(), no_label);
  values_ = by_slot(frame_.values, by_cell, slots_.size(), std::numeric_limits<double>::quiet_NaN());
}

void TrajectorySeeds::check_inside(const Bounds& bounds) const {
  for (std::size_t i = 0; i < frame_.positions.size(); ++i) {
    const Point& point = frame_.positions[i];
    if (holds(bounds, point, *grid_)) continue;
    throw Error(
        fmt::format("{}: particle {} of frame {} is at ({}, {}), outside the {} {}; give --bounds "
                    "X0,Y0,X1,Y1 that hold the particles of all frames",
                    path_, frame_.ids[i], number_, point.x, point.y,
                    given_bounds_ ? "bounds" : "bounding box of the first frame,", to_string(bounds)));
  }
}

}  // namespace vorocl::command
