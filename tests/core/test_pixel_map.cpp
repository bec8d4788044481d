// The map from data units to pixels, against integers.
#define BOOST_TEST_MODULE pixel_map
#include <cmath>
#include <random>

#include "fixture.hpp"
#include "vorocl/bounds.hpp"

using namespace vorocl;

namespace {

/// Whole units of data, in which the oracle computes.
struct Units {
  std::int64_t x0, y0, x1, y1;

  operator Bounds() const {
    return {static_cast<double>(x0), static_cast<double>(y0), static_cast<double>(x1),
            static_cast<double>(y1)};
  }
};

std::int64_t floor_of(std::int64_t numerator, std::int64_t denominator) {
  const std::int64_t quotient = numerator / denominator;
  return quotient - (numerator % denominator < 0 ? 1 : 0);
}

std::int64_t brought_into(std::int64_t at, std::int64_t low, std::int64_t high) {
  return low + (at - low) - floor_of(at - low, high - low) * (high - low);
}

std::pair<double, double> pixel(const PixelMap& map, double x, double y) {
  const Point found = map.pixel({x, y});
  return {found.x, found.y};
}

PixelMap periodic_map(const Bounds& bounds, const Grid& grid, bool y_up) {
  PixelMap map(bounds, grid, y_up, true);
  map.repeat(grid.periodic(), bounds);
  return map;
}

}  // namespace

BOOST_AUTO_TEST_CASE(pixels_are_those_of_integers) {
  std::mt19937 rng(3);
  const auto below = [&](int end) { return static_cast<std::int64_t>(rng() % static_cast<unsigned>(end)); };
  for (int number = 0; number < 2000; ++number) {
    const Units bounds = {below(100) - 50, below(100) - 50, 51 + below(90), 51 + below(90)};
    const Grid grid(1 + static_cast<int>(below(300)), 1 + static_cast<int>(below(300)),
                    static_cast<Periodic>(number % 4));
    const bool y_up = number % 8 < 4, closed = grid.periodic() == Periodic::none && number % 16 < 8;
    PixelMap map(bounds, grid, y_up, closed);
    map.repeat(grid.periodic(), bounds);
    for (int i = 0; i < 20; ++i) {
      const std::int64_t x = below(1000) - 500, y = below(1000) - 500;
      const std::int64_t in_x = grid.periodic_x() ? brought_into(x, bounds.x0, bounds.x1) : x;
      const std::int64_t in_y = grid.periodic_y() ? brought_into(y, bounds.y0, bounds.y1) : y;
      std::int64_t column = floor_of((in_x - bounds.x0) * grid.width(), bounds.x1 - bounds.x0);
      std::int64_t row = floor_of((in_y - bounds.y0) * grid.height(), bounds.y1 - bounds.y0);
      if (closed && x == bounds.x1) column = grid.width() - 1;
      if (closed && y == bounds.y1) row = grid.height() - 1;
      if (y_up) row = grid.height() - 1 - row;
      const Point data = {static_cast<double>(x), static_cast<double>(y)}, found = map.pixel(data);
      BOOST_TEST(found.x == static_cast<double>(column) + 0.5);
      BOOST_TEST(found.y == static_cast<double>(row) + 0.5);
      const bool outside = in_x < bounds.x0 || in_x > bounds.x1 || in_y < bounds.y0 || in_y > bounds.y1;
      BOOST_TEST(map.is_outside(data) == outside);
    }
  }
}

// A zoom into a period, in whole pixels on both sides: points come into it, and so does the domain.
BOOST_AUTO_TEST_CASE(a_window_knows_where_its_period_lies) {
  std::mt19937 rng(4);
  const auto below = [&](int end) { return static_cast<std::int64_t>(rng() % static_cast<unsigned>(end)); };
  for (int number = 0; number < 500; ++number) {
    const std::int64_t scale = 1 + below(7), x0 = below(40), y0 = below(40);  // pixels per unit
    const Units box = {0, 0, 60 + below(40), 60 + below(40)};
    const Units window = {x0, y0, x0 + 1 + below(20), y0 + 1 + below(20)};
    const Grid grid((window.x1 - window.x0) * scale, (window.y1 - window.y0) * scale);
    const auto axes = static_cast<Periodic>(1 + number % 3);
    const bool y_up = number % 2 == 0;
    PixelMap map(window, grid, y_up, false);
    BOOST_TEST(!map.domain().has_value());
    map.repeat(axes, box);
    const Domain domain = map.domain().value();
    BOOST_TEST((domain.periodic == axes));
    if (has_x(axes)) {
      BOOST_TEST(domain.x == -x0 * scale);
      BOOST_TEST(domain.width == box.x1 * scale);
    }
    if (has_y(axes)) {
      BOOST_TEST(domain.y == (y_up ? grid.height() - (box.y1 - y0) * scale : -y0 * scale));
      BOOST_TEST(domain.height == box.y1 * scale);
    }
    for (int i = 0; i < 20; ++i) {
      const std::int64_t x = below(400) - 200, y = below(400) - 200;
      const Point found = map.pixel({static_cast<double>(x), static_cast<double>(y)});
      const std::int64_t in_x = has_x(axes) ? brought_into(x, 0, box.x1) : x;
      const std::int64_t in_y = has_y(axes) ? brought_into(y, 0, box.y1) : y;
      const std::int64_t row = (in_y - y0) * scale;
      BOOST_TEST(found.x == static_cast<double>((in_x - x0) * scale) + 0.5);
      BOOST_TEST(found.y == static_cast<double>(y_up ? grid.height() - 1 - row : row) + 0.5);
    }
  }
}

// Ten pixels for a period of 10.3: positions are scaled to them about the middle, which stays where it is.
BOOST_AUTO_TEST_CASE(a_period_is_rounded_to_whole_pixels) {
  PixelMap map({0, 0, 20, 20}, Grid(20, 20), false, false);
  map.repeat(Periodic::x, {0, 0, 10.3, 20});
  BOOST_TEST(map.domain()->width == 10);
  BOOST_TEST((pixel(map, 5.14, 0) == std::pair(5.5, 0.5)));
  BOOST_TEST((pixel(map, 9.1, 0) == std::pair(8.5, 0.5)));   // at 8.985
  BOOST_TEST((pixel(map, 10.2, 0) == std::pair(0.5, 0.5)));  // at 10.053
  BOOST_TEST((pixel(map, -1.2, 0) == std::pair(8.5, 0.5)));
}

BOOST_AUTO_TEST_CASE(a_period_begins_where_the_bounds_can_use_it) {
  const auto begin = [](double low, double high) {
    PixelMap map({0.1, 0, 0.4, 1}, Grid(3, 10), false, false);
    map.repeat(Periodic::x, {low, 0, high, 1});
    return std::pair(map.domain()->x, map.domain()->width);
  };
  BOOST_TEST((begin(0.1, 0.1 + 0.1 + 0.2) == std::pair<std::int64_t, std::int64_t>(0, 3)));
  BOOST_TEST((begin(0.2, 0.5) == std::pair<std::int64_t, std::int64_t>(0, 3)));   // as long as the bounds
  BOOST_TEST((begin(0.0, 0.5) == std::pair<std::int64_t, std::int64_t>(-1, 5)));  // holds them
  BOOST_TEST((begin(-0.3, 0.3) == std::pair<std::int64_t, std::int64_t>(0, 6)));  // longer, and crosses them
  BOOST_TEST((begin(0.2, 0.3) == std::pair<std::int64_t, std::int64_t>(1, 1)));   // within them
  BOOST_TEST((begin(7.0, 7.2) == std::pair<std::int64_t, std::int64_t>(0, 2)));   // somewhere else
}

BOOST_AUTO_TEST_CASE(rounding_at_the_borders) {
  const Bounds world = {0, 0, 360, 180};
  const PixelMap map(world, Grid(1440, 720), false, true);
  BOOST_TEST((pixel(map, std::nextafter(360.0, 0.0), 90) == std::pair(1439.5, 360.5)));
  BOOST_TEST((pixel(PixelMap({-2, 2, -1, 2}, Grid(10, 5), false, true), -1.5, 2) == std::pair(5.5, 2.5)));
  // 5.1 * 100 is a little less than 510, and 5.1 / 10 * 100 is 51: the order of operations matters.
  BOOST_TEST((pixel(PixelMap({0, 0, 10, 1}, Grid(100, 1), false, true), 5.1, 0) == std::pair(50.5, 0.5)));
  const PixelMap round_the_world = periodic_map({-180, -90, 180, 90}, Grid(360, 180, Periodic::x), false);
  BOOST_TEST((pixel(round_the_world, 180, 0) == std::pair(0.5, 90.5)));  // the period begins again
  BOOST_TEST((pixel(round_the_world, std::nextafter(-180.0, -181.0), 0) == std::pair(359.5, 90.5)));
  const double column = round_the_world.pixel({1e300, 0}).x;
  BOOST_TEST((column >= 0.5 && column <= 359.5));
}

BOOST_AUTO_TEST_CASE(bounds_without_a_scale_are_refused) {
  const auto map = [](const Bounds& bounds, const Grid& grid) { PixelMap(bounds, grid, false, true); };
  const double nan = std::nan("");
  check_error([&] { map({0, 0, nan, 1}, Grid(9, 9)); }, {"0,0,nan,1", "x0 <= x1"});
  check_error([&] { map({1, 0, 0, 1}, Grid(9, 9)); }, {"1,0,0,1", "x0 <= x1"});
  check_error([&] { map({0, 1, 1, 0}, Grid(9, 9)); }, {"0,1,1,0", "y0 <= y1"});
  check_error([&] { map({0, 0, 1e308, 1}, Grid(9, 9)); }, {"too far apart"});
  check_error([&] { map({0, 0, 1e-320, 1}, Grid(9, 9)); }, {"too near"});
  check_error([&] { map({1, 0, 1, 2}, Grid(9, 9, Periodic::xy)); }, {"no extent in x", "periodic"});
  check_error([&] { map({1, 0, 2, 0}, Grid(9, 9, Periodic::y)); }, {"no extent in y", "periodic"});
  PixelMap zoom({0, 0, 1000, 1000}, Grid(9, 9), false, false);
  check_error(
      [&] {
        zoom.repeat(Periodic::y, {0, 0, 1000, 55});
      },
      {"period in y is 55", "less than a pixel"});
}
