#include "app/sources/trajectory_seeds.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <system_error>
#include <utility>

#include "app/sources/bounds.hpp"
#include "app/sources/particles.hpp"
#include "app/sources/volume_input.hpp"
#include "app/terminal/console.hpp"
#include "vorocl/error.hpp"

namespace vorocl::command {

namespace {

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

FrameReader::FrameReader(const SeedOptions& options, bool of_volume)
    : path_(options.trajectory),
      reader_(open_trajectory(path_, options.read_column(), of_volume ? Wanted::volume : Wanted::all)) {}

bool FrameReader::next() {
  Read read;
  try {
    read = ahead_.valid() ? ahead_.get() : read_into(std::move(room_));
  } catch (const Error& error) {
    throw BadFrame(error.what());
  }
  if (!read.is_there) return false;
  room_ = std::exchange(frame_, std::move(read.frame));
  bytes_left_ = read.bytes_left;
  ++number_;
  return true;
}

void FrameReader::go_to(int number) {
  while (number_ < number) {
    if (next()) continue;
    throw Error(fmt::format("{}: there is no frame {}; the last one of the file is {}, counted from 0", path_,
                            number, number_));
  }
}

void FrameReader::read_ahead() {
  if (!bytes_left_) return;
  try {
    ahead_ = std::async(std::launch::async,
                        [this, room = std::move(room_)]() mutable { return read_into(std::move(room)); });
  } catch (const std::system_error&) {
    // Where the system allows no more threads, the frame is read when it is needed.
  }
}

BadFrame FrameReader::error(const Error& what) const {
  return BadFrame(fmt::format("{}: frame {}: {}", path_, number_, what.what()));
}

FrameReader::Read FrameReader::read_into(Frame room) const {
  Read read;
  read.frame = std::move(room);
  read.is_there = reader_->next(read.frame);
  read.bytes_left = reader_->bytes_left();
  return read;
}

TrajectorySeeds::TrajectorySeeds(const SeedOptions& options, int start, Fit fit,
                                 const std::optional<Bounds>& all)
    : options_(options), reader_(options, is_volume()), fit_(fit), fitted_(all) {
  reader_.go_to(start);
  has_boxes_ = reader_.frame().box.has_value();
}

std::optional<Input> TrajectorySeeds::next() {
  if (!is_first_) {
    if (!reader_.next()) return std::nullopt;
    reader_.read_ahead();
  }
  Input input = is_volume() ? volume() : plane();
  const Frame& frame = reader_.frame();
  if (is_first_) note_of_frame(frame, reader_.number(), options_.periodic, is_volume());
  is_first_ = false;
  window_ = input.view.window;
  points_ = input.points;
  input.place = [grid = window_->grid(), points = points_, weights = input.weights,
                 snap = options_.snapping()](const Device& device) {
    return Seeds(device, grid, weighted(*points, weights), {Outside::count, snap});
  };
  input.timestep = frame.timestep;
  input.box = frame.box;
  input.bytes_left = reader_.bytes_left();
  return input;
}

Input TrajectorySeeds::volume() {
  const Frame& frame = reader_.frame();
  const std::vector<Point> points = points_of(frame);
  const Grid grid = [&] {
    try {
      return grid_of_frame(options_, frame, points, fitted_);
    } catch (const Error& error) {
      throw reader_.error(error);
    }
  }();
  if (is_first_) note_scales(grid);
  if (!scales_checked_) scales_checked_ = warn_of_voxels(grid, fmt::format("frame {}: ", reader_.number()));
  Input input = {view_of_volume(grid, in_pixels(options_)), {}, frame.ids};
  input.weights = weights_of_frame(1);
  input.points = std::make_shared<std::vector<std::optional<Point>>>(points.begin(), points.end());
  return input;
}

Weights TrajectorySeeds::weights_of_frame(double squares) const {
  try {
    return weights_of(options_, reader_.frame().values, reader_.frame().ids, squares);
  } catch (const Error& error) {
    throw reader_.error(error);
  }
}

std::optional<Bounds> TrajectorySeeds::shown_bounds() {
  if (options_.bounds) return options_.bounds;
  if (fit_ == Fit::frame) return bounds_of(reader_.frame());
  if (!fitted_) fitted_ = bounds_of(reader_.frame());
  return fitted_;
}

Size TrajectorySeeds::size_of_picture(const std::optional<Bounds>& bounds) const {
  if (!options_.size && !bounds) {
    throw Error(options_.trajectory +
                ": the frame has neither a box nor particles to tell the height by: give --size "
                "instead of --width, or --bounds");
  }
  try {
    return picture_size(options_, bounds.value_or(Bounds()));
  } catch (const Error& error) {
    throw Error(options_.trajectory + ": " + error.what());
  }
}

Mapping TrajectorySeeds::mapping_of_frame(const Bounds& bounds) const {
  const std::optional<Box>& box = reader_.frame().box;
  Mapping mapping;
  mapping.bounds = bounds;
  mapping.outside = options_.outside.value_or(Outside::count);
  mapping.closed = !options_.bounds || mapping.outside == Outside::refuse;
  mapping.y_up = points_up(options_);
  mapping.periodic = options_.periodic.value_or(box ? periodic_axes(*box, false) : Axes::none);
  mapping.snap = options_.snapping();
  mapping.in_pixels = in_pixels(options_);
  mapping.has_one_scale = fit_ == Fit::all || options_.bounds;
  if (box) {
    mapping.domain = bounds_of(reader_.frame());
    mapping.ends = {!box->open_x0, !box->open_y0, !box->open_x1, !box->open_y1};
    if (mapping.periodic == Axes::xy) mapping.tilt = box->tilt;
    if (box->tilt != 0 && mapping.periodic == Axes::y) {
      throw Error("the box is tilted, so it does not repeat straight along y; give --periodic xy or x");
    }
    if (mapping.tilt != 0 && !options_.keeps_inside.empty()) {
      throw Error("the box is tilted, which " + options_.keeps_inside +
                  "; with --periodic x cells end at its border in y instead");
    }
  } else if (options_.bounds && has_boxes_ && mapping.periodic != Axes::none) {
    throw Error("there is no box to say what repeats along the axes of --periodic; give --periodic none");
  }
  return mapping;
}

void TrajectorySeeds::note_of_scales(const Bounds& bounds, std::size_t outside) {
  const Grid grid = picture_->grid();
  if (fit_ == Fit::frame && !options_.bounds) {
    warn_of_scales(bounds, grid, "--fit all has one scale for all frames");
  } else if (!scales_checked_) {
    warn_of_scales(bounds, grid);
  }
  note_of_growth();
  if (!scales_checked_ && options_.bounds) {
    note_outside(outside, reader_.frame().ids.size(), bounds, options_.keeps_inside);
  }
  scales_checked_ = true;
}

void TrajectorySeeds::note_of_growth() {
  const auto own = bounds_of(reader_.frame());
  if (growth_noted_ || fit_ == Fit::frame || options_.bounds || !fitted_ || !own) return;
  if (own->x0 >= fitted_->x0 && own->y0 >= fitted_->y0 && own->x1 <= fitted_->x1 && own->y1 <= fitted_->y1) {
    return;
  }
  print_note(
      fmt::format("{}: frame {} fills more than the picture, which shows what the first frame does because "
                  "the file is read once; give --bounds, or the file by its name",
                  options_.trajectory, reader_.number()));
  growth_noted_ = true;
}

Input TrajectorySeeds::plane() {
  const Frame& frame = reader_.frame();
  const std::optional<Bounds> bounds = shown_bounds();
  if (!picture_) picture_ = size_of_picture(bounds);
  MappedPoints mapped{{*picture_, picture_->grid()}, {}};
  Periods periods;
  double squares = 1;
  if (bounds) {
    try {
      if (!options_.weight_column.empty()) squares = pixels_of_square(*bounds, *picture_);
      mapped = map_points(frame.positions, mapping_of_frame(*bounds), *picture_, frame.ids);
    } catch (const Error& error) {
      throw reader_.error(error);
    }
    if (frame.box) periods = periods_in_pixels(*frame.box, *bounds, *picture_, points_up(options_));
    note_of_scales(*bounds, mapped.outside);
  }
  const std::vector<Point>& places = mapped.places;
  slots_.update(frame.ids, places);
  const auto points = std::make_shared<std::vector<std::optional<Point>>>(slots_.size());
  for (std::size_t i = 0; i < places.size(); ++i) (*points)[slots_.of_ids()[i]] = places[i];
  // With weights the one that is heaviest has the pixels of a place, under its own slot.
  const Weights weights = weights_of_frame(squares);
  const std::vector<std::uint32_t> by_cell = weights ? slots_.of_ids() : slots_by_cell(places, slots_);
  Input input = {
      mapped.view,
      {},
      by_slot(frame.ids, by_cell, slots_.size(), no_label),
      {by_slot(frame.values.numbers, by_cell, slots_.size(), std::numeric_limits<double>::quiet_NaN()),
       frame.values.texts},
      mapped.is_window()};
  input.points = points;
  if (weights) {
    input.weights = std::make_shared<const std::vector<double>>(
        by_slot(*weights, by_cell, slots_.size(), std::numeric_limits<double>::quiet_NaN()));
  }
  if (window_ && *window_ != mapped.view.window) return input;
  double greatest = 0;
  for (std::size_t slot = 0; points_ && slot < std::min(points->size(), points_->size()); ++slot) {
    // A slot that was taken holds the same particle still.
    const std::optional<Point>&from = (*points_)[slot], &to = (*points)[slot];
    if (from && to) greatest = std::max(greatest, displacement(*from, *to, periods));
  }
  input.displacement = greatest;
  return input;
}

}  // namespace vorocl::command
