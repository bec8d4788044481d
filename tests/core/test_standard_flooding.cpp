// Standard flooding against brute force, and its number of waves.
#define BOOST_TEST_MODULE standard_flooding
#include <algorithm>

#include "brute_force.hpp"
#include "fixture.hpp"

using namespace vorocl;

namespace {

std::int64_t largest_chebyshev_distance(const Grid& grid, const std::vector<Pixel>& seeds,
                                        const std::vector<std::uint32_t>& labels) {
  std::int64_t largest = 0;
  std::size_t i = 0;
  for (int y = 0; y < grid.height(); ++y) {
    for (int x = 0; x < grid.width(); ++x, ++i) {
      if (labels[i] == no_label) continue;
      const Pixel seed = nearest_image(grid, seeds[labels[i]], {x, y});
      largest = std::max({largest, std::abs(seed.x - x), std::abs(seed.y - y)});
    }
  }
  return largest;
}

}  // namespace

BOOST_AUTO_TEST_CASE(edge_cases_against_brute_force) {
  for (const Metric metric : both_metrics) {
    for (const Case& c : all_edge_cases(metric)) {
      BOOST_TEST_CONTEXT(c.name << ", " << name_of(metric)) {
        const auto ground_truth = brute_force(c.grid, c.seeds, metric);
        Diagram diagram(test_device(), c.grid);
        const Report report =
            standard_flooding(Seeds(test_device(), c.grid, centres(c.seeds), to_centres), diagram, {metric});
        const auto labels = diagram.read();
        const Verdict verdict = judge(c.grid, c.seeds, metric, labels, ground_truth);
        BOOST_TEST(verdict.unlabelled == 0);
        BOOST_TEST(verdict.invalid == 0);
        BOOST_TEST(verdict.too_near == 0);
        // A region is flooded by its own pixels: only one that is thinner than a pixel somewhere can be cut
        // off. Measured on these cases: at most 1 pixel in 1,000 with the Euclidean metric, none with the
        // Manhattan one.
        BOOST_TEST(verdict.wrong <= (metric == Metric::euclidean ? c.grid.pixels() / 1000 : 0));
        BOOST_TEST(report.waves() == largest_chebyshev_distance(c.grid, c.seeds, labels));
      }
    }
  }
}

BOOST_AUTO_TEST_CASE(von_neumann_labels_all_pixels_with_existing_seeds) {
  for (const Metric metric : both_metrics) {
    for (const Case& c : all_edge_cases(metric)) {
      BOOST_TEST_CONTEXT(c.name << ", " << name_of(metric)) {
        Diagram diagram(test_device(), c.grid);
        standard_flooding(Seeds(test_device(), c.grid, centres(c.seeds), to_centres), diagram,
                          {metric, Neighbourhood::von_neumann});
        const auto ground_truth = brute_force(c.grid, c.seeds, metric);
        const Verdict verdict = judge(c.grid, c.seeds, metric, diagram.read(), ground_truth);
        BOOST_TEST(verdict.unlabelled == 0);
        BOOST_TEST(verdict.invalid == 0);
        BOOST_TEST(verdict.too_near == 0);
        // In steps along the axes a Euclidean region thinner than a diagonal step is cut off too.
        BOOST_TEST(verdict.wrong <= (metric == Metric::euclidean ? c.grid.pixels() / 50 : 0));
      }
    }
  }
}

BOOST_AUTO_TEST_CASE(many_waves_between_two_reads_of_the_flag) {
  // 299 waves: the flag is read in between, and the last interval is not full.
  const Grid grid(300, 4);
  Diagram diagram(test_device(), grid);
  const Report report = standard_flooding(Seeds(test_device(), grid, {{0, 0}}, to_centres), diagram);
  BOOST_TEST(report.waves() == 299);
  const auto labels = diagram.read();
  BOOST_TEST(std::count(labels.begin(), labels.end(), 0u) == 1200);
}
