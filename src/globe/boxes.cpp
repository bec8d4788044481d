// Boxes that lie along the directions in them: see kernels/globe/globe.cl.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

#include "globe/globe.hpp"
// Last: it defines macros.
#include "exact_cells/sizes.cl"
#include "globe/sizes.cl"

namespace vorocl {

namespace {

constexpr std::size_t fan = FAN, numbers = BOX_NUMBERS;

using Way = std::array<double, 3>;

double dot(const Way& p, const Way& q) { return p[0] * q[0] + p[1] * q[1] + p[2] * q[2]; }

Way difference(const Way& p, const Way& q) { return {p[0] - q[0], p[1] - q[1], p[2] - q[2]}; }

Way cross(const Way& p, const Way& q) {
  return {p[1] * q[2] - p[2] * q[1], p[2] * q[0] - p[0] * q[2], p[0] * q[1] - p[1] * q[0]};
}

Way times(const Way& way, double factor) { return {way[0] * factor, way[1] * factor, way[2] * factor}; }

/// Of length 1; `other` instead of one of a length below 1.
Way unit_of(const Way& way, const Way& other) {
  const double length = std::sqrt(dot(way, way));
  return length >= 1 ? times(way, 1 / length) : other;
}

/// Upright to a direction.
Way upright(const Way& way, const Way& direction) {
  return difference(way, times(direction, dot(way, direction)));
}

class Boxes {
 public:
  explicit Boxes(const DirectionSites& tree)
      : tree_(tree), boxes_(tree.boxes.size() / numbers_of_sides * numbers) {}

  std::vector<cl_int> lay() {
    for (std::size_t level = 1, sites = fan; level < tree_.levels.size(); ++level, sites *= fan) {
      for (std::size_t first = 0, box = 0; first < tree_.count(); first += sites, ++box) {
        const std::size_t group = tree_.levels[level] + box / fan;
        lay_one(&boxes_[group * numbers * fan + box % fan], first,
                std::min<std::size_t>(first + sites, tree_.count()));
      }
    }
    return std::move(boxes_);
  }

 private:
  static constexpr std::size_t numbers_of_sides = 6;

  Way place(std::size_t site) const {
    const cl_int* const at = &tree_.places[site / fan * 3 * fan + site % fan];
    return {static_cast<double>(at[0]), static_cast<double>(at[fan]), static_cast<double>(at[2 * fan])};
  }

  void lay_one(cl_int* box, std::size_t first, std::size_t behind) {
    Way middle = {};
    for (std::size_t site = first; site < behind; ++site) {
      const Way at = place(site);
      for (std::size_t axis = 0; axis < 3; ++axis) middle[axis] += at[axis];
    }
    middle = times(unit_of(middle, {0, 0, 1}), direction_length);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      box[axis * fan] = static_cast<cl_int>(std::lrint(middle[axis]));
      middle[axis] = box[axis * fan];
    }
    const Way up = unit_of(middle, {});
    const Way any =
        upright(std::abs(up[2]) < 0.7 ? Way{0, 0, direction_length} : Way{direction_length, 0, 0}, up);
    const Way along = unit_of(upright(difference(place(behind - 1), place(first)), up), unit_of(any, {}));
    const Way across = cross(up, along);
    double length = 0, width = 0, depth = 0;
    for (std::size_t site = first; site < behind; ++site) {
      const Way way = difference(place(site), middle);
      length = std::max(length, std::abs(dot(way, along)));
      width = std::max(width, std::abs(dot(way, across)));
      depth = std::max(depth, -dot(way, up));
    }
    for (std::size_t axis = 0; axis < 3; ++axis) put(box, 3 + axis, along[axis]);
    constexpr double wider = 1.000001;  // than what floats round to
    put(box, 6, length * wider);
    put(box, 7, width * wider);
    put(box, 8, depth * wider);
  }

  static void put(cl_int* box, std::size_t number, double value) {
    const auto rounded = static_cast<cl_float>(value);
    std::memcpy(&box[number * fan], &rounded, sizeof(rounded));
  }

  const DirectionSites& tree_;
  std::vector<cl_int> boxes_;
};

}  // namespace

std::vector<cl_int> boxes_along(const DirectionSites& tree) { return Boxes(tree).lay(); }

}  // namespace vorocl
