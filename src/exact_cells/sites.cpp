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

// The longer side has at most so many steps (kernels/exact_cells/polygon.cl says why).
constexpr int step_bits = 30, step_bits_if_tilted = 29;
constexpr std::size_t fan = FAN;
constexpr std::size_t sides = 4;  // of a box

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

/// A step is the least power of two of which the longer side has at most 2^bits, and that has an inverse.
int exponent_of_step(double longer_side, int bits) {
  int exponent = 0;
  const bool is_power = std::frexp(longer_side, &exponent) == 0.5;
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
      : axis_(axis), origin_(origin), per_unit_(std::ldexp(1.0, -exponent)) {}

  cl_int from() const { return at(axis_.from()); }
  cl_int to() const { return at(axis_.to()); }
  cl_int period() const { return axis_.is_periodic() ? to() - from() : 0; }
  cl_int length(double extent) const { return static_cast<cl_int>(std::nearbyint(extent * per_unit_)); }

  /// The step that a coordinate is rounded to.
  cl_int operator()(double coordinate) const {
    if (!axis_.is_periodic()) return at(coordinate);
    const double period = axis_.to() - axis_.from();
    double offset = std::fmod(coordinate - axis_.from(), period);
    if (offset < 0) offset += period;
    const cl_int step = at(axis_.from() + offset);
    return step >= to() ? from() : step;
  }

 private:
  cl_int at(double coordinate) const {
    return static_cast<cl_int>(std::nearbyint((coordinate - origin_) * per_unit_));
  }

  Axis axis_;
  double origin_;
  double per_unit_;  // a power of two, so that products are exact
};

/// A point's place in Hilbert's order.
struct OnCurve {
  std::uint64_t order;
  cl_uint id;
};

/// Sorts by place; points at one place come in the order of their ids. By the upper bits first, in which few
/// points are the same.
void sort(std::vector<OnCurve>& places) {
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
    if (end - begin > 1) {
      std::sort(begin, end, [](const OnCurve& p, const OnCurve& q) {
        return std::tie(p.order, p.id) < std::tie(q.order, q.id);
      });
    }
    begin = end;
  }
}

struct Box {
  cl_int left = std::numeric_limits<cl_int>::max(), right = std::numeric_limits<cl_int>::min();
  cl_int lower = left, upper = right;
};

/// Makes boxes around each eight sites, around each eight boxes, and so on.
void make_tree(Sites& sites) {
  std::vector<Box> boxes((sites.ids.size() + fan - 1) / fan);
  for (std::size_t i = 0; i < sites.ids.size(); ++i) {
    Box& box = boxes[i / fan];
    const cl_int* const leaf = &sites.places[i / fan * 2 * fan];
    const cl_int x = leaf[i % fan], y = leaf[fan + i % fan];
    box = {std::min(box.left, x), std::max(box.right, x), std::min(box.lower, y), std::max(box.upper, y)};
  }
  sites.levels = {0};
  for (std::size_t groups = 0, of_level = 2; of_level > 1; groups += of_level) {
    sites.levels.push_back(static_cast<cl_uint>(groups));
    of_level = (boxes.size() + fan - 1) / fan;
    sites.boxes.resize((groups + of_level) * sides * fan);
    std::vector<Box> above(of_level);
    for (std::size_t i = 0; i < boxes.size(); ++i) {
      const Box& box = boxes[i];
      cl_int* const place = &sites.boxes[(groups + i / fan) * sides * fan + i % fan];
      place[0] = box.left;
      place[fan] = box.right;
      place[2 * fan] = box.lower;
      place[3 * fan] = box.upper;
      Box& whole = above[i / fan];
      whole = {std::min(whole.left, box.left), std::max(whole.right, box.right),
               std::min(whole.lower, box.lower), std::max(whole.upper, box.upper)};
    }
    boxes.swap(above);
  }
}

}  // namespace

Sites sites_of(const Grid& grid, const std::vector<std::optional<Point>>& points) {
  const double tilt = grid.tilt();
  const Stretch x = stretch_of(grid.x(), points, &Point::x), y = stretch_of(grid.y(), points, &Point::y);
  const int exponent =
      exponent_of_step(std::max(x.length(), y.length()), tilt == 0 ? step_bits : step_bits_if_tilted);
  const Steps steps_x(grid.x(), x.from, exponent), steps_y(grid.y(), y.from, exponent);
  Sites sites;
  sites.rectangle = {{steps_x.from(), steps_y.from(), steps_x.to(), steps_y.to()}};
  sites.periods = {{steps_x.period(), steps_y.period(), steps_x.length(tilt), 0}};
  sites.origin = {x.from, y.from};
  sites.step = std::ldexp(1.0, exponent);
  if (steps_x.from() >= steps_x.to() || steps_y.from() >= steps_y.to()) {
    std::ostringstream text;
    text << "exact cells need a rectangle with an extent; this one is " << grid.x().to() - grid.x().from()
         << " x " << grid.y().to() - grid.y().from() << ", and positions are rounded to " << sites.step;
    throw Error(text.str());
  }
  sites.lattice = lattice_of(sites.periods);
  std::vector<cl_int2> positions(points.size());
  std::vector<OnCurve> places;
  places.reserve(points.size());
  for (std::size_t id = 0; id < points.size(); ++id) {
    if (!points[id]) continue;
    Point point = *points[id];
    const cl_int step_y = steps_y(point.y);
    if (tilt != 0) {
      const double brought_up = point.y - (y.from + step_y * sites.step);
      point.x -= std::nearbyint(brought_up / y.length()) * tilt;
    }
    const cl_int step_x = steps_x(point.x);
    positions[id] = {{step_x, step_y}};
    places.push_back({hilbert_order(static_cast<std::uint32_t>(step_x), static_cast<std::uint32_t>(step_y)),
                      static_cast<cl_uint>(id)});
  }
  sort(places);
  const auto is_same = [](const OnCurve& a, const OnCurve& b) { return a.order == b.order; };
  places.erase(std::unique(places.begin(), places.end(), is_same), places.end());
  sites.ids.reserve(places.size());
  sites.places.resize((places.size() + fan - 1) / fan * 2 * fan);
  for (std::size_t i = 0; i < places.size(); ++i) {
    sites.ids.push_back(places[i].id);
    cl_int* const leaf = &sites.places[i / fan * 2 * fan];
    const cl_int2& position = positions[places[i].id];
    leaf[i % fan] = position.s[0];
    leaf[fan + i % fan] = position.s[1];
  }
  make_tree(sites);
  return sites;
}

}  // namespace vorocl
