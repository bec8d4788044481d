// Similarity on the host and on the device.
#define BOOST_TEST_MODULE similarity
#include <algorithm>
#include <cmath>
#include <limits>

#include "brute_force.hpp"
#include "fixture.hpp"
#include "plane_brute_force.hpp"

using namespace vorocl;

BOOST_AUTO_TEST_CASE(matching_pixels_in_percent) {
  BOOST_TEST(similarity({1, 2, 3, 4}, {1, 2, 3, 5}) == 75.0);
  BOOST_TEST(similarity({1, 2}, {2, 1}) == 0.0);
  BOOST_TEST(similarity({no_label}, {no_label}) == 100.0);
  check_error([] { similarity({1, 2}, {1}); }, {"2 and 1"});
  check_error([] { similarity(std::vector<std::uint32_t>{}, std::vector<std::uint32_t>{}); }, {"0 and 0"});
}

BOOST_AUTO_TEST_CASE(the_device_counts_as_the_host_does) {
  for (const Grid& grid : {Grid(1, 1), Grid(13, 7), Grid(1000, 333), Grid(1023, 5)}) {
    Diagram a(test_device(), grid), b(test_device(), grid);
    jump_flooding(Seeds(test_device(), grid, centres(random_pixels(grid, 50, 1))), a);
    jump_flooding(Seeds(test_device(), grid, centres(random_pixels(grid, 50, 2))), b);
    BOOST_TEST(similarity(a, b) == similarity(a.read(), b.read()));
    BOOST_TEST(similarity(a, a) == 100.0);
  }
}

// Against distances in 64 bits on the host: seeds inside and outside the grid, pixels without a label.
BOOST_AUTO_TEST_CASE(distances_that_differ_by_less_than_the_tolerance_are_equal) {
  std::mt19937_64 rng(4);
  for (const Grid& grid : {Grid(40, 30), Grid(33, 41, Periodic::x), Grid(64, 20, Periodic::xy)}) {
    for (const std::int64_t reach : {0, 50, 2000000}) {
      if (reach > 0 && grid.periodic() != Periodic::none) continue;
      const std::vector<PlanePixel> points =
          random_plane_pixels(-reach, -reach, grid.width() - 1 + reach, grid.height() - 1 + reach, 30, rng);
      const Seeds seeds(test_device(), grid, centres(points));
      std::vector<std::uint32_t> labels_a(grid.pixels()), labels_b(grid.pixels());
      for (std::uint32_t& label : labels_a) label = static_cast<std::uint32_t>(rng() % 32);
      for (std::uint32_t& label : labels_b) label = static_cast<std::uint32_t>(rng() % 32);
      Diagram a(test_device(), grid), b(test_device(), grid);
      a.write(labels_a);
      b.write(labels_b);
      const Domain domain = {0, 0, grid.width(), grid.height(), grid.periodic()};
      for (const Metric metric : both_metrics) {
        std::vector<double> apart;
        for (std::size_t i = 0; i < grid.pixels(); ++i) {
          const PlanePixel at = {static_cast<int>(i) % grid.width(), static_cast<int>(i) / grid.width()};
          const auto length = [&](std::uint32_t label) {
            const auto d = static_cast<double>(distance(domain, at, points[label], metric));
            return metric == Metric::euclidean ? std::sqrt(d) : d;
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
          BOOST_TEST(similarity(seeds, a, b, tolerance, metric) == expected);
        }
      }
      BOOST_TEST(similarity(seeds, a, a, 0) == 100.0);
    }
  }
}

BOOST_AUTO_TEST_CASE(diagrams_that_do_not_fit_together_are_refused) {
  const Diagram a(test_device(), Grid(10, 20)), b(test_device(), Grid(20, 10));
  check_error([&] { similarity(a, b); }, {"different grids"});
  const Diagram c(Device::select(), Grid(10, 20));
  check_error([&] { similarity(a, c); }, {"different devices"});
  const Seeds seeds(test_device(), Grid(10, 20), {Point{1, 1}});
  check_error([&] { similarity(seeds, a, b, 1); }, {"different grids"});
  check_error([&] { similarity(seeds, b, b, 1); }, {"grid"});
  check_error([&] { similarity(seeds, a, a, -0.1); }, {"tolerance", "-0.1"});
  check_error([&] { similarity(seeds, a, a, std::nan("")); }, {"tolerance", "nan"});
}
