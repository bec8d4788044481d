#include "points/exact_diagram.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "runtime/buffer.hpp"
// Last: it defines macros.
#include "points/sizes.cl"

namespace vorocl {

namespace {

/// The engine's working memory.
struct PlacesWorkspace {
  cl::Buffer counts, ends, sorted;  // while the index is made
  cl::Buffer starts, x, y, z, ids;  // the index (kernels/points/index.cl)
};

std::size_t along(int voxels, int bits) { return (static_cast<std::size_t>(voxels - 1) >> bits) + 1; }

/// Bins as near to cubes as powers of two come, with PLACES_OF_BIN each.
cl_int4 bits_of_bins(const PixelGrid& grid, std::size_t places) {
  const std::array<int, 3> sides = {grid.width(), grid.height(), grid.depth()};
  cl_int4 bits = {};
  const double each = PLACES_OF_BIN * static_cast<double>(grid.pixels()) /
                      static_cast<double>(std::max<std::size_t>(places, 1));
  for (auto doublings = std::llround(std::log2(std::max(each, 1.0))); doublings > 0; --doublings) {
    std::size_t shortest = 3;
    const auto length = [&](std::size_t axis) { return grid.spacing()[axis] << bits.s[axis]; };
    for (std::size_t axis = 0; axis < 3; ++axis) {
      if (1 << bits.s[axis] >= sides[axis]) continue;
      if (shortest == 3 || length(axis) < length(shortest)) shortest = axis;
    }
    if (shortest == 3) break;
    ++bits.s[shortest];
  }
  return bits;
}

/// The parts of the list of seeds that are sorted at once: each costs a count per bucket.
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
  const bool are_points = filling.seeds().are_points;
  const PixelGrid& grid = filling.placement().grid;
  const cl::Buffer& given = are_points ? filling.take_points().seeds : *filling.placement().positions;
  const std::size_t seeds = filling.seeds().size, chunks = chunks_of(seeds), room = seeds + BEHIND_PLACES;
  const cl_int4 bits = bits_of_bins(grid, seeds);
  const std::size_t rows = along(grid.height(), bits.s[1]) * along(grid.depth(), bits.s[2]);
  PlacesWorkspace& memory = state.workspace<PlacesWorkspace>();
  auto& [counts, ends, sorted, starts, x, y, z, ids] = memory;
  state.reserve(counts, chunks * BUCKETS * word);
  state.reserve(ends, BUCKETS * word);
  state.reserve(sorted, room * sizeof(cl_int4));
  state.reserve(starts, rows * (along(grid.width(), bits.s[0]) + 1) * word);
  for (cl::Buffer* const list : {&x, &y, &z, &ids}) state.reserve(*list, room * word);

  const Device device = without_vectors(state.device);  // kernels have vectors of their own
  KernelOptions options;
  if (are_points) options.extent = Extent::fractions;
  // Work-items that do much each: small groups spread them over the compute units.
  const auto kernel = [&](const char* name) -> Kernel& {
    return state.kernels.get(device, "points/diagram.cl", name, grid, options).in_groups_of(1);
  };
  const auto count = static_cast<cl_uint>(seeds), chunk_count = static_cast<cl_uint>(chunks);
  const cl_int4 size = {{grid.width(), grid.height(), grid.depth(), 0}};
  cl_uint shift = 0;
  while ((rows - 1) >> shift >= BUCKETS) ++shift;
  const cl::Event first =
      kernel("count_chunks").over_items(chunks, given, count, chunk_count, bits, size, shift, counts);
  kernel("sum_chunks").over_items(1, chunk_count, counts, ends);
  kernel("sort_chunks").over_items(chunks, given, count, chunk_count, bits, size, shift, counts, sorted);
  kernel("sort_buckets").over_items(BUCKETS, sorted, bits, size, shift, ends, starts, x, y, z, ids);
  const auto regions_along = [](int voxels) { return static_cast<std::size_t>(voxels - 1) / REGION + 1; };
  const std::size_t regions =
      regions_along(grid.width()) * regions_along(grid.height()) * regions_along(grid.depth());
  const cl::Event last =
      kernel("label_regions").over_items(regions, starts, x, y, z, ids, bits, size, state.labels);
  return filling.commit(0, first, last);
}

}  // namespace vorocl
