#include "exact/points.hpp"

#include <algorithm>

#include "runtime/buffer.hpp"
#include "runtime/opencl_info.hpp"
// Last: it defines macros.
#include "exact/points/sizes.cl"

namespace vorocl {

namespace {

static_assert(fractions_of_pixel == 1 << FRACTION_BITS);

struct PointsWorkspace {
  cl::Buffer starts, list, ids;  // the index (kernels/exact/points/index.cl)
};

std::size_t along(int pixels, int bits) { return (static_cast<std::size_t>(pixels - 1) >> bits) + 1; }

/// Bins with some four places each, so that neither bins nor places that are too far are what a walk meets
/// most.
int bits_of_bins(const PixelGrid& grid, std::size_t places) {
  constexpr int least = 1, most = 12;
  constexpr std::size_t places_of_bin = 8;
  int bits = least;
  while (bits < most && (places << 2 * (bits + 1)) <= places_of_bin * grid.pixels()) ++bits;
  return bits;
}

/// The places of a work-item that sorts them into bins: on CPUs as many as are a part for each core, and no
/// fewer than are worth an item, and a table of all bins.
std::size_t chunk_for(const Device& device, std::size_t places, std::size_t bins) {
  if (device.tuning().shape != Shape::vector) return 1;
  const std::size_t units = device_info<cl_uint>(device.cl_device()(), CL_DEVICE_MAX_COMPUTE_UNITS);
  constexpr std::size_t least = 4096;
  return std::max({least, places / units + 1, bins / 2});
}

}  // namespace

Report exact_diagram_of_points(Filling& filling, DiagramState& state) {
  const PointPlacement& points = filling.take_points();
  const PixelGrid& grid = points.grid;
  const int width = grid.width(), height = grid.height();
  const cl_int bits = bits_of_bins(grid, points.count);
  const std::size_t rows = along(height, bits), bins = rows * (along(width, bits) + 1);
  PointsWorkspace& memory = state.workspace<PointsWorkspace>();
  const std::size_t room = points.count + LANES_OF_POINTS;
  state.reserve(memory.list, room * sizeof(cl_int2));
  state.reserve(memory.ids, room * word);

  const Device device = without_vectors(state.device);
  const std::size_t group = device.tuning().group_width * device.tuning().group_height;
  const bool in_tiles = device.tuning().shape == Shape::vector;
  const char* const file = in_tiles ? "exact/points/diagram.cl" : "exact/points/pixels.cl";
  const auto kernel = [&](const char* name, std::size_t most) -> Kernel& {
    return state.kernels.get(device, file, name, grid, {filling.metric()})
        .in_groups_of(std::min(group, most));
  };
  const bool has_ids = points.ids() != nullptr;
  const std::size_t chunk = chunk_for(device, points.count, bins), items = points.count / chunk + 1;
  const std::size_t tables = chunk == 1 ? 1 : items, group_of_chunks = chunk == 1 ? group : 1;
  const auto chunk_size = static_cast<cl_uint>(chunk);
  state.reserve(memory.starts, (tables * bins + 1) * word);
  const cl::Event first = fill(state.device, memory.starts, cl_uint{0}, tables * bins + 1);
  kernel("count_points", group_of_chunks)
      .over_items(items, points.places, points.count, chunk_size, bits, width, height, memory.starts);
  kernel("start_bins", 8).over_items(rows, memory.starts, static_cast<cl_uint>(tables), bits, width, height);
  kernel("list_points", group_of_chunks)
      .over_items(items, points.places, has_ids ? points.ids : points.places, cl_int{has_ids}, points.count,
                  chunk_size, bits, width, height, memory.starts, memory.list, memory.ids);
  kernel("drop_repeats", 8).over_items(rows, memory.starts, bits, width, height, memory.list, memory.ids);
  // Work-items that label a tile do much each: small groups spread them over the compute units.
  const std::size_t tiles = along(width, POINTS_TILE_BITS) * along(height, POINTS_TILE_BITS);
  const cl::Event last =
      (in_tiles ? kernel("label_tiles", 8) : kernel("label_pixels", group))
          .over_items(in_tiles ? tiles : grid.pixels(), memory.starts, memory.list, memory.ids, points.order,
                      cl_int{has_ids}, bits, width, height, points.region, state.labels);
  return filling.commit(0, first, last);
}

}  // namespace vorocl
