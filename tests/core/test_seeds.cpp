// Seeds: points of the host's, where they lie, how they move, and random numbers against the published known
// answers.
#define BOOST_TEST_MODULE seeds
#include <array>
#include <cmath>
#include <limits>
#include <random>

#include "brute_force.hpp"
#include "fixture.hpp"

using namespace vorocl;

namespace {

const double not_a_number = std::numeric_limits<double>::quiet_NaN();
const double infinity = std::numeric_limits<double>::infinity();

using SomePoints = std::vector<std::optional<Point>>;

bool same(const SomePoints& a, const SomePoints& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](const std::optional<Point>& p, const std::optional<Point>& q) {
                      return p.has_value() == q.has_value() && (!p || (p->x == q->x && p->y == q->y));
                    });
}

/// Philox-4x32-10 as published (Salmon et al. 2011), in 64-bit products: another form than the kernel's.
std::array<std::uint32_t, 4> philox(std::array<std::uint32_t, 4> c, std::array<std::uint32_t, 2> k) {
  for (int round = 0; round < 10; ++round) {
    const std::uint64_t p0 = std::uint64_t{0xd2511f53} * c[0], p1 = std::uint64_t{0xcd9e8d57} * c[2];
    c = {static_cast<std::uint32_t>(p1 >> 32) ^ c[1] ^ k[0], static_cast<std::uint32_t>(p1),
         static_cast<std::uint32_t>(p0 >> 32) ^ c[3] ^ k[1], static_cast<std::uint32_t>(p0)};
    k = {k[0] + 0x9e3779b9u, k[1] + 0xbb67ae85u};
  }
  return c;
}

}  // namespace

BOOST_AUTO_TEST_CASE(points_are_snapped_to_the_pixel_that_contains_them) {
  const SomePoints points = {Point{0, 0}, Point{9.999, 7.999}, Point{3.0, 2.999}, Point{0.5, 5}};
  const Seeds seeds(test_device(), Grid(10, 8), points, to_centres);
  BOOST_TEST(same(seeds.read(), points));
  const SomePoints centres = {Point{0.5, 0.5}, Point{9.5, 7.5}, Point{3.5, 2.5}, Point{0.5, 5.5}};
  BOOST_TEST(same(seeds.read_pixels(), centres));
}

BOOST_AUTO_TEST_CASE(bad_points_are_named) {
  const Grid grid(10, 8);
  const auto seeds_with = [&](Point bad) {
    Seeds(test_device(), grid, {{1, 1}, {2, 2}, bad, bad}, to_centres);
  };
  check_error([&] { seeds_with({not_a_number, 1}); }, {"point 2", "nan", "not finite"});
  check_error([&] { seeds_with({1, infinity}); }, {"point 2", "inf", "not finite"});
  check_error([&] { seeds_with({1e300, 1}); }, {"point 2", "too far away", "2^31"});
  BOOST_CHECK_NO_THROW(seeds_with({10, 1}));  // it counts
}

// Whatever views them, they are the same seeds.
BOOST_AUTO_TEST_CASE(views_of_points) {
  struct Particle {
    float mass;
    double y, x;
  };
  const Grid grid(20, 10);
  const std::vector<Point> points = {{1, 1}, {2.5, 9}, {3, 3}};
  const SomePoints expected = {points[0], points[1], points[2]};
  const std::vector<Particle> particles = {{1, 1, 1}, {1, 9, 2.5}, {1, 3, 3}};
  const std::vector<double> columns = {3, 2.5, 1, 3, 9, 1};
  const auto stride = static_cast<std::ptrdiff_t>(sizeof(double));
  for (const Points& view : {Points(points), Points(points.data(), 3), Points(expected),
                             Points(&particles[0].x, &particles[0].y, 3, sizeof(Particle)),
                             Points(&columns[2], &columns[5], 3, -stride)}) {
    BOOST_TEST(same(Seeds(test_device(), grid, view, to_centres).read(), expected));
    Seeds moved(test_device(), grid, {{7, 7}}, to_centres);
    moved.move_to(view);
    BOOST_TEST(same(moved.read(), expected));
    BOOST_TEST(moved.size() == 3u);
  }
  BOOST_TEST(
      same(Seeds(test_device(), grid, Points(columns.data(), columns.data() + 3, 3), to_centres).read(),
           {Point{3, 3}, Point{2.5, 9}, Point{1, 1}}));
}

BOOST_AUTO_TEST_CASE(points_in_braces) {
  const Grid grid(20, 10);
  BOOST_TEST(Seeds(test_device(), grid, {}, to_centres).size() == 0u);
  const Seeds one(test_device(), grid, {{1, 1}}, to_centres);
  BOOST_TEST(one.size() == 1u);
  BOOST_TEST(points_of(one).front().y == 1);
  BOOST_TEST(Seeds(test_device(), grid, {Point{1, 1}, Point{2, 2}}, to_centres).alive() == 2u);
  BOOST_TEST(Seeds(test_device(), grid, {{25, 1}, {2, 2}}, {Outside::absent, Snap::to_pixels}).alive() == 1u);
  Seeds seeds(test_device(), grid, {{1, 1}, {2, 2}, {3, 3}}, to_centres);
  seeds.move_to(std::vector<Point>{{4, 4}, {5, 5}});
  BOOST_TEST(centres_of(seeds)[1].x == 5.5);
  seeds.move_to({{6, 6}});
  BOOST_TEST(seeds.size() == 1u);
  BOOST_TEST(centres_of(seeds).front().x == 6.5);
  seeds.move_to({{6, 6}, {1, 7}});
  BOOST_TEST(centres_of(seeds)[1].y == 7.5);
  seeds.move_to({Point{7, 7}, Point{8, 8}, Point{9, 9}});
  BOOST_TEST(seeds.alive() == 3u);
  seeds.move_to({});
  BOOST_TEST(seeds.size() == 0u);
}

// The two ways to say that a point is absent. Buffers have a third one.
BOOST_AUTO_TEST_CASE(absent_seeds) {
  const Grid grid(20, 10);
  const SomePoints points = {Point{3, 4}, std::nullopt, Point{15, 5}, std::nullopt};
  const std::vector<Point> values = {{3, 4}, {not_a_number, 0}, {15, 5}, {1e300, 1}};
  const std::vector<std::uint8_t> marks = {1, 0, 255, 0};
  const Points marked = Points(values).marked(marks.data());
  Seeds moved(test_device(), grid, {{1, 1}, {2, 2}, {3, 3}, {4, 4}}, to_centres);
  moved.move_to(points);
  const Seeds constructed(test_device(), grid, points, to_centres),
      of_marks(test_device(), grid, marked, to_centres);
  for (const Seeds* const seeds : {&constructed, &std::as_const(moved), &of_marks}) {
    BOOST_TEST(seeds->size() == 4u);
    BOOST_TEST(seeds->alive() == 2u);
    BOOST_TEST(same(seeds->read(), points));
    Diagram diagram(test_device(), grid);
    exact_diagram(*seeds, diagram);
    const Pixel nowhere = {100000, 100000};
    BOOST_TEST((diagram.read() == brute_force(grid, {{3, 4}, nowhere, {15, 5}, nowhere}, Metric::euclidean)));
  }
  const std::vector<std::uint8_t> other_marks = {0, 1, 1, 1};
  moved.move_to(Points(points).marked(other_marks.data()));  // absent if either says so
  BOOST_TEST(moved.alive() == 1u);
  BOOST_TEST(moved.read()[2].has_value());
}

// Points in degrees: their seeds are those of their pixels, round the world.
BOOST_AUTO_TEST_CASE(points_in_units_of_the_data) {
  const Grid grid(Axis(72, -180, 180).periodic(), Axis(37, -90, 90).reversed().closed());
  std::mt19937 rng(1);
  std::uniform_real_distribution<double> degrees(-900, 900), latitude(-90, 90);
  std::vector<Point> points = {{180, 90}, {-180, -90}, {540, 0}};
  for (int i = 0; i < 200; ++i) points.push_back({degrees(rng), latitude(rng)});
  const Seeds seeds(test_device(), grid, points, {Outside::refuse, Snap::to_pixels});
  const std::vector<Point> as_given = points_of(seeds), centres = centres_of(seeds);
  BOOST_REQUIRE(centres.size() == points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    BOOST_TEST(as_given[i].x == points[i].x);
    BOOST_TEST(as_given[i].y == points[i].y);
    BOOST_TEST(centres[i].x == grid.x().pixel(points[i].x) + 0.5);
    BOOST_TEST(centres[i].y == grid.y().pixel(points[i].y) + 0.5);
  }
  BOOST_TEST(seeds.outside() == 0u);
  Diagram diagram(test_device(), grid);
  exact_diagram(seeds, diagram);
  BOOST_TEST((diagram.read() == brute_force(Grid(72, 37, Axes::x), pixels_of(centres), Metric::euclidean)));
}

BOOST_AUTO_TEST_CASE(points_outside_the_grid) {
  const Grid grid(20, 10, Axes::y);
  const std::vector<Point> points = {{1, 1}, {-0.5, 3}, {19.9, -3}, {20, 25}};
  const Seeds counted(test_device(), grid, points, to_centres);
  BOOST_TEST(counted.alive() == 4u);
  BOOST_TEST(counted.outside() == 2u);
  const SomePoints centres = {Point{1.5, 1.5}, Point{-0.5, 3.5}, Point{19.5, 7.5}, Point{20.5, 5.5}};
  BOOST_TEST(same(counted.read_pixels(), centres));
  Diagram diagram(test_device(), grid);
  exact_diagram(counted, diagram);
  BOOST_TEST((diagram.read() == brute_force(grid, {{1, 1}, {-1, 3}, {19, 7}, {20, 5}}, Metric::euclidean)));

  Seeds some(test_device(), grid, points, {Outside::absent, Snap::to_pixels});
  BOOST_TEST(some.size() == 4u);
  BOOST_TEST(some.alive() == 2u);
  BOOST_TEST(some.outside() == 0u);
  BOOST_TEST(same(some.read(), {points[0], std::nullopt, points[2], std::nullopt}));
  some.move_to({{1, 1}, {5, 5}, {-7, 2}});  // for all frames
  BOOST_TEST(same(some.read_pixels(), {Point{1.5, 1.5}, Point{5.5, 5.5}, std::nullopt}));
  check_error([&] { some.move_to({{1, 1}, {not_a_number, 5}}); }, {"point 1", "not finite"});

  check_error(
      [&] {
        Seeds(test_device(), grid, points, {Outside::refuse, Snap::to_pixels});
      },
      {"point 1 (-0.5", "outside the grid", "[0, 20)"});
  Seeds all(test_device(), grid, {{1, 1}, {2, 2}}, {Outside::refuse, Snap::to_pixels});
  check_error([&] { all.move_to({{3, 3}, {20, 2}}); }, {"point 1 (20", "outside the grid"});
  BOOST_TEST(same(all.read(), {Point{1, 1}, Point{2, 2}}));  // where they were
  const Grid closed(Axis(20).closed(), Axis(10));
  BOOST_TEST(centres_of(Seeds(test_device(), closed, {{20, 2}}, {Outside::refuse, Snap::to_pixels}))[0].x ==
             19.5);
}

BOOST_AUTO_TEST_CASE(seeds_on_another_grid) {
  const Grid small(20, 10), large(Axis(60, 0, 30).periodic(), Axis(40, 0, 20));
  Seeds seeds(test_device(), small, {{1, 1}, {19, 9}}, to_centres);
  const std::vector<Point> points = {{1, 1}, {19, 9}, {31, 19}};
  Diagram of_small(test_device(), small), of_large(test_device(), large);
  exact_diagram(seeds, of_small);
  seeds.move_to(large, points);
  BOOST_TEST((seeds.grid() == large));
  BOOST_TEST(same(seeds.read_pixels(), {Point{2.5, 2.5}, Point{38.5, 18.5}, Point{2.5, 38.5}}));
  exact_diagram(seeds, of_large);
  BOOST_TEST((of_small.read() == brute_force(small, {{1, 1}, {19, 9}}, Metric::euclidean)));
  BOOST_TEST((of_large.read() ==
              brute_force(Grid(60, 40, Axes::x), {{2, 2}, {38, 18}, {2, 38}}, Metric::euclidean)));
  check_error([&] { exact_diagram(seeds, of_small); }, {"20 x 10", "60 x 40"});
  check_error([&] { seeds.move_to(small, std::vector<Point>{{infinity, 1}}); }, {"point 0"});
  BOOST_TEST((seeds.grid() == large));
  BOOST_TEST(seeds.size() == 3u);
}

BOOST_AUTO_TEST_CASE(the_greatest_way_of_a_seed) {
  std::mt19937 rng(2);
  for (const Axes axes : {Axes::none, Axes::x, Axes::xy}) {
    const Grid grid(41, 30, axes);
    Seeds seeds(test_device(), grid, {}, to_centres);
    SomePoints before;
    BOOST_TEST(seeds.displacement() == 0);
    for (int frame = 0; frame < 30; ++frame) {
      SomePoints now(rng() % 8);
      for (std::optional<Point>& point : now) {
        if (rng() % 4 != 0)
          point = {static_cast<int>(rng() % 90) - 20.25, static_cast<int>(rng() % 90) - 20.25};
      }
      seeds.move_to(now);
      const SomePoints after = seeds.read_pixels();
      double greatest = 0;
      for (std::size_t id = 0; id < std::min(before.size(), after.size()); ++id) {
        if (!before[id] || !after[id]) continue;
        double dx = std::abs(after[id]->x - before[id]->x), dy = std::abs(after[id]->y - before[id]->y);
        if (has_x(axes)) dx = std::min(dx, 41 - dx);
        if (has_y(axes)) dy = std::min(dy, 30 - dy);
        greatest = std::max({greatest, dx, dy});
      }
      BOOST_TEST(seeds.displacement() == greatest);
      before = after;
    }
  }
  Seeds walking = Seeds::random(test_device(), Grid(64, 64), 50, 1);
  BOOST_TEST(walking.displacement() == 0);
  random_step(walking, 3, Border::reflect, 1, 1);
  BOOST_TEST(walking.displacement() == 3);
}

BOOST_AUTO_TEST_CASE(a_clone_moves_on_its_own) {
  const Grid grid(20, 10);
  const SomePoints points = {Point{3, 4}, std::nullopt, Point{15, 5}};
  Seeds seeds(test_device(), grid, points, to_centres);
  Seeds copy = seeds.clone();
  seeds.move_to({Point{1, 1}, Point{2, 2}, Point{3, 3}, Point{4, 4}});
  random_step(seeds, 3, Border::reflect, 1, 1);
  BOOST_TEST(copy.size() == 3u);
  BOOST_TEST(copy.alive() == 2u);
  BOOST_TEST(copy.read_pixels()[2]->x == 15.5);
  copy.move_to({Point{9, 9}});
  BOOST_TEST(seeds.alive() == 4u);
  const Seeds taken = std::move(seeds);
  BOOST_TEST(taken.size() == 4u);
  // NOLINTNEXTLINE(bugprone-use-after-move,clang-analyzer-cplusplus.Move)
  check_error([&] { seeds.size(); }, {"moved from"});
}

BOOST_AUTO_TEST_CASE(philox_has_its_published_answers) {
  // From the known-answer vectors of Random123, the authors' reference library.
  const auto expect = [](std::array<std::uint32_t, 4> counter, std::array<std::uint32_t, 2> key,
                         std::array<std::uint32_t, 4> answer) { BOOST_TEST(philox(counter, key) == answer); };
  expect({0, 0, 0, 0}, {0, 0}, {0x6627e8d5, 0xe169c58d, 0xbc57ac4c, 0x9b00dbd8});
  expect({0xffffffff, 0xffffffff, 0xffffffff, 0xffffffff}, {0xffffffff, 0xffffffff},
         {0x408f276d, 0x41c83b0e, 0xa20bc7c6, 0x6d5451fd});
  expect({0x243f6a88, 0x85a308d3, 0x13198a2e, 0x03707344}, {0xa4093822, 0x299f31d0},
         {0xd16cfe09, 0x94fdcceb, 0x5001e420, 0x24126ea1});
}

BOOST_AUTO_TEST_CASE(random_seeds_are_philox_numbers) {
  const std::uint64_t rng_seed = 0x123456789abcdef0;
  // The host places those of the second one, whose period is too long for kernels.
  for (const Grid& grid : {Grid(1000, 37), Grid(32500, 37, Axes::x)}) {
    const std::vector<Point> read = points_of(Seeds::random(test_device(), grid, 5000, rng_seed));
    for (std::uint32_t id = 0; id < read.size(); ++id) {
      const auto bits = philox({id, 0, 0, 0}, {0x9abcdef0, 0x12345678});
      BOOST_REQUIRE(read[id].x == static_cast<double>((bits[0] * std::uint64_t(grid.width())) >> 32) + 0.5);
      BOOST_REQUIRE(read[id].y == static_cast<double>((bits[1] * std::uint64_t{37}) >> 32) + 0.5);
    }
  }
  check_error([&] { Seeds::random(test_device(), Grid(32769, 1), 1, 1); },
              {"no larger than a diagram", "32769"});
  for (const std::size_t count : {(std::size_t{1} << 30) + 1, std::size_t{1} << 62,
                                  (std::size_t{1} << 62) + 8, std::size_t{1} << 63, ~std::size_t{0}}) {
    check_error([&] { Seeds::random(test_device(), Grid(8, 6), count, 1); }, {"too many", "2^30"});
    test_device().finish();  // nothing was enqueued
  }
}

BOOST_AUTO_TEST_CASE(random_seeds_are_uniform) {
  // Chi-squared over 8 x 8 blocks: 63 degrees of freedom, and 103.4 is passed by one run in a thousand.
  const Grid grid(512, 512);
  const std::size_t count = 64000;
  std::array<double, 64> blocks{};
  for (const Point& point : points_of(Seeds::random(test_device(), grid, count, 7))) {
    blocks[static_cast<std::size_t>(point.y / 64) * 8 + static_cast<std::size_t>(point.x / 64)] += 1;
  }
  double chi_squared = 0;
  for (const double block : blocks) chi_squared += (block - 1000) * (block - 1000) / 1000;
  BOOST_TEST(chi_squared < 103.4);
  BOOST_TEST(chi_squared > 30.0);  // and not suspiciously even either
}
