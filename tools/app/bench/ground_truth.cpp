#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <nanoflann.hpp>
#include <opencv2/core/utility.hpp>

#include "app/bench/benchmark.hpp"
#include "vorocl/error.hpp"

namespace vorocl::command {

namespace {

constexpr std::int64_t parts_of_pixel = 4096;

/// In double, whose sums of squares are exact for whole pixels, and where they are rounded find a seed that
/// is as near but for 2^-53 of that.
using Place = std::array<double, 3>;

/// In parts of a unit of distances: of a pixel, or of that by which axes are spaced.
std::int64_t in_parts(double pixels, const Axis& along) {
  return along.spacing() * std::llround(pixels * static_cast<double>(parts_of_pixel));
}
std::int64_t centre_of(std::int64_t pixel, const Axis& along) {
  return along.spacing() * (pixel * parts_of_pixel + parts_of_pixel / 2);
}
std::int64_t period_of(const Axis& axis) { return axis.spacing() * axis.pixels() * parts_of_pixel; }

std::array<const Axis*, 3> axes_of(const Grid& grid) { return {&grid.x(), &grid.y(), &grid.z()}; }

/// The seeds' positions in parts of a pixel as nanoflann wants them.
struct Cloud {
  std::vector<Place> points;

  std::size_t kdtree_get_point_count() const { return points.size(); }
  double kdtree_get_pt(std::size_t index, std::size_t axis) const { return points[index][axis]; }
  template <typename Box>
  bool kdtree_get_bbox(Box&) const {
    return false;
  }
};

/// Where a pixel is along an axis, and a period before and behind that.
std::vector<double> images(std::int64_t at, const Axis& axis) {
  const auto here = static_cast<double>(at), period = static_cast<double>(period_of(axis));
  if (!axis.is_periodic()) return {here};
  return {here, here - period, here + period};
}

/// The seeds in a k-d tree, for one metric.
template <template <class, class, class, class> class Distance>
class Tree {
 public:
  explicit Tree(const Cloud& cloud) : cloud_(cloud), tree_(3, cloud) {}

  /// The nearest one to a position, or to an image of it.
  const Place& nearest(const Grid& grid, const std::array<std::int64_t, 3>& to) const {
    const auto [x, y, z] = axes_of(grid);
    std::uint32_t index = 0;
    double least = 0;
    nanoflann::KNNResultSet<double, std::uint32_t> found(1);  // of all images: one ends where none is nearer
    found.init(&index, &least);
    for (const double image_z : images(to[2], *z)) {
      for (const double image_y : images(to[1], *y)) {
        for (const double image_x : images(to[0], *x)) {
          const Place query = {image_x, image_y, image_z};
          tree_.findNeighbors(found, query.data(), {});
        }
      }
    }
    return cloud_.points[index];
  }

 private:
  const Cloud& cloud_;
  nanoflann::KDTreeSingleIndexAdaptor<Distance<double, Cloud, double, std::uint32_t>, Cloud, 3> tree_;
};

}  // namespace

GroundTruth::GroundTruth(const Grid& grid, const std::vector<std::optional<Point>>& seeds, Metric metric)
    : grid_(grid), metric_(metric), seeds_(seeds.size()), least_(grid.pixels()) {
  Cloud cloud;
  for (std::size_t id = 0; id < seeds.size(); ++id) {
    if (!seeds[id]) continue;
    const Position at = {in_parts(seeds[id]->x, grid.x()), in_parts(seeds[id]->y, grid.y()),
                         in_parts(seeds[id]->z, grid.z())};
    seeds_[id] = at;
    cloud.points.push_back(
        {static_cast<double>(at[0]), static_cast<double>(at[1]), static_cast<double>(at[2])});
  }
  // Thousands of seeds at one place would make a leaf of the tree that every query goes through.
  std::sort(cloud.points.begin(), cloud.points.end());
  cloud.points.erase(std::unique(cloud.points.begin(), cloud.points.end()), cloud.points.end());
  if (cloud.points.empty()) throw Error("without seeds no pixel has a true label");
  const auto find_all = [&](const auto& tree) {
    const auto rows = static_cast<int>(grid.height() * grid.depth());
    cv::parallel_for_(cv::Range(0, rows), [&](const cv::Range& range) {
      for (int row = range.start; row < range.end; ++row) {
        visit_row(row, [&](std::size_t i, const Position& at) {
          const Place& nearest = tree.nearest(grid, at);
          least_[i] = distance({static_cast<std::int64_t>(nearest[0]), static_cast<std::int64_t>(nearest[1]),
                                static_cast<std::int64_t>(nearest[2])},
                               at);
        });
      }
    });
  };
  switch (metric) {
    case Metric::euclidean:
      find_all(Tree<nanoflann::L2_Simple_Adaptor>(cloud));
      break;
    case Metric::manhattan:
      find_all(Tree<nanoflann::L1_Adaptor>(cloud));
      break;
    case Metric::great_circle:  // which commands that compare do not take
      break;
  }
}

std::size_t GroundTruth::wrong_pixels(const std::vector<std::uint32_t>& labels) const {
  std::size_t wrong = 0;
  for (std::int64_t row = 0; row < grid_.height() * grid_.depth(); ++row) {
    visit_row(row, [&](std::size_t i, const Position& at) {
      const std::uint32_t label = labels.at(i);
      if (label >= seeds_.size() || !seeds_[label] || distance(*seeds_[label], at) > least_[i]) ++wrong;
    });
  }
  return wrong;
}

template <typename Visit>
void GroundTruth::visit_row(std::int64_t row, const Visit& visit) const {
  auto i = static_cast<std::size_t>(row * grid_.width());
  for (std::int64_t x = 0; x < grid_.width(); ++x, ++i) {
    visit(i, {centre_of(x, grid_.x()), centre_of(row % grid_.height(), grid_.y()),
              centre_of(row / grid_.height(), grid_.z())});
  }
}

std::uint64_t GroundTruth::distance(const Position& a, const Position& b) const {
  std::uint64_t sum = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const Axis& along = *axes_of(grid_)[axis];
    std::int64_t way = std::abs(a[axis] - b[axis]);
    if (along.is_periodic()) way = std::min(way, period_of(along) - way);
    const auto length = static_cast<std::uint64_t>(way);
    sum += metric_ == Metric::euclidean ? length * length : length;
  }
  return sum;
}

}  // namespace vorocl::command
