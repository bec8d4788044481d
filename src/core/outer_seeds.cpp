#include "core/outer_seeds.hpp"

#include <algorithm>

#include "core/box_tree.hpp"
#include "core/window_places.hpp"
#include "core/z_order.hpp"
#include "runtime/buffer.hpp"
// Last: it defines macros.
#include "exact/sizes.cl"

namespace vorocl {

namespace {

static_assert(sizeof(Box) == sizeof(cl_int4), "a node of the tree is a box");

/// A seed outside the pixels, or an image.
struct Entry {
  std::uint64_t order;  // along a Z-curve
  cl_int2 place;
  cl_uint id;
};

/// Calls a function with each place of a seed that is no pixel where seeds lie themselves and may be the
/// nearest one of a pixel of the region.
template <typename Use>
void each_outer_place(const Region& region, const Images& images, const Place& seed, Use use) {
  each_place(region, images, seed, [&](const Place& place, bool is_image) {
    const bool inside = place.x >= region.left && place.x <= region.right && place.y >= region.top &&
                        place.y <= region.bottom;
    if (is_image || !inside) use(place);
  });
}

/// The outer places, in order; of several on one pixel, which are images of seeds on one pixel, that of the
/// lowest id.
std::vector<Entry> ordered_entries(const Region& region, const Images& images,
                                   const std::vector<PlanePosition>& positions) {
  std::vector<Entry> entries;
  if (region.empty()) return entries;
  const auto each_seed = [&](auto use) {
    for (std::size_t id = 0; id < positions.size(); ++id) {
      if (!is_absent(positions[id])) use(Place{positions[id].s[0], positions[id].s[1]}, id);
    }
  };
  Rim rim(region);
  each_seed([&](const Place& seed, std::size_t) {
    rim.add(seed);
    each_outer_place(region, images, seed, [&](const Place& place) { rim.add(place); });
  });
  each_seed([&](const Place& seed, std::size_t id) {
    each_outer_place(region, images, seed, [&](const Place& place) {
      if (rim.rules_out(place)) return;
      const cl_int2 at = {{static_cast<cl_int>(place.x), static_cast<cl_int>(place.y)}};
      entries.push_back({z_order(at.s[0], at.s[1]), at, static_cast<cl_uint>(id)});
    });
  });
  std::sort(entries.begin(), entries.end(), [](const Entry& a, const Entry& b) {
    return a.order != b.order ? a.order < b.order : a.id < b.id;
  });
  const auto same_place = [](const Entry& a, const Entry& b) { return a.order == b.order; };
  entries.erase(std::unique(entries.begin(), entries.end(), same_place), entries.end());
  return entries;
}

void make_tree(OuterSeeds& outer, const Device& device, const std::vector<Entry>& entries) {
  std::vector<cl_int2> places;
  std::vector<cl_uint> ids;
  for (const Entry& entry : entries) {
    places.push_back(entry.place);
    ids.push_back(entry.id);
  }
  BoxTree<OUTER_FAN_BITS> tree;
  tree.make(places.size(), [&](std::size_t i) {
    const auto& [x, y] = places[i].s;
    return Box{x, y, x, y};
  });
  std::vector<Box> nodes;
  for (const std::vector<Box>& level : tree.levels()) {
    outer.top_start = static_cast<cl_uint>(nodes.size());
    nodes.insert(nodes.end(), level.begin(), level.end());
  }
  outer.top = static_cast<cl_int>(tree.levels().size()) - 1;
  outer.count = static_cast<cl_uint>(entries.size());
  outer.places = allocate_with(device, places, "seeds outside the grid");
  outer.ids = allocate_with(device, ids, "seeds outside the grid");
  outer.nodes = allocate_with(device, nodes, "seeds outside the grid");
}

cl_int4 bounds_of(const Region& region) {
  const auto as_int = [](std::int64_t at) { return static_cast<cl_int>(at); };
  return {{as_int(region.left), as_int(region.top), as_int(region.right), as_int(region.bottom)}};
}

/// Whether distances from all pixels to all these positions, and their keys (kernels/exact/outer.cl), take 32
/// bits.
bool is_near(const PixelGrid& grid, const PlanePosition& at) {
  constexpr int most = 0x7fff;
  return at.s[0] >= grid.width() - 1 - most && at.s[0] <= most && at.s[1] >= grid.height() - 1 - most &&
         at.s[1] <= most;
}

}  // namespace

std::shared_ptr<const OuterSeeds> gather_outer_seeds(const Device& device, const Window& window,
                                                     const PixelGrid& pixels,
                                                     std::vector<PlanePosition> positions) {
  OuterSeeds outer;
  bool near = true;
  for (const PlanePosition& position : positions) {
    if (is_absent(position)) continue;
    outer.outside += is_inside(pixels, position) ? 0 : 1;
    near = near && is_near(pixels, position);
  }
  const Axes periodic = window.grid().periodic();
  if (outer.outside == 0 && !has_x(periodic) && !has_y(periodic)) return nullptr;

  const Periods periods(window.grid());
  const Region home = home_region(window), region = labelled_region(window, home);
  outer.home = bounds_of(home);
  outer.region = bounds_of(region);
  outer.periods = {{static_cast<cl_int>(periods.x), static_cast<cl_int>(periods.y), 0, 0}};
  const std::vector<Entry> entries = ordered_entries(region, Images(window.grid()), positions);
  for (const Entry& entry : entries) near = near && is_near(pixels, entry.place);
  outer.extent = near ? Extent::near : Extent::far;
  positions.push_back({{absent_coordinate, 0}});
  outer.seeds = allocate_with(device, positions, "seeds outside the grid");
  if (!entries.empty()) make_tree(outer, device, entries);
  return std::make_shared<const OuterSeeds>(std::move(outer));
}

}  // namespace vorocl
