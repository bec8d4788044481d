// The map from data units to pixels, and the grids that it is to.
#define BOOST_TEST_MODULE bounds
#include <cmath>
#include <limits>

#include "app/options/option_groups.hpp"
#include "app/sources/bounds.hpp"
#include "app/sources/mapping.hpp"
#include "fixture.hpp"
#include "run_command.hpp"

using namespace vorocl;
using namespace vorocl::command;

namespace {

using Pairs = std::vector<std::pair<double, double>>;

Pairs pairs_of(const std::vector<Point>& points) {
  return transformed(points, [](const Point& point) { return std::pair(point.x, point.y); });
}

/// Bounds outside which no point may be.
Mapping refusing(const Bounds& bounds, bool y_up = false) {
  Mapping mapping;
  mapping.bounds = bounds;
  mapping.y_up = y_up;
  mapping.outside = Outside::refuse;
  return mapping;
}

/// Column and row of one point.
Pairs pixel(const Point& point, const Bounds& bounds, const Grid& grid, bool y_up = false) {
  Mapping mapping = refusing(bounds, y_up);
  mapping.periodic = grid.periodic();
  return pairs_of(map_points({point}, mapping, Size(grid)).places);
}

}  // namespace

BOOST_AUTO_TEST_CASE(bounds_map_to_pixels) {
  const Bounds world = {0, 0, 360, 180};
  const Grid grid(1440, 720);
  BOOST_TEST((pixel({0, 0}, world, grid) == Pairs{{0.5, 0.5}}));
  BOOST_TEST(
      (pixel({360, 180}, world, grid) == Pairs{{1439.5, 719.5}}));  // the far side belongs to the bounds
  BOOST_TEST((pixel({90, 180}, world, grid, true) == Pairs{{360.5, 0.5}}));
}

BOOST_AUTO_TEST_CASE(points_wrap_along_periodic_axes) {
  const Bounds world = {-180, -90, 180, 90};
  const Grid grid(360, 180, Axes::x);
  BOOST_TEST((pixel({180, 0}, world, grid) == Pairs{{0.5, 90.5}}));  // the period begins again
  BOOST_TEST((pixel({-180, 90}, world, grid, true) == Pairs{{0.5, 0.5}}));
  check_error([&] { pixel({0, 91}, world, grid); }, {"(0, 91)", "outside the bounds"});
}

BOOST_AUTO_TEST_CASE(a_period_is_scaled_to_whole_pixels_where_it_is) {
  // 7.4 pixels, from 3.3 to 10.7, become the 7 from 3 on: a position is where it was, but for 0.2 at the
  // ends.
  Mapping mapping;
  mapping.bounds = {0, 0, 20, 1};
  mapping.periodic = Axes::x;
  mapping.domain = Bounds{3.3, 0, 10.7, 1};
  for (int i = 0; i < 740; ++i) {
    const double x = 3.3 + 0.01 * i;
    const MappedPoints mapped = map_points({{x, 0.5}, {x + 7.4, 0.5}, {x - 14.8, 0.5}}, mapping, Size(20, 1));
    BOOST_TEST((mapped.view.window == Window(Grid(7, 1, Axes::x))));
    BOOST_TEST(mapped.view.x == 3);
    const double scaled = 7 + (x - 7) * 7 / 7.4;
    const double column = std::floor(scaled) < 3 ? 9 : std::floor(scaled) > 9 ? 3 : std::floor(scaled);
    if (std::abs(scaled - std::round(scaled)) < 1e-6) continue;  // on the border of a pixel
    for (const Point& place : mapped.places) BOOST_TEST(place.x + 3 == column + 0.5, x);
  }
  BOOST_TEST(map_points({{5, 0.5}}, mapping, Size(20, 1)).view.units.of_length() == std::string("data"));
}

BOOST_AUTO_TEST_CASE(a_picture_shows_as_much_of_a_period_as_it_has_room_for) {
  Mapping mapping;
  mapping.periodic = Axes::x;
  mapping.domain = Bounds{0, 0, 10, 4};
  struct Case {
    double from, to;    // of the bounds
    int first, pixels;  // of the diagram, in the picture
  };
  for (const Case& c : {Case{2, 7, 0, 5},
                        {2, 12, 0, 10},
                        {2, 13, 0, 10},
                        {8, 20, 0, 10},
                        {10, 22, 0, 10},
                        {18, 30, 0, 10},
                        {-2, 12, 2, 10},
                        {0, 10, 0, 10},
                        {0, 20, 0, 10},
                        {-7, 18, 7, 10},
                        {-8, 3, 0, 10},
                        {-30, -18, 0, 10}}) {
    mapping.bounds = {c.from, 0, c.to, 4};
    const auto width = static_cast<int>(c.to - c.from);
    const MappedPoints mapped = map_points({{1, 1}, {4, 2}, {7, 3}}, mapping, Size(width, 4));
    BOOST_TEST_CONTEXT("bounds from " << c.from << " to " << c.to) {
      BOOST_TEST(mapped.view.x == c.first);
      BOOST_TEST(mapped.view.size().width() == c.pixels);
      BOOST_TEST(mapped.outside == (c.pixels == 10 ? 0u : 2u));
      // Wherever they end along the other axis.
      mapping.bounds.y0 = 2;
      const View part = map_points({{1, 1}, {4, 2}, {7, 3}}, mapping, Size(width, 2)).view;
      BOOST_TEST(part.x == c.first);
      BOOST_TEST(part.size().width() == c.pixels);
    }
  }
}

BOOST_AUTO_TEST_CASE(a_period_that_the_picture_holds_stays_in_it_when_it_is_rounded) {
  Mapping mapping;
  mapping.periodic = Axes::x;
  mapping.bounds = {0, 0, 12, 12};
  for (const double first : {0.4, 0.5, 1.4, 1.5, 1.6}) {
    mapping.domain = Bounds{first, 0, 12, 12};
    const View view = map_points({{5, 5}}, mapping, Size(12, 12)).view;
    BOOST_TEST(view.window.is_whole());
    BOOST_TEST(view.x + view.size().width() <= 12);
  }
}

BOOST_AUTO_TEST_CASE(units_are_those_of_the_data) {
  Mapping mapping;
  mapping.bounds = {0, 0, 4, 2};
  const auto units = [&](const Size& picture) { return map_points({}, mapping, picture).view.units; };
  BOOST_TEST(units(Size(8, 4)).area(12) == 3);
  BOOST_TEST(units(Size(8, 4)).length(3) == 1.5);
  BOOST_TEST(units(Size(8, 4)).of_area() == std::string("data"));
  // Pixels of 1 by 1/2: a length has no single scale.
  BOOST_TEST(units(Size(4, 4)).area(12) == 6);
  BOOST_TEST(units(Size(4, 4)).length(3) == 3);
  BOOST_TEST(units(Size(4, 4)).of_length() == std::string("px"));
  mapping.in_pixels = true;
  BOOST_TEST(units(Size(8, 4)).area(12) == 12);
  BOOST_TEST(units(Size(8, 4)).of_area() == std::string("px"));
  mapping.in_pixels = false;
  mapping.bounds = {0, 0, 4, 0};  // an axis without an extent
  BOOST_TEST(units(Size(8, 4)).of_area() == std::string("px"));
  // A period of 7.4 pixels has 7, which are longer.
  mapping.bounds = {0, 0, 20, 1};
  mapping.periodic = Axes::x;
  mapping.domain = Bounds{3.3, 0, 10.7, 1};
  BOOST_TEST(units(Size(20, 1)).area(7) == 7.4, boost::test_tools::tolerance(1e-12));
}

BOOST_AUTO_TEST_CASE(points_outside_are_named) {
  const double none = std::numeric_limits<double>::quiet_NaN(), far = std::numeric_limits<double>::infinity();
  const auto map = [](const Point& bad) {
    map_points({{0, 0}, {1, 1}, bad}, refusing({0, 0, 2, 1}), Size(4, 2));
  };
  check_error([&] { map({2.5, 1}); }, {"point 2", "(2.5, 1)", "outside the bounds 0,0,2,1"});
  check_error([&] { map({1, -0.001}); }, {"point 2", "(1, -0.001)", "outside"});
  check_error([&] { map({none, 1}); }, {"point 2", "(nan, 1)", "not finite"});
  check_error([&] { map({1, -far}); }, {"point 2", "(1, -inf)", "not finite"});
  check_error([&] { bounding_box({{0, 0}, {far, 0}}); }, {"point 1", "(inf, 0)", "not finite"});
}

BOOST_AUTO_TEST_CASE(the_bounding_box_holds_all_points) {
  const Bounds box = bounding_box({{3, 4}, {-1, 7}, {2, -5}});
  BOOST_TEST(to_string(box) == "-1,-5,3,7");
}

BOOST_AUTO_TEST_CASE(a_margin_is_bounds_that_are_wider) {
  const TemporaryFolder folder;
  folder.file("p.csv", "x,y\n10,4\n30,8\n20,9\n");
  const std::string points = " --points p.csv ", cells = "--cells m.csv ";
  const auto table = [&](const std::string& command) {
    BOOST_TEST(run(folder, command).exit_code == 0);
    return content_of(folder / "m.csv");
  };
  for (const std::string& command : {"cells --width 40" + points + cells, "cells --exact" + points + cells,
                                     "tiles --size 48x18" + points + cells}) {
    const std::string expected = table(command + "--bounds=8,2,32,11");
    BOOST_TEST(table(command + "--margin 10") == expected);
    BOOST_TEST(table(command) != expected);
    refuses(folder, command + "--margin 1 --bounds 0,0,40,40", usage, {"--margin", "--bounds"});
  }
  refuses(folder, "cells --size 9x9x9" + points + cells + "--margin 1", usage, {"--margin", "volumes"});
  refuses(folder, "cells --random 9 --size 9x9 --margin 1 " + cells, usage, {"--margin", "--points"});
}

BOOST_AUTO_TEST_CASE(bounds_are_four_numbers) {
  BOOST_TEST(to_string(parse_bounds("-180,-90, 180,9e1")) == "-180,-90,180,90");
  for (const char* bad :
       {"", "1,2,3", "1,2,3,4,5", "1,2,3,", "a,2,3,4", "3,0,2,1", "0,3,1,2", "0,0,nan,1", "0,0,inf,1"}) {
    check_error([&] { parse_bounds(bad); }, {bad, "X0,Y0,X1,Y1"});
  }
}

BOOST_AUTO_TEST_CASE(a_width_makes_pixels_square) {
  BOOST_TEST((size_of_width({0, 0, 360, 180}, 1440) == Size(1440, 720)));
  BOOST_TEST((size_of_width({0, 0, 3, 2}, 100) == Size(100, 67)));
  BOOST_TEST((size_of_width({0, 0, 3, 0}, 100) == Size(100, 1)));
  check_error([] { size_of_width({0, 0, 0, 1}, 100); }, {"no width", "--size"});
  check_error([] { size_of_width({0, 0, 1, 1000}, 100); }, {"100000", "32768"});
  for (const int width : {1, 7, 100, 101}) {
    for (const double height : {0.1, 1.0, 1.7, 33.3}) {
      const Bounds bounds = {0, 0, 3, height};
      const double rows = width * height / 3, rounded = std::max(1.0, std::round(rows));
      BOOST_TEST(has_square_pixels(bounds, size_of_width(bounds, width).grid()) ==
                     (std::max(rows / rounded, rounded / rows) <= 1.05),
                 width << " " << height);
    }
  }
  BOOST_TEST(!has_square_pixels({0, 0, 360, 180}, Grid(1440, 721)));
  BOOST_TEST(!has_square_pixels({0, 0, 1, 1}, Grid(100, 50)));
  BOOST_TEST(!has_square_pixels({0, 0, 1000, 10}, Grid(20, 1)));
  BOOST_TEST(!has_square_pixels({0, 0, 1000, 25}, Grid(100, 3)));
  BOOST_TEST(has_square_pixels({0, 0, 0, 1}, Grid(100, 50)));
}

BOOST_AUTO_TEST_CASE(sizes_are_width_x_height) {
  BOOST_TEST((parse_grid("1440x720") == Grid(1440, 720)));
  for (const char* bad : {"", "10", "x", "10x", "x10", "10x10x10", "10X10", "1e3x10", "10.5x10", "ax10"}) {
    check_error([&] { parse_grid(bad); }, {"WxH"});
  }
  check_error([] { parse_grid("0x10"); }, {"width is 0"});
  check_error([] { parse_grid("10x-1"); }, {"height is -1"});
  check_error([] { parse_grid("32769x10"); }, {"32769", "32768"});
}
