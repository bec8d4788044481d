// The index of the seeds that the group shape makes exact diagrams from (kernels/exact/group/index.cl): its
// memory, and the launches that make it.
#pragma once

#include "core/diagram_state.hpp"
#include "vorocl/diagram.hpp"

namespace vorocl {

struct IndexMemory {
  cl::Buffer bits, word_starts, starts, list, ids;
  cl::Buffer bit_of_seed, duplicates;  // while the index is made
  cl::Buffer pyramid;
};

/// What the index covers, in pixels: the grid, and margins along periodic axes
/// (kernels/exact/group/seed_index.cl).
struct IndexFrame {
  explicit IndexFrame(const PixelGrid& grid);

  int width, height;
};

/// The level of the top of the pyramid.
int top_level(const IndexFrame& frame);

/// Makes the index by the kernels of a file, built for a device, and returns the first command.
cl::Event make_index(Filling& filling, DiagramState& state, const Device& device, IndexMemory& memory,
                     const char* file);

}  // namespace vorocl
