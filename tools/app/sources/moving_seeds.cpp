#include "app/sources/moving_seeds.hpp"

#include <fmt/format.h>

#include "app/sources/bounds.hpp"
#include "app/sources/trajectory_seeds.hpp"
#include "app/terminal/console.hpp"

namespace vorocl::command {

namespace {

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
