#include "app/sources/moving_seeds.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <future>
#include <limits>
#include <system_error>
#include <utility>

#include "app/sources/bounds.hpp"
#include "app/sources/data_grid.hpp"
#include "app/sources/mapping.hpp"
#include "app/sources/particles.hpp"
#include "app/terminal/console.hpp"
#include "formats/trajectory/trajectory.hpp"
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

/// The frames as seeds. Those of a plane are in pixels of the grid that the diagram is a window of, each in a
/// slot of its own as long as it is there; ids and values are by slot, and no_label and NaN for an empty one.
/// Of particles at one place the lowest slot, whose label the pixels carry, has the lowest id. Particles of
/// volumes and of exact cells are in the units of the data.
///
/// A thread reads and places the next frame while the present one is worked on: memory does not grow with the
/// number of frames.
class TrajectorySeeds : public MovingSeeds {
 public:
  /// Reads the first frames, up to the one to start from; of those up to the `last` one next() makes motions.
  /// `all` are the bounds of all frames; without them a plane shows those of the first frame that has some,
  /// and a volume each frame's own.
  TrajectorySeeds(const SeedOptions& options, bool is_volume, int start = 0, std::optional<int> last = {},
                  Fit fit = Fit::all, const std::optional<Bounds>& all = std::nullopt)
      : options_(options),
        is_volume_(is_volume),
        reader_(open_trajectory(options.trajectory, options.read_column(),
                                is_volume ? Wanted::volume : Wanted::all)),
        number_(start),
        last_(last),
        fit_(fit),
        fitted_(all),
        present_(first()),
        bytes_(present_.bytes_left) {}

  const Input& frame() const override { return present_; }

  bool next() override {
    if (number_ == last_) return false;
    std::optional<Input> next = ahead_.valid() ? ahead_.get() : placed_next();
    if (!next) return false;
    present_ = std::move(*next);
    ++number_;
    place_ahead();
    return true;
  }

  void move(Seeds& seeds, Window& window) const override {
    window = present_.view.window;
    seeds.move_to(window.grid(), weighted(*present_.points, present_.weights));
  }

  std::optional<double> done() const override {
    const double of_frames = last_ ? static_cast<double>(number_) / *last_ : 0;
    const auto left = present_.bytes_left;
    if (!bytes_ || !left || *bytes_ == 0) return last_ ? std::optional<double>(of_frames) : std::nullopt;
    return std::max(of_frames, 1 - static_cast<double>(*left) / static_cast<double>(*bytes_));
  }

 private:
  /// The frame to start from.
  Input first() {
    while (number_read_ < number_) {
      if (read()) continue;
      throw Error(fmt::format("{}: there is no frame {}; the last one of the file is {}, counted from 0",
                              options_.trajectory, number_, number_read_));
    }
    return placed();
  }

  /// Goes to the next frame of the file; false after the last. Throws BadFrame if it is bad.
  bool read() {
    try {
      if (!reader_->next(read_)) return false;
    } catch (const Error& error) {
      throw BadFrame(error.what());
    }
    ++number_read_;
    return true;
  }

  /// An error in the frame that was read, which it names.
  BadFrame error(const Error& what) const {
    return BadFrame(fmt::format("{}: frame {}: {}", options_.trajectory, number_read_, what.what()));
  }

  void place_ahead() {
    // Not from a pipe, where the next frame may never come.
    if (number_ == last_ || !present_.bytes_left) return;
    try {
      ahead_ = std::async(std::launch::async, [this] { return placed_next(); });
    } catch (const std::system_error&) {
      // Where the system allows no more threads, the frame is placed when it is needed.
    }
  }

  /// The next frame; none after the last.
  std::optional<Input> placed_next() { return read() ? std::optional(placed()) : std::nullopt; }

  /// That frame's.
  Input placed() {
    const Frame& frame = read_;
    if (is_first_) has_boxes_ = frame.box.has_value();
    Input input = is_volume_ || options_.is_exact ? in_data() : plane();
    if (is_first_) note_of_frame(frame, number_read_, options_.periodic, is_volume_);
    is_first_ = false;
    input.timestep = frame.timestep;
    input.box = frame.box;
    input.bytes_left = reader_->bytes_left();
    return input;
  }

  Input in_data() {
    const Frame& frame = read_;
    const std::vector<Point> points = is_volume_ ? points_of(frame) : frame.positions;
    try {
      const Grid grid = is_volume_ ? box_of_frame(options_, frame, points, fitted_)
                                   : rectangle_of_frame(options_, frame, is_first_);
      if (is_first_ && options_.size) note_scales(options_, grid);
      if (!scales_checked_ && options_.size)
        scales_checked_ = warn_of_voxels(grid, fmt::format("frame {}: ", number_read_));
      Input input = {view_of_grid(grid, in_pixels(options_))};
      input.ids = frame.ids;
      place_points(input, options_, {points.begin(), points.end()},
                   weights_of(options_, frame.values, frame.ids),
                   is_volume_ ? Outside::count : options_.outside.value_or(Outside::count));
      return input;
    } catch (const Error& error) {
      throw this->error(error);
    }
  }

  /// What the picture shows; none if the frame, and those before it, have neither a box nor particles.
  std::optional<Bounds> shown_bounds() {
    if (options_.bounds) return options_.bounds;
    if (fit_ == Fit::frame) return bounds_of(read_);
    if (!fitted_) fitted_ = bounds_of(read_);
    return fitted_;
  }

  Size size_of_picture(const std::optional<Bounds>& bounds) const {
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

  Mapping mapping_of_frame(const Bounds& bounds) const {
    const std::optional<Box>& box = read_.box;
    Mapping mapping = mapping_of(options_, bounds);
    if (box && !options_.periodic) mapping.periodic = periodic_axes(*box, false);
    mapping.has_one_scale = fit_ == Fit::all || options_.bounds;
    if (box) {
      mapping.domain = bounds_of(read_);
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

  void note_of_scales(const Bounds& bounds, std::size_t outside) {
    const Grid grid = picture_->grid();
    if (fit_ == Fit::frame && !options_.bounds) {
      warn_of_scales(bounds, grid, "--fit all has one scale for all frames");
    } else if (!scales_checked_) {
      warn_of_scales(bounds, grid);
    }
    note_of_growth();
    if (!scales_checked_ && options_.bounds) {
      note_outside(outside, read_.ids.size(), bounds, options_.keeps_inside);
    }
    scales_checked_ = true;
  }

  void note_of_growth() {
    const auto own = bounds_of(read_);
    if (growth_noted_ || fit_ == Fit::frame || options_.bounds || !fitted_ || !own) return;
    if (own->x0 >= fitted_->x0 && own->y0 >= fitted_->y0 && own->x1 <= fitted_->x1 &&
        own->y1 <= fitted_->y1) {
      return;
    }
    print_note(
        fmt::format("{}: frame {} fills more than the picture, which shows what the first frame does because "
                    "the file is read once; give --bounds, or the file by its name",
                    options_.trajectory, number_read_));
    growth_noted_ = true;
  }

  Input plane() {
    const Frame& frame = read_;
    const std::optional<Bounds> bounds = shown_bounds();
    if (!picture_) picture_ = size_of_picture(bounds);
    MappedPoints mapped{{*picture_, picture_->grid()}, {}};
    Periods periods;
    Weights weights;
    try {
      if (bounds) no_extent_noted_ = no_extent_noted_ || note_no_extent(options_, *bounds);
      const bool has_weights = bounds && !options_.weight_column.empty();
      const double squares = has_weights ? pixels_of_square(*bounds, *picture_) : 1;
      if (bounds) mapped = map_points(frame.positions, mapping_of_frame(*bounds), *picture_, frame.ids);
      weights = weights_of(options_, frame.values, frame.ids, squares);
    } catch (const Error& error) {
      throw this->error(error);
    }
    if (bounds) {
      if (frame.box) periods = periods_in_pixels(*frame.box, *bounds, *picture_, points_up(options_));
      note_of_scales(*bounds, mapped.outside);
    }
    const std::vector<Point>& places = mapped.places;
    slots_.update(frame.ids, places);
    std::vector<std::optional<Point>> points(slots_.size());
    for (std::size_t i = 0; i < places.size(); ++i) points[slots_.of_ids()[i]] = places[i];
    // With weights the one that is heaviest has the pixels of a place, under its own slot.
    const std::vector<std::uint32_t> by_cell = weights ? slots_.of_ids() : slots_by_cell(places, slots_);
    constexpr double none = std::numeric_limits<double>::quiet_NaN();
    Input input = {mapped.view};
    input.ids = by_slot(frame.ids, by_cell, slots_.size(), no_label);
    input.values = {by_slot(frame.values.numbers, by_cell, slots_.size(), none), frame.values.texts};
    input.is_window = mapped.is_window();
    if (weights) {
      weights = std::make_shared<const std::vector<double>>(by_slot(*weights, by_cell, slots_.size(), none));
    }
    place_points(input, options_, std::move(points), weights);
    const std::optional<Window> last_window = std::exchange(window_, input.view.window);
    const auto last = std::exchange(points_, input.points);
    if (last_window && *last_window != *window_) return input;
    double greatest = 0;
    for (std::size_t slot = 0; last && slot < std::min(points_->size(), last->size()); ++slot) {
      // A slot that was taken holds the same particle still.
      const std::optional<Point>&from = (*last)[slot], &to = (*points_)[slot];
      if (from && to) greatest = std::max(greatest, displacement(*from, *to, periods));
    }
    input.displacement = greatest;
    return input;
  }

  const SeedOptions options_;
  bool is_volume_;
  std::unique_ptr<TrajectoryReader> reader_;
  Frame read_;  // the last frame that was read
  int number_read_ = -1;
  int number_;  // of the present frame
  std::optional<int> last_;
  Fit fit_;
  std::optional<Bounds> fitted_;  // the same for all frames
  bool is_first_ = true;          // frame that is placed
  bool has_boxes_ = false;        // the first frame has one
  bool scales_checked_ = false;
  bool growth_noted_ = false;
  bool no_extent_noted_ = false;

  std::optional<Size> picture_;   // the same for all frames
  std::optional<Window> window_;  // of the last frame
  ParticleSlots slots_;
  std::shared_ptr<const std::vector<std::optional<Point>>> points_;  // of the last frame

  Input present_;
  std::optional<std::uintmax_t> bytes_;      // behind the first frame
  std::future<std::optional<Input>> ahead_;  // none: nothing is being placed
};

/// The paper's model: uniform steps, in each frame up to so many pixels along x and y. The window stays.
class RandomWalk : public MovingSeeds {
 public:
  RandomWalk(const SeedOptions& seeds, const MotionOptions& motion)
      : input_(read_input(seeds)), rng_seed_(seeds.rng_seed), motion_(motion) {
    refuse_window(input_, "random motion");
    input_.displacement = *motion.step_length;
  }

  const Input& frame() const override { return input_; }
  bool next() override {
    if (frame_ == *motion_.frames.last) return false;
    ++frame_;
    return true;
  }
  void move(Seeds& seeds, Window&) const override {
    random_step(seeds, *motion_.step_length, motion_.border, rng_seed_, static_cast<std::uint32_t>(frame_));
  }
  std::optional<double> done() const override { return static_cast<double>(frame_) / *motion_.frames.last; }

 private:
  Input input_;
  std::uint64_t rng_seed_;
  MotionOptions motion_;
  int frame_ = 0;
};

}  // namespace

std::string how_to_continue(const FrameRange& frames, int complete, bool has_tables) {
  const int next = frames.first + complete;
  if (complete == 0 || (frames.last && next > *frames.last)) return {};
  return fmt::format("; --frames {}:{} makes the others{}", next,
                     frames.last ? std::to_string(*frames.last) : "",
                     has_tables ? ", with other names of tables" : "");
}

void note_of_last(const std::string& trajectory, const FrameRange& frames, int last) {
  if (!frames.last || last >= *frames.last) return;
  print_note(fmt::format("{}: frame {} is the last one, and --frames asks for frames up to {}", trajectory,
                         last, *frames.last));
}

Input frame_of_trajectory(const SeedOptions& options, bool is_volume) {
  return TrajectorySeeds(options, is_volume, options.frame).frame();
}

std::unique_ptr<MovingSeeds> read_moving_seeds(const SeedOptions& seeds, const MotionOptions& motion,
                                               const Interruption& interruption) {
  SeedOptions options = seeds;
  if (!seeds.trajectory.empty()) {
    const bool is_volume = check_seeds(options), needs_all = motion.fit == Fit::all && !seeds.bounds;
    return std::make_unique<TrajectorySeeds>(
        options, is_volume, 0, motion.frames.last, motion.fit,
        needs_all && !seeds.is_exact
            ? bounds_of_all_frames(seeds.trajectory, is_volume, motion.frames.last, interruption)
            : std::nullopt);
  }
  if (!motion.frames.last) throw UsageError("--frames L or K:L is required, except with --trajectory");
  if (!motion.step_length) throw UsageError("--step-length D is required, except with --trajectory");
  snap_for("random motion", options);
  return std::make_unique<RandomWalk>(options, motion);
}

}  // namespace vorocl::command
