// The ground truth of bench against brute force, and OpenCV's labels as it judges them.
#define BOOST_TEST_MODULE ground_truth
#include <algorithm>
#include <optional>

#include "brute_force.hpp"
#include "fixture.hpp"
#include "trials/benchmark.hpp"

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

BOOST_AUTO_TEST_CASE(missing_and_impossible_labels_are_wrong) {
  const GroundTruth truth(Grid(4, 1), {Point{0.5, 0.5}, std::nullopt}, Metric::euclidean);
  BOOST_TEST(truth.wrong_pixels({0, no_label, 2, 1}) == 3u);
  check_error([&] { GroundTruth(Grid(4, 1), {}, Metric::euclidean); }, {"without seeds"});
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
