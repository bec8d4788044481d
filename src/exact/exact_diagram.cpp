#include "vorocl/exact_diagram.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/diagram_state.hpp"
#include "globe/globe.hpp"
#include "masks/exact_diagram.hpp"
#include "runtime/buffer.hpp"
#include "runtime/opencl_info.hpp"
// Last: it defines macros.
#include "exact/sizes.cl"

namespace vorocl {

namespace {

static_assert(fractions_of_pixel == 1 << MOST_FRACTION_BITS);

/// The engine's working memory.
struct PlacesWorkspace {
  cl::Buffer counts, ends, sorted;        // while the index is made
  cl::Buffer table;                       // likewise, in the group shape
  cl::Buffer starts, x, y, z, ids, lags;  // the index (kernels/exact/bins.cl)
  cl::Buffer bounds;                      // of its blocks, on CPUs
  cl::Buffer pending, queue;              // patches without labels as yet, and those with crowds
  cl::Buffer open;                        // pixels that look for their places alone
};

/// What is labelled: places with their images, or seeds at the centres of the grid's pixels.
PointPlacement places_of(Filling& filling) {
  if (filling.takes_places()) return filling.take_places();
  const PixelGrid& grid = filling.placement().grid;
  const cl::Buffer& centres = *filling.placement().positions;
  return {grid,    centres,
          centres, centres,
          {},      static_cast<cl_uint>(filling.seeds().size),
          {},      {{grid.width() - 1, grid.height() - 1, grid.depth() - 1}}};
}

std::size_t boxes_along(int pixels, int side) { return static_cast<std::size_t>((pixels - 1) / side) + 1; }

/// Bins as near to squares or cubes as powers of two come, with PLACES_OF_BIN each. Rather high than wide: a
/// walk takes bins of a row at once.
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
      if (shortest == 3 || length(axis) <= length(shortest)) shortest = axis;
    }
    if (shortest == 3) break;
    ++bits.s[shortest];
  }
  return bits;
}

/// The parts of the list of seeds that are sorted at once: each costs a count per bucket.
std::size_t chunks_of(std::size_t seeds) { return seeds < 4096 ? 1 : seeds < 65536 ? 8 : 64; }

/// Labels the diagram by lists of places and by stamps (kernels/exact).
Report exact_diagram_by_places(Filling& filling, DiagramState& state) {
  const PointPlacement given = places_of(filling);
  const PixelGrid& grid = given.grid;
  const cl_uint count = given.count;
  const cl_int has_ids = given.ids() != nullptr;
  const cl::Buffer& given_ids = has_ids != 0 ? given.ids : given.places;
  const Device device = without_vectors(state.device);  // kernels have vectors of their own
  if (given.places_in_pixels) {
    const cl::Event done =
        state.kernels
            .get(device, "exact/far.cl", "label_far", grid,
                 {filling.metric(), Neighbourhood::moore, Extent::far})
            .over_items(grid.pixels(), given.places, given_ids, given.order, count,
                        cl_int4{{grid.width(), grid.height(), 1, 0}}, given.first, given.last, state.labels);
    return filling.commit(0, done, done);
  }
  const cl_int4 size = {{grid.width(), grid.height(), grid.depth(), static_cast<cl_int>(grid.periodic())}};
  cl_int4 tilts;
  std::copy_n(given.lattice.s + 4, 4, tilts.s);
  const cl_int4 bits = bits_of_bins(grid, count);
  const auto bins_along = [&](int axis) { return boxes_along(size.s[axis], 1 << bits.s[axis]); };
  const std::size_t rows = bins_along(1) * bins_along(2);
  const std::size_t entries = rows * (bins_along(0) + 1), room = count + BEHIND_PLACES;
  auto& [counts, ends, sorted, table, starts, x, y, z, ids, lags, bounds, pending, queue, open] =
      state.workspace<PlacesWorkspace>();
  state.reserve(starts, (entries + 1) * word);
  for (cl::Buffer* const list : {&x, &y, &ids}) state.reserve(*list, room * word);
  const bool in_groups = device.tuning().shape == Shape::group;
  KernelOptions options{filling.metric()};
  const bool is_flat = grid.has_voxels() && grid.depth() == 1;
  options.flat = is_flat && !in_groups;
  const bool have_z = grid.has_voxels() && !options.flat;
  if (have_z) state.reserve(z, room * word);
  const std::shared_ptr<const Lags> weighted = filling.seeds().lags();
  if (weighted) state.reserve(lags, (in_groups ? room : rows + room) * word);
  // Kernels do not look at what there is not.
  const cl::Buffer &of_lags = weighted ? lags : ids, &of_seeds = weighted ? weighted->there : ids,
                   &of_z = have_z ? z : x;

  if (filling.takes_places()) options.extent = Extent::fractions;
  options.weighted = weighted != nullptr;
  options.tilted = grid.is_periodic() && state.window.grid().is_tilted();
  options.any_axes = !in_groups;
  const auto kernel = [&](const char* name, std::size_t items_of_group) -> Kernel& {
    return state.kernels
        .get(device, in_groups ? "exact/group/diagram.cl" : "exact/diagram.cl", name, grid, options)
        .in_groups_of(items_of_group);
  };
  if (in_groups) {
    const std::size_t group = device.tuning().group_width * device.tuning().group_height;
    const std::size_t items_of_places = std::max<std::size_t>(count, BEFORE_QUEUE);
    const std::size_t most_of_row = std::min<std::size_t>(group, MOST_ITEMS_OF_ROW);
    constexpr std::size_t warp = 32;  // fewer take no less time, and PoCL compiles anew for each size
    std::size_t items_of_row = std::min(warp, most_of_row);
    while (items_of_row < std::min(bins_along(0), most_of_row)) items_of_row *= 2;
    cl_uint table_bits = 1;
    while (std::size_t{1} << table_bits < 2 * items_of_places) ++table_bits;
    const std::size_t of_table = (std::size_t{1} << table_bits) + items_of_places;
    state.reserve(table, of_table * word);
    const auto patches_along = [&](int axis, int side_of_box) {
      return boxes_along(size.s[axis], have_z ? BOXES_ALONG * side_of_box : PATCH);
    };
    const std::size_t patches =
        patches_along(0, BOX_WIDTH) * patches_along(1, BOX_HEIGHT) * patches_along(2, BOX_DEPTH);
    state.reserve(pending, patches * word);
    state.reserve(queue, (BEFORE_QUEUE + patches) * word);
    const cl::Event begin = fill(state.device, starts, cl_uint{0}, entries + 1);
    fill(state.device, table, ~cl_uint{0}, of_table);
    kernel("find_repeats", group)
        .over_items(items_of_places, given.places, given_ids, has_ids, of_seeds, count, table_bits, table,
                    bits, size, starts);
    kernel("start_bins", items_of_row).over_items(rows * items_of_row, starts, bits, size);
    kernel("list_places", group)
        .over_items(items_of_places, given.places, table_bits, table, count, bits, size, of_seeds, starts, x,
                    y, of_z, ids, of_lags, queue);
    // Lambdas take no structured bindings but by names of their own.
    const auto label = [&, &of_starts = starts, &of_x = x, &of_y = y, &of_ids = ids](
                           const char* name, std::size_t items_of_group, std::size_t groups,
                           const auto&... more) {
      return kernel(name, items_of_group)
          .over_items(groups * items_of_group, of_starts, of_x, of_y, of_z, of_ids, of_lags, given.order,
                      has_ids, bits, size, tilts, given.first, given.last, state.labels, more...);
    };
    const std::size_t items = device.tuning().patch_items;
    if (is_flat) {
      const std::size_t squares =
          boxes_along(grid.width(), CROWD_SIDE) * boxes_along(grid.height(), CROWD_SIDE);
      return filling.commit(0, begin, label("label_squares", items, squares));
    }
    constexpr std::size_t crowd_side = CROWD_SIDE, crowd_pixels = crowd_side * crowd_side;
    constexpr std::size_t crowds_along = PATCH / CROWD_SIDE, crowds_of_patch = crowds_along * crowds_along;
    const bool is_stamped =
        !have_z || (options.extent == Extent::fractions && grid.spacing() == std::array{1, 1, 1});
    if (is_stamped) {
      state.reserve(open, patches * MOST_OPEN * word);
      // In volumes they have more local memory each.
      const std::size_t items_of_stamps = have_z ? std::max(items, std::min(2 * items, group)) : items;
      label("stamp_patches", items_of_stamps, patches, pending, queue, open);
      constexpr std::size_t most_often_open = MOST_OPEN / 16;  // of a patch
      label("label_open", group, (patches * most_often_open - 1) / group + 1, queue, open);
    } else {
      fill(state.device, pending, cl_uint{1}, patches);
    }
    if (have_z) {
      constexpr std::size_t along = BOXES_ALONG, boxes_of_patch = along * along * along;
      return filling.commit(0, begin, label("label_boxes", items, boxes_of_patch * patches, pending));
    }
    label("list_patches", items, patches, pending, queue);
    // A few crowds may have far more places than all others, which wait for them then.
    const std::size_t items_of_crowd = std::max(items, std::min(group, crowd_pixels));
    constexpr std::size_t crowds_of_unit = 16;  // at a time: most often there are none
    const std::size_t crowds = std::min(crowds_of_patch * patches, crowds_of_unit * units_of(device));
    const cl::Event end = label("label_crowds", items_of_crowd, crowds, queue);
    return filling.commit(0, begin, end);
  }
  const std::size_t chunks = chunks_of(count);
  const auto chunk_count = static_cast<cl_uint>(chunks);
  state.reserve(counts, chunks * BUCKETS * word);
  state.reserve(ends, BUCKETS * word);
  state.reserve(sorted, room * sizeof(cl_int4));
  constexpr std::size_t at_once = BLOCKS_AT_ONCE, places_at_once = at_once * PLACES_OF_BLOCK;
  state.reserve(bounds, (room / places_at_once + 1) * at_once * MOST_BOUNDS * sizeof(float));
  cl_uint shift = 0;
  while ((rows - 1) >> shift >= BUCKETS) ++shift;
  // Work-items that do much each: small groups spread them over the compute units.
  const cl::Event begin =
      kernel("count_chunks", 1)
          .over_items(chunks, given.places, count, chunk_count, bits, size, shift, counts);
  kernel("sum_chunks", 1).over_items(1, chunk_count, counts, ends);
  kernel("sort_chunks", 1)
      .over_items(chunks, given.places, given_ids, has_ids, count, chunk_count, bits, size, shift, counts,
                  sorted);
  kernel("sort_buckets", 1)
      .over_items(BUCKETS, sorted, bits, size, shift, ends, of_seeds, starts, x, y, of_z, ids, of_lags,
                  bounds);
  const int side = have_z ? SIDE_OF_VOLUME : SIDE_OF_PLANE;
  const std::size_t items =
      boxes_along(grid.width(), side) * boxes_along(grid.height(), side) * boxes_along(grid.depth(), side);
  const cl::Event end = kernel("label_regions", 1)
                            .over_items(items, starts, x, y, of_z, ids, of_lags, bounds, given.order, has_ids,
                                        bits, size, tilts, given.first, given.last, state.labels);
  return filling.commit(0, begin, end);
}

}  // namespace

Report exact_diagram(const Seeds& seeds, Diagram& diagram, const ExactOptions& options) {
  Filling filling(seeds, diagram, options.metric, "exact");
  DiagramState& state = Internal::state(diagram);
  if (options.metric == Metric::great_circle) return exact_diagram_on_globe(filling, state);
  if (state.grid.has_voxels() && options.metric == Metric::manhattan) {
    throw Error(
        "exact diagrams of volumes and spaced planes are Euclidean; jump flooding takes the Manhattan "
        "metric");
  }
  if (labels_by_passes(filling, state)) return exact_diagram_by_passes(filling, state);
  return exact_diagram_by_places(filling, state);
}

}  // namespace vorocl
