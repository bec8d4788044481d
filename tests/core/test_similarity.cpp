// Similarity on the host and on the device.
#define BOOST_TEST_MODULE similarity
#include "brute_force.hpp"
#include "fixture.hpp"

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

BOOST_AUTO_TEST_CASE(diagrams_that_do_not_fit_together_are_refused) {
  const Diagram a(test_device(), Grid(10, 20)), b(test_device(), Grid(20, 10));
  check_error([&] { similarity(a, b); }, {"different grids"});
  const Diagram c(Device::select(), Grid(10, 20));
  check_error([&] { similarity(a, c); }, {"different devices"});
}
