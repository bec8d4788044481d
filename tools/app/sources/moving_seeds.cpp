#include "app/sources/moving_seeds.hpp"

#include <algorithm>
#include <utility>

#include "app/sources/bounds.hpp"
#include "app/sources/random_seeds.hpp"
#include "app/terminal/console.hpp"

namespace vorocl::command {

namespace {

class RandomWalk : public MovingSeeds {
 public:
  RandomWalk(const SeedOptions& seeds, const MotionOptions& motion)
      : input_(read_input(seeds)),
        motion_{*motion.step_length, seeds.rng_seed, motion.border},
        frames_(*motion.frames) {
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
  const std::vector<double>& values() const override { return input_.values; }
  std::optional<Box> box() const override { return std::nullopt; }
  std::optional<std::int64_t> timestep() const override { return std::nullopt; }
  std::optional<double> done() const override { return static_cast<double>(frame_) / frames_; }

 private:
  Input input_;
  RandomMotion motion_;
  int frames_;
  int frame_ = 0;
};

class Trajectory : public MovingSeeds {
 public:
  Trajectory(const SeedOptions& seeds, const MotionOptions& motion, const std::optional<Bounds>& bounds)
      : particles_(seeds, 0, motion.fit, bounds),
        snap_(seeds.snapping()),
        frames_(motion.frames),
        bytes_(particles_.bytes_left()) {}

  const View& view() const override { return particles_.view(); }
  Seeds place(const Device& device) const override {
    return {device, view().window.grid(), particles_.points(), Outside::count, snap_};
  }
  bool next() override {
    if (frame_ == frames_ || !particles_.next()) return false;
    ++frame_;
    return true;
  }
  void move(Seeds& seeds, Window& window) const override {
    window = view().window;
    seeds.move_to(window.grid(), particles_.points());
  }
  std::optional<double> displacement() const override { return particles_.max_displacement(); }
  const std::vector<std::uint32_t>& ids() const override { return particles_.ids(); }
  const std::vector<double>& values() const override { return particles_.values(); }
  std::optional<Box> box() const override { return particles_.box(); }
  std::optional<std::int64_t> timestep() const override { return particles_.timestep(); }
  std::optional<double> done() const override {
    const double of_frames = frames_ ? static_cast<double>(frame_) / *frames_ : 0;
    const auto left = particles_.bytes_left();
    if (!bytes_ || !left || *bytes_ == 0) return frames_ ? std::optional<double>(of_frames) : std::nullopt;
    return std::max(of_frames, 1 - static_cast<double>(*left) / static_cast<double>(*bytes_));
  }

 private:
  TrajectorySeeds particles_;
  Snap snap_;
  std::optional<int> frames_;
  std::optional<std::uintmax_t> bytes_;  // after frame 0
  int frame_ = 0;
};

}  // namespace

std::unique_ptr<MovingSeeds> read_moving_seeds(const SeedOptions& seeds, const MotionOptions& motion,
                                               const Interruption& interruption) {
  if (!seeds.trajectory.empty()) {
    check_seed_options(seeds);
    const bool needs_all = motion.fit == Fit::all && !seeds.bounds;
    return std::make_unique<Trajectory>(
        seeds, motion,
        needs_all ? bounds_of_all_frames(seeds.trajectory, motion.frames, interruption) : std::nullopt);
  }
  if (!motion.frames) throw UsageError("--frames A is required, except with --trajectory");
  if (!motion.step_length) throw UsageError("--step-length D is required, except with --trajectory");
  SeedOptions of_pixels = seeds;
  snap_for("random motion", of_pixels);
  return std::make_unique<RandomWalk>(of_pixels, motion);
}

}  // namespace vorocl::command
