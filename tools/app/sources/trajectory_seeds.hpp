// The particles of a trajectory as moving seeds: mapped to pixels, each in a slot of its own.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/sources/bounds.hpp"
#include "app/sources/particle_slots.hpp"
#include "formats/trajectory/trajectory.hpp"
#include "vorocl/seeds.hpp"

namespace vorocl::command {

struct SeedOptions;

/// Holds one frame: memory does not grow with the number of frames.
class TrajectorySeeds {
 public:
  /// Reads the first frames, up to the one to start from. Throws UsageError where no size is given, Error if
  /// the file is bad or has fewer frames; warns on standard error where the axes get different scales, and
  /// notes there which periodic axes of the box are left out.
  explicit TrajectorySeeds(const SeedOptions& options, int start = 0);

  const Grid& grid() const { return *grid_; }

  /// Reads the next frame; false after the last. Throws Error, and leaves the seeds as they are, if it is
  /// bad, has a particle outside the bounds, or has other periodic axes.
  bool next();

  /// The seeds of the frame, by slot, to move_to() from.
  const std::vector<std::optional<Point>>& points() const { return points_; }

  /// Where the frame's box repeats, if the grid does not say it.
  const std::optional<Domain>& domain() const { return domain_; }

  /// Whether particles lie outside the grid, or there is a domain.
  bool is_window() const { return outside_grid_ > 0 || domain_; }

  /// The particles' ids, by slot; no_label for an empty slot. Of particles on one pixel the lowest slot,
  /// whose label the pixels carry, has the lowest id.
  const std::vector<std::uint32_t>& ids() const { return ids_; }

  /// The values of the value column, in the same order; NaN for an empty slot, and without such a column.
  const std::vector<double>& values() const { return values_; }

  /// The greatest displacement along an axis to this frame of a particle that was there before, in pixels;
  /// the shorter way round where the box is periodic.
  double max_displacement() const { return max_displacement_; }

  /// The frame's time step, where the file has one.
  std::optional<std::int64_t> timestep() const { return frame_.timestep; }

  /// How much of the file is still to be read; none where that is not known.
  std::optional<std::uintmax_t> bytes_left() const { return reader_->bytes_left(); }

 private:
  bool read();
  /// None for a frame that has neither a box nor particles.
  std::optional<Bounds> bounds_of_frame();
  /// Along which axes the frame's box, as it is drawn, repeats, or the bounds where there is no box.
  Periodic axes_of_frame() const;
  void check_tilt() const;
  Mapping mapping_of_frame(const Bounds& bounds) const;
  Grid make_grid(const SeedOptions& options, const std::optional<Bounds>& bounds) const;
  void take_frame(const std::optional<Bounds>& bounds);
  void check_inside(const Bounds& bounds) const;

  std::string path_;
  std::unique_ptr<TrajectoryReader> reader_;
  std::optional<Bounds> given_bounds_;
  std::optional<Bounds> first_bounds_;  // for frames without a box
  std::optional<Grid> grid_;            // set by the constructor
  std::optional<Periodic> told_axes_;   // by the caller, not by the file
  Outside outside_;
  bool has_domain_ = false;  // the bounds are given, and the frame's box is what repeats
  bool y_up_;
  bool scales_checked_ = false;

  Frame frame_;
  int number_ = -1;
  ParticleSlots slots_;
  std::vector<std::optional<Point>> points_;
  std::optional<Domain> domain_;
  std::size_t outside_grid_ = 0;  // particles of the frame
  std::vector<std::uint32_t> ids_;
  std::vector<double> values_;
  double max_displacement_ = 0;
};

}  // namespace vorocl::command
