#include "exact_cells/sites.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <sstream>
#include <tuple>

#include "exact_cells/hilbert_order.hpp"
#include "vorocl/error.hpp"
// Last: it defines macros.
#include "exact_cells/sizes.cl"

namespace vorocl {

namespace {

/// What planes and volumes have of their own. The longest side has at most 2^bits steps, half as many in a
/// tilted box (kernels/exact_cells/polygon.cl and volumes/sides.cl say why). No two places are so far from
/// each other, squared, as the greatest lag: a cell with it is empty.
template <std::size_t dimensions>
struct SiteKind;
template <>
struct SiteKind<2> {
  static constexpr int bits = 30, bits_of_curve = 30;
  static constexpr double most_lag = 0x1p62;
  static std::uint64_t order(const std::array<std::uint32_t, 2>& at) { return hilbert_order(at[0], at[1]); }
};
template <>
struct SiteKind<3> {
  static constexpr int bits = 40, bits_of_curve = hilbert_bits;
  static constexpr double most_lag = 0x1p83;
  static std::uint64_t order(const std::array<std::uint32_t, 3>& at) { return hilbert_order(at); }
};

constexpr std::size_t fan = FAN;

/// A stretch of an axis in the units of the data.
struct Stretch {
  double from, to;
  double length() const { return to - from; }
};

/// An axis, with the points beyond its ends that count.
Stretch stretch_of(const Axis& axis, const std::vector<std::optional<Point>>& points, double Point::*along) {
  Stretch stretch = {axis.from(), axis.to()};
  if (axis.is_periodic()) return stretch;
  for (const std::optional<Point>& point : points) {
    if (!point) continue;
    stretch.from = std::min(stretch.from, (*point).*along);
    stretch.to = std::max(stretch.to, (*point).*along);
  }
  return stretch;
}

/// A step is the least power of two of which the longest side has at most 2^bits, and that has an inverse.
int exponent_of_step(double longest_side, int bits) {
  int exponent = 0;
  const bool is_power = std::frexp(longest_side, &exponent) == 0.5;
  return std::max(exponent - (is_power ? 1 : 0) - bits, std::numeric_limits<double>::min_exponent);
}

// --- what repeats ---

using LatticeWay = PeriodCounts;          // in steps
using Edges = std::array<LatticeWay, 3>;  // of the box, by axis: along it and the axes before it, or 0 if it
                                          // is not periodic

double dot(const LatticeWay& p, const LatticeWay& q) {
  double sum = 0;
  for (std::size_t axis = 0; axis < 3; ++axis)
    sum += static_cast<double>(p[axis]) * static_cast<double>(q[axis]);
  return sum;
}

LatticeWay sum_of(const Edges& edges, const LatticeWay& counts) {
  LatticeWay sum = {};
  for (std::size_t edge = 0; edge < 3; ++edge) {
    for (std::size_t axis = 0; axis < 3; ++axis) sum[axis] += counts[edge] * edges[edge][axis];
  }
  return sum;
}

/// Between which vectors of a lattice, and those opposite, the places lie that are nearest to one of its
/// points: sums of an obtuse superbase, by Selling's reduction (Conway and Sloane, "Low-dimensional lattices
/// VI", 1992).
std::vector<LatticeWay> vectors_around(const Edges& edges) {
  constexpr double rounding = 1e-12;
  std::array<LatticeWay, 4> base = {edges[0], edges[1], edges[2], sum_of(edges, {-1, -1, -1})};
  for (bool is_changed = true; is_changed;) {
    is_changed = false;
    for (std::size_t i = 1; i < 4; ++i) {
      for (std::size_t j = 0; j < i; ++j) {
        const LatticeWay way = base[i];
        if (dot(way, base[j]) <= rounding * dot(way, way)) continue;
        for (std::size_t k = 0; k < 4; ++k) {
          for (std::size_t axis = 0; axis < 3 && k != j; ++axis)
            base[k][axis] = k == i ? -way[axis] : base[k][axis] + way[axis];
        }
        is_changed = true;
      }
    }
  }
  std::vector<LatticeWay> vectors;
  for (int of = 1; of < 8; ++of)
    vectors.push_back(sum_of({base[0], base[1], base[2]}, {of & 1, of >> 1 & 1, of >> 2}));
  return vectors;
}

/// How far, along each axis, a site that cuts a cell may lie from the cell's own: twice as far as the places
/// that are nearer to it than to its own images. No place is farther from all images than half of the box's
/// diagonal.
LatticeWay most_ways(const Edges& edges) {
  LatticeWay most = {};
  double square = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) square += std::pow(static_cast<double>(edges[axis][axis]), 2);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const std::int64_t side = edges[axis][axis];
    const bool is_straight =
        dot(edges[axis], edges[axis]) == static_cast<double>(side) * static_cast<double>(side);
    most[axis] = is_straight ? side : std::llround(std::ceil(std::sqrt(square)));
  }
  return most;
}

/// The images of all sites that may cut cells, itself first and then the nearest. A site that is d away cuts
/// none if a vector r of the lattice has |d.r| > |r|^2: its image that is r nearer is nearer to all of the
/// cell.
std::vector<PeriodCounts> images_of(const Edges& edges) {
  constexpr std::size_t most_images = 0xffff;
  constexpr double most_to_try = 0x1p22, rounding = 1e-14;
  const std::vector<LatticeWay> around = vectors_around(edges);
  const LatticeWay most = most_ways(edges);
  double to_try = 1;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (most[axis] == 0) continue;
    const std::int64_t periods = most[axis] / edges[axis][axis];
    to_try *= 2 * static_cast<double>(periods) + 3;
  }
  std::vector<std::pair<double, PeriodCounts>> images;
  PeriodCounts counts = {};
  const auto add = [&] {
    const LatticeWay way = sum_of(edges, counts);
    for (const LatticeWay& vector : around) {
      double nearest = std::abs(dot(way, vector));  // of sites in the box, of ways times the vector
      for (std::size_t axis = 0; axis < 3; ++axis)
        nearest -= static_cast<double>(std::max(edges[axis][axis] - 1, std::int64_t{0})) *
                   static_cast<double>(std::abs(vector[axis]));
      if (nearest > dot(vector, vector) * (1 + rounding)) return;
    }
    images.emplace_back(dot(way, way), counts);
  };
  const auto each = [&](std::size_t axis, auto next) {
    const std::int64_t side = edges[axis][axis];
    if (side == 0) return next();
    const double from = static_cast<double>(sum_of(edges, counts)[axis]),
                 range = static_cast<double>(most[axis] + side);
    const auto per_side = 1 / static_cast<double>(side);
    const std::int64_t last = std::llround(std::floor((range - from) * per_side));
    for (counts[axis] = std::llround(std::ceil((-range - from) * per_side)); counts[axis] <= last;
         ++counts[axis])
      next();
    counts[axis] = 0;
  };
  if (to_try <= most_to_try) each(2, [&] { each(1, [&] { each(0, add); }); });
  if (images.empty() || images.size() > most_images) {
    throw Error("the box is tilted and too flat for that: exact cells know at most " +
                std::to_string(most_images) + " of its images, and need more");
  }
  std::sort(images.begin(), images.end());
  std::vector<PeriodCounts> sorted;
  sorted.reserve(images.size());
  for (const auto& image : images) sorted.push_back(image.second);
  return sorted;
}

/// The steps of one axis.
class Steps {
 public:
  Steps(const Axis& axis, double origin, int exponent)
      : axis_(axis),
        origin_(origin),
        per_unit_(std::ldexp(1.0, -exponent)),
        from_(at(axis.from())),
        to_(at(axis.to())) {}

  std::int64_t from() const { return from_; }
  std::int64_t to() const { return to_; }
  std::int64_t length(double extent) const { return std::llrint(extent * per_unit_); }

  /// The step that a coordinate is rounded to, and how many periods it lies beyond that.
  std::pair<std::int64_t, std::int64_t> operator()(double coordinate) const {
    if (!axis_.is_periodic()) return {at(coordinate), 0};
    std::int64_t periods = 0;
    if (!(coordinate >= axis_.from() && coordinate < axis_.to())) {
      const double period = axis_.to() - axis_.from(), way = coordinate - axis_.from();
      double offset = std::fmod(way, period);
      if (offset < 0) offset += period;
      periods = std::llrint((way - offset) / period);
      coordinate = axis_.from() + offset;
    }
    const std::int64_t step = at(coordinate);
    return step < to_ ? std::pair(step, periods) : std::pair(from_, periods + 1);
  }

 private:
  std::int64_t at(double coordinate) const { return std::llrint((coordinate - origin_) * per_unit_); }

  Axis axis_;
  double origin_;
  double per_unit_;  // a power of two, so that products are exact
  std::int64_t from_, to_;
};

/// A point's place in Hilbert's order.
struct OnCurve {
  std::uint64_t order;
  cl_uint id;
};

/// Sorts by place, by the upper bits first, in which few points are the same, and then by `is_before`.
template <typename IsBefore>
void sort(std::vector<OnCurve>& places, IsBefore is_before) {
  constexpr int digit_bits = 11, first_bit = 31, all_bits = 64;
  constexpr std::size_t digits = std::size_t{1} << digit_bits;
  std::vector<OnCurve> sorted(places.size());
  for (int shift = first_bit; shift < all_bits; shift += digit_bits) {
    const auto digit = [shift](const OnCurve& place) { return (place.order >> shift) & (digits - 1); };
    std::array<std::size_t, digits> next = {};
    for (const OnCurve& place : places) ++next[digit(place)];
    std::size_t sum = 0;
    for (std::size_t& entry : next) {
      const std::size_t here = entry;
      entry = sum;
      sum += here;
    }
    for (const OnCurve& place : places) sorted[next[digit(place)]++] = place;
    places.swap(sorted);
  }
  for (auto begin = places.begin(); begin != places.end();) {
    const std::uint64_t upper = begin->order >> first_bit;
    auto end = begin + 1;
    while (end != places.end() && end->order >> first_bit == upper) ++end;
    if (end - begin > 1) std::sort(begin, end, is_before);
    begin = end;
  }
}

/// The lags of points that are there, by id, in whole steps squared; none if all weights are the same.
std::vector<double> lags_of(const std::vector<double>& weights,
                            const std::vector<std::optional<Point>>& points, double step, double most_lag) {
  double greatest = -std::numeric_limits<double>::infinity(), least = -greatest;
  for (std::size_t id = 0; id < weights.size(); ++id) {
    if (!points[id]) continue;
    greatest = std::max(greatest, weights[id]);
    least = std::min(least, weights[id]);
  }
  std::vector<double> lags;
  if (least >= greatest) return lags;
  lags.reserve(weights.size());
  for (const double weight : weights)
    lags.push_back(std::min(std::nearbyint((greatest - weight) / step / step), most_lag));
  return lags;
}

/// Makes sites of places, by id, of which the one with the least lag, or else the first one, at each place
/// counts, and boxes around each eight sites, around each eight boxes, and so on.
template <typename SitesOfKind>
void make_tree(SitesOfKind& tree, std::vector<OnCurve>&& order,
               const std::vector<std::array<typename SitesOfKind::Number, SitesOfKind::dimensions>>& places,
               const std::vector<double>& lags) {
  using Number = typename SitesOfKind::Number;
  constexpr std::size_t dimensions = SitesOfKind::dimensions;
  // Where sites and boxes are that are not there. Most kernels ask whether they are; those that list the
  // sites near a leaf in a volume find them too far.
  constexpr Number far = std::is_integral_v<Number> ? 0 : 1e17;
  const auto lag_of = [&lags](cl_uint id) { return lags.empty() ? 0.0 : lags[id]; };
  sort(order, [&](const OnCurve& p, const OnCurve& q) {
    if (p.order != q.order) return p.order < q.order;
    if (places[p.id] != places[q.id]) return places[p.id] < places[q.id];
    return lag_of(p.id) != lag_of(q.id) ? lag_of(p.id) < lag_of(q.id) : p.id < q.id;
  });
  const auto is_same = [&places](const OnCurve& p, const OnCurve& q) { return places[p.id] == places[q.id]; };
  order.erase(std::unique(order.begin(), order.end(), is_same), order.end());
  const auto groups_of = [](std::size_t entries) { return (entries + fan - 1) / fan; };
  struct Box {
    std::array<Number, dimensions> lower, upper;
    double lag;
  };
  Box nothing;
  nothing.lag = std::numeric_limits<double>::max();
  nothing.lower.fill(std::numeric_limits<Number>::max());
  nothing.upper.fill(std::numeric_limits<Number>::lowest());
  const auto add = [](Box& to, const Box& box) {
    for (std::size_t axis = 0; axis < dimensions; ++axis) {
      to.lower[axis] = std::min(to.lower[axis], box.lower[axis]);
      to.upper[axis] = std::max(to.upper[axis], box.upper[axis]);
    }
    to.lag = std::min(to.lag, box.lag);
  };
  std::vector<Box> boxes(groups_of(order.size()), nothing);
  tree.ids.reserve(order.size());
  tree.places.resize(boxes.size() * dimensions * fan, far);
  if (!lags.empty()) tree.lags.resize(boxes.size() * fan);
  for (std::size_t i = 0; i < order.size(); ++i) {
    const std::array<Number, dimensions>& place = places[order[i].id];
    tree.ids.push_back(order[i].id);
    for (std::size_t axis = 0; axis < dimensions; ++axis)
      tree.places[(i / fan * dimensions + axis) * fan + i % fan] = place[axis];
    if (!lags.empty()) tree.lags[i] = lags[order[i].id];
    add(boxes[i / fan], {place, place, lag_of(order[i].id)});
  }
  tree.levels = {0};
  for (std::size_t groups = 0, of_level = 2; of_level > 1; groups += of_level) {
    tree.levels.push_back(static_cast<cl_uint>(groups));
    of_level = groups_of(boxes.size());
    tree.boxes.resize((groups + of_level) * 2 * dimensions * fan, far);
    if (!lags.empty()) tree.box_lags.resize((groups + of_level) * fan);
    std::vector<Box> above(of_level, nothing);
    for (std::size_t i = 0; i < boxes.size(); ++i) {
      for (std::size_t axis = 0; axis < dimensions; ++axis) {
        Number* const at = &tree.boxes[((groups + i / fan) * dimensions + axis) * 2 * fan + i % fan];
        at[0] = boxes[i].lower[axis];
        at[fan] = boxes[i].upper[axis];
      }
      if (!lags.empty()) tree.box_lags[groups * fan + i] = boxes[i].lag;
      add(above[i / fan], boxes[i]);
    }
    boxes.swap(above);
  }
}

/// For a box with less than a step along an axis.
[[noreturn]] void refuse_flat(const Grid& grid, double step) {
  std::ostringstream text;
  const bool is_volume = grid.is_volume();
  text << "exact cells need a " << (is_volume ? "box" : "rectangle") << " with an extent; this one is "
       << grid.x().to() - grid.x().from() << " x " << grid.y().to() - grid.y().from();
  if (is_volume) text << " x " << grid.z().to() - grid.z().from();
  text << ", and positions are rounded to " << step;
  throw Error(text.str());
}

}  // namespace

template <typename SitesOfKind>
SitesOfKind sites_of(const Grid& grid, const std::vector<std::optional<Point>>& points,
                     const std::vector<double>& weights) {
  constexpr std::size_t dimensions = SitesOfKind::dimensions;
  using KindOfSites = SiteKind<dimensions>;
  using Number = typename SitesOfKind::Number;
  const Axis* const axes[] = {&grid.x(), &grid.y(), &grid.z()};
  double Point::*const along[] = {&Point::x, &Point::y, &Point::z};
  const double tilts[3][2] = {{0, 0}, {grid.tilt(), 0}, {grid.tilt_xz(), grid.tilt_yz()}};
  SitesOfKind sites;
  double longest = 0;
  for (std::size_t axis = 0; axis < dimensions; ++axis) {
    const Stretch stretch = stretch_of(*axes[axis], points, along[axis]);
    sites.origin.*along[axis] = stretch.from;
    longest = std::max(longest, stretch.length());
  }
  const int bits = KindOfSites::bits - (grid.is_tilted() ? 1 : 0), exponent = exponent_of_step(longest, bits);
  sites.step = std::ldexp(1.0, exponent);
  std::vector<Steps> steps;
  Edges edges = {};
  for (std::size_t axis = 0; axis < dimensions; ++axis) {
    steps.emplace_back(*axes[axis], sites.origin.*along[axis], exponent);
    const Steps& of_axis = steps.back();
    sites.lower.s[axis] = static_cast<Number>(of_axis.from());
    sites.upper.s[axis] = static_cast<Number>(of_axis.to());
    if (of_axis.from() >= of_axis.to()) refuse_flat(grid, sites.step);
    if (axes[axis]->is_periodic()) edges[axis][axis] = of_axis.to() - of_axis.from();
    for (std::size_t other = 0; other < axis; ++other)
      edges[axis][other] = of_axis.length(tilts[axis][other]);
  }
  const LatticeWay most = most_ways(edges);
  for (std::size_t axis = 0; axis < dimensions; ++axis)
    if (most[axis] > 0) sites.reach.s[axis] = static_cast<Number>(most[axis] + 1);
  sites.images = images_of(edges);
  for (const PeriodCounts& image : sites.images) {
    const LatticeWay way = sum_of(edges, image);
    for (std::size_t axis = 0; axis < dimensions; ++axis)
      sites.shifts.push_back(static_cast<Number>(way[axis]));
  }
  std::vector<std::array<Number, dimensions>> places(points.size());
  std::vector<OnCurve> order;
  order.reserve(points.size());
  for (std::size_t id = 0; id < points.size(); ++id) {
    if (!points[id]) continue;
    Point point = *points[id];
    std::array<std::uint32_t, dimensions> place;
    PeriodCounts beyond = {};
    for (std::size_t axis = dimensions; axis-- > 0;) {
      const auto [step, periods] = steps[axis](point.*along[axis]);
      places[id][axis] = static_cast<Number>(step);
      place[axis] = static_cast<std::uint32_t>(step >> (KindOfSites::bits - KindOfSites::bits_of_curve));
      beyond[axis] = periods;
      for (std::size_t other = 0; other < axis && periods != 0; ++other)
        point.*along[other] -= static_cast<double>(periods) * tilts[axis][other];
    }
    order.push_back({KindOfSites::order(place), static_cast<cl_uint>(id)});
    if (beyond == PeriodCounts{}) continue;
    sites.beyond.resize(points.size());
    sites.beyond[id] = beyond;
  }
  make_tree(sites, std::move(order), places, lags_of(weights, points, sites.step, KindOfSites::most_lag));
  return sites;
}

template PlaneSites sites_of(const Grid&, const std::vector<std::optional<Point>>&,
                             const std::vector<double>&);
template VolumeSites sites_of(const Grid&, const std::vector<std::optional<Point>>&,
                              const std::vector<double>&);

DirectionSites sites_of_directions(const std::vector<cl_int4>& directions) {
  std::vector<std::array<cl_int, 3>> places(directions.size());
  std::vector<OnCurve> order;
  order.reserve(directions.size());
  for (std::size_t id = 0; id < directions.size(); ++id) {
    std::array<std::uint32_t, 3> place;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      places[id][axis] = directions[id].s[axis];
      place[axis] = (static_cast<std::uint32_t>(directions[id].s[axis]) + 0x80000000u) >> (32 - hilbert_bits);
    }
    if (places[id] != std::array<cl_int, 3>{})
      order.push_back({hilbert_order(place), static_cast<cl_uint>(id)});
  }
  DirectionSites tree;
  make_tree(tree, std::move(order), places, {});
  return tree;
}

}  // namespace vorocl
