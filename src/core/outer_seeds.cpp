#include "core/outer_seeds.hpp"

#include <algorithm>
#include <array>
#include <optional>

#include "core/box_tree.hpp"
#include "core/z_order.hpp"
#include "runtime/buffer.hpp"
// Last: it defines macros.
#include "exact/sizes.cl"

namespace vorocl {

namespace {

static_assert(sizeof(Box) == sizeof(cl_int4), "a node of the tree is a box");

/// A position of 64 bits, for sums that do not overflow.
struct Place {
  std::int64_t x, y;
};

/// A rectangle of pixels, both ends included.
struct Region {
  std::int64_t left, top, right, bottom;
  bool empty() const { return right < left || bottom < top; }
};

/// A seed outside the pixels, or an image.
struct Entry {
  std::uint64_t order;  // along a Z-curve
  cl_int2 place;
  cl_uint id;
};

/// What repeats: the periods, 0 along an axis that is not periodic.
struct Periods {
  explicit Periods(const Grid& grid)
      : x(grid.x().is_periodic() ? grid.width() : 0), y(grid.y().is_periodic() ? grid.height() : 0) {}

  std::int64_t x, y;
};

/// The pixels of a window that lie in its grid's one period, where seeds lie themselves and not their images.
Region home_region(const Window& window) {
  Region region = {0, 0, window.width() - 1, window.height() - 1};
  const Periods periods(window.grid());
  if (periods.x > 0) {
    region.left = std::max<std::int64_t>(region.left, -window.x());
    region.right = std::min(region.right, periods.x - 1 - window.x());
  }
  if (periods.y > 0) {
    region.top = std::max<std::int64_t>(region.top, -window.y());
    region.bottom = std::min(region.bottom, periods.y - 1 - window.y());
  }
  return region;
}

/// The pixels of a window that get labels: all along an axis of which it shows no more than a period.
Region labelled_region(const Window& window, const Region& home) {
  Region region = home;
  const Periods periods(window.grid());
  if (window.width() <= periods.x) region.left = 0, region.right = window.width() - 1;
  if (window.height() <= periods.y) region.top = 0, region.bottom = window.height() - 1;
  return region;
}

/// Calls a function with each place of a seed that is no pixel where seeds lie themselves and may be the
/// nearest one of a pixel of the region: no image farther than half a period is. A window may begin late in
/// the period, and end nearly a period behind it.
template <typename Use>
void each_outer_place(const Region& region, const Periods& periods, const Place& seed, Use use) {
  const std::int64_t images_x = periods.x > 0 ? 1 : 0, images_y = periods.y > 0 ? 1 : 0;
  for (std::int64_t j = -images_y; j <= 2 * images_y; ++j) {
    const std::int64_t y = seed.y + j * periods.y;
    if (periods.y > 0 && (2 * (region.top - y) > periods.y || 2 * (y - region.bottom) > periods.y)) continue;
    for (std::int64_t i = -images_x; i <= 2 * images_x; ++i) {
      const std::int64_t x = seed.x + i * periods.x;
      if (periods.x > 0 && (2 * (region.left - x) > periods.x || 2 * (x - region.right) > periods.x))
        continue;
      const bool inside = x >= region.left && x <= region.right && y >= region.top && y <= region.bottom;
      if (i != 0 || j != 0 || !inside) use(Place{x, y});
    }
  }
}

/// Rules out places that own no pixel of the region. Whatever is nearer at the region's four corners is
/// nearer at all its pixels (kernels/exact/dominance.cl says why). Along the region's rim stand witnesses:
/// the places nearest to each stretch of it. A place is held against the witness of the stretch that it is
/// nearest to.
class Rim {
 public:
  explicit Rim(const Region& region) : region_(region) {
    while (std::max(region.right - region.left, region.bottom - region.top) >> shift_ >= stretches_of_side)
      ++shift_;
    witnesses_.resize(4 * stretches_of_side);
  }

  void add(const Place& place) {
    std::optional<Witness>& witness = witnesses_[stretch_of(place)];
    const std::int64_t away = distance_to_rim(place);
    if (!witness || away < witness->away) witness = Witness{place, away};
  }

  bool rules_out(const Place& place) const {
    const std::optional<Witness>& witness = witnesses_[stretch_of(place)];
    return witness && is_nearer(witness->place, place);
  }

 private:
  static constexpr std::int64_t stretches_of_side = 1024;  // at most
  struct Witness {
    Place place;
    std::int64_t away;
  };

  /// The distances to the four sides, negative inside the region.
  std::array<std::int64_t, 4> to_sides(const Place& place) const {
    return {region_.top - place.y, place.y - region_.bottom, region_.left - place.x, place.x - region_.right};
  }

  std::int64_t distance_to_rim(const Place& place) const {
    const auto sides = to_sides(place);
    return std::abs(*std::max_element(sides.begin(), sides.end()));
  }

  std::size_t stretch_of(const Place& place) const {
    const auto sides = to_sides(place);
    const auto side = std::max_element(sides.begin(), sides.end()) - sides.begin();
    const bool along_x = side < 2;
    const std::int64_t low = along_x ? region_.left : region_.top;
    const std::int64_t high = along_x ? region_.right : region_.bottom;
    const std::int64_t at = std::min(std::max(along_x ? place.x : place.y, low), high) - low;
    return static_cast<std::size_t>(side * stretches_of_side + (at >> shift_));
  }

  /// Whether a place is nearer than another one at all corners, by both metrics.
  bool is_nearer(const Place& place, const Place& other) const {
    for (const std::int64_t x : {region_.left, region_.right}) {
      for (const std::int64_t y : {region_.top, region_.bottom}) {
        const std::int64_t dx = std::abs(place.x - x), dy = std::abs(place.y - y);
        const std::int64_t other_dx = std::abs(other.x - x), other_dy = std::abs(other.y - y);
        if (dx + dy >= other_dx + other_dy) return false;
        if (dx * dx + dy * dy >= other_dx * other_dx + other_dy * other_dy) return false;
      }
    }
    return true;
  }

  Region region_;
  int shift_ = 0;  // a stretch has 2^shift pixels
  std::vector<std::optional<Witness>> witnesses_;
};

/// The outer places, in order; of several on one pixel, which are images of seeds on one pixel, that of the
/// lowest id.
std::vector<Entry> ordered_entries(const Region& region, const Periods& periods,
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
    each_outer_place(region, periods, seed, [&](const Place& place) { rim.add(place); });
  });
  each_seed([&](const Place& seed, std::size_t id) {
    each_outer_place(region, periods, seed, [&](const Place& place) {
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
  if (outer.outside == 0 && window.grid().periodic() == Periodic::none) return nullptr;

  const Periods periods(window.grid());
  const Region home = home_region(window), region = labelled_region(window, home);
  outer.home = bounds_of(home);
  outer.region = bounds_of(region);
  outer.periods = {{static_cast<cl_uint>(periods.x), static_cast<cl_uint>(periods.y)}};
  const std::vector<Entry> entries = ordered_entries(region, periods, positions);
  for (const Entry& entry : entries) near = near && is_near(pixels, entry.place);
  outer.extent = near ? Extent::near : Extent::far;
  positions.push_back({{absent_coordinate, 0}});
  outer.seeds = allocate_with(device, positions, "seeds outside the grid");
  if (!entries.empty()) make_tree(outer, device, entries);
  return std::make_shared<const OuterSeeds>(std::move(outer));
}

}  // namespace vorocl
