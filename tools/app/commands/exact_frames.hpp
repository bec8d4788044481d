// vorocl simulate --exact: cells as polygons in each frame of a trajectory, without diagrams.
#pragma once

#include <optional>
#include <string>

#include "app/outputs/diagram_files.hpp"
#include "app/sources/seed_input.hpp"

namespace vorocl::command {

struct ExactFramesOptions {
  SeedOptions seeds;
  std::string device;
  FileRequest cells, adjacency;
  std::string polygons;       // a pattern; empty: not asked for
  std::optional<int> frames;  // after frame 0; none: all
  int every = 1;              // of the numbered files
  bool json = false;
};

/// Frames that are complete are kept where a later one is bad, or a signal comes.
void run_exact_frames(const ExactFramesOptions& options);

}  // namespace vorocl::command
