#include "exact/plane.hpp"

#include <algorithm>

#include "exact/outer.hpp"
#include "runtime/buffer.hpp"
#include "runtime/opencl_info.hpp"
// Last: it defines macros.
#include "exact/sizes.cl"

namespace vorocl {

namespace {

static_assert(fractions_of_pixel == 1 << MOST_FRACTION_BITS);

struct PlaneWorkspace {
  cl::Buffer starts, list, ids;  // the index (kernels/exact/index.cl)
};

std::size_t along(int pixels, int side) {
  return static_cast<std::size_t>(pixels - 1) / static_cast<std::size_t>(side) + 1;
}

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

/// What is labelled: points with their images, or seeds at the centres of pixels inside the window, which
/// others outside are held against afterwards.
struct Places {
  PixelGrid grid;
  cl::Buffer given, ids, order;
  bool have_ids;
  cl_uint count;
  std::size_t near;  // those that are in the index
  cl_int4 region;    // the pixels that get labels
};

Places places_of(Filling& filling) {
  if (filling.seeds().are_points) {
    const PointPlacement& points = filling.take_points();
    const bool have_ids = points.ids() != nullptr;
    return {points.grid,  points.places, have_ids ? points.ids : points.places,
            points.order, have_ids,      points.count,
            points.count, points.region};
  }
  const Placement& placement = filling.placement();
  const cl::Buffer& positions = *placement.positions;
  const PixelGrid& grid = placement.grid;
  return {grid,
          positions,
          positions,
          positions,
          false,
          static_cast<cl_uint>(filling.seeds().size),
          filling.seeds_inside(),
          {{0, 0, grid.width() - 1, grid.height() - 1}}};
}

}  // namespace

Report exact_diagram_of_plane(Filling& filling, DiagramState& state) {
  const auto [grid, given, ids, order, have_ids, count, near, region] = places_of(filling);
  const int width = grid.width(), height = grid.height();
  const cl_int bits = bits_of_bins(grid, near);
  const std::size_t rows = along(height, 1 << bits), bins = rows * (along(width, 1 << bits) + 1);
  PlaneWorkspace& memory = state.workspace<PlaneWorkspace>();
  const std::size_t room = near + LANES_OF_POINTS;
  state.reserve(memory.list, room * sizeof(cl_int2));
  state.reserve(memory.ids, room * word);

  const Device device = without_vectors(state.device);
  const std::size_t group = device.tuning().group_width * device.tuning().group_height;
  const bool in_tiles = device.tuning().shape == Shape::vector;
  const char* const file = in_tiles ? "exact/diagram.cl" : "exact/pixels.cl";
  KernelOptions options{filling.metric()};
  if (filling.seeds().are_points) options.extent = Extent::fractions;
  const auto kernel = [&, &of_grid = grid](const char* name, std::size_t most) -> Kernel& {
    return state.kernels.get(device, file, name, of_grid, options).in_groups_of(std::min(group, most));
  };
  const std::size_t chunk = chunk_for(device, count, bins), items = count / chunk + 1;
  const std::size_t tables = chunk == 1 ? 1 : items, group_of_chunks = chunk == 1 ? group : 1;
  const auto chunk_size = static_cast<cl_uint>(chunk);
  state.reserve(memory.starts, (tables * bins + 1) * word);
  const cl::Event first = fill(state.device, memory.starts, cl_uint{0}, tables * bins + 1);
  kernel("count_places", group_of_chunks)
      .over_items(items, given, count, chunk_size, bits, width, height, memory.starts);
  kernel("start_bins", 8).over_items(rows, memory.starts, static_cast<cl_uint>(tables), bits, width, height);
  kernel("list_places", group_of_chunks)
      .over_items(items, given, ids, cl_int{have_ids}, count, chunk_size, bits, width, height, memory.starts,
                  memory.list, memory.ids);
  kernel("drop_repeats", 1).over_items(rows, memory.starts, bits, width, height, memory.list, memory.ids);
  const auto label = [&, &of_ids = have_ids, &of_order = order, &of_region = region](
                         Kernel& by, std::size_t work, auto... more) {
    return by.over_items(work, memory.starts, memory.list, memory.ids, of_order, cl_int{of_ids}, bits, width,
                         height, of_region, state.labels, more...);
  };
  if (!in_tiles) return filling.commit(0, first, label(kernel("label_pixels", group), grid.pixels()));
  // Work-items that do much each: small groups spread them over the compute units.
  const auto label_squares = [&](cl_int tiles) {
    const int side = tiles * TILE_SIDE;
    return label(kernel("label_tiles", 1), along(width, side) * along(height, side), tiles);
  };
  label_squares(TILES_OF_REGION);
  const cl::Event last = label_squares(1);
  return filling.commit(0, first, filling.seeds().are_points ? last : add_outer_seeds(filling, state, last));
}

}  // namespace vorocl
