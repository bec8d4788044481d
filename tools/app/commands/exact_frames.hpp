// vorocl simulate --exact: cells as polygons or polyhedra in each frame of a trajectory, without diagrams.
#pragma once

#include <string>

#include "app/outputs/frame_writer.hpp"

namespace vorocl::command {

struct ExactFramesOptions {
  SeedOptions seeds;
  std::string device;
  FrameWriterOptions output;  // tables of cells and pairs, and polygons
  FrameRange frames;
  bool json = false;
};

/// Throws UsageError if nothing is to be written. Frames that are complete are kept where a later one is bad,
/// or a signal comes.
void run_exact_frames(const ExactFramesOptions& options);

}  // namespace vorocl::command
