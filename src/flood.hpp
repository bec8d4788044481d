// The waves of one diagram, enqueued one after the other: what all flooding engines are made of.
#pragma once

#include <chrono>
#include <string>

#include "vorocl/diagram.hpp"
#include "vorocl/plan.hpp"
#include "vorocl/report.hpp"
#include "vorocl/seeds.hpp"

namespace vorocl {

/// Between waves the diagram is an image of packed seed positions. Each wave reads the front image and writes
/// the back one, then they change places.
class Flood {
 public:
  /// Checks that seeds and diagram fit together and that the device has the memory, before anything is
  /// enqueued.
  Flood(const Seeds& seeds, Diagram& diagram, Metric metric);

  /// A step that leads out of the grid from every pixel: such a wave keeps each pixel's own label.
  int no_step() const { return diagram_.grid().longest_side(); }

  /// Stamps the seeds on an empty image, and runs a first wave over it.
  void first_wave(const Wave& wave);

  /// Starts from the diagram's labels instead of a first wave: their seeds at their present positions.
  void advance_labels();

  void wave(const Wave& wave);

  /// A wave of step 1 that stores `number` in `last_change` if it changes a label.
  void reporting_wave(Neighbourhood neighbourhood, int number, const cl::Buffer& last_change);

  /// Runs a last wave and writes the ids of its labels into the diagram.
  void last_wave(const Wave& wave);

  Report report(int waves) const;

 private:
  const Seeds& seeds_;
  Diagram& diagram_;
  Metric metric_;
  std::chrono::steady_clock::time_point started_ = std::chrono::steady_clock::now();
  cl::Buffer front_, back_, seeded_;
  cl::Event first_event_, last_event_;
};

}  // namespace vorocl
