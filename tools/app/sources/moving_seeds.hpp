// Seeds with their motion: what a simulation is of.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "app/sources/seed_input.hpp"
#include "app/terminal/end_of_run.hpp"
#include "vorocl/motion.hpp"

namespace vorocl::command {

/// The frames that a run makes, from 0 on: all that there are without a last one.
struct FrameRange {
  int first = 0;
  std::optional<int> last = std::nullopt;
};

/// "; --frames 3:20 makes the others", for the error that ended a run behind so many frames; empty where none
/// is left, or none is complete.
std::string how_to_continue(const FrameRange& frames, int complete, bool has_tables);

/// Says on standard error that the trajectory's last frame comes before the last one that is asked for, if
/// so.
void note_of_last(const std::string& trajectory, const FrameRange& frames, int last);

/// What a picture of many frames shows where no bounds are given.
enum class Fit {
  all,   ///< the bounds of all frames, with one scale
  frame  ///< each frame's own, stretched onto the picture
};

/// What is wrong in a frame of a file: to make frames again from there on is of no use.
class BadFrame : public Error {
 public:
  using Error::Error;
};

struct MotionOptions {
  FrameRange frames;
  std::optional<int> step_length;
  Border border = Border::reflect;
  Fit fit = Fit::all;  // of a trajectory
};

class MovingSeeds {
 public:
  virtual ~MovingSeeds() = default;

  /// The present frame, whose picture has one size in all frames, and how far a seed went to it at most.
  virtual const Input& frame() const = 0;

  /// Makes the next motion ready; false if there is none. Throws Error if a file is bad there.
  virtual bool next() = 0;

  /// Moves the seeds by it, to where the frame's diagram has its window.
  virtual void move(Seeds& seeds, Window& window) const = 0;

  /// How much of the whole is done, 0 ... 1, as far as that is known.
  virtual std::optional<double> done() const = 0;
};

/// The frame of a trajectory that the options ask for. Throws Error if the file is bad, has fewer frames, no
/// z where it is to be a volume, or a particle outside the bounds where that is refused; warns on standard
/// error where the axes get different scales, and notes there what of the box is left out.
Input frame_of_trajectory(const SeedOptions& options, bool is_volume);

/// Those of a trajectory, or seeds that move at random. Throws UsageError for options that do not go
/// together, Error as frame_of_trajectory(), for any frame, and if reading all of a file is interrupted.
std::unique_ptr<MovingSeeds> read_moving_seeds(const SeedOptions& seeds, const MotionOptions& motion,
                                               const Interruption& interruption);

}  // namespace vorocl::command
