// vorocl simulate --exact: cells as polygons or polyhedra in each frame of a trajectory, without diagrams.
#pragma once

#include <string>

#include "app/outputs/diagram_files.hpp"
#include "app/sources/moving_seeds.hpp"

namespace vorocl::command {

struct ExactFramesOptions {
  SeedOptions seeds;
  std::string device;
  FileRequest cells, adjacency;
  std::string polygons;  // a pattern; empty: not asked for
  FrameRange frames;
  int every = 1;  // of the numbered files
  bool json = false;
};

/// Frames that are complete are kept where a later one is bad, or a signal comes.
void run_exact_frames(const ExactFramesOptions& options);

}  // namespace vorocl::command
