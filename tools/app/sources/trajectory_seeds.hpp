// The particles of a trajectory as moving seeds, of a plane or a volume.
#pragma once

#include <cstdint>
#include <future>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/sources/mapping.hpp"
#include "app/sources/moving_seeds.hpp"
#include "app/sources/particles.hpp"
#include "formats/trajectory/trajectory.hpp"

namespace vorocl::command {

/// The frames as seeds. Those of a plane are in pixels of the grid that the diagram is a window of, each in a
/// slot of its own as long as it is there; ids and values are by slot, and no_label and NaN for an empty one.
/// Of particles at one place the lowest slot, whose label the pixels carry, has the lowest id. Particles of
/// volumes and of exact cells are in the units of the data.
///
/// A thread reads and places the next frame while the present one is worked on: memory does not grow with the
/// number of frames.
class TrajectorySeeds : public MovingSeeds {
 public:
  /// Reads the first frames, up to the one to start from; of those up to the `last` one next() makes motions.
  /// `all` are the bounds of all frames; without them a plane shows those of the first frame that has some,
  /// and a volume each frame's own. Throws Error if the file is bad, has fewer frames, no z where it is to be
  /// a volume, or a particle outside the bounds where that is refused; warns on standard error where the axes
  /// get different scales, and notes there what of the box is left out. So do the others.
  TrajectorySeeds(const SeedOptions& options, bool is_volume, int start = 0, std::optional<int> last = {},
                  Fit fit = Fit::all, const std::optional<Bounds>& all = std::nullopt);

  const Input& frame() const override { return present_; }
  bool next() override;
  void move(Seeds& seeds, Window& window) const override;
  std::optional<double> done() const override;

 private:
  /// Goes to the next frame of the file; false after the last. Throws BadFrame if it is bad.
  bool read();
  /// An error in the frame that was read, which it names.
  BadFrame error(const Error& what) const;
  /// That frame's.
  Input placed();
  /// The frame to start from.
  Input first();
  /// The next frame; none after the last.
  std::optional<Input> placed_next();
  void place_ahead();
  Input in_data();
  Input plane();
  /// What the picture shows; none if the frame, and those before it, have neither a box nor particles.
  std::optional<Bounds> shown_bounds();
  Mapping mapping_of_frame(const Bounds& bounds) const;
  Size size_of_picture(const std::optional<Bounds>& bounds) const;
  void note_of_scales(const Bounds& bounds, std::size_t outside);
  void note_of_growth();

  const SeedOptions options_;
  bool is_volume_;
  std::unique_ptr<TrajectoryReader> reader_;
  Frame read_;  // the last frame that was read
  int number_read_ = -1;
  int number_;  // of the present frame
  std::optional<int> last_;
  Fit fit_;
  std::optional<Bounds> fitted_;  // the same for all frames
  bool is_first_ = true;          // frame that is placed
  bool has_boxes_ = false;        // the first frame has one
  bool scales_checked_ = false;
  bool growth_noted_ = false;

  std::optional<Size> picture_;   // the same for all frames
  std::optional<Window> window_;  // of the last frame
  ParticleSlots slots_;
  std::shared_ptr<const std::vector<std::optional<Point>>> points_;  // of the last frame

  Input present_;
  std::optional<std::uintmax_t> bytes_;      // behind the first frame
  std::future<std::optional<Input>> ahead_;  // none: nothing is being placed
};

}  // namespace vorocl::command
