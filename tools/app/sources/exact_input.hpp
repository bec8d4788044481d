// Seeds at their own places, in the units of the data, for cells without pixels.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "app/sources/seed_input.hpp"
#include "formats/trajectory/trajectory.hpp"
#include "vorocl/seeds.hpp"

namespace vorocl::command {

struct ExactInput {
  Grid grid;  ///< of few pixels, which do not count: the rectangle or box, its periodic axes and its tilt
  std::function<Seeds(const Device&)> place;
  std::vector<std::uint32_t> ids;                       ///< by seed, ascending; empty: the seeds' own
  std::optional<std::int64_t> timestep = std::nullopt;  ///< of a trajectory's frame that has one
  KeptColumns kept = {};                                ///< of --keep
  std::optional<Crs> crs = std::nullopt;                ///< of points
};

/// Checks the options, and reads and checks the files. Points and particles lie in the bounds, else in the
/// domain, the box of the trajectory's frame or the points' bounding box; along a periodic axis in the domain
/// or the box. Other seeds are the centres of pixels. Throws UsageError, Error if a file is bad, or a box is
/// tilted of which an axis is said not to be periodic, or which is a volume.
///
/// It is a volume if an option says so that planes do not have (bounds of six numbers, z among the columns or
/// the periodic axes, a depth), or if neither bounds nor columns say that it is a plane, and the points are
/// an array of three columns, or the particles of the first frame do not lie in a plane.
ExactInput read_exact_input(const SeedOptions& options);

/// The frames of a trajectory as read_exact_input() has one, one after the other.
class ExactFrames {
 public:
  /// Checks the options, and keeps a reference to them. Throws UsageError, and Error, as the other functions
  /// do, if the file is bad.
  explicit ExactFrames(const SeedOptions& options);

  /// The next frame; none after the last.
  std::optional<ExactInput> next();

  /// Leaves a frame out; false after the last.
  bool skip();

  /// The frames that were read so far.
  int count() const { return count_; }

  bool is_volume() const { return is_volume_; }

 private:
  const SeedOptions& options_;
  bool is_volume_;
  std::unique_ptr<TrajectoryReader> reader_;
  Frame frame_;
  int count_ = 0;
  bool is_first_ = true;  // of those that next() gives
};

}  // namespace vorocl::command
