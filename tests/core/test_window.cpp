// Windows of grids, periodic ones too: exact diagrams with seeds outside the window, judged by the diagram of
// the whole grid and by brute force over all images.
#define BOOST_TEST_MODULE window
#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "brute_force.hpp"
#include "window_cases.hpp"

using namespace vorocl;

namespace {

/// Many more cases, for minutes instead of seconds.
const bool long_tests = std::getenv("VOROCL_LONG_TESTS") != nullptr;

Labels labels_of(const Engine& engine, const Window& window, const std::vector<Pixel>& seeds, Metric metric) {
  Diagram diagram(engine.device, window);
  exact_diagram(Seeds(engine.device, window.grid(), centres(seeds), to_centres), diagram, {metric});
  return diagram.read();
}

void check_against_brute_force(const Window& window, const std::vector<Pixel>& seeds, const Engine& engine,
                               Metric metric) {
  const std::size_t wrong =
      count_differences(labels_of(engine, window, seeds, metric), brute_force(window, seeds, metric));
  BOOST_TEST(wrong == 0u, text_of(window, seeds.size())
                              << ", " << engine.name << ", " << name_of(metric) << ": " << wrong << " wrong");
}

}  // namespace

BOOST_AUTO_TEST_CASE(windows_are_cut_out_of_the_grid) {
  const unsigned planes = long_tests ? 500 : 50, windows_of_plane = 20;
  std::mt19937 rng(5);
  const auto below = [&](std::int64_t end) {
    return static_cast<std::int64_t>(rng() % static_cast<unsigned>(end));
  };
  std::size_t parts = 0;
  for (unsigned number = 0; number < planes; ++number) {
    const std::int64_t width = 100 + below(200);
    const Grid plane(width, 100 + below(200));
    const std::vector<Pixel> seeds = seeds_of_plane(plane, number % kinds_of_planes, number);
    const Metric metric = both_metrics[number / kinds_of_planes % 2];
    Diagram whole(test_device(), plane);
    exact_diagram(Seeds(test_device(), plane, centres(seeds), to_centres), whole, {metric});
    const Labels all = whole.read();
    for (unsigned i = 0; i < windows_of_plane; ++i) {
      const std::int64_t left = below(plane.width()), top = below(plane.height());
      const std::int64_t columns = 1 + below(plane.width() - left);
      const Window window(plane, left, top, columns, 1 + below(plane.height() - top));
      Labels cut;
      for (std::int64_t y = 0; y < window.height(); ++y) {
        const auto row = all.begin() + (top + y) * plane.width() + left;
        cut.insert(cut.end(), row, row + window.width());
      }
      const Engine& engine = engine_for(window, metric, rng());
      parts += window.is_whole() ? 0 : 1;
      const std::size_t wrong = count_differences(labels_of(engine, window, seeds, metric), cut);
      BOOST_TEST(wrong == 0u, "plane " << number << ", window " << i << ": " << text_of(window, seeds.size())
                                       << ", " << engine.name << ": " << wrong << " wrong");
    }
  }
  BOOST_TEST(parts > 15 * planes);
}

BOOST_AUTO_TEST_CASE(far_seeds) {
  std::mt19937_64 rng(6);
  const Grid small(70, 45), large(Axis::max_pixels, Axis::max_pixels);
  const std::int64_t half = Axis::max_pixels / 2;
  for (const Window& window : {Window(small), Window(large, half, half, 70, 45)}) {
    const std::int64_t most = window.is_whole() ? (std::int64_t{1} << 31) - 1 - 70 : half - 100;
    for (const std::int64_t reach : {std::int64_t{100}, std::int64_t{32600}, std::int64_t{32767},
                                     std::int64_t{32768}, std::int64_t{40000}, std::int64_t{1} << 20, most}) {
      for (unsigned number = 0; number < 20; ++number) {
        const std::int64_t w = window.width(), h = window.height();
        std::vector<Pixel> seeds;
        if (number % 4 == 0) {  // around, none inside
          seeds = random_pixels_between({-reach, -reach}, {w + reach, h + reach}, 50, rng);
        } else if (number % 4 == 1) {  // some inside too
          seeds = random_pixels_between({-reach, -reach}, {w + reach, h + reach}, 300, rng);
          for (const Pixel& inside : random_pixels_between({-5, -5}, {w, h}, 3, rng)) seeds.push_back(inside);
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
        for (Pixel& seed : seeds) seed = {seed.x + window.x(), seed.y + window.y()};
        const Metric metric = both_metrics[number / 4 % 2];
        check_against_brute_force(window, seeds, engine_for(window, metric, number), metric);
      }
    }
  }
}

// The last boxes stick out of such windows, and a seed beyond them owns pixels there.
BOOST_AUTO_TEST_CASE(boxes_beyond_the_window_find_seeds_beyond_it) {
  std::mt19937_64 rng(8);
  const auto below = [&](std::int64_t end) {
    return static_cast<std::int64_t>(rng() % static_cast<std::uint64_t>(end));
  };
  for (int number = 0; number < (long_tests ? 400 : 40); ++number) {
    const Grid plane(256, 512);
    const Window window(plane, 0, 0, number == 0 ? 65 : 60 + below(30), 512);
    std::vector<Pixel> seeds = random_pixels_between(
        {0, 450}, {63, 511}, number == 0 ? 520 : 1 + static_cast<std::size_t>(below(600)), rng);
    seeds.push_back(number == 0 ? Pixel{96, 164} : Pixel{window.width() + below(100), below(400)});
    for (const Metric metric : both_metrics) {
      for (const Engine& engine : engines_of(metric))
        check_against_brute_force(window, seeds, engine, metric);
    }
  }
}

// Windows that are a part of the period, cross its end, are as long as it from any pixel on, or longer.
BOOST_AUTO_TEST_CASE(windows_of_periodic_grids) {
  std::mt19937_64 rng(7);
  const unsigned cases = long_tests ? 6000 : 600;
  std::size_t crossing = 0, whole = 0, longer = 0;
  for (unsigned number = 0; number < cases; ++number) {
    const auto below = [&](std::int64_t end) {
      return static_cast<std::int64_t>(rng() % static_cast<std::uint64_t>(end));
    };
    const auto side = [&] { return 1 + below(number % 3 == 0 ? 30 : 200); };
    const std::int64_t columns = side();
    const Grid grid(columns, side(), static_cast<Axes>(1 + number % 3));
    // Where a window begins along an axis, and how long it is.
    const auto stretch = [&](const Axis& axis) -> std::pair<std::int64_t, std::int64_t> {
      const std::int64_t most = std::min<std::int64_t>(axis.pixels(), 90);
      if (!axis.is_periodic()) {
        const std::int64_t length = 1 + below(most);
        return {below(axis.pixels() - length + 1), length};
      }
      const std::int64_t length = number % 5 == 0  ? axis.pixels()
                                  : number % 5 < 3 ? 1 + below(most)
                                                   : 1 + below(150);
      crossing += length < axis.pixels() ? 1 : 0;
      whole += length == axis.pixels() ? 1 : 0;
      longer += length > axis.pixels() ? 1 : 0;
      return {below(600) - 300, length};
    };
    const auto [x, width] = stretch(grid.x());
    const auto [y, height] = stretch(grid.y());
    const Window window(grid, x, y, width, height);
    const std::size_t count = number % 7 == 0 ? 1 : number % 5 == 0 ? 400 : 1 + rng() % 40;
    // Outside the grid too: along periodic axes they wrap.
    const auto seeds = random_pixels_between({-100, -100}, {2 * grid.width(), 2 * grid.height()}, count, rng);
    const Metric metric = both_metrics[number / 3 % 2];
    check_against_brute_force(window, seeds, engine_for(window, metric, number), metric);
  }
  BOOST_TEST(crossing > cases / 3);
  BOOST_TEST(whole > cases / 5);
  BOOST_TEST(longer > cases / 8);
}

BOOST_AUTO_TEST_CASE(long_periods) {
  std::mt19937_64 rng(8);
  for (const std::int64_t period : {std::int64_t{60000}, std::int64_t{70001}, Axis::max_pixels}) {
    for (const Axes axes : {Axes::x, Axes::y, Axes::xy}) {
      const Grid grid(period, period, axes);
      const Window window(grid, has_x(axes) ? -25 : period / 2, has_y(axes) ? -20 : period / 2, 50, 40);
      for (const Engine& engine : engines()) {
        if (!takes(engine.device.tuning().shape)) continue;
        const auto seeds = random_pixels_between({0, 0}, {period - 1, period - 1}, 60, rng);
        for (const Metric metric : engine.metrics) check_against_brute_force(window, seeds, engine, metric);
      }
    }
  }
}

// One whole period is a torus, from whichever pixel it is shown: the labels of all spellings are the same,
// though some of them are methods of their own inside the engine.
BOOST_AUTO_TEST_CASE(all_spellings_of_a_torus) {
  const std::int64_t w = 211, h = 130;
  for (const Axes axes : {Axes::x, Axes::y, Axes::xy}) {
    for (const std::size_t count : {1u, 5u, 100u, 3000u}) {
      const Grid grid(w, h, axes);
      const std::vector<Pixel> seeds = random_pixels(grid, count, 9);
      const Labels expected = brute_force(grid, seeds, Metric::euclidean);
      const auto check = [&](const Engine& engine, const Window& window, const std::vector<Point>& points) {
        Diagram diagram(engine.device, window);
        exact_diagram(Seeds(engine.device, window.grid(), points, to_centres), diagram);
        const Labels labels = diagram.read();
        std::size_t wrong = 0, i = 0;
        for (std::int64_t y = 0; y < window.height(); ++y) {
          for (std::int64_t x = 0; x < window.width(); ++x, ++i) {
            const auto pixel = shown_pixel(window, x, y);
            const std::uint32_t label =
                pixel ? expected[static_cast<std::size_t>(pixel->y * w + pixel->x)] : no_label;
            wrong += labels[i] != label ? 1 : 0;
          }
        }
        BOOST_TEST(wrong == 0u, text_of(window, count) << ", " << engine.name << ": " << wrong << " wrong");
      };
      const auto axis = [](std::int64_t pixels, bool periodic) {
        const Axis in_data(pixels, -3, -3 + static_cast<double>(pixels) / 4);  // exact in binary
        return periodic ? in_data.periodic() : in_data;
      };
      const Grid in_data(axis(w, has_x(axes)), axis(h, has_y(axes)));
      const std::vector<Point> points = centres(seeds);
      std::vector<Point> images, points_in_data;
      for (std::size_t i = 0; i < points.size(); ++i) {
        const double periods = static_cast<double>(i % 5) - 2;
        images.push_back({points[i].x + (has_x(axes) ? periods * static_cast<double>(w) : 0),
                          points[i].y - (has_y(axes) ? periods * static_cast<double>(h) : 0)});
        points_in_data.push_back(in_data.point(images.back()));
      }
      const std::int64_t left = has_x(axes) ? 150 : 0, top = has_y(axes) ? -30 : 0;
      const std::int64_t more_x = has_x(axes) ? 60 : 0, more_y = has_y(axes) ? 50 : 0;
      for (const Engine& engine : engines_of(Metric::euclidean)) {
        check(engine, grid, points);
        check(engine, grid, images);
        check(engine, in_data, points_in_data);
        check(engine, {grid, left, top, w, h}, points);
        check(engine, {in_data, left, top, w, h}, points_in_data);
        check(engine, {grid, -more_x / 2, -more_y / 2, w + more_x, h + more_y}, images);
      }
    }
  }
}

// Diagrams are of the frame that the seeds had, whatever window they show.
BOOST_AUTO_TEST_CASE(frames_with_seeds_outside) {
  const Grid grid(20, 10, Axes::x);
  Seeds seeds(test_device(), grid, {{-0.5, 13}, {5, 3}, {19.9, 3}}, to_centres);
  BOOST_TEST(seeds.alive() == 3u);
  BOOST_TEST(seeds.outside() == 1u);
  const Window window(grid, 15, 2, 9, 4);
  const Seeds copy = seeds.clone();
  Diagram of_copy(test_device(), window), of_seeds(test_device(), window), all(test_device(), grid);
  seeds.move_to({{26, 12}, {3, 3}});
  BOOST_TEST(seeds.read_pixels()[0]->x == 6.5);
  BOOST_TEST(copy.outside() == 1u);
  exact_diagram(copy, of_copy);
  exact_diagram(seeds, of_seeds);
  exact_diagram(seeds, all);
  seeds.move_to({{5, 5}});
  BOOST_TEST(seeds.outside() == 0u);
  BOOST_TEST((of_copy.read() == brute_force(window, {{19, 13}, {5, 3}, {19, 3}}, Metric::euclidean)));
  BOOST_TEST((of_seeds.read() == brute_force(window, {{6, 12}, {3, 3}}, Metric::euclidean)));
  BOOST_TEST((all.read() == brute_force(grid, {{6, 12}, {3, 3}}, Metric::euclidean)));
  exact_diagram(seeds, of_seeds);
  BOOST_TEST((of_seeds.read() == Labels(window.pixels(), 0u)));
}

BOOST_AUTO_TEST_CASE(points_that_are_too_far_away) {
  const Grid grid(20, 10);
  const double side = 2147483648.0;
  const auto with = [&](Point bad) { Seeds(test_device(), grid, {Point{1, 1}, bad}, to_centres); };
  BOOST_CHECK_NO_THROW(with({side - 1, 10 - side}));
  check_error([&] { with({side, 1}); }, {"point 1", "2147483648", "too far away", "2^31"});
  check_error([&] { with({1, 9 - side}); }, {"point 1", "too far away"});
  check_error([&] { with({std::nan(""), 1}); }, {"point 1", "not finite"});
}

BOOST_AUTO_TEST_CASE(what_floods_cannot_take_is_refused) {
  const Grid grid(20, 10), torus(20, 10, Axes::xy), long_torus(32001, 10, Axes::x);
  Seeds outside(test_device(), grid, {{1, 1}, {-1, 1}, {1, 99}}, to_centres);
  const Seeds inside(test_device(), grid, {{1, 1}}, to_centres),
      on_torus(test_device(), torus, {{1, 1}}, to_centres),
      on_long_torus(test_device(), long_torus, {{1, 1}}, to_centres);
  Diagram whole(test_device(), grid), part(test_device(), {grid, 0, 0, 20, 9}),
      part_of_torus(test_device(), {torus, 3, 0, 10, 10}), turned(test_device(), {torus, 3, 0, 20, 10}),
      longer(test_device(), {torus, 0, 0, 21, 10}), of_long_torus(test_device(), long_torus);
  for (const Method& method : methods()) {
    if (method.windows) {
      method.run(outside, whole, {});
      for (Diagram* const diagram : {&part_of_torus, &turned, &longer}) method.run(on_torus, *diagram, {});
      method.run(inside, part, {});
      method.run(on_long_torus, of_long_torus, {});
      continue;
    }
    check_error([&] { method.run(outside, whole, {}); }, {"2 of 3 seeds lie outside", "exact"});
    check_error([&] { method.run(inside, part, {}); }, {"window", "exact"});
    for (Diagram* const diagram : {&part_of_torus, &turned, &longer})
      check_error([&] { method.run(on_torus, *diagram, {}); }, {"window", "exact"});
    check_error([&] { method.run(on_long_torus, of_long_torus, {}); }, {"32,000", "exact"});
    method.run(inside, whole, {});
  }
  check_error([&] { random_step(outside, 1, Border::reflect, 1, 1); },
              {"2 of 3 seeds lie outside", "random motion"});
  check_error([&] { relax(outside, whole, engine(method("exact")), 1); }, {"2 of 3", "Lloyd relaxation"});
  exact_diagram(outside, whole);
  check_error([&] { energy(whole); }, {"2 of 3", "energy"});
}
