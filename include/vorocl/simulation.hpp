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
/// motion. Nothing is allocated on the device after frame 1 (while the seeds' number and grid stay). Nothing
/// waits unless an engine, the motion or the caller reads, or the queue is full (see Device).
///
/// After step() has thrown, the next one goes on: with the same frame if the motion threw, or diagrams of a
/// new window could not be made; with the next frame if an engine did.
///
/// Threads: one thread at a time.
///
/// Lifetime: seeds(), diagram() and report() are valid as long as the simulation, and those of the last frame
/// until the next step(). What motion and engines refer to must live as long as they are called.
///
/// Ordering: all work goes to the device's in-order queue, in the order of the calls.
class VOROCL_API Simulation {
 public:
  /// Moves the seeds on to a frame (from 1 on). It may move them to another grid or replace them by others of
  /// the same device, and change the window that the diagrams cover, which must be of the seeds' grid: then
  /// the diagrams are made anew, and engines start from nothing.
  using Motion = std::function<void(Seeds& seeds, Window& window, int frame)>;

  /// Fills the diagram of a frame.
  using Engine = std::function<Report(const Seeds& seeds, Diagram& diagram)>;

  /// Diagrams of the window, or of the seeds' whole grid, whichever that is in a frame. Throws Error if the
  /// motion is empty.
  Simulation(Seeds seeds, Motion motion);
  Simulation(Seeds seeds, const Window& window, Motion motion);

  /// Adds an engine, before the first step; returns its number. Throws Error if it is empty or too late.
  std::size_t add_engine(Engine engine);

  /// Makes the next frame's diagrams: frame 0 of the seeds as they are, then one motion per frame.
  void step();

  /// Moves the seeds on to the next frame without its diagrams: these stay those of an earlier frame. Throws
  /// what the motion throws, and then only what that did to the seeds has changed.
  void skip();

  /// The frame that the last step() made or skip() passed, -1 before the first.
  int frame() const { return frame_; }
  const Seeds& seeds() const { return seeds_; }
  const Diagram& diagram(std::size_t engine = 0) const { return track(engine).diagram; }

  /// Of the last frame.
  const Report& report(std::size_t engine = 0) const { return track(engine).report; }

  /// The device's time for the diagrams of frames 1, 2, ..., without the motion, as the paper measures it.
  /// Waits.
  double milliseconds(std::size_t engine = 0);

  /// The host's time to enqueue the same.
  double host_milliseconds(std::size_t engine = 0) const { return track(engine).host_milliseconds; }

 private:
  struct Track {
    Engine engine;
    Diagram diagram;
    Report report;
    std::vector<Report> untimed;  // frames whose device time has not been asked for
    double milliseconds = 0;
    double host_milliseconds = 0;
  };

  /// Throws Error if there is no engine of this number.
  const Track& track(std::size_t engine) const;

  Seeds seeds_;
  Window window_;
  Motion motion_;
  std::vector<Track> tracks_;
  int frame_ = -1;
};

}  // namespace vorocl
