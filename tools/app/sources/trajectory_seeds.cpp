#include "app/sources/trajectory_seeds.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <system_error>
#include <utility>

#include "app/sources/bounds.hpp"
#include "app/sources/particles.hpp"
#include "app/sources/seed_input.hpp"
#include "app/terminal/console.hpp"
#include "vorocl/error.hpp"

namespace vorocl::command {

namespace {

Axes periodic_axes(const Box& box) { return axes_of(box.periodic_x, box.periodic_y); }

/// The first particle at each place, in a table with room for twice as many or more.
class FirstAtPlaces {
 public:
  explicit FirstAtPlaces(const std::vector<Point>& places) : places_(places) {
    while (std::size_t{1} << bits_ < 2 * places.size()) ++bits_;
    entries_.assign(std::size_t{1} << bits_, none);
  }

  /// The first of the particles asked for so far that is at the place of this one.
  std::size_t of(std::size_t particle) {
    const Point& place = places_[particle];
    std::size_t at = hash(place);
    while (entries_[at] != none && !is_at(place, entries_[at])) at = (at + 1) % entries_.size();
    if (entries_[at] == none) entries_[at] = static_cast<std::uint32_t>(particle);
    return entries_[at];
  }

 private:
  static constexpr std::uint32_t none = 0xffffffff;

  bool is_at(const Point& place, std::size_t particle) const {
    return places_[particle].x == place.x && places_[particle].y == place.y;  // both are rounded
  }

  std::size_t hash(const Point& place) const {
    const auto bits = [](double of) {
      return static_cast<std::uint64_t>(static_cast<std::int64_t>(of * 4096));
    };
    std::uint64_t mixed = (bits(place.y) << 32 ^ bits(place.x)) * 0x9e3779b97f4a7c15u;
    mixed = (mixed ^ mixed >> 32) * 0x9e3779b97f4a7c15u;
    return static_cast<std::size_t>(mixed >> (64 - bits_));
  }

  const std::vector<Point>& places_;
  int bits_ = 1;
  std::vector<std::uint32_t> entries_;
};

/// By particle, the slot that has what files and pictures say of it: its own, but of particles at one
/// place the first, which has the lowest id, exchanges with the one in the lowest slot, whose label the
/// pixels carry.
std::vector<std::uint32_t> slots_by_cell(const std::vector<Point>& places, const ParticleSlots& slots) {
  std::vector<std::uint32_t> by_cell = slots.of_ids();
  FirstAtPlaces first(places);
  for (std::size_t i = 0; i < places.size(); ++i) {
    std::uint32_t& lowest = by_cell[first.of(i)];
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

TrajectorySeeds::TrajectorySeeds(const SeedOptions& options, int start, Fit fit,
                                 const std::optional<Bounds>& all)
    : path_(options.trajectory),
      given_bounds_(options.bounds),
      keeps_inside_(options.keeps_inside),
      fit_(fit),
      fitted_(all),
      told_axes_(options.periodic),
      outside_is_(options.outside.value_or(Outside::count)),
      y_up_(points_up(options)),
      snap_(options.snapping()),
      in_pixels_(in_pixels(options)) {
  reader_ = open_trajectory(path_, options.value_column);
  while (number_ < start) {
    if (!read()) {
      throw Error(fmt::format("{}: there is no frame {}; the last one of the file is {}, counted from 0",
                              path_, start, number_));
    }
  }
  has_boxes_ = frame_.box.has_value();
  const std::optional<Bounds> bounds = shown_bounds();
  take_frame(bounds, make_picture(options, bounds));
  note_of_frame(frame_, number_, told_axes_);
}

bool TrajectorySeeds::next() {
  if (!read()) return false;
  read_ahead();
  take_frame(shown_bounds(), view_->picture.size);
  return true;
}

TrajectorySeeds::Read TrajectorySeeds::read_into(Frame room) const {
  Read read;
  read.frame = std::move(room);
  read.is_there = reader_->next(read.frame);
  read.bytes_left = reader_->bytes_left();
  return read;
}

bool TrajectorySeeds::read() {
  Read read = ahead_.valid() ? ahead_.get() : read_into(std::move(room_));
  if (!read.is_there) return false;
  room_ = std::exchange(frame_, std::move(read.frame));
  bytes_left_ = read.bytes_left;
  ++number_;
  return true;
}

void TrajectorySeeds::read_ahead() {
  // Not from a pipe, where the next frame may never come.
  if (!bytes_left_) return;
  try {
    ahead_ = std::async(std::launch::async,
                        [this, room = std::move(room_)]() mutable { return read_into(std::move(room)); });
  } catch (const std::system_error&) {
    // Where the system allows no more threads, the frame is read when it is needed.
  }
}

std::optional<Bounds> TrajectorySeeds::shown_bounds() {
  if (given_bounds_) return given_bounds_;
  if (fit_ == Fit::frame) return bounds_of(frame_);
  if (!fitted_) fitted_ = bounds_of(frame_);
  return fitted_;
}

Axes TrajectorySeeds::axes_of_frame() const {
  return told_axes_ || !frame_.box ? told_axes_.value_or(Axes::none) : periodic_axes(*frame_.box);
}

Size TrajectorySeeds::make_picture(const SeedOptions& options, const std::optional<Bounds>& bounds) const {
  if (options.size) return *options.size;
  if (!bounds) {
    throw Error(path_ +
                ": the frame has neither a box nor particles to tell the height by: give --size "
                "instead of --width, or --bounds");
  }
  try {
    return size_of_width(*bounds, options.width);
  } catch (const Error& error) {
    throw Error(path_ + ": " + error.what());
  }
}

Mapping TrajectorySeeds::mapping_of_frame(const Bounds& bounds) const {
  Mapping mapping;
  mapping.bounds = bounds;
  mapping.closed = !given_bounds_ || outside_is_ == Outside::refuse;
  mapping.y_up = y_up_;
  mapping.outside = outside_is_;
  mapping.periodic = axes_of_frame();
  mapping.snap = snap_;
  mapping.in_pixels = in_pixels_;
  mapping.has_one_scale = fit_ == Fit::all || given_bounds_;
  if (const std::optional<Box>& box = frame_.box) {
    mapping.domain = bounds_of(frame_);
    mapping.ends = {!box->open_x0, !box->open_y0, !box->open_x1, !box->open_y1};
    if (mapping.periodic == Axes::xy) mapping.tilt = box->tilt;
    if (box->tilt != 0 && mapping.periodic == Axes::y) {
      throw Error("the box is tilted, so it does not repeat straight along y; give --periodic xy or x");
    }
    if (mapping.tilt != 0 && !keeps_inside_.empty()) {
      throw Error("the box is tilted, which " + keeps_inside_ +
                  "; with --periodic x cells end at its border in y instead");
    }
  } else if (given_bounds_ && has_boxes_ && mapping.periodic != Axes::none) {
    throw Error("there is no box to say what repeats along the axes of --periodic; give --periodic none");
  }
  return mapping;
}

void TrajectorySeeds::note_of_scales(const Bounds& bounds, std::size_t outside) {
  if (fit_ == Fit::frame && !given_bounds_) {
    warn_of_scales(bounds, view_->picture.size.grid(), "--fit all has one scale for all frames");
  } else if (!scales_checked_) {
    warn_of_scales(bounds, view_->picture.size.grid());
  }
  note_of_growth();
  if (!scales_checked_ && given_bounds_) note_outside(outside, frame_.ids.size(), bounds, keeps_inside_);
  scales_checked_ = true;
}

void TrajectorySeeds::note_of_growth() {
  const auto own = bounds_of(frame_);
  if (growth_noted_ || fit_ == Fit::frame || given_bounds_ || !fitted_ || !own) return;
  if (own->x0 >= fitted_->x0 && own->y0 >= fitted_->y0 && own->x1 <= fitted_->x1 && own->y1 <= fitted_->y1) {
    return;
  }
  print_note(
      fmt::format("{}: frame {} fills more than the picture, which shows what the first frame does because "
                  "the file is read once; give --bounds, or the file by its name",
                  path_, number_));
  growth_noted_ = true;
}

void TrajectorySeeds::take_frame(const std::optional<Bounds>& bounds, const Size& picture) {
  MappedPoints mapped{{picture, picture.grid()}, {}};
  Periods periods;
  if (bounds) {
    try {
      mapped = map_points(frame_.positions, mapping_of_frame(*bounds), picture, frame_.ids);
    } catch (const Error& error) {
      throw Error(fmt::format("{}: frame {}: {}", path_, number_, error.what()));
    }
    if (frame_.box) periods = periods_in_pixels(*frame_.box, *bounds, picture, y_up_);
  }
  const bool has_other_window = view_ && view_->window != mapped.view.window;
  view_ = mapped.view;
  if (bounds) note_of_scales(*bounds, mapped.outside);
  const std::vector<Point>& places = mapped.places;
  slots_.update(frame_.ids, places);
  std::vector<std::optional<Point>> points(slots_.size());
  for (std::size_t i = 0; i < places.size(); ++i) points[slots_.of_ids()[i]] = places[i];
  max_displacement_ = has_other_window ? std::nullopt : std::optional<double>(0);
  if (max_displacement_) {
    for (std::size_t slot = 0; slot < std::min(points.size(), points_.size()); ++slot) {
      // A slot that was taken holds the same particle still.
      if (!points[slot] || !points_[slot]) continue;
      max_displacement_ = std::max(*max_displacement_, displacement(*points_[slot], *points[slot], periods));
    }
  }
  points_ = std::move(points);
  is_window_ = mapped.is_window();
  const std::vector<std::uint32_t> by_cell = slots_by_cell(places, slots_);
  ids_ = by_slot(frame_.ids, by_cell, slots_.size(), no_label);
  values_ = {by_slot(frame_.values.numbers, by_cell, slots_.size(), std::numeric_limits<double>::quiet_NaN()),
             frame_.values.texts};
}

}  // namespace vorocl::command
