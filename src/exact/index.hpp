// The index of the seeds that exact diagrams are made from (kernels/exact/make_index.cl): its memory, and the
// launches that make it.
#pragma once

#include "diagram_state.hpp"
#include "vorocl/diagram.hpp"

namespace vorocl {

struct IndexMemory {
  cl::Buffer bits, word_starts, starts, list, ids, list_end;
  cl::Buffer bit_of_seed, duplicates, duplicate_count;  // while the index is made
  cl::Buffer pyramid;
};

/// The bins of a level, along the axes of the frame (kernels/exact/seed_index.cl) and in all.
std::size_t bins_across(const Grid& grid, int level);
std::size_t bins_down(const Grid& grid, int level);
std::size_t bins(const Grid& grid, int level);

/// The level of the top of the pyramid.
int top_level(const Grid& grid);

/// Makes the index by the kernels of a file, of this shape and built for a device, and returns the first
/// command.
cl::Event make_index(DiagramState& state, const Device& device, const Seeds& seeds, IndexMemory& memory,
                     Shape shape, const char* file, Metric metric);

}  // namespace vorocl
