// Grids and their windows: limits, and where a window lies.
#define BOOST_TEST_MODULE grid
#include "fixture.hpp"

using namespace vorocl;

namespace {

std::pair<std::int64_t, std::int64_t> corner(const Window& window) { return {window.x(), window.y()}; }

}  // namespace

BOOST_AUTO_TEST_CASE(grids_know_their_axes) {
  const Grid grid(Axis(40, -180, 180).periodic(), Axis(20, -90, 90).reversed());
  BOOST_TEST(grid.width() == 40);
  BOOST_TEST(grid.height() == 20);
  BOOST_TEST(grid.pixels() == 800u);
  BOOST_TEST((grid.periodic() == Axes::x));
  BOOST_TEST(grid.point({0.5, 0.5}).x == -175.5);
  BOOST_TEST(grid.point({0.5, 0.5}).y == 85.5);
  BOOST_TEST((grid == Grid(grid.x(), grid.y())));
  BOOST_TEST((grid != Grid(40, 20, Axes::x)));
  constexpr Axes all[] = {Axes::none, Axes::x, Axes::y, Axes::xy};
  for (const Axes axes : all) {
    const Grid in_pixels(7, 5, axes);
    BOOST_TEST((in_pixels.periodic() == axes));
    BOOST_TEST((in_pixels.x() == (has_x(axes) ? Axis(7).periodic() : Axis(7))));
    BOOST_TEST((in_pixels.y() == (has_y(axes) ? Axis(5).periodic() : Axis(5))));
  }
}

BOOST_AUTO_TEST_CASE(limits_of_a_grid) {
  const std::int64_t most = 2147483647;
  BOOST_TEST(Grid(most, most).pixels() ==
             static_cast<std::uint64_t>(most) * static_cast<std::uint64_t>(most));
  BOOST_TEST(Grid(most, 1, Axes::x).width() == most);
  check_error([] { Grid(0, 5); }, {"0 pixels", "2147483647"});
  check_error([] { Grid(5, -1); }, {"-1 pixels", "2147483647"});
  check_error([] { Grid(1, 1LL << 40); }, {"1099511627776 pixels"});
}

BOOST_AUTO_TEST_CASE(a_grid_is_the_window_that_shows_all_of_it) {
  const Grid grid(3, 7, Axes::y);
  const Window window = grid;
  BOOST_TEST((window.grid() == grid));
  BOOST_TEST(window.width() == 3);
  BOOST_TEST(window.height() == 7);
  BOOST_TEST(window.longest_side() == 7);
  BOOST_TEST(window.pixels() == 21u);
  BOOST_TEST(window.is_whole());
  BOOST_TEST((window.periodic() == Axes::y));
  BOOST_TEST((window == Window(grid, 0, 0, 3, 7)));
  BOOST_TEST((window == Window(grid, 0, -7, 3, 7)));
}

BOOST_AUTO_TEST_CASE(windows_begin_inside_the_period) {
  const Grid grid(10, 8, Axes::x);
  BOOST_TEST((corner({grid, 3, 2, 7, 6}) == std::pair<std::int64_t, std::int64_t>(3, 2)));
  for (const std::int64_t periods : {-300000000, -2, -1, 0, 1, 5}) {
    BOOST_TEST((corner({grid, 10 * periods + 7, 0, 4, 8}) == std::pair<std::int64_t, std::int64_t>(7, 0)));
    BOOST_TEST((Window(grid, 10 * periods, 0, 10, 8) == grid));
  }
  const Window part(grid, 7, 1, 4, 3), turned(grid, 7, 0, 10, 8);
  BOOST_TEST((part.periodic() == Axes::none));
  BOOST_TEST(!part.is_whole());
  BOOST_TEST((part == Window(grid, -3, 1, 4, 3)));
  BOOST_TEST((part != Window(grid, 6, 1, 4, 3)));
  BOOST_TEST((part != Window(Grid(10, 8, Axes::xy), 7, 1, 4, 3)));
  BOOST_TEST((turned.periodic() == Axes::x));  // one whole period, from its eighth column on
  BOOST_TEST(!turned.is_whole());
  BOOST_TEST((Window(grid, 0, 2, 10, 5).periodic() == Axes::x));
  BOOST_TEST((Window(Grid(10, 8, Axes::xy), 0, 2, 10, 5).periodic() == Axes::x));
  BOOST_TEST((Window(Grid(10, 8, Axes::xy), 5, 2, 10, 8).periodic() == Axes::xy));
  BOOST_TEST((Window(Grid(10, 8), 0, 0, 10, 8).periodic() == Axes::none));
}

BOOST_AUTO_TEST_CASE(windows_longer_than_a_period_keep_where_it_lies) {
  const Grid grid(10, 8, Axes::xy);
  const Window around(grid, -4, -3, 25, 20);
  BOOST_TEST((corner(around) == std::pair<std::int64_t, std::int64_t>(-4, -3)));
  BOOST_TEST((around.periodic() == Axes::none));
  BOOST_TEST(!around.is_whole());
  BOOST_TEST(around.pixels() == 500u);
  BOOST_TEST((corner({grid, 24, -27, 25, 20}) == std::pair<std::int64_t, std::int64_t>(4, -3)));
}

BOOST_AUTO_TEST_CASE(windows_outside_the_grid_are_refused) {
  const Grid grid(10, 8, Axes::x);
  check_error([&] { Window(grid, 0, 0, 0, 8); }, {"0 pixels along x", "from 1 to 2147483647"});
  check_error([&] { Window(grid, 0, 0, 4, -1); }, {"-1 pixels along y"});
  check_error([&] { Window(grid, 0, 0, 2147483648, 8); }, {"2147483648 pixels along x"});
  check_error([&] { Window(grid, 0, -1, 4, 4); }, {"4 pixels from y = -1", "8 along that axis", "periodic"});
  check_error([&] { Window(grid, 0, 5, 4, 4); }, {"4 pixels from y = 5"});
  check_error([&] { Window(grid, 0, 0, 4, 9); }, {"9 pixels from y = 0"});
  check_error([&] { Window(grid, 0, INT64_MIN, 4, 4); }, {"from y = -9223372036854775808"});
  check_error([&] { Window(Grid(10, 8), 10, 0, 1, 1); }, {"1 pixels from x = 10"});
}

BOOST_AUTO_TEST_CASE(limits_of_a_diagram) {
  const Grid grid(70000, 70000, Axes::x), wide(70000, 9);
  BOOST_TEST(Diagram(test_device(), {grid, 69999, 69990, 10, 10}).read().size() == 100u);
  check_error([&] { Diagram(test_device(), wide); }, {"width", "is 70000", "from 1 to 32768"});
  check_error([&] { Diagram(test_device(), {grid, 0, 0, 3, 32769}); }, {"height", "is 32769"});
  check_error([&] { jump_flooding_plan(wide); }, {"width", "is 70000"});
  BOOST_TEST((Window::max_pixels == std::uint64_t{32768} * 32768));
}
