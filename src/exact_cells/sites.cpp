#include "exact_cells/sites.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <sstream>
#include <tuple>

#include "core/window_places.hpp"
#include "exact_cells/hilbert_order.hpp"
#include "vorocl/error.hpp"
// Last: it defines macros.
#include "exact_cells/sizes.cl"

namespace vorocl {

namespace {

// The longest side has at most so many steps (kernels/exact_cells/polygon.cl and volumes/sides.cl say why).
constexpr int step_bits = 30, step_bits_if_tilted = 29, step_bits_of_volume = 40;

// No two places are so far from each other, squared: a cell with such a lag is empty.
constexpr double most_lag = 0x1p62, most_lag_of_volume = 0x1p83;
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

/// What repeats by periods and a tilt: see Sites.
cl_int4 lattice_of(const cl_int4& periods) {
  const cl_int4 flat = {{periods.s[0], 0, 0, periods.s[1]}};
  if (periods.s[2] == 0) return flat;
  auto [u, v] = reduced({periods.s[0], 0}, {periods.s[2], periods.s[1]});
  if (u.x * v.y < u.y * v.x) v = {-v.x, -v.y};
  return {{static_cast<cl_int>(u.x), static_cast<cl_int>(u.y), static_cast<cl_int>(v.x),
           static_cast<cl_int>(v.y)}};
}

/// The steps of one axis.
class Steps {
 public:
  Steps(const Axis& axis, double origin, int exponent)
      : axis_(axis), origin_(origin), exponent_(exponent), per_unit_(std::ldexp(1.0, -exponent)) {}

  std::int64_t from() const { return at(axis_.from()); }
  std::int64_t to() const { return at(axis_.to()); }
  std::int64_t period() const { return axis_.is_periodic() ? to() - from() : 0; }
  std::int64_t length(double extent) const { return std::llrint(extent * per_unit_); }

  /// The step that a coordinate is rounded to.
  std::int64_t operator()(double coordinate) const {
    if (!axis_.is_periodic()) return at(coordinate);
    const double period = axis_.to() - axis_.from();
    double offset = std::fmod(coordinate - axis_.from(), period);
    if (offset < 0) offset += period;
    const std::int64_t step = at(axis_.from() + offset);
    return step >= to() ? from() : step;
  }

  /// How many periods a coordinate lies beyond the step that it is rounded to.
  std::int64_t periods_beyond(double coordinate) const {
    if (!axis_.is_periodic()) return 0;
    const double place =
        axis_.from() + std::ldexp(static_cast<double>((*this)(coordinate)-from()), exponent_);
    return std::llrint((coordinate - place) / (axis_.to() - axis_.from()));
  }

 private:
  std::int64_t at(double coordinate) const { return std::llrint((coordinate - origin_) * per_unit_); }

  Axis axis_;
  double origin_;
  int exponent_;
  double per_unit_;  // a power of two, so that products are exact
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
/// counts, and boxes around each eight sites, around each eight boxes, and so on. `far` is where sites and
/// boxes are that are not there.
template <std::size_t dimensions, typename Number>
void make_tree(SiteTree<Number>& tree, std::vector<OnCurve>&& order,
               const std::vector<std::array<Number, dimensions>>& places, const std::vector<double>& lags,
               Number far) {
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

PlaneSites sites_of_plane(const Grid& grid, const std::vector<std::optional<Point>>& points,
                          const std::vector<double>& weights) {
  const double tilt = grid.tilt();
  const Stretch x = stretch_of(grid.x(), points, &Point::x), y = stretch_of(grid.y(), points, &Point::y);
  const int exponent =
      exponent_of_step(std::max(x.length(), y.length()), tilt == 0 ? step_bits : step_bits_if_tilted);
  const Steps steps_x(grid.x(), x.from, exponent), steps_y(grid.y(), y.from, exponent);
  const auto number = [](std::int64_t steps) { return static_cast<cl_int>(steps); };
  PlaneSites sites;
  sites.rectangle = {
      {number(steps_x.from()), number(steps_y.from()), number(steps_x.to()), number(steps_y.to())}};
  sites.periods = {{number(steps_x.period()), number(steps_y.period()), number(steps_x.length(tilt)), 0}};
  sites.origin = {x.from, y.from};
  sites.step = std::ldexp(1.0, exponent);
  if (steps_x.from() >= steps_x.to() || steps_y.from() >= steps_y.to()) refuse_flat(grid, sites.step);
  sites.lattice = lattice_of(sites.periods);
  std::vector<std::array<cl_int, 2>> places(points.size());
  std::vector<OnCurve> order;
  order.reserve(points.size());
  for (std::size_t id = 0; id < points.size(); ++id) {
    if (!points[id]) continue;
    Point point = *points[id];
    const std::int64_t step_y = steps_y(point.y);
    if (tilt != 0) {
      const double brought_up = point.y - (y.from + static_cast<double>(step_y) * sites.step);
      point.x -= std::nearbyint(brought_up / y.length()) * tilt;
    }
    const std::int64_t step_x = steps_x(point.x);
    places[id] = {number(step_x), number(step_y)};
    order.push_back({hilbert_order(static_cast<std::uint32_t>(step_x), static_cast<std::uint32_t>(step_y)),
                     static_cast<cl_uint>(id)});
  }
  make_tree<2>(sites, std::move(order), places, lags_of(weights, points, sites.step, most_lag), 0);
  return sites;
}

VolumeSites sites_of_volume(const Grid& grid, const std::vector<std::optional<Point>>& points,
                            const std::vector<double>& weights) {
  const Stretch x = stretch_of(grid.x(), points, &Point::x), y = stretch_of(grid.y(), points, &Point::y),
                z = stretch_of(grid.z(), points, &Point::z);
  const int exponent = exponent_of_step(std::max({x.length(), y.length(), z.length()}), step_bits_of_volume);
  const std::array<Steps, 3> steps = {Steps(grid.x(), x.from, exponent), Steps(grid.y(), y.from, exponent),
                                      Steps(grid.z(), z.from, exponent)};
  VolumeSites sites;
  sites.origin = {x.from, y.from, z.from};
  sites.step = std::ldexp(1.0, exponent);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    sites.lower.s[axis] = static_cast<double>(steps[axis].from());
    sites.upper.s[axis] = static_cast<double>(steps[axis].to());
    sites.periods.s[axis] = static_cast<double>(steps[axis].period());
    if (steps[axis].from() >= steps[axis].to()) refuse_flat(grid, sites.step);
  }
  std::vector<std::array<double, 3>> places(points.size());
  std::vector<OnCurve> order;
  order.reserve(points.size());
  for (std::size_t id = 0; id < points.size(); ++id) {
    if (!points[id]) continue;
    const std::array<double, 3> point = {points[id]->x, points[id]->y, points[id]->z};
    std::array<std::uint32_t, 3> place;
    PeriodCounts beyond;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const std::int64_t step = steps[axis](point[axis]);
      places[id][axis] = static_cast<double>(step);
      place[axis] = static_cast<std::uint32_t>(step >> (step_bits_of_volume - hilbert_bits));
      beyond[axis] = steps[axis].periods_beyond(point[axis]);
    }
    order.push_back({hilbert_order(place), static_cast<cl_uint>(id)});
    if (beyond == PeriodCounts{}) continue;
    sites.beyond.resize(points.size());
    sites.beyond[id] = beyond;
  }
  constexpr double far = 1e17;  // no box is so long
  make_tree<3>(sites, std::move(order), places, lags_of(weights, points, sites.step, most_lag_of_volume),
               far);
  return sites;
}

}  // namespace vorocl
