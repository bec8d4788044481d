// Windows of a larger plane and of periodic domains: exact diagrams with seeds outside the grid, judged by
// the diagram of the whole plane and by brute force over all images.
#define BOOST_TEST_MODULE window
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>

#include "brute_force.hpp"
#include "window_cases.hpp"

using namespace vorocl;

namespace {

/// Many more cases, for minutes instead of seconds.
const bool long_tests = std::getenv("VOROCL_LONG_TESTS") != nullptr;

/// One of those whose vectors fit in the grid's rows: for others kernels would be built anew.
const Engine& engine_for(const Grid& grid, std::size_t number) {
  while (engines()[number % engines().size()].device.tuning().vector_width > grid.width()) ++number;
  return engines()[number % engines().size()];
}

Labels labels_of(const Engine& engine, const Seeds& seeds, Metric metric) {
  Diagram diagram(engine.device, seeds.grid());
  exact_diagram(seeds, diagram, {metric});
  return diagram.read();
}

std::size_t count_differences(const Labels& a, const Labels& b) {
  BOOST_REQUIRE(a.size() == b.size());
  std::size_t differences = 0;
  for (std::size_t i = 0; i < a.size(); ++i) differences += a[i] != b[i] ? 1 : 0;
  return differences;
}

/// Holds every engine and metric against brute force.
void check_against_brute_force(const Grid& grid, const Domain& domain, const std::vector<PlanePixel>& seeds,
                               const Engine& engine, Metric metric) {
  const Seeds made(engine.device, grid, centres(seeds), domain);
  const std::size_t wrong =
      count_differences(labels_of(engine, made, metric), brute_force(grid, domain, seeds, metric));
  BOOST_TEST(wrong == 0u, text_of(grid, domain, seeds.size())
                              << ", " << engine.name << ", " << name_of(metric) << ": " << wrong << " wrong");
}

/// All kinds of planes.
std::vector<Pixel> seeds_of_plane(const Grid& plane, unsigned kind, unsigned rng_seed) {
  const auto pixels = plane.pixels();
  std::mt19937 rng(rng_seed);
  std::vector<Pixel> seeds;
  switch (kind) {
    case 0:
      return {};
    case 1:
      return random_pixels(plane, 1, rng_seed);
    case 2:
      return random_pixels(plane, 2 + rng_seed % 7, rng_seed);
    case 3:
      return random_pixels(plane, pixels / 1000, rng_seed);
    case 4:
      return random_pixels(plane, pixels / 20, rng_seed);
    case 5: {  // clusters
      std::normal_distribution<double> spread(0, plane.width() / 40.0);
      for (const Pixel& middle : random_pixels(plane, 4, rng_seed)) {
        for (int i = 0; i < 100; ++i) {
          const Pixel at = {static_cast<int>(middle.x + spread(rng)),
                            static_cast<int>(middle.y + spread(rng))};
          if (at.x >= 0 && at.x < plane.width() && at.y >= 0 && at.y < plane.height()) seeds.push_back(at);
        }
      }
      return seeds;
    }
    case 6:  // several on each pixel
      for (int copy = 0; copy < 3; ++copy) {
        for (const Pixel& pixel : random_pixels(plane, 30, rng_seed)) seeds.push_back(pixel);
      }
      return seeds;
    case 7:  // in rows and columns, with many ties
      for (int y = 0; y < plane.height(); y += 10) {
        for (int x = 0; x < plane.width(); x += 10) seeds.push_back({x, y});
      }
      return seeds;
    case 8:  // on the plane's border
      for (int x = 0; x < plane.width(); x += 3) seeds.push_back({x, x % 2 == 0 ? 0 : plane.height() - 1});
      return seeds;
    default:  // on every pixel of a part
      return every_pixel({plane.width() / 3, plane.height() / 3});
  }
}
constexpr unsigned kinds_of_planes = 10;

}  // namespace

BOOST_AUTO_TEST_CASE(windows_are_cut_out_of_the_plane) {
  const unsigned planes = long_tests ? 500 : 50, windows_of_plane = 20;
  std::mt19937 rng(5);
  std::size_t with_outside = 0;
  for (unsigned number = 0; number < planes; ++number) {
    const Grid plane(100 + static_cast<int>(rng() % 200), 100 + static_cast<int>(rng() % 200));
    const std::vector<Pixel> seeds = seeds_of_plane(plane, number % kinds_of_planes, number);
    const Metric metric = both_metrics[number / kinds_of_planes % 2];
    Diagram whole(test_device(), plane);
    exact_diagram(Seeds(test_device(), plane, centres(seeds)), whole, {metric});
    const Labels all = whole.read();
    for (unsigned i = 0; i < windows_of_plane; ++i) {
      const int left = static_cast<int>(rng() % static_cast<unsigned>(plane.width()));
      const int top = static_cast<int>(rng() % static_cast<unsigned>(plane.height()));
      const Grid window(1 + static_cast<int>(rng() % static_cast<unsigned>(plane.width() - left)),
                        1 + static_cast<int>(rng() % static_cast<unsigned>(plane.height() - top)));
      const std::vector<Point> points = transformed(seeds, [&](const Pixel& seed) {
        return centre({seed.x - left, seed.y - top});
      });
      Labels cut;
      for (int y = 0; y < window.height(); ++y) {
        const auto row = all.begin() + std::ptrdiff_t{top + y} * plane.width() + left;
        cut.insert(cut.end(), row, row + window.width());
      }
      const Engine& engine = engine_for(window, rng());
      const Seeds in_window(engine.device, window, points);
      with_outside += in_window.outside() > 0 ? 1 : 0;
      const std::size_t wrong = count_differences(labels_of(engine, in_window, metric), cut);
      BOOST_TEST(wrong == 0u, "plane " << number << ", window " << i << ": " << window.width() << " x "
                                       << window.height() << " at " << left << ", " << top << ", "
                                       << engine.name << ": " << wrong << " wrong");
    }
  }
  BOOST_TEST(with_outside > 15 * planes);
}

BOOST_AUTO_TEST_CASE(far_seeds) {
  std::mt19937_64 rng(6);
  const Grid grid(70, 45);
  for (const std::int64_t reach :
       {std::int64_t{100}, std::int64_t{32600}, std::int64_t{32767}, std::int64_t{32768}, std::int64_t{40000},
        std::int64_t{1} << 20, (std::int64_t{1} << 31) - 1 - 70}) {
    for (unsigned number = 0; number < 20; ++number) {
      const std::int64_t w = grid.width(), h = grid.height();
      std::vector<PlanePixel> seeds;
      if (number % 4 == 0) {  // around, none inside
        seeds = random_plane_pixels(-reach, -reach, w + reach, h + reach, 50, rng);
      } else if (number % 4 == 1) {  // some inside too
        seeds = random_plane_pixels(-reach, -reach, w + reach, h + reach, 300, rng);
        for (const PlanePixel& inside : random_plane_pixels(-5, -5, w, h, 3, rng)) seeds.push_back(inside);
      } else if (number % 4 == 2) {  // as far as can be, on a line
        for (int i = 0; i < 40; ++i)
          seeds.push_back({w - 1 - reach + i / 20, h - reach + static_cast<int>(rng() % 30)});
      } else {  // at nearly one distance from the middle
        for (int i = 0; i < 400; ++i) {
          const double angle = i * 0.0157, radius = static_cast<double>(reach) * 0.99;
          seeds.push_back({w / 2 + std::llround(radius * std::cos(angle)),
                           h / 2 + std::llround(radius * std::sin(angle))});
        }
      }
      check_against_brute_force(grid, {}, seeds, engines()[number % engines().size()],
                                both_metrics[number / 4 % 2]);
    }
  }
}

BOOST_AUTO_TEST_CASE(zooms_into_periodic_domains) {
  std::mt19937_64 rng(7);
  const unsigned cases = long_tests ? 4000 : 400;
  for (unsigned number = 0; number < cases; ++number) {
    const Grid grid(1 + static_cast<int>(rng() % 90), 1 + static_cast<int>(rng() % 90));
    const auto side = [&] { return 1 + static_cast<std::int64_t>(rng() % (number % 3 == 0 ? 30 : 200)); };
    const auto begin = [&] { return static_cast<std::int64_t>(rng() % 200) - 130; };
    const Domain domain = {begin(), begin(), side(), side(), static_cast<Periodic>(1 + number % 3)};
    const std::size_t count = number % 7 == 0 ? 1 : number % 5 == 0 ? 400 : 1 + rng() % 40;
    // Outside the domain too: they wrap.
    const auto seeds = random_plane_pixels(domain.x - 100, domain.y - 100, domain.x + 2 * domain.width,
                                           domain.y + 2 * domain.height, count, rng);
    check_against_brute_force(grid, domain, seeds, engine_for(grid, number), both_metrics[number / 3 % 2]);
  }
}

BOOST_AUTO_TEST_CASE(long_periods) {
  std::mt19937_64 rng(8);
  const Grid grid(50, 40);
  for (const std::int64_t period : {std::int64_t{60000}, std::int64_t{70001}, std::int64_t{1} << 31}) {
    for (const Periodic axes : {Periodic::x, Periodic::y, Periodic::xy}) {
      for (const Engine& engine : engines()) {
        const Domain domain = {-period / 2, -period / 2, period, period, axes};
        const auto seeds =
            random_plane_pixels(-period / 2, -period / 2, period / 2 - 1, period / 2 - 1, 60, rng);
        check_against_brute_force(grid, domain, seeds, engine, Metric::euclidean);
        check_against_brute_force(grid, domain, seeds, engine, Metric::manhattan);
      }
    }
  }
}

// The same plane said in two ways: the other one is a method of its own inside the engine.
BOOST_AUTO_TEST_CASE(a_domain_of_the_grids_size_is_a_periodic_grid) {
  for (const Periodic axes : {Periodic::x, Periodic::y, Periodic::xy}) {
    for (const std::size_t count : {1u, 5u, 100u, 3000u}) {
      const Grid grid(211, 130), periodic(211, 130, axes);
      const std::vector<Point> points = centres(random_pixels(grid, count, 9));
      Diagram expected(test_device(), periodic);
      exact_diagram(Seeds(test_device(), periodic, points), expected);
      for (const Engine& engine : engines()) {
        const Seeds seeds(engine.device, grid, points, {0, 0, 211, 130, axes});
        BOOST_TEST(count_differences(labels_of(engine, seeds, Metric::euclidean), expected.read()) == 0u);
      }
    }
  }
}

BOOST_AUTO_TEST_CASE(seeds_know_where_they_lie) {
  const Grid grid(20, 10);
  Seeds seeds(test_device(), grid,
              std::vector<std::optional<Point>>{Point{-0.5, 3}, std::nullopt, Point{20, 3}, Point{19.9, 3}});
  BOOST_TEST(seeds.alive() == 3u);
  BOOST_TEST(seeds.outside() == 2u);
  const auto read = seeds.read();
  BOOST_TEST(read[0]->x == -0.5);
  BOOST_TEST(!read[1].has_value());
  BOOST_TEST(read[2]->x == 20.5);
  BOOST_TEST(read[3]->x == 19.5);
  const Seeds copy = seeds.clone();
  Diagram of_copy(test_device(), grid), of_seeds(test_device(), grid);
  const Domain domain = {-5, -5, 15, 15, Periodic::xy};
  seeds.move_to(std::vector<Point>{{-6, 12}, {3, 3}}, domain);
  BOOST_TEST(seeds.outside() == 1u);
  BOOST_TEST(seeds.read()[0]->x == 9.5);
  BOOST_TEST(seeds.read()[0]->y == -2.5);
  exact_diagram(copy, of_copy);
  exact_diagram(seeds, of_seeds);
  BOOST_TEST((of_copy.read() ==
              brute_force(grid, {}, {{-1, 3}, {1000, 1000}, {20, 3}, {19, 3}}, Metric::euclidean)));
  BOOST_TEST((of_seeds.read() == brute_force(grid, domain, {{9, -3}, {3, 3}}, Metric::euclidean)));
  seeds.move_to({{5, 5}});
  BOOST_TEST(seeds.outside() == 0u);
  exact_diagram(seeds, of_seeds);
  BOOST_TEST((of_seeds.read() == Labels(grid.pixels(), 0u)));
}

BOOST_AUTO_TEST_CASE(what_is_not_possible_is_refused) {
  const Grid grid(20, 10);
  const double side = 2147483648.0, nan = std::numeric_limits<double>::quiet_NaN();
  const auto with = [&](Point bad) { Seeds(test_device(), grid, {Point{1, 1}, bad}); };
  BOOST_CHECK_NO_THROW(with({side - 1, 10 - side}));
  check_error([&] { with({side, 1}); }, {"point 1", "2147483648", "too far away", "2^31"});
  check_error([&] { with({1, 9 - side}); }, {"point 1", "too far away"});
  check_error([&] { with({nan, 1}); }, {"point 1", "not finite"});
  const Grid periodic(20, 10, Periodic::x);
  check_error(
      [&] {
        Seeds(test_device(), periodic, {Point{1, 1}, Point{20, 1}});
      },
      {"point 1", "outside the grid"});

  const std::vector<Point> points = {{1, 1}};
  const auto in = [&](const Domain& domain) { Seeds(test_device(), grid, points, domain); };
  check_error([&] { in({0, 0, 0, 5, Periodic::x}); }, {"domain's width is 0", "2^31"});
  check_error([&] { in({0, 0, 5, (std::int64_t{1} << 31) + 1, Periodic::x}); }, {"domain's height", "2^31"});
  check_error([&] { in({std::int64_t{1} << 31, 0, 5, 5, Periodic::x}); }, {"begins at x = 2147483648"});
  check_error(
      [&] {
        Seeds(test_device(), Grid(20, 10, Periodic::x), points, Domain{0, 0, 5, 5, Periodic::x});
      },
      {"the grid is periodic", "domain"});

  Seeds outside(test_device(), grid, {Point{1, 1}, Point{-1, 1}, Point{1, 99}});
  Seeds in_domain(test_device(), grid, points, {0, 0, 20, 10, Periodic::x});
  Diagram diagram(test_device(), grid);
  for (const Method& method : methods()) {
    if (method.outer_seeds) {
      method.run(outside, diagram, 0, {});
      method.run(in_domain, diagram, 0, {});
    } else {
      check_error([&] { method.run(outside, diagram, 0, {}); }, {"2 of 3 seeds lie outside", "exact"});
      check_error([&] { method.run(in_domain, diagram, 0, {}); }, {"periodic domain", "exact"});
    }
  }
  check_error([&] { random_step(outside, 1, Border::reflect, 1, 1); },
              {"2 of 3 seeds lie outside", "random motion"});
  check_error([&] { relax(outside, diagram, engine(method("exact")), 1); }, {"2 of 3", "Lloyd relaxation"});
  check_error([&] { energy(outside, diagram); }, {"2 of 3", "energy"});
}
