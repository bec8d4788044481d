// The particles of a trajectory as moving seeds: mapped to pixels, each in a slot of its own.
#pragma once

#include <cstdint>
#include <future>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/sources/mapping.hpp"
#include "app/sources/particles.hpp"
#include "formats/trajectory/trajectory.hpp"
#include "vorocl/seeds.hpp"

namespace vorocl::command {

struct SeedOptions;

/// What a picture of many frames shows where no bounds are given.
enum class Fit {
  all,   ///< the bounds of all frames, with one scale
  frame  ///< each frame's own, stretched onto the picture
};

/// Holds one frame, and reads the next one of a file meanwhile: memory does not grow with the number of
/// frames.
class TrajectorySeeds {
 public:
  /// Reads the first frames, up to the one to start from. `all` are the bounds of all frames, else those of
  /// the first that has some. Throws Error if the file is bad or has fewer frames; warns on standard error
  /// where the axes get different scales, and notes there what of the box is left out.
  explicit TrajectorySeeds(const SeedOptions& options, int start = 0, Fit fit = Fit::all,
                           const std::optional<Bounds>& all = std::nullopt);

  /// Where the frame's diagram stands in the picture, which has one size in all frames.
  const View& view() const { return *view_; }

  /// Goes to the next frame; false after the last. Throws Error, and leaves the seeds as they are, if it is
  /// bad, or has a particle outside the bounds where that is refused.
  bool next();

  /// The seeds of the frame, by slot, in pixels of the grid that the diagram is a window of.
  const std::vector<std::optional<Point>>& points() const { return points_; }

  /// As MappedPoints.
  bool is_window() const { return is_window_; }

  /// The frame's box; none in an XYZ without a lattice.
  const std::optional<Box>& box() const { return frame_.box; }

  /// The particles' ids, by slot; no_label for an empty slot. Of particles at one place the lowest slot,
  /// whose label the pixels carry, has the lowest id.
  const std::vector<std::uint32_t>& ids() const { return ids_; }

  /// The values of the value column, in the same order; NaN for an empty slot, and without such a column.
  const ColumnValues& values() const { return values_; }

  /// The greatest displacement along an axis to this frame of a particle that was there before, in pixels of
  /// the diagram's grid, and none if that is another one; the shorter way round where the box is periodic.
  std::optional<double> max_displacement() const { return max_displacement_; }

  /// The frame's time step, where the file has one.
  std::optional<std::int64_t> timestep() const { return frame_.timestep; }

  /// How much of the file lies behind the frame; none where that is not known.
  std::optional<std::uintmax_t> bytes_left() const { return bytes_left_; }

 private:
  /// What the reader gives next.
  struct Read {
    Frame frame;
    bool is_there = false;
    std::optional<std::uintmax_t> bytes_left;
  };
  Read read_into(Frame room) const;
  bool read();
  void read_ahead();
  /// What the picture shows; none if the frame, and those before it, have neither a box nor particles.
  std::optional<Bounds> shown_bounds();
  /// Along which axes the frame's box repeats, or the bounds where there is no box.
  Axes axes_of_frame() const;
  Mapping mapping_of_frame(const Bounds& bounds) const;
  Size make_picture(const SeedOptions& options, const std::optional<Bounds>& bounds) const;
  void note_of_scales(const Bounds& bounds, std::size_t outside);
  void note_of_growth();
  void take_frame(const std::optional<Bounds>& bounds, const Size& picture);

  std::string path_;
  std::unique_ptr<TrajectoryReader> reader_;
  std::optional<Bounds> given_bounds_;
  std::string keeps_inside_;  // see note_outside()
  Fit fit_;
  std::optional<Bounds> fitted_;   // the same for all frames
  std::optional<Axes> told_axes_;  // by the caller, not by the file
  Outside outside_is_;
  bool y_up_;
  Snap snap_;
  bool in_pixels_;
  bool has_boxes_ = false;  // the first frame has one
  bool scales_checked_ = false;
  bool growth_noted_ = false;

  Frame frame_, room_;  // the present frame, and memory for the next one
  std::optional<std::uintmax_t> bytes_left_;
  int number_ = -1;
  std::optional<View> view_;  // set by the constructor
  ParticleSlots slots_;
  std::vector<std::optional<Point>> points_;
  bool is_window_ = false;
  std::vector<std::uint32_t> ids_;
  ColumnValues values_;
  std::optional<double> max_displacement_;
  std::future<Read> ahead_;  // none: nothing is being read
};

}  // namespace vorocl::command
