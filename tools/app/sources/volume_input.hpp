// The seeds of a volume that a command line asks for, and the grid that they are on.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/sources/seed_input.hpp"
#include "app/terminal/end_of_run.hpp"
#include "formats/trajectory/trajectory.hpp"
#include "vorocl/seeds.hpp"

namespace vorocl::command {

/// A stretch of the data along an axis, and those along all three.
struct VolumeSide {
  double low = 0, high = 0;
  bool is_periodic = false;
};
using VolumeSides = std::array<VolumeSide, 3>;

/// What the boxes of all frames of a trajectory fill, or their particles where there is no box, as
/// read_all_frames() reads them; none for a pipe.
std::optional<VolumeSides> sides_of_all_frames(const std::string& path, std::optional<int> frames,
                                               const Interruption& interruption);

std::vector<Point> points_of(const Frame& frame);

/// The grid of a frame with these points: what its box, the bounds that are given, `all` (see VolumeFrames)
/// or the points say that it shows. Without a size it has few voxels, which do not count. Throws Error, as if
/// a point lies outside.
Grid grid_of_frame(const SeedOptions& options, const Frame& frame, const std::vector<Point>& points,
                   const std::optional<VolumeSides>& all = std::nullopt);

/// Says on standard error what may not be expected of a first frame: that it is turned, or has other periodic
/// axes than are given.
void note_of_volume(const SeedOptions& options, const Frame& frame);

/// The particles of a trajectory in a volume, frame by frame. Voxels are counted along the coordinates. Each
/// frame has its own box, whose periodic axes are those of the file unless they are given; without a box the
/// bounding box of the particles. Where the sides of a frame's voxels are whole multiples of one length in
/// data units, up to 16, its axes are spaced so.
class VolumeFrames {
 public:
  /// Reads the first frames, up to the one to start from. Throws Error if the file is bad, has fewer frames
  /// or no z, or has a tilted box; warns on standard error where the axes get different scales,
  /// and notes where the file has other periodic axes than are given.
  /// `all` is what the volume shows along axes that are not periodic, unless the options have bounds; without
  /// it each frame's own box.
  explicit VolumeFrames(const SeedOptions& options, int start = 0,
                        const std::optional<VolumeSides>& all = std::nullopt);

  /// Goes to the next frame; false after the last. Throws as above.
  bool next();

  View view() const;
  const std::vector<Point>& points() const { return points_; }

  /// The particles' ids, by seed.
  const std::vector<std::uint32_t>& ids() const { return frame_.ids; }

  std::optional<std::int64_t> timestep() const { return frame_.timestep; }

  // The same as of TrajectorySeeds; volumes have no value columns, and no method that asks for displacements.
  const std::optional<Box>& box() const { return frame_.box; }
  const ColumnValues& values() const { return frame_.values; }
  std::optional<double> max_displacement() const { return std::nullopt; }
  std::optional<std::uintmax_t> bytes_left() const { return reader_->bytes_left(); }

 private:
  void take_frame();

  const SeedOptions& options_;
  std::optional<VolumeSides> all_;
  std::unique_ptr<TrajectoryReader> reader_;
  Frame frame_;
  int number_ = -1;
  bool has_warned_ = false;   // of distances without a scale
  std::optional<Grid> grid_;  // set by the constructor
  std::vector<Point> points_;
};

/// Throws UsageError: volumes do not have this option.
[[noreturn]] void refuse_in_volumes(const std::string& option);

/// Throws UsageError for options of seeds that volumes do not have.
void check_volume_options(const SeedOptions& options);

/// As read_input(), of a volume. A point outside the bounds is an Error.
Input read_volume_input(const SeedOptions& options);

}  // namespace vorocl::command
