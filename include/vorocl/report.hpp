// What an engine reports of one diagram: its waves and its times.
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "vorocl/export.h"
#include "vorocl/opencl.hpp"

namespace vorocl {

/// What the waves of a diagram started with.
struct FloodStart {
  int first_step = 0;      ///< of the first wave, in pixels; 0: there was none
  bool from_seeds = true;  ///< from the seeds alone, as JFA, and not from the last labels
};

/// Engines enqueue and return; their report can be asked later, from any thread, also when seeds and diagram
/// are gone.
class VOROCL_API Report {
 public:
  Report() = default;

  /// The waves that ran, 0 for an engine without waves.
  int waves() const { return waves_; }

  /// Of the waves that made the labels: those that ran before a new start are not looked at.
  const FloodStart& start() const { return start_; }

  /// Whether the labels are those of the centres of the seeds' pixels, although the seeds' points lie
  /// elsewhere in them (Snap::none): engines that flood snap.
  bool snapped() const { return snapped_; }

  /// Completes with the diagram.
  const cl::Event& event() const { return last_; }

  /// The device's time from the start of the diagram's first command to the end of its last one, with the
  /// gaps between them. A gap in which the driver compiles a kernel for its first launch is left out. Waits
  /// for it. 0 if the queue does not profile. Throws Error if the device failed, and in a forked child.
  double milliseconds() const;

  /// The host's time to enqueue the diagram, without waiting for room in a full queue (see Device). Where an
  /// engine waits for the device to know what to enqueue next (standard flooding; dynamic_jump_flooding()
  /// says when), that counts.
  double host_milliseconds() const { return host_milliseconds_; }

 private:
  friend struct Internal;
  Report(int waves, const cl::Event& first, const cl::Event& last, double host_milliseconds,
         const FloodStart& start, std::vector<std::pair<cl::Event, cl::Event>>&& first_launches,
         std::int64_t process, bool snapped)
      : waves_(waves),
        first_(first),
        last_(last),
        first_launches_(std::move(first_launches)),
        host_milliseconds_(host_milliseconds),
        start_(start),
        process_(process),
        snapped_(snapped) {}

  int waves_ = 0;
  cl::Event first_;
  cl::Event last_;
  std::vector<std::pair<cl::Event, cl::Event>> first_launches_;  // of kernels, each behind what came before
  double host_milliseconds_ = 0;
  FloodStart start_;
  std::int64_t process_ = 0;  // that made it
  bool snapped_ = false;
};

}  // namespace vorocl
