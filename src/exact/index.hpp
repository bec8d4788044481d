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

/// The level of the top of the pyramid.
int top_level(const Grid& grid);

/// Makes the index by the kernels of a file, built for a device, and returns the first command.
cl::Event make_index(DiagramState& state, const Device& device, const Seeds& seeds, IndexMemory& memory,
                     const char* file, Metric metric);

}  // namespace vorocl
