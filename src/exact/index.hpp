// The index of the seeds that exact diagrams are made from (kernels/exact/make_index.cl): its memory, and the
// launches that make it.
#pragma once

#include "core/diagram_state.hpp"
#include "vorocl/diagram.hpp"

namespace vorocl {

struct IndexMemory {
  cl::Buffer bits, word_starts, starts, list, ids;
  cl::Buffer bit_of_seed, duplicates;  // while the index is made
  cl::Buffer pyramid;
};

/// What the index covers, in pixels: the grid, and margins along periodic axes that are a shape's
/// (kernels/exact/seed_index.cl).
struct IndexFrame {
  IndexFrame(const PixelGrid& grid, Shape shape);

  int width, height;
};

/// The bins of a level, along the axes and in all.
std::size_t bins_across(const IndexFrame& frame, int level);
std::size_t bins_down(const IndexFrame& frame, int level);
std::size_t bins(const IndexFrame& frame, int level);

/// The level of the top of the pyramid.
int top_level(const IndexFrame& frame);

/// Makes the index by the kernels of a file, of this shape and built for a device, and returns the first
/// command.
cl::Event make_index(Filling& filling, DiagramState& state, const Device& device, IndexMemory& memory,
                     Shape shape, const char* file);

}  // namespace vorocl
