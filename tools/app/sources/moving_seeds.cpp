#include "app/sources/moving_seeds.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <future>
#include <system_error>
#include <type_traits>
#include <utility>

#include "app/sources/bounds.hpp"
#include "app/sources/random_seeds.hpp"
#include "app/sources/volume_input.hpp"
#include "app/terminal/console.hpp"

namespace vorocl::command {

namespace {

class RandomWalk : public MovingSeeds {
 public:
  RandomWalk(const SeedOptions& seeds, const MotionOptions& motion)
      : input_(read_input(seeds)),
        motion_{*motion.step_length, seeds.rng_seed, motion.border},
        frames_(*motion.frames.last) {
    refuse_window(input_, "random motion");
  }

  const View& view() const override { return input_.view; }
  Seeds place(const Device& device) const override { return input_.place(device); }
  bool next() override {
    if (frame_ == frames_) return false;
    ++frame_;
    return true;
  }
  void move(Seeds& seeds, Window& window) const override { motion_(seeds, window, frame_); }
  std::optional<double> displacement() const override { return motion_.step_length; }
  const std::vector<std::uint32_t>& ids() const override { return input_.ids; }
  const ColumnValues& values() const override { return input_.values; }
  std::optional<Box> box() const override { return std::nullopt; }
  std::optional<std::int64_t> timestep() const override { return std::nullopt; }
  std::optional<double> done() const override { return static_cast<double>(frame_) / frames_; }

 private:
  Input input_;
  RandomMotion motion_;
  int frames_;
  int frame_ = 0;
};

/// What is known of a frame of a trajectory.
template <typename Points>
struct PlacedFrame {
  Points points;
  std::vector<std::uint32_t> ids;
  ColumnValues values;
  std::optional<View> view;  // of every frame
  std::optional<double> displacement;
  std::optional<Box> box;
  std::optional<std::int64_t> timestep;
  std::optional<std::uintmax_t> bytes_left;
  bool is_there = true;
};

/// Reads and places the next frame of a file in a thread, while the present one is worked on. The particles
/// are TrajectorySeeds or VolumeFrames.
template <typename Particles>
class Trajectory : public MovingSeeds {
 public:
  template <typename... Fitted>
  Trajectory(const SeedOptions& seeds, const MotionOptions& motion, const Fitted&... fitted)
      : particles_(seeds, 0, fitted...),
        snap_(seeds.snapping()),
        frames_(motion.frames.last),
        bytes_(particles_.bytes_left()) {
    take_particles(present_);
  }

  const View& view() const override { return *present_.view; }
  Seeds place(const Device& device) const override {
    return {device, view().window.grid(), present_.points, {Outside::count, snap_}};
  }
  bool next() override {
    if (frame_ == frames_) return false;
    Placed next = ahead_.valid() ? ahead_.get() : place_next(std::move(room_));
    if (!next.is_there) return false;
    room_ = std::exchange(present_, std::move(next));
    ++frame_;
    place_ahead();
    return true;
  }
  void move(Seeds& seeds, Window& window) const override {
    window = view().window;
    seeds.move_to(window.grid(), present_.points);
  }
  std::optional<double> displacement() const override { return present_.displacement; }
  const std::vector<std::uint32_t>& ids() const override { return present_.ids; }
  const ColumnValues& values() const override { return present_.values; }
  std::optional<Box> box() const override { return present_.box; }
  std::optional<std::int64_t> timestep() const override { return present_.timestep; }
  std::optional<double> done() const override {
    const double of_frames = frames_ ? static_cast<double>(frame_) / *frames_ : 0;
    const auto left = present_.bytes_left;
    if (!bytes_ || !left || *bytes_ == 0) return frames_ ? std::optional<double>(of_frames) : std::nullopt;
    return std::max(of_frames, 1 - static_cast<double>(*left) / static_cast<double>(*bytes_));
  }

 private:
  using Placed = PlacedFrame<std::decay_t<decltype(std::declval<Particles>().points())>>;

  void take_particles(Placed& frame) const {
    frame.points = particles_.points();
    frame.ids = particles_.ids();
    frame.values = particles_.values();
    frame.view = particles_.view();
    frame.displacement = particles_.max_displacement();
    frame.box = particles_.box();
    frame.timestep = particles_.timestep();
    frame.bytes_left = particles_.bytes_left();
  }

  Placed place_next(Placed room) {
    room.is_there = particles_.next();
    if (room.is_there) take_particles(room);
    return room;
  }

  void place_ahead() {
    // Not from a pipe, where the next frame may never come.
    if (frame_ == frames_ || !present_.bytes_left) return;
    try {
      ahead_ = std::async(std::launch::async,
                          [this, room = std::move(room_)]() mutable { return place_next(std::move(room)); });
    } catch (const std::system_error&) {
      // Where the system allows no more threads, the frame is placed when it is needed.
    }
  }

  Particles particles_;  // those of the frame that was placed last
  Snap snap_;
  std::optional<int> frames_;
  std::optional<std::uintmax_t> bytes_;  // after frame 0
  int frame_ = 0;
  Placed present_, room_;      // and memory for the next one
  std::future<Placed> ahead_;  // none: nothing is being placed
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

std::unique_ptr<MovingSeeds> read_moving_seeds(const SeedOptions& seeds, const MotionOptions& motion,
                                               const Interruption& interruption) {
  const bool needs_all = motion.fit == Fit::all && !seeds.bounds;
  if (seeds.depth > 1) {
    return std::make_unique<Trajectory<VolumeFrames>>(
        seeds, motion,
        needs_all ? sides_of_all_frames(seeds.trajectory, motion.frames.last, interruption) : std::nullopt);
  }
  if (!seeds.trajectory.empty()) {
    check_seed_options(seeds);
    return std::make_unique<Trajectory<TrajectorySeeds>>(
        seeds, motion, motion.fit,
        needs_all ? bounds_of_all_frames(seeds.trajectory, motion.frames.last, interruption) : std::nullopt);
  }
  if (!motion.frames.last) throw UsageError("--frames L or K:L is required, except with --trajectory");
  if (!motion.step_length) throw UsageError("--step-length D is required, except with --trajectory");
  SeedOptions of_pixels = seeds;
  snap_for("random motion", of_pixels);
  return std::make_unique<RandomWalk>(of_pixels, motion);
}

}  // namespace vorocl::command
