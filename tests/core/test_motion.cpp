// Random motion: borders, and the same numbers everywhere.
#define BOOST_TEST_MODULE motion
#include <algorithm>
#include <cmath>

#include "brute_force.hpp"
#include "fixture.hpp"

using namespace vorocl;

namespace {

std::vector<Point> moved(const Grid& grid, const std::vector<Point>& from, int most, Border border,
                         std::uint32_t frame) {
  Seeds seeds(test_device(), grid, from, to_centres);
  random_step(seeds, most, border, 42, frame);
  return points_of(seeds);
}

}  // namespace

BOOST_AUTO_TEST_CASE(steps_in_the_middle_are_uniform) {
  const Grid grid(1000, 1000);
  const std::size_t count = 70000;
  const std::vector<Point> after =
      moved(grid, std::vector<Point>(count, {500.5, 500.5}), 3, Border::reflect, 1);
  // 7 x 7 equally likely steps: chi-squared with 48 degrees of freedom is above 84 in one run of a thousand.
  std::vector<double> steps(49);
  for (const Point& point : after) {
    const double dx = point.x - 500.5, dy = point.y - 500.5;
    BOOST_REQUIRE((std::abs(dx) <= 3 && std::abs(dy) <= 3));
    steps[static_cast<std::size_t>((dy + 3) * 7 + dx + 3)] += 1;
  }
  const double expected = static_cast<double>(count) / 49;
  double chi_squared = 0;
  for (const double step : steps) chi_squared += (step - expected) * (step - expected) / expected;
  BOOST_TEST(chi_squared < 84);
  BOOST_TEST(chi_squared > 20);
}

BOOST_AUTO_TEST_CASE(frames_differ_and_repeat) {
  const Grid grid(100, 80);
  const std::vector<Point> from = centres(random_pixels(grid, 200, 1));
  const auto same = [](const std::vector<Point>& a, const std::vector<Point>& b) {
    return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                      [](const Point& p, const Point& q) { return p.x == q.x && p.y == q.y; });
  };
  BOOST_TEST(same(moved(grid, from, 4, Border::reflect, 1), moved(grid, from, 4, Border::reflect, 1)));
  BOOST_TEST(!same(moved(grid, from, 4, Border::reflect, 1), moved(grid, from, 4, Border::reflect, 2)));
  BOOST_TEST(same(moved(grid, from, 0, Border::reflect, 1), from));
}

BOOST_AUTO_TEST_CASE(steps_are_the_same_for_every_vector_width) {
  const Grid grid(30000, 20000);
  const std::vector<Point> from = centres(random_pixels(grid, 1003, 1));
  const auto moved_by = [&](int width) {
    Seeds seeds(test_device().with_tuning({width, 64, 1}), grid, from, to_centres);
    random_step(seeds, 32768, Border::reflect, 0x9e3779b97f4a7c15, 77);
    return points_of(seeds);
  };
  const std::vector<Point> one_by_one = moved_by(1);
  for (const int width : {2, 4, 8, 16}) {
    const std::vector<Point> points = moved_by(width);
    for (std::size_t id = 0; id < points.size(); ++id) {
      BOOST_TEST((points[id].x == one_by_one[id].x && points[id].y == one_by_one[id].y),
                 "width " << width << ", seed " << id);
    }
  }
}

BOOST_AUTO_TEST_CASE(borders_reflect_or_wrap) {
  // The step of a seed in the middle of a large grid, folded by hand into a small one, whatever its length.
  const Grid large(30001, 30001), small(7, 5);
  const std::size_t count = 3000;
  const double middle = 15000.5;
  const auto free = moved(large, std::vector<Point>(count, {middle, middle}), 40, Border::reflect, 3);
  const auto reflected = moved(small, std::vector<Point>(count, {2, 3}), 40, Border::reflect, 3);
  const auto wrapped = moved(small, std::vector<Point>(count, {2, 3}), 40, Border::periodic, 3);
  const auto bounce = [](int at, int size) {
    while (at < 0 || at >= size) at = at < 0 ? -1 - at : 2 * size - 1 - at;
    return at;
  };
  const auto wrap = [](int at, int size) {
    while (at < 0) at += size;
    while (at >= size) at -= size;
    return at;
  };
  for (std::size_t i = 0; i < count; ++i) {
    const int x = 2 + static_cast<int>(free[i].x - middle), y = 3 + static_cast<int>(free[i].y - middle);
    BOOST_REQUIRE(reflected[i].x == bounce(x, 7) + 0.5);
    BOOST_REQUIRE(reflected[i].y == bounce(y, 5) + 0.5);
    BOOST_REQUIRE(wrapped[i].x == wrap(x, 7) + 0.5);
    BOOST_REQUIRE(wrapped[i].y == wrap(y, 5) + 0.5);
  }
}

BOOST_AUTO_TEST_CASE(impossible_steps_are_refused) {
  Seeds seeds(test_device(), Grid(8, 8), {{1, 1}}, to_centres);
  check_error([&] { random_step(seeds, -1, Border::reflect, 1, 1); }, {"displacement of at most -1"});
  check_error([&] { random_step(seeds, 1 << 16, Border::reflect, 1, 1); }, {"displacement of at most 65536"});
  Seeds outside(test_device(), Grid(8, 8), {{1, 1}, {-1, 3}}, to_centres);
  check_error([&] { random_step(outside, 1, Border::reflect, 1, 1); }, {"outside"});
  Seeds far(test_device(), Grid(100000, 8), {{1, 1}}, to_centres);
  check_error([&] { random_step(far, 1, Border::reflect, 1, 1); }, {"100000"});
}

// The numbers are those of pixels, whatever the unit of the data and the way that rows count.
BOOST_AUTO_TEST_CASE(steps_are_in_pixels) {
  const Grid pixels(80, 60, Axes::x);
  const Grid data(Axis(80, -1, 1).periodic(), Axis(60, 0, 30).reversed());
  const std::vector<Pixel> from = random_pixels(pixels, 100, 1);
  Seeds a(test_device(), pixels, centres(from), to_centres);
  Seeds b(test_device(), data,
          transformed(from, [&](const Pixel& pixel) { return data.point(centre(pixel)); }), to_centres);
  BOOST_TEST(a.displacement() == 0);
  random_step(a, 7, Border::reflect, 5, 1);
  random_step(b, 7, Border::reflect, 5, 1);
  BOOST_TEST(a.displacement() == 7);  // its bound
  BOOST_TEST(b.displacement() == 7);
  const auto moved_a = a.read_pixels(), moved_b = b.read_pixels(), points = b.read();
  for (std::size_t id = 0; id < from.size(); ++id) {
    BOOST_TEST((moved_a[id]->x == moved_b[id]->x && moved_a[id]->y == moved_b[id]->y));
    const Point expected = data.point(*moved_a[id]);
    BOOST_TEST((points[id]->x == expected.x && points[id]->y == expected.y));
  }
}

BOOST_AUTO_TEST_CASE(absent_seeds_stay_absent) {
  Seeds seeds(test_device(), Grid(50, 50), {{10, 10}, {20, 20}, {30, 30}}, to_centres);
  seeds.move_to(std::vector<std::optional<Point>>{Point{10, 10}, std::nullopt, Point{30, 30}});
  BOOST_TEST(seeds.alive() == 2u);
  random_step(seeds, 5, Border::reflect, 1, 1);
  const std::vector<std::optional<Point>> points = seeds.read();
  BOOST_TEST(!points[1].has_value());
  BOOST_TEST(points[0].has_value());
}
