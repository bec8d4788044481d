// The particles of a trajectory as moving seeds, of a plane or a volume.
#pragma once

#include <cstdint>
#include <future>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/sources/mapping.hpp"
#include "app/sources/particles.hpp"
#include "app/sources/seed_input.hpp"
#include "formats/trajectory/trajectory.hpp"

namespace vorocl::command {

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

/// Reads the frames of a file one after the other. Holds one, and reads the next one meanwhile: memory does
/// not grow with the number of frames.
class FrameReader {
 public:
  /// Throws Error if the file cannot be read.
  FrameReader(const SeedOptions& options, bool of_volume);

  /// Goes to the next frame; false after the last. Throws BadFrame if it is bad.
  bool next();

  /// Goes on to a frame by its number. Throws Error if the file has fewer.
  void go_to(int number);

  /// Begins to read the next one in a thread. Not from a pipe, where it may never come.
  void read_ahead();

  /// The present frame, which may be moved from.
  Frame& frame() { return frame_; }
  const Frame& frame() const { return frame_; }
  int number() const { return number_; }

  /// How much of the file lies behind the frame; none where that is not known.
  std::optional<std::uintmax_t> bytes_left() const { return bytes_left_; }

  /// An error in the frame, which it names.
  BadFrame error(const Error& what) const;

 private:
  /// What the reader gives next.
  struct Read {
    Frame frame;
    bool is_there = false;
    std::optional<std::uintmax_t> bytes_left;
  };
  Read read_into(Frame room) const;

  std::string path_;
  std::unique_ptr<TrajectoryReader> reader_;
  Frame frame_, room_;  // the present frame, and memory for the next one
  std::optional<std::uintmax_t> bytes_left_;
  int number_ = -1;
  std::future<Read> ahead_;  // none: nothing is being read
};

/// The frames as seeds. Those of a plane are in pixels of the grid that the diagram is a window of, each in a
/// slot of its own as long as it is there; ids and values are by slot, and no_label and NaN for an empty one.
/// Of particles at one place the lowest slot, whose label the pixels carry, has the lowest id.
class TrajectorySeeds {
 public:
  /// Reads the first frames, up to the one to start from, and keeps a reference to the options. `all` are the
  /// bounds of all frames; without them a plane shows those of the first frame that has some, and a volume
  /// each frame's own. Throws Error if the file is bad or has fewer frames.
  explicit TrajectorySeeds(const SeedOptions& options, int start = 0, Fit fit = Fit::all,
                           const std::optional<Bounds>& all = std::nullopt);

  /// The next frame, at first the one to start from; none after the last. Throws Error if it is bad, has no
  /// z where it is to be a volume, or has a particle outside the bounds where that is refused; warns on
  /// standard error where the axes get different scales, and notes there what of the box is left out.
  std::optional<Input> next();

 private:
  bool is_volume() const { return options_.is_volume(); }
  Input volume();
  Input plane();
  /// See weights_of().
  Weights weights_of_frame(double squares) const;
  /// What the picture shows; none if the frame, and those before it, have neither a box nor particles.
  std::optional<Bounds> shown_bounds();
  Mapping mapping_of_frame(const Bounds& bounds) const;
  Size size_of_picture(const std::optional<Bounds>& bounds) const;
  void note_of_scales(const Bounds& bounds, std::size_t outside);
  void note_of_growth();

  const SeedOptions& options_;
  FrameReader reader_;
  Fit fit_;
  std::optional<Bounds> fitted_;  // the same for all frames
  bool is_first_ = true;          // frame, of those that next() gives
  bool has_boxes_ = false;        // the first frame has one
  bool scales_checked_ = false;
  bool growth_noted_ = false;

  std::optional<Size> picture_;   // the same for all frames
  std::optional<Window> window_;  // of the last frame
  ParticleSlots slots_;
  std::shared_ptr<const std::vector<std::optional<Point>>> points_;  // of the last frame
};

}  // namespace vorocl::command
