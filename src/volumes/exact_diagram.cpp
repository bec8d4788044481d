#include "volumes/exact_diagram.hpp"

#include "runtime/buffer.hpp"
// Last: it defines macros.
#include "volumes/sizes.cl"

namespace vorocl {

namespace {

constexpr std::size_t entry = sizeof(cl_ulong), lanes = 8;

/// The engine's working memory.
struct VolumeWorkspace {
  cl::Buffer bits, starts, list;
  cl::Buffer low, high, seed;         // of nodes: bins, regions, blocks
  cl::Buffer counts, totals, sorted;  // while the index is made
  cl::Buffer boxes_left;              // of each region, once the dense ones are labelled
};

std::size_t parts_along(int size, int part) {
  return static_cast<std::size_t>(size - 1) / static_cast<std::size_t>(part) + 1;
}

std::size_t regions_of(const PixelGrid& grid) {
  return parts_along(grid.width(), REGION) * parts_along(grid.height(), REGION) *
         parts_along(grid.depth(), REGION);
}

/// Blocks, as many as whole vectors hold.
std::size_t padded_blocks(const PixelGrid& grid) {
  constexpr int side = REGION * BLOCK;
  const std::size_t blocks =
      parts_along(grid.width(), side) * parts_along(grid.height(), side) * parts_along(grid.depth(), side);
  return (blocks + lanes - 1) / lanes * lanes;
}

/// The parts of the list of seeds that are sorted at once: each costs a count per region.
std::size_t chunks_of(std::size_t seeds) { return seeds < 4096 ? 1 : seeds < 65536 ? 8 : 64; }

}  // namespace

void check_exact_volume(const Filling& filling, const DiagramState& state) {
  if (filling.metric() != Metric::euclidean) {
    throw Error("exact diagrams of volumes are Euclidean; jump flooding takes the Manhattan metric");
  }
  if (state.device.tuning().shape == Shape::group) {
    throw Error("exact diagrams of volumes are made by CPUs alone, and " + state.device.name() +
                " is tuned as a GPU: take jump flooding, or a CPU");
  }
}

Report exact_diagram_of_volume(Filling& filling, DiagramState& state) {
  const PixelGrid& grid = filling.placement().grid;
  const cl::Buffer& positions = *filling.placement().positions;
  const std::size_t seeds = filling.seeds().size, regions = regions_of(grid), blocks = padded_blocks(grid);
  const std::size_t chunks = chunks_of(seeds), across = (regions + lanes - 1) / lanes * lanes;
  VolumeWorkspace& memory = state.workspace<VolumeWorkspace>();
  auto& [bits, starts, list, low, high, seed, counts, totals, sorted, boxes_left] = memory;
  state.reserve(bits, regions * BINS * WORDS * word);
  state.reserve(starts, regions * (BINS + 1) * word);
  state.reserve(list, (seeds + BEHIND_LIST) * entry);
  for (cl::Buffer* const of_nodes : {&low, &high, &seed}) {
    state.reserve(*of_nodes, (regions * (BINS + 1) + blocks) * word);
  }
  state.reserve(counts, chunks * across * word);
  state.reserve(totals, (across + 1) * word);
  state.reserve(sorted, seeds * entry);
  state.reserve(boxes_left, regions * word);

  const Device device = without_vectors(state.device);  // kernels have vectors of their own
  const int width = grid.width(), height = grid.height(), depth = grid.depth();
  const auto count = static_cast<cl_uint>(seeds), chunk_count = static_cast<cl_uint>(chunks),
             padded = static_cast<cl_uint>(across);
  // Work-items that do much each: small groups spread them over the compute units.
  const auto kernel = [&](const char* name) -> Kernel& {
    return filling.kernel(device, "volumes/exact.cl", name).in_groups_of(1);
  };
  const cl::Event first =
      kernel("count_chunks")
          .over_items(chunks, positions, count, chunk_count, counts, padded, width, height, depth);
  kernel("sum_chunks").over_items(across / lanes, counts, chunk_count, padded, totals);
  kernel("sum_regions").over_items(1, totals, padded);
  kernel("sort_seeds")
      .over_items(chunks, positions, count, chunk_count, counts, padded, totals, sorted, width, height,
                  depth);
  kernel("make_bins")
      .over_items(regions, bits, starts, low, high, seed, sorted, totals, list, width, height, depth);
  kernel("make_blocks").over_items(blocks, low, high, seed, width, height, depth);
  kernel("label_dense")
      .over_items(regions, bits, starts, list, width, height, depth, state.labels, boxes_left);
  const cl::Event last =
      kernel("label_regions")
          .over_items(regions, starts, low, high, seed, list, width, height, depth, state.labels, boxes_left);
  return filling.commit(0, first, last);
}

}  // namespace vorocl
