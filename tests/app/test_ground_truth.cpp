// The ground truth of bench against brute force, and OpenCV's labels as it judges them.
#define BOOST_TEST_MODULE ground_truth
#include <algorithm>
#include <cmath>
#include <optional>

#include "app/bench/benchmark.hpp"
#include "brute_force.hpp"
#include "fixture.hpp"

using namespace vorocl;
using namespace vorocl::command;

namespace {

std::vector<std::optional<Point>> present(const std::vector<Point>& points) {
  return {points.begin(), points.end()};
}

}  // namespace

BOOST_AUTO_TEST_CASE(exact_labels_are_right_and_others_are_counted) {
  for (const Case& example : all_edge_cases()) {
    if (example.seeds.empty()) continue;
    for (const Metric metric : both_metrics) {
      const GroundTruth truth(example.grid, present(centres(example.seeds)), metric);
      const std::vector<std::uint32_t> exact = brute_force(example.grid, example.seeds, metric);
      BOOST_TEST(truth.wrong_pixels(exact) == 0u, example.name << ", " << name_of(metric));
      // One label for all pixels: wrong in many.
      const std::vector<std::uint32_t> constant(exact.size(),
                                                static_cast<std::uint32_t>(example.seeds.size() - 1));
      BOOST_TEST(
          truth.wrong_pixels(constant) == judge(example.grid, example.seeds, metric, constant, exact).wrong,
          example.name << ", " << name_of(metric));
    }
  }
}

BOOST_AUTO_TEST_CASE(seeds_within_their_pixels_are_judged_where_they_are) {
  const std::vector<std::optional<Point>> seeds = {Point{3.25, 3.5}, Point{3.75, 3.5}, Point{9.5, 0.5}};
  for (const Metric metric : both_metrics) {
    const GroundTruth truth(Grid(12, 7), seeds, metric);
    const GroundTruth round(Grid(12, 7, Axes::xy), seeds, metric);
    const auto labels = [&](bool periodic) {
      const auto way = [periodic](double from, double to, double period) {
        const double straight = std::abs(from - to);
        return periodic ? std::min(straight, period - straight) : straight;
      };
      std::vector<std::uint32_t> nearest;
      for (int i = 0; i < 12 * 7; ++i) {
        double least = 1e9;
        nearest.push_back(0);
        for (std::uint32_t id = 0; id < seeds.size(); ++id) {  // in 1/4 pixel: without rounding
          const double dx = way(seeds[id]->x, i % 12 + 0.5, 12), dy = way(seeds[id]->y, i / 12 + 0.5, 7);
          const double distance = metric == Metric::euclidean ? dx * dx + dy * dy : dx + dy;
          if (distance < least) least = distance, nearest.back() = id;
        }
      }
      return nearest;
    };
    BOOST_TEST(truth.wrong_pixels(labels(false)) == 0u);
    BOOST_TEST(round.wrong_pixels(labels(true)) == 0u);
    BOOST_TEST(truth.wrong_pixels(labels(true)) > 0u);
    std::vector<std::uint32_t> swapped = labels(false);
    for (std::uint32_t& label : swapped) label = label == 0 ? 1 : label == 1 ? 0 : label;
    // Those of column 3 are as far from both.
    const auto ties = [&] {
      std::size_t count = 0;
      for (std::size_t i = 3; i < swapped.size(); i += 12) count += swapped[i] != 2 ? 1 : 0;
      return count;
    };
    const auto others = static_cast<std::size_t>(
        std::count_if(swapped.begin(), swapped.end(), [](auto l) { return l != 2; }));
    BOOST_TEST(truth.wrong_pixels(swapped) == others - ties());
  }
}

BOOST_AUTO_TEST_CASE(axes_count_as_they_are_spaced) {
  const std::vector<std::optional<Point>> seeds = {Point{1.5, 2.5, 0.5}, Point{5.5, 0.5, 3.5},
                                                   Point{3.5, 3.5, 2.5}};
  const int sides[] = {7, 4, 5}, spacing[] = {1, 2, 5};
  for (const Metric metric : both_metrics) {
    const auto labels = [&](const auto& units) {  // z is periodic
      std::vector<std::uint32_t> nearest;
      for (int i = 0; i < 7 * 4 * 5; ++i) {
        const double at[] = {i % 7 + 0.5, i / 7 % 4 + 0.5, i / 28 + 0.5};
        const auto distance = [&](const Point& seed) {
          const double to[] = {seed.x, seed.y, seed.z};
          double sum = 0;
          for (int axis = 0; axis < 3; ++axis) {
            double way = std::abs(at[axis] - to[axis]);
            if (axis == 2) way = std::min(way, sides[axis] - way);
            way *= units[axis];
            sum += metric == Metric::euclidean ? way * way : way;
          }
          return sum;
        };
        std::uint32_t best = 0;
        for (std::uint32_t id = 1; id < 3; ++id)
          if (distance(*seeds[id]) < distance(*seeds[best])) best = id;
        nearest.push_back(best);
      }
      return nearest;
    };
    const Grid grid(Axis(7), Axis(4).spaced(2), Axis(5).periodic().spaced(5));
    const GroundTruth truth(grid, seeds, metric);
    BOOST_TEST(truth.wrong_pixels(labels(spacing)) == 0u);
    BOOST_TEST(truth.wrong_pixels(labels(std::array{1, 1, 1})) > 0u);
  }
}

BOOST_AUTO_TEST_CASE(missing_and_impossible_labels_are_wrong) {
  const GroundTruth truth(Grid(4, 1), {Point{0.5, 0.5}, std::nullopt}, Metric::euclidean);
  BOOST_TEST(truth.wrong_pixels({0, no_label, 2, 1}) == 3u);
  check_error([&] { GroundTruth(Grid(4, 1), std::vector<std::optional<Point>>(), Metric::euclidean); },
              {"without seeds"});
}

BOOST_AUTO_TEST_CASE(opencv_labels_are_seed_ids) {
  for (const Metric metric : both_metrics) {
    const Grid grid(80, 60);
    std::vector<Pixel> seeds = random_pixels(grid, 40, 3);
    seeds.push_back(seeds[7]);  // coincident: the lower id has the cell
    OpenCvBaseline baseline(grid, present(centres(seeds)), metric);
    baseline.run();
    const std::vector<std::uint32_t> labels = baseline.labels();
    const std::vector<std::uint32_t> exact = brute_force(grid, seeds, metric);
    const Verdict verdict = judge(grid, seeds, metric, labels, exact);
    BOOST_TEST(verdict.unlabelled + verdict.invalid == 0u);
    BOOST_TEST(verdict.wrong < grid.pixels() / 50, name_of(metric));  // approximate: about 1 % are wrong
    BOOST_TEST(GroundTruth(grid, present(centres(seeds)), metric).wrong_pixels(labels) == verdict.wrong);
    BOOST_TEST((std::find(labels.begin(), labels.end(), 40u) == labels.end()));
  }
}
