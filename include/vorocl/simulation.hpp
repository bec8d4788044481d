// The loop of the paper's Algorithm 1: move the seeds, make the diagram, hand it over.
#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include "vorocl/diagram.hpp"
#include "vorocl/export.h"
#include "vorocl/report.hpp"
#include "vorocl/seeds.hpp"

namespace vorocl {

/// Owns the frame counter, the seeds and a diagram for each engine, so that engines can be compared on one
/// motion. Nothing is allocated on the device after frame 0 (while the number of seeds stays), and nothing
/// waits unless an engine or the caller reads. One thread at a time. If step() throws, the simulation can go
/// on with the next one: the frame that failed counts, and its diagrams count as never filled.
class VOROCL_API Simulation {
 public:
  /// Moves the seeds on to a frame (from 1 on) and returns the greatest displacement of a seed along an axis,
  /// in pixels (the paper's d_max).
  using Motion = std::function<double(Seeds& seeds, int frame)>;

  /// Fills the diagram of a frame. max_displacement is what the motion returned, 0 for frame 0.
  using Engine = std::function<Report(const Seeds& seeds, Diagram& diagram, double max_displacement)>;

  Simulation(Seeds seeds, Motion motion);

  /// Adds an engine, before the first step; returns its number.
  std::size_t add_engine(Engine engine);

  /// Makes the next frame's diagrams: frame 0 of the seeds as they are, then one motion per frame.
  void step();

  /// The frame that the last step() made, -1 before the first.
  int frame() const { return frame_; }
  const Seeds& seeds() const { return seeds_; }
  const Diagram& diagram(std::size_t engine = 0) const { return tracks_.at(engine).diagram; }

  /// Of the last frame.
  const Report& report(std::size_t engine = 0) const { return tracks_.at(engine).report; }

  /// The device's time for the diagrams of frames 1, 2, ..., without the motion, as the paper measures it.
  /// Waits.
  double milliseconds(std::size_t engine = 0);

  /// The host's time to enqueue the same.
  double host_milliseconds(std::size_t engine = 0) const { return tracks_.at(engine).host_milliseconds; }

 private:
  struct Track {
    Engine engine;
    Diagram diagram;
    Report report;
    std::vector<Report> untimed;  // frames whose device time has not been asked for
    double milliseconds = 0;
    double host_milliseconds = 0;
    double max_displacement = 0;  // since the diagram was last filled
  };

  Seeds seeds_;
  Motion motion_;
  std::vector<Track> tracks_;
  int frame_ = -1;
};

}  // namespace vorocl
