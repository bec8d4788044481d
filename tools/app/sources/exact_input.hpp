// Seeds at their own places, in the units of the data, for cells without pixels.
#pragma once

#include <optional>

#include "app/sources/trajectory_seeds.hpp"

namespace vorocl::command {

/// Checks the options, and reads and checks the files. The values are weights. Points and particles lie in
/// the bounds, else in the domain, the box of the trajectory's frame or the points' bounding box; along a
/// periodic axis in the domain or the box. Other seeds are the centres of pixels. Where there are no pixels
/// the window's grid has few, which do not count: it says the rectangle or box, its periodic axes and its
/// tilts. Throws UsageError, Error if a file is bad, or a weight, or a box is tilted of which an axis is said
/// not to be periodic.
///
/// It is a volume if an option says so that planes do not have (bounds of six numbers, z among the columns or
/// the periodic axes, a depth), or if neither bounds nor columns say that it is a plane, and the points are
/// an array of three columns, or the particles of the first frame do not lie in a plane, or its box is tilted
/// in z.
Input read_exact_input(const SeedOptions& options);

/// The frames of a trajectory as read_exact_input() has one, one after the other.
class ExactFrames {
 public:
  /// Checks the options. Throws UsageError, and Error, as the other functions do, if the file is bad.
  explicit ExactFrames(const SeedOptions& options);

  /// The next frame; none after the last.
  std::optional<Input> next();

  /// Leaves a frame out; false after the last.
  bool skip() { return reader_.next(); }

  /// Goes on to a frame, which take() then gives. Throws Error if the file has fewer.
  void go_to(int number) { reader_.go_to(number); }
  Input take();

  /// The frames that were read so far.
  int count() const { return reader_.number() + 1; }

  /// The time of the last one: its time step, or its number.
  std::int64_t time() const { return reader_.frame().timestep.value_or(reader_.number()); }

  bool is_volume() const { return is_volume_; }

 private:
  const SeedOptions options_;
  bool is_volume_;
  FrameReader reader_;
  bool is_first_ = true;  // of those that next() gives
};

}  // namespace vorocl::command
