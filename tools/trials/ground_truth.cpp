#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <nanoflann.hpp>
#include <opencv2/core/utility.hpp>
#include <tuple>

#include "trials/benchmark.hpp"
#include "vorocl/error.hpp"

namespace vorocl::command {

namespace {

constexpr std::int64_t parts_of_pixel = 4096;

std::int64_t in_parts(double pixels) { return std::llround(pixels * static_cast<double>(parts_of_pixel)); }
std::int64_t centre_of(int pixel) { return pixel * parts_of_pixel + parts_of_pixel / 2; }

/// The seeds' positions in parts of a pixel as nanoflann wants them. In double, whose sums of squares are
/// exact for whole pixels, and where they are rounded find a seed that is as near but for 2^-53 of that.
struct Cloud {
  std::vector<Point> points;

  std::size_t kdtree_get_point_count() const { return points.size(); }
  double kdtree_get_pt(std::size_t index, std::size_t axis) const {
    return axis == 0 ? points[index].x : points[index].y;
  }
  template <typename Box>
  bool kdtree_get_bbox(Box&) const {
    return false;
  }
};

/// Where a pixel is along an axis, and a period before and behind that.
std::vector<std::int64_t> images(int at, int size, bool periodic) {
  if (!periodic) return {centre_of(at)};
  return {centre_of(at - size), centre_of(at), centre_of(at + size)};
}

/// The length of a way along an axis, round the grid if that is shorter.
std::int64_t along(std::int64_t offset, int size, bool periodic) {
  const std::int64_t inside = std::abs(offset);
  return periodic ? std::min(inside, size * parts_of_pixel - inside) : inside;
}

/// Calls found(x, y, where a nearest seed is) for every pixel, from several threads.
template <template <class, class, class, class> class Distance, typename Found>
void for_each_nearest(const Size& size, Periodic periodic, const Cloud& cloud, const Found& found) {
  using Adaptor = Distance<double, Cloud, double, std::uint32_t>;
  const nanoflann::KDTreeSingleIndexAdaptor<Adaptor, Cloud, 2> tree(2, cloud);
  cv::parallel_for_(cv::Range(0, size.height()), [&](const cv::Range& rows) {
    for (int y = rows.start; y < rows.end; ++y) {
      for (int x = 0; x < size.width(); ++x) {
        std::uint32_t nearest = 0;
        double least = std::numeric_limits<double>::infinity();
        for (const std::int64_t image_y : images(y, size.height(), has_y(periodic))) {
          for (const std::int64_t image_x : images(x, size.width(), has_x(periodic))) {
            const double query[2] = {static_cast<double>(image_x), static_cast<double>(image_y)};
            std::uint32_t index = 0;
            double distance = 0;
            tree.knnSearch(query, 1, &index, &distance);
            if (distance >= least) continue;
            least = distance;
            nearest = index;
          }
        }
        found(x, y, cloud.points[nearest]);
      }
    }
  });
}

}  // namespace

GroundTruth::GroundTruth(const Grid& grid, const std::vector<std::optional<Point>>& seeds, Metric metric)
    : size_(grid), periodic_(grid.periodic()), metric_(metric), seeds_(seeds.size()), least_(size_.pixels()) {
  Cloud cloud;
  for (std::size_t id = 0; id < seeds.size(); ++id) {
    if (!seeds[id]) continue;
    seeds_[id] = Position{in_parts(seeds[id]->x), in_parts(seeds[id]->y)};
    cloud.points.push_back({static_cast<double>(seeds_[id]->x), static_cast<double>(seeds_[id]->y)});
  }
  // Thousands of seeds at one place would make a leaf of the tree that every query goes through.
  const auto before = [](const Point& a, const Point& b) { return std::tie(a.y, a.x) < std::tie(b.y, b.x); };
  const auto same = [](const Point& a, const Point& b) { return a.x == b.x && a.y == b.y; };
  std::sort(cloud.points.begin(), cloud.points.end(), before);
  cloud.points.erase(std::unique(cloud.points.begin(), cloud.points.end(), same), cloud.points.end());
  if (cloud.points.empty()) throw Error("without seeds no pixel has a true label");
  const auto found = [&](int x, int y, const Point& nearest) {
    const auto i =
        static_cast<std::size_t>(y) * static_cast<std::size_t>(size_.width()) + static_cast<std::size_t>(x);
    least_[i] = distance({static_cast<std::int64_t>(nearest.x), static_cast<std::int64_t>(nearest.y)}, x, y);
  };
  switch (metric) {
    case Metric::euclidean:
      for_each_nearest<nanoflann::L2_Simple_Adaptor>(size_, periodic_, cloud, found);
      break;
    case Metric::manhattan:
      for_each_nearest<nanoflann::L1_Adaptor>(size_, periodic_, cloud, found);
      break;
  }
}

std::size_t GroundTruth::wrong_pixels(const std::vector<std::uint32_t>& labels) const {
  std::size_t wrong = 0, i = 0;
  for (int y = 0; y < size_.height(); ++y) {
    for (int x = 0; x < size_.width(); ++x, ++i) {
      const std::uint32_t label = labels.at(i);
      if (label >= seeds_.size() || !seeds_[label] || distance(*seeds_[label], x, y) > least_[i]) ++wrong;
    }
  }
  return wrong;
}

std::uint64_t GroundTruth::distance(const Position& seed, int x, int y) const {
  const std::int64_t dx = along(seed.x - centre_of(x), size_.width(), has_x(periodic_));
  const std::int64_t dy = along(seed.y - centre_of(y), size_.height(), has_y(periodic_));
  switch (metric_) {
    case Metric::euclidean:
      return static_cast<std::uint64_t>(dx * dx + dy * dy);
    case Metric::manhattan:
      break;
  }
  return static_cast<std::uint64_t>(dx + dy);
}

}  // namespace vorocl::command
