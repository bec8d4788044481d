// Similarity on the host and on the device.
#define BOOST_TEST_MODULE similarity
#include <algorithm>
#include <cmath>
#include <limits>

#include "brute_force.hpp"
#include "fixture.hpp"
#include "read_measures.hpp"

using namespace vorocl;

BOOST_AUTO_TEST_CASE(matching_pixels_in_percent) {
  BOOST_TEST(similarity({1, 2, 3, 4}, {1, 2, 3, 5}) == 75.0);
  BOOST_TEST(similarity({1, 2}, {2, 1}) == 0.0);
  BOOST_TEST(similarity({no_label}, {no_label}) == 100.0);
  check_error([] { similarity({1, 2}, {1}); }, {"2 and 1"});
  check_error([] { similarity(std::vector<std::uint32_t>{}, std::vector<std::uint32_t>{}); }, {"0 and 0"});
}

BOOST_AUTO_TEST_CASE(the_device_counts_as_the_host_does) {
  for (const Grid& grid : {Grid(1, 1), Grid(13, 7), Grid(1000, 333), Grid(1023, 5), Grid(50, 40, 30)}) {
    Diagram a(test_device(), grid), b(test_device(), grid);
    jump_flooding(Seeds(test_device(), grid, centres(random_pixels(grid, 50, 1)), to_centres), a);
    jump_flooding(Seeds(test_device(), grid, centres(random_pixels(grid, 50, 2)), to_centres), b);
    BOOST_TEST(similarity_of(a, b) == similarity(a.read(), b.read()));
    BOOST_TEST(similarity_of(a, a) == 100.0);
  }
}

// Against distances in 64 bits on the host: seeds inside and outside the grid, pixels without a label.
BOOST_AUTO_TEST_CASE(distances_that_differ_by_less_than_the_tolerance_are_equal) {
  std::mt19937_64 rng(4);
  for (const Grid& grid : {Grid(40, 30), Grid(33, 41, Axes::x), Grid(64, 20, Axes::xy), Grid(20, 12, 9),
                           Grid(Axis(37).spaced(2).periodic(), Axis(9), Axis(12).periodic())}) {
    for (const std::int64_t reach : {0, 50, 2000000}) {
      if (grid.is_volume() && reach > 0) continue;  // their seeds lie inside
      std::vector<Pixel> points;
      std::uniform_int_distribution<std::int64_t> x(-reach, grid.width() - 1 + reach),
          y(-reach, grid.height() - 1 + reach), z(0, grid.depth() - 1);
      for (int i = 0; i < 30; ++i) {
        const std::int64_t column = x(rng);
        const std::int64_t row = y(rng);
        points.push_back({column, row, z(rng)});
      }
      const Seeds seeds(test_device(), grid, centres(points), to_centres);
      std::vector<std::uint32_t> labels_a(grid.pixels()), labels_b(grid.pixels());
      for (std::uint32_t& label : labels_a) label = static_cast<std::uint32_t>(rng() % 32);
      for (std::uint32_t& label : labels_b) label = static_cast<std::uint32_t>(rng() % 32);
      Diagram a(test_device(), grid), b(test_device(), grid);
      SimilarityResult result;
      for (const Metric metric : both_metrics) {
        a.write(labels_a, seeds, metric);
        b.write(labels_b, seeds, metric);
        std::vector<double> apart;
        for (std::size_t i = 0; i < grid.pixels(); ++i) {
          const auto length = [&](std::uint32_t label) {
            return length_of(distance(grid, pixel_at(grid, i), in_period(grid, points[label]), metric),
                             metric);
          };
          const bool none_a = labels_a[i] >= 30, none_b = labels_b[i] >= 30;
          apart.push_back(none_a && none_b   ? 0
                          : none_a || none_b ? std::numeric_limits<double>::infinity()
                                             : std::abs(length(labels_a[i]) - length(labels_b[i])));
        }
        for (const double tolerance : {0.0, 0.3, metric == Metric::euclidean ? 7.7 : 7.0, 30.3}) {
          const auto equal = std::count_if(apart.begin(), apart.end(),
                                           [&](double distance) { return distance <= tolerance; });
          const double expected = 100.0 * static_cast<double>(equal) / static_cast<double>(grid.pixels());
          similarity(a, b, tolerance, result);
          BOOST_TEST(result.read() == expected);
        }
      }
      similarity(a, a, 0, result);
      BOOST_TEST(result.read() == 100.0);
    }
  }
}

BOOST_AUTO_TEST_CASE(pixels_that_differ_are_counted) {
  const Grid grid(700, 300);
  Diagram a(test_device(), grid), b(test_device(), grid);
  std::vector<std::uint32_t> labels(grid.pixels());
  std::mt19937 rng(3);
  for (std::uint32_t& label : labels) label = static_cast<std::uint32_t>(rng() % 100);
  a.write(labels);
  b.write(labels);
  SimilarityResult result;
  BOOST_TEST(result.read_differences() == 0u);
  BOOST_TEST(result.read() == 100.0);
  BOOST_TEST((result.differences()() == nullptr));
  similarity(a, b, result);
  BOOST_TEST(result.read_differences() == 0u);
  for (std::size_t i = 0; i < 12345; ++i) labels[17 * i] ^= 1;
  b.write(labels);
  similarity(a, b, result);
  BOOST_TEST(result.read_differences() == 12345u);
  BOOST_TEST(result.read() == 100.0 * (210000 - 12345) / 210000);
  cl_uint on_the_device = 0;
  BOOST_TEST_REQUIRE(test_device().queue().enqueueReadBuffer(result.differences(), CL_TRUE, 0, 4,
                                                             &on_the_device) == CL_SUCCESS);
  BOOST_TEST(on_the_device == 12345u);
}

BOOST_AUTO_TEST_CASE(diagrams_that_do_not_fit_together_are_refused) {
  const Grid grid(10, 20);
  Diagram a(test_device(), grid), b(test_device(), Grid(20, 10)), c(Device::select(), grid);
  SimilarityResult result;
  check_error([&] { similarity(a, b, result); }, {"different windows"});
  check_error([&] { similarity(a, c, result); }, {"different devices"});
  check_error([&] { similarity(a, a, 1, result); }, {"seeds"});
  Seeds seeds(test_device(), grid, {{1, 1}}, to_centres);
  exact_diagram(seeds, a);
  check_error([&] { similarity(a, b, 1, result); }, {"different windows"});
  check_error([&] { similarity(a, a, -0.1, result); }, {"tolerance", "-0.1"});
  check_error([&] { similarity(a, a, std::nan(""), result); }, {"tolerance", "nan"});
  // Labels are compared all the same, but not distances.
  Diagram other(test_device(), grid);
  exact_diagram(seeds, other, {Metric::manhattan});
  check_error([&] { similarity(a, other, 1, result); }, {"metric"});
  seeds.move_to({{2, 2}});
  exact_diagram(seeds, other);
  check_error([&] { similarity(a, other, 1, result); }, {"frame"});
  BOOST_TEST(similarity_of(a, other) == 100.0);
}
