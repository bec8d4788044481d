#include "core/outer_seeds.hpp"

#include <algorithm>
#include <array>
#include <string>

#include "core/box_tree.hpp"
#include "core/z_order.hpp"
#include "runtime/buffer.hpp"
// Last: it defines macros.
#include "exact/sizes.cl"

namespace vorocl {

namespace {

static_assert(sizeof(Box) == sizeof(cl_int4), "a node of the tree is a box");
constexpr std::int64_t plane_side = std::int64_t{1} << 31;

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

/// The pixels of the grid that lie in the domain along its periodic axes.
Region labelled_region(const Grid& grid, const std::optional<Domain>& domain) {
  Region region = {0, 0, grid.width() - 1, grid.height() - 1};
  if (domain && has_x(domain->periodic)) {
    region.left = std::max(region.left, domain->x);
    region.right = std::min(region.right, domain->x + domain->width - 1);
  }
  if (domain && has_y(domain->periodic)) {
    region.top = std::max(region.top, domain->y);
    region.bottom = std::min(region.bottom, domain->y + domain->height - 1);
  }
  return region;
}

/// Calls a function with each place of a seed that is not a pixel of the region and may be the nearest one of
/// a pixel there: no image farther than half a period is.
template <typename Use>
void each_outer_place(const Region& region, const std::optional<Domain>& domain, const Place& seed, Use use) {
  const std::int64_t period_x = domain && has_x(domain->periodic) ? domain->width : 0;
  const std::int64_t period_y = domain && has_y(domain->periodic) ? domain->height : 0;
  const std::int64_t images_x = period_x > 0 ? 1 : 0, images_y = period_y > 0 ? 1 : 0;
  for (std::int64_t j = -images_y; j <= images_y; ++j) {
    const std::int64_t y = seed.y + j * period_y;
    if (period_y > 0 && (2 * (region.top - y) > period_y || 2 * (y - region.bottom) > period_y)) continue;
    for (std::int64_t i = -images_x; i <= images_x; ++i) {
      const std::int64_t x = seed.x + i * period_x;
      if (period_x > 0 && (2 * (region.left - x) > period_x || 2 * (x - region.right) > period_x)) continue;
      const bool inside = x >= region.left && x <= region.right && y >= region.top && y <= region.bottom;
      if (!inside) use(Place{x, y});
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
std::vector<Entry> ordered_entries(const Region& region, const std::optional<Domain>& domain,
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
    each_outer_place(region, domain, seed, [&](const Place& place) { rim.add(place); });
  });
  each_seed([&](const Place& seed, std::size_t id) {
    each_outer_place(region, domain, seed, [&](const Place& place) {
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

/// Whether distances from all pixels to all these positions, and their keys (kernels/exact/outer.cl), take 32
/// bits.
bool is_near(const Grid& grid, const PlanePosition& at) {
  constexpr int most = 0x7fff;
  return at.s[0] >= grid.width() - 1 - most && at.s[0] <= most && at.s[1] >= grid.height() - 1 - most &&
         at.s[1] <= most;
}

void check_side(std::int64_t begin, std::int64_t length, int pixels, const char* side, const char* axis) {
  if (length < 1 || length > plane_side) {
    throw Error("the domain's " + std::string(side) + " is " + std::to_string(length) +
                "; it must be from 1 to 2^31 pixels");
  }
  if (begin < pixels - plane_side || begin > plane_side - length) {
    throw Error("the domain begins at " + std::string(axis) + " = " + std::to_string(begin) +
                "; it may reach to less than 2^31 pixels from all pixels of the grid");
  }
}

}  // namespace

void check_domain(const Grid& grid, const Domain& domain) {
  if (grid.periodic() != Periodic::none) {
    throw Error(
        "the grid is periodic, and there is a domain too; give the periodic axes to the domain alone");
  }
  check_side(domain.x, domain.width, grid.width(), "width", "x");
  check_side(domain.y, domain.height, grid.height(), "height", "y");
}

std::shared_ptr<const OuterSeeds> gather_outer_seeds(const Device& device, const Grid& grid,
                                                     const std::optional<Domain>& domain,
                                                     std::vector<PlanePosition> positions) {
  OuterSeeds outer;
  if (domain) outer.periodic = domain->periodic;
  bool near = true;
  for (const PlanePosition& position : positions) {
    if (is_absent(position)) continue;
    outer.outside += is_inside(grid, position) ? 0 : 1;
    near = near && is_near(grid, position);
  }
  if (outer.outside == 0 && outer.periodic == Periodic::none) return nullptr;

  const Region region = labelled_region(grid, domain);
  const auto as_int = [](std::int64_t at) { return static_cast<cl_int>(at); };
  outer.region = {{as_int(region.left), as_int(region.top), as_int(region.right), as_int(region.bottom)}};
  if (domain && has_x(domain->periodic)) outer.periods.s[0] = static_cast<cl_uint>(domain->width);
  if (domain && has_y(domain->periodic)) outer.periods.s[1] = static_cast<cl_uint>(domain->height);
  const std::vector<Entry> entries = ordered_entries(region, domain, positions);
  for (const Entry& entry : entries) near = near && is_near(grid, entry.place);
  outer.extent = near ? Extent::near : Extent::far;
  positions.push_back({{absent_coordinate, 0}});
  outer.seeds = allocate_with(device, positions, "seeds outside the grid");
  if (!entries.empty()) make_tree(outer, device, entries);
  return std::make_shared<const OuterSeeds>(std::move(outer));
}

}  // namespace vorocl
