// Measures of windows of a larger plane and of periodic domains, against the host's in 64 bits.
#define BOOST_TEST_MODULE window_measures
#include <algorithm>
#include <climits>
#include <cmath>

#include "window_cases.hpp"

using namespace vorocl;

namespace {

/// A window with seeds all around, near and far, and zooms into domains.
struct MeasuredWindow {
  Grid grid;
  Domain domain;
  std::vector<PlanePixel> seeds;
};

std::vector<MeasuredWindow> measured_windows() {
  std::mt19937_64 rng(10);
  const Grid grid(61, 47);
  std::vector<MeasuredWindow> windows;
  windows.push_back({grid, {}, random_plane_pixels(-60, -60, 120, 100, 60, rng)});
  windows.push_back({grid, {}, random_plane_pixels(-20000, -20000, 20000, 20000, 60, rng)});
  windows.push_back({grid, {}, random_plane_pixels(-2000000000, -2000000000, -1999990000, 0, 30, rng)});
  windows.push_back({grid, {-30, -20, 80, 70, Periodic::xy}, random_plane_pixels(-30, -20, 49, 49, 12, rng)});
  windows.push_back({grid, {10, 5, 30, 25, Periodic::xy}, random_plane_pixels(10, 5, 39, 29, 9, rng)});
  windows.push_back(
      {grid, {10, -50000, 30, 90000, Periodic::xy}, random_plane_pixels(10, -50000, 39, 39999, 9, rng)});
  windows.push_back({grid, {-1, 0, 50, 1, Periodic::x}, random_plane_pixels(-1, -90, 48, 90, 20, rng)});
  return windows;
}

/// Calls a function with the exact diagram of each window, in both metrics and by each engine.
template <typename Use>
void each_exact_diagram(Use use) {
  for (const MeasuredWindow& window : measured_windows()) {
    for (const Metric metric : both_metrics) {
      for (const Engine& engine : engines()) {
        const Seeds seeds(engine.device, window.grid, centres(window.seeds), window.domain);
        Diagram diagram(engine.device, window.grid);
        exact_diagram(seeds, diagram, {metric});
        BOOST_TEST_CONTEXT(text_of(window.grid, window.domain, seeds.size()) << ", " << engine.name) {
          use(window, metric, seeds, diagram);
        }
      }
    }
  }
}

/// Calls a function with each pixel that has a label, and its distance to the label's seed.
template <typename Use>
void each_labelled_pixel(const MeasuredWindow& window, const Labels& labels, Metric metric, Use use) {
  for (int y = 0, i = 0; y < window.grid.height(); ++y) {
    for (int x = 0; x < window.grid.width(); ++x, ++i) {
      const std::uint32_t label = labels[static_cast<std::size_t>(i)];
      if (label == no_label) continue;
      const PlanePixel seed = brought_into(window.domain, window.seeds[label]);
      use(static_cast<std::size_t>(i), label, x, y, distance(window.domain, {x, y}, seed, metric));
    }
  }
}

}  // namespace

BOOST_AUTO_TEST_CASE(distances_of_windows) {
  each_exact_diagram(
      [](const MeasuredWindow& window, Metric metric, const Seeds& seeds, const Diagram& diagram) {
        const Labels labels = diagram.read();
        std::vector<std::int64_t> expected(labels.size(), -1);
        each_labelled_pixel(window, labels, metric,
                            [&](std::size_t i, std::uint32_t, int, int, std::int64_t d) { expected[i] = d; });
        const bool fits = *std::max_element(expected.begin(), expected.end()) < no_distance;

        Field<float> floats;
        distance_field(seeds, diagram, floats, metric);
        const std::vector<float> in_pixels = floats.read();
        std::size_t wrong = 0;
        for (std::size_t i = 0; i < labels.size(); ++i) {
          const auto d = static_cast<double>(expected[i]);
          const double right = metric == Metric::euclidean ? std::sqrt(d) : d;
          if (expected[i] < 0) {
            wrong += std::isinf(in_pixels[i]) ? 0 : 1;
          } else {
            wrong += std::abs(in_pixels[i] - right) <= 1e-6 * right ? 0 : 1;
          }
        }
        BOOST_TEST(wrong == 0u);

        Field<std::int32_t> integers;
        if (!fits) {
          check_error([&] { distance_field(seeds, diagram, integers, metric); }, {"31 bits", "floats"});
          BOOST_TEST(integers.read().empty());
          return;
        }
        distance_field(seeds, diagram, integers, metric);
        for (std::int64_t& d : expected) d = d < 0 ? no_distance : d;
        const std::vector<std::int32_t> found = integers.read();
        BOOST_TEST(std::equal(found.begin(), found.end(), expected.begin(), expected.end()));
      });
}

BOOST_AUTO_TEST_CASE(cells_of_windows) {
  each_exact_diagram(
      [](const MeasuredWindow& window, Metric metric, const Seeds& seeds, const Diagram& diagram) {
        std::vector<CellShape> shapes(seeds.size(), CellShape{INT_MAX, INT_MAX, INT_MIN, INT_MIN, -1, false});
        std::vector<CellSums> sums(seeds.size());
        each_labelled_pixel(window, diagram.read(), metric,
                            [&](std::size_t, std::uint32_t label, int x, int y, std::int64_t d) {
                              CellShape& shape = shapes[label];
                              shape.left = std::min(shape.left, x);
                              shape.top = std::min(shape.top, y);
                              shape.right = std::max(shape.right, x);
                              shape.bottom = std::max(shape.bottom, y);
                              shape.largest_distance = std::max(shape.largest_distance, d);
                              ++sums[label].area;
                              sums[label].sum_x += x;
                              sums[label].sum_y += y;
                            });
        CellShapesResult found_shapes;
        CellSumsResult found_sums;
        cell_shapes(seeds, diagram, found_shapes, metric);
        cell_sums(seeds, diagram, found_sums);
        const std::vector<CellShape> read_shapes = found_shapes.read();
        const std::vector<CellSums> read_sums = found_sums.read();
        BOOST_REQUIRE(read_shapes.size() == shapes.size());
        std::size_t wrong = 0;
        for (std::size_t id = 0; id < shapes.size(); ++id) {
          const CellShape &a = read_shapes[id], &b = shapes[id];
          const bool touches =
              sums[id].area > 0 && (b.left == 0 || b.top == 0 || b.right == window.grid.width() - 1 ||
                                    b.bottom == window.grid.height() - 1);
          wrong += a.left != b.left || a.top != b.top || a.right != b.right || a.bottom != b.bottom ||
                   a.largest_distance != b.largest_distance || a.touches_border != touches;
          wrong += read_sums[id].area != sums[id].area || read_sums[id].sum_x != sums[id].sum_x ||
                   read_sums[id].sum_y != sums[id].sum_y;
        }
        BOOST_TEST(wrong == 0u);
        const bool far = std::any_of(window.seeds.begin(), window.seeds.end(),
                                     [](const PlanePixel& seed) { return std::abs(seed.x) > 50000; });
        if (far) BOOST_TEST((found_shapes.largest_distances()() == nullptr));
        // A seed counts if it is in the grid or owns a pixel.
        std::size_t cells = 0;
        for (std::size_t id = 0; id < sums.size(); ++id) {
          const PlanePixel seed = brought_into(window.domain, window.seeds[id]);
          const bool inside =
              seed.x >= 0 && seed.x < window.grid.width() && seed.y >= 0 && seed.y < window.grid.height();
          cells += inside || sums[id].area > 0 ? 1 : 0;
        }
        BOOST_TEST(cell_statistics(found_sums).cells == cells);
      });
}

BOOST_AUTO_TEST_CASE(errors_of_labels_of_windows) {
  for (const MeasuredWindow& window : measured_windows()) {
    for (const Metric metric : both_metrics) {
      const Seeds seeds(test_device(), window.grid, centres(window.seeds), window.domain);
      Diagram exact(test_device(), window.grid), diagram(test_device(), window.grid);
      exact_diagram(seeds, exact, {metric});
      const Labels right = exact.read();
      Labels labels = right;
      for (std::size_t i = 0; i < labels.size(); i += 3) {
        if (labels[i] != no_label) labels[i] = static_cast<std::uint32_t>(i % (seeds.size() + 1));
      }
      diagram.write(labels);
      std::vector<std::int64_t> least(labels.size(), 0);
      each_labelled_pixel(window, right, metric,
                          [&](std::size_t i, std::uint32_t, int, int, std::int64_t d) { least[i] = d; });
      DistanceErrors expected;
      double sum = 0;
      for (std::size_t i = 0; i < labels.size(); ++i) {
        if (right[i] == no_label) continue;
        if (labels[i] == seeds.size()) {
          ++expected.wrong_pixels;
          ++expected.unlabelled_pixels;
          continue;
        }
        const int x = static_cast<int>(i) % window.grid.width(),
                  y = static_cast<int>(i) / window.grid.width();
        const PlanePixel seed = brought_into(window.domain, window.seeds[labels[i]]);
        const std::int64_t d = distance(window.domain, {x, y}, seed, metric);
        if (d == least[i]) continue;
        ++expected.wrong_pixels;
        const auto longer = static_cast<double>(d - least[i]);
        const double roots = std::sqrt(static_cast<double>(d)) + std::sqrt(static_cast<double>(least[i]));
        const double excess = metric == Metric::euclidean ? longer / roots : longer;
        sum += excess;
        expected.largest_excess = std::max(expected.largest_excess, excess);
      }
      const DistanceErrors found = distance_errors(seeds, diagram, exact, metric);
      BOOST_TEST(found.wrong_pixels == expected.wrong_pixels);
      BOOST_TEST(found.unlabelled_pixels == expected.unlabelled_pixels);
      BOOST_TEST(std::abs(found.largest_excess - expected.largest_excess) <= 1e-4 * expected.largest_excess);
      const double mean = sum / static_cast<double>(labels.size());
      BOOST_TEST(std::abs(found.mean_excess - mean) <= 1e-4 * mean);
      BOOST_TEST(distance_errors(seeds, exact, exact, metric).wrong_pixels == 0u);
    }
  }
}
