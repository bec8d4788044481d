// How far particles have moved, by the shorter way round a periodic box.
#define BOOST_TEST_MODULE periodic_step
#include <algorithm>
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <random>

#include "app/sources/particles.hpp"

using namespace vorocl;
using namespace vorocl::command;

// In a flat box that is tilted, going round in y can be shorter though y itself does not say so.
BOOST_AUTO_TEST_CASE(a_way_round_that_only_the_tilt_makes_shorter) {
  const Periods flat{100, 10, 30};
  BOOST_TEST(displacement({0, 0}, {30, 4}, flat) == 6);
  BOOST_TEST(displacement({0, 0}, {-30, -4}, flat) == 6);
}

BOOST_AUTO_TEST_CASE(steps_go_the_shorter_way_round) {
  const Size picture(100, 50);
  const Bounds bounds{0, 0, 10, 5};
  const auto step = [&](const Box& box, Point from, Point to, bool y_up = false) {
    return displacement(from, to, periods_in_pixels(box, bounds, picture, y_up));
  };
  const Box walls{bounds, false, false, false, 0}, x_periodic{bounds, true, false, false, 0},
      periodic{bounds, true, true, false, 0}, tilted{bounds, true, true, false, 3};
  BOOST_TEST(step(walls, {1.5, 2.5}, {98.5, 47.5}) == 97);
  BOOST_TEST(step(x_periodic, {1.5, 2.5}, {98.5, 47.5}) == 45);
  BOOST_TEST(step(periodic, {1.5, 2.5}, {98.5, 47.5}) == 5);
  BOOST_TEST(step(periodic, {98.5, 20.5}, {4.5, 21.5}) == 6);
  // Through the top of the box: the particle comes in at the bottom, 30 pixels to the left.
  BOOST_TEST(step(tilted, {60.5, 48.5}, {30.5, 1.5}) == 3);
  BOOST_TEST(step(tilted, {60.5, 1.5}, {30.5, 48.5}, true) == 3);
  BOOST_TEST(step(periodic, {60.5, 48.5}, {30.5, 1.5}) == 30);
}

BOOST_AUTO_TEST_CASE(no_other_way_round_is_shorter) {
  std::mt19937 bits(1);
  const auto uniform = [&](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(bits);
  };
  for (int trial = 0; trial < 2000; ++trial) {
    const double width = uniform(50, 100), height = uniform(50, 100);  // not flat: see above
    const Periods periods{width, height, trial % 3 == 0 ? 0 : uniform(-width / 2, width / 2)};
    const Point from{uniform(0, width), uniform(0, height)}, to{uniform(0, width), uniform(0, height)};
    double least = INFINITY;
    for (int turns_y = -3; turns_y <= 3; ++turns_y) {
      for (int turns_x = -5; turns_x <= 5; ++turns_x) {
        const double x = to.x - from.x - turns_x * width - turns_y * periods.tilt;
        least = std::min(least, std::max(std::abs(x), std::abs(to.y - from.y - turns_y * height)));
      }
    }
    BOOST_TEST(displacement(from, to, periods) == least, boost::test_tools::tolerance(1e-9));
  }
}
