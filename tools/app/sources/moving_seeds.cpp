#include "app/sources/moving_seeds.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <future>
#include <system_error>
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
    input_.displacement = motion_.step_length;
  }

  const Input& frame() const override { return input_; }
  bool next() override {
    if (frame_ == frames_) return false;
    ++frame_;
    return true;
  }
  void move(Seeds& seeds, Window& window) const override { motion_(seeds, window, frame_); }
  std::optional<double> done() const override { return static_cast<double>(frame_) / frames_; }

 private:
  Input input_;
  RandomMotion motion_;
  int frames_;
  int frame_ = 0;
};

/// Reads and places the next frame of a file in a thread, while the present one is worked on.
class Trajectory : public MovingSeeds {
 public:
  Trajectory(const SeedOptions& seeds, const MotionOptions& motion, const std::optional<Bounds>& all)
      : particles_(seeds, 0, motion.fit, all),
        frames_(motion.frames.last),
        present_(*particles_.next()),
        bytes_(present_.bytes_left) {}

  const Input& frame() const override { return present_; }
  bool next() override {
    if (frame_ == frames_) return false;
    std::optional<Input> next = ahead_.valid() ? ahead_.get() : particles_.next();
    if (!next) return false;
    present_ = std::move(*next);
    ++frame_;
    place_ahead();
    return true;
  }
  void move(Seeds& seeds, Window& window) const override {
    window = present_.view.window;
    seeds.move_to(window.grid(), weighted(*present_.points, present_.weights));
  }
  std::optional<double> done() const override {
    const double of_frames = frames_ ? static_cast<double>(frame_) / *frames_ : 0;
    const auto left = present_.bytes_left;
    if (!bytes_ || !left || *bytes_ == 0) return frames_ ? std::optional<double>(of_frames) : std::nullopt;
    return std::max(of_frames, 1 - static_cast<double>(*left) / static_cast<double>(*bytes_));
  }

 private:
  void place_ahead() {
    // Not from a pipe, where the next frame may never come.
    if (frame_ == frames_ || !present_.bytes_left) return;
    try {
      ahead_ = std::async(std::launch::async, [this] { return particles_.next(); });
    } catch (const std::system_error&) {
      // Where the system allows no more threads, the frame is placed when it is needed.
    }
  }

  TrajectorySeeds particles_;
  std::optional<int> frames_;
  Input present_;
  std::optional<std::uintmax_t> bytes_;  // after frame 0
  int frame_ = 0;
  std::future<std::optional<Input>> ahead_;  // none: nothing is being placed
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
  if (!seeds.trajectory.empty()) {
    const bool is_volume = seeds.is_volume();
    is_volume ? check_volume_options(seeds) : check_seed_options(seeds);
    return std::make_unique<Trajectory>(
        seeds, motion,
        needs_all ? bounds_of_all_frames(seeds.trajectory, is_volume, motion.frames.last, interruption)
                  : std::nullopt);
  }
  if (!motion.frames.last) throw UsageError("--frames L or K:L is required, except with --trajectory");
  if (!motion.step_length) throw UsageError("--step-length D is required, except with --trajectory");
  SeedOptions of_pixels = seeds;
  snap_for("random motion", of_pixels);
  return std::make_unique<RandomWalk>(of_pixels, motion);
}

}  // namespace vorocl::command
