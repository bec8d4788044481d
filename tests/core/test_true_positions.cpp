// Exact diagrams of points within their pixels, judged by every pixel's distances to all seeds in 128-bit
// integers.
#define BOOST_TEST_MODULE true_positions
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <optional>
#include <random>

#include "true_positions.hpp"
#include "vorocl/fields.hpp"
#include "weights.hpp"
#include "window_cases.hpp"

using namespace vorocl;

namespace {

/// Many more cases, for minutes instead of seconds.
const bool long_tests = std::getenv("VOROCL_LONG_TESTS") != nullptr;

/// One random case: a grid, a window of it, and points that are hard for some part of the engine.
struct RandomCase {
  explicit RandomCase(unsigned number) : rng(number) {
    const auto side = [&] { return below(4) == 0 ? 1 + below(8) : 1 + below(90); };
    const std::int64_t width = side();
    grid.emplace(width, side(), static_cast<Axes>(below(4)));
    window.emplace(below(3) == 0 ? part() : Window(*grid));
    make_points();
  }

  std::mt19937_64 rng;
  std::optional<Grid> grid;
  std::optional<Window> window;
  std::vector<std::optional<Point>> points;
  unsigned kind = 0;

  std::int64_t below(std::int64_t end) {
    return static_cast<std::int64_t>(rng() % static_cast<std::uint64_t>(end));
  }
  double between(double from, double to) {
    return from + (to - from) * static_cast<double>(rng() >> 11) * 0x1p-53;
  }

 private:
  Window part() {
    const auto cut = [&](const Axis& axis) {
      const std::int64_t pixels = axis.pixels();
      if (!axis.is_periodic()) {
        const std::int64_t begin = below(pixels);
        return std::make_pair(begin, 1 + below(pixels - begin));
      }
      return std::make_pair(below(4 * pixels) - 2 * pixels,
                            1 + below(below(4) == 0 ? pixels + pixels / 2 + 1 : pixels));
    };
    const auto x = cut(grid->x()), y = cut(grid->y());
    return {*grid, x.first, y.first, x.second, y.second};
  }

  void make_points() {
    const auto w = static_cast<double>(grid->width()), h = static_cast<double>(grid->height());
    const double beside = below(3) > 0 ? 0 : below(3) == 0 ? 200000 : 100;
    const auto anywhere = [&] { return Point{between(-beside, w + beside), between(-beside, h + beside)}; };
    const Point middle = {between(0, w), between(0, h)};
    const double step = 1 << below(5);
    const std::int64_t most = below(3) == 0 ? 2 * grid->width() * grid->height() : 60;
    const std::int64_t count = below(5) == 0 ? below(4) : 1 + below(most);
    const bool some_absent = below(4) == 0;
    kind = static_cast<unsigned>(below(8));
    for (std::int64_t i = 0; i < count; ++i) {
      Point point = anywhere();
      if (kind == 1) point = {std::floor(point.x * 2) / 2, std::floor(point.y * 2) / 2};  // half pixels
      if (kind == 2)
        point = {std::floor(point.x / step) * step + 0.25, std::floor(point.y / step) * step + 0.75};
      if (kind == 3)
        point = {middle.x + between(-1, 1), middle.y + between(-1, 1)};  // in and around one pixel
      if (kind == 4)
        point = {middle.x + static_cast<double>(below(7) - 3) / parts,
                 middle.y + static_cast<double>(below(7) - 3) / parts};
      if (kind == 5) {  // a ring: nearly all win at its centre
        const double angle = between(0, 6.2831853), radius = std::min(w, h) * 0.45;
        point = {w / 2 + radius * std::cos(angle), h / 2 + radius * std::sin(angle)};
      }
      points.emplace_back(point);
      if (some_absent && below(3) == 0) points.back().reset();
    }
  }
};

Labels labels_of(const Engine& engine, const Window& window, const std::vector<std::optional<Point>>& points,
                 Metric metric, const std::vector<double>& weights = {}) {
  Diagram diagram(engine.device, window);
  const Points given = Points(points).weighted(weights.empty() ? nullptr : weights.data());
  exact_diagram(Seeds(engine.device, window.grid(), given, {Outside::count, Snap::none}), diagram, {metric});
  return diagram.read();
}

}  // namespace

BOOST_AUTO_TEST_CASE(labels_are_those_of_the_rounded_positions_and_of_their_weights) {
  const unsigned cases = long_tests ? 200000 : 4000;
  std::size_t empty = 0;
  for (unsigned number = 0; number < cases; ++number) {
    const bool are_weighted = number % 2 == 1;
    const unsigned of_pair = number / 2;
    RandomCase random(of_pair);
    const Grid& grid = *random.grid;
    const std::size_t count = random.points.size();
    const Metric metric = !are_weighted && of_pair % 7 == 0 ? Metric::manhattan : Metric::euclidean;
    const Engine& engine = long_tests && takes(Shape::vector) ? engines()[of_pair % engines().size()]
                                                              : engine_for(*random.window, metric, of_pair);
    std::vector<double> weights;
    std::vector<std::int64_t> lags;
    if (are_weighted) {
      const double side = std::sqrt(static_cast<double>(grid.pixels()) / static_cast<double>(count + 1)) + 1;
      weights = hard_weights(count, side, random.rng);
      lags = lags_by_definition(weights, [&](std::size_t id) { return bool(random.points[id]); });
    }
    const Labels labels = labels_of(engine, *random.window, random.points, metric, weights);
    const std::size_t wrong = count_differences(
        labels, labels_by_definition(*random.window, positions_of(grid, random.points), metric, lags));
    BOOST_TEST(wrong == 0u, "case " << number << ", kind " << random.kind << ": "
                                    << text_of(*random.window, count) << ", " << engine.name << ", "
                                    << name_of(metric) << ": " << wrong << " wrong");
    for (std::uint32_t id = 0; are_weighted && id < count; ++id)
      empty += std::find(labels.begin(), labels.end(), id) == labels.end() ? 1 : 0;
  }
  BOOST_TEST(empty > cases / 2);
}

BOOST_AUTO_TEST_CASE(weights_of_data_are_in_its_units) {
  std::mt19937_64 rng(8);
  const Grid pixels(90, 60, Axes::x), data(Axis(90, -1, 0.5).periodic(), Axis(60, 3, 4).reversed());
  std::vector<Point> at, points;
  std::vector<double> weights, of_data;
  for (int i = 0; i < 70; ++i) {
    at.push_back({static_cast<double>(rng() % (90 * 64)) / 64, static_cast<double>(rng() % (60 * 64)) / 64});
    points.push_back(data.point(at.back()));
    weights.push_back(static_cast<double>(rng() % 100));
    of_data.push_back(5 + weights.back() / 3600);
  }
  Diagram of_pixels(test_device(), pixels), diagram(test_device(), data);
  Seeds seeds(test_device(), data, Points(points).weighted(of_data.data()));
  exact_diagram(Seeds(test_device(), pixels, Points(at).weighted(weights.data())), of_pixels);
  exact_diagram(seeds, diagram);
  BOOST_TEST(count_differences(diagram.read(), of_pixels.read()) == 0u);
  // Moved, to other weights; and those that are all the same are none.
  std::vector<double> same(70, -3);
  seeds.move_to(Points(points).weighted(same.data()));
  exact_diagram(seeds, diagram);
  exact_diagram(Seeds(test_device(), pixels, at), of_pixels);
  BOOST_TEST(count_differences(diagram.read(), of_pixels.read()) == 0u);
  jump_flooding(seeds, diagram);
  seeds.move_to(Points(points).weighted(of_data.data()));
  const std::size_t heavy = 7;
  weights.assign(70, 0);
  weights[heavy] = 1e12;  // swallows all
  exact_diagram(Seeds(test_device(), pixels, Points(at).weighted(weights.data())), of_pixels);
  const Labels labels = of_pixels.read();
  BOOST_TEST(std::count(labels.begin(), labels.end(), heavy) == 90 * 60);
}

BOOST_AUTO_TEST_CASE(what_cannot_be_weighted_is_refused) {
  const std::vector<Point> points = {{1, 1}, {6, 5}};
  std::vector<double> weights = {4, 1};
  const Points weighted = Points(points).weighted(weights.data());
  const Device& device = test_device();
  const Grid grid(9, 8);
  Diagram diagram(device, grid);
  Seeds seeds(device, grid, weighted);
  check_error([&] { jump_flooding(seeds, diagram); }, {"the method jfa does not know"});
  check_error([&] { exact_diagram(seeds, diagram, {Metric::manhattan}); }, {"not Euclidean"});
  check_error([&] { random_step(seeds, 1, Border::reflect, 1, 1); }, {"random motion"});
  check_error([&] { seeds.move_to(points); }, {"give each a weight"});
  exact_diagram(seeds, diagram);
  DistanceErrorsResult errors;
  check_error([&] { distance_errors(diagram, diagram, errors); }, {"an error of distances"});
  SimilarityResult shares;
  check_error([&] { similarity(diagram, diagram, 1, shares); }, {"an error of distances"});
  const auto label = [&](const Grid& of, const SeedsOptions& options = {}) {
    Diagram other(device, of);
    exact_diagram(Seeds(device, of, weighted, options), other);
  };
  check_error([&] { label(Grid(Axis(9, 0, 9), Axis(8, 0, 9))); }, {"are squares"});
  check_error([&] { label(Grid(Axis(9), Axis(8).spaced(2))); }, {"spaced"});
  check_error([&] { label(Grid(7, 6), to_centres); }, {"snapped to pixels"});
  weights[1] = std::nan("");
  check_error([&] { Seeds(device, grid, weighted); }, {"the weight of seed 1 is nan"});
  weights[1] = -2e6;
  label(grid);
  check_error([&] { label(Grid(2000, 8)); }, {"may differ by at most 1048576"});
}

BOOST_AUTO_TEST_CASE(many_points_in_tiles_of_all_densities) {
  std::mt19937_64 rng(3);
  for (const std::size_t count :
       {std::size_t{1}, std::size_t{40}, std::size_t{700}, std::size_t{9000}, std::size_t{60000}}) {
    const Grid grid(300, 200, count % 700 == 0 ? Axes::xy : Axes::none);
    std::vector<std::optional<Point>> points;
    for (std::size_t i = 0; i < count; ++i) {
      // Half of them in a corner, so that tiles and bins differ.
      const double w = i % 2 == 0 ? 300 : 30, h = i % 2 == 0 ? 200 : 20;
      points.emplace_back(Point{w * static_cast<double>(rng() >> 11) * 0x1p-53,
                                h * static_cast<double>(rng() >> 11) * 0x1p-53});
    }
    const Window part(grid, 0, 0, 64, 40);
    const Labels expected = labels_by_definition(part, positions_of(grid, points), Metric::euclidean);
    for (const Engine& engine : engines_of(Metric::euclidean)) {
      const Labels all = labels_of(engine, grid, points, Metric::euclidean);
      Labels cut;
      for (std::int64_t y = 0; y < part.height(); ++y) {
        cut.insert(cut.end(), all.begin() + y * grid.width(), all.begin() + y * grid.width() + part.width());
      }
      BOOST_TEST(count_differences(cut, expected) == 0u, count << " points, " << engine.name);
      BOOST_TEST(count_differences(labels_of(engine, part, points, Metric::euclidean), expected) == 0u,
                 count << " points in a window, " << engine.name);
    }
    const std::vector<double> weights = hard_weights(count, 250 / std::sqrt(static_cast<double>(count)), rng);
    const auto lags = lags_by_definition(weights, [](std::size_t) { return true; });
    const Labels weighted = labels_by_definition(part, positions_of(grid, points), Metric::euclidean, lags);
    for (const Engine& engine : engines_of(Metric::euclidean)) {
      BOOST_TEST(
          count_differences(labels_of(engine, part, points, Metric::euclidean, weights), weighted) == 0u,
          count << " weighted points in a window, " << engine.name);
    }
  }
}

BOOST_AUTO_TEST_CASE(labels_of_stamps_go_past_the_caches_where_they_are_many) {
  const Grid grid(2064, 2040);
  std::mt19937_64 rng(5);
  std::vector<std::optional<Point>> points;
  for (int i = 0; i < 700000; ++i) {
    const double x = static_cast<double>(rng() >> 11) * 0x1p-53,
                 y = static_cast<double>(rng() >> 11) * 0x1p-53;
    points.emplace_back(Point{2064 * x, 2040 * y});
  }
  const Labels all = labels_of(engines_of(Metric::euclidean)[0], grid, points, Metric::euclidean);
  for (std::int64_t y = 0; y < grid.height(); y += 510) {  // which have fewer
    const Labels part =
        labels_of(engines_of(Metric::euclidean)[0], Window(grid, 0, y, 2064, 510), points, Metric::euclidean);
    const auto first = all.begin() + y * grid.width();
    BOOST_TEST(count_differences(part, Labels(first, first + 510 * grid.width())) == 0u, "from row " << y);
  }
}

BOOST_AUTO_TEST_CASE(crowds_that_no_list_holds) {
  // Far from a line of points all of those beside a tile may win in it. A row's pixels have one label: that
  // of the first.
  const Grid grid(700, 200);
  std::mt19937_64 rng(4);
  std::vector<std::optional<Point>> points;
  for (int i = 0; i < 20000; ++i)
    points.emplace_back(Point{20.5, 200 * static_cast<double>(rng() >> 11) * 0x1p-53});
  for (const Metric metric : both_metrics) {
    const Labels first = labels_by_definition(Window(grid, 0, 0, 1, 200), positions_of(grid, points), metric);
    Labels expected;
    for (const std::uint32_t label : first) expected.insert(expected.end(), 700, label);
    for (const Engine& engine : engines_of(metric)) {
      BOOST_TEST(count_differences(labels_of(engine, grid, points, metric), expected) == 0u,
                 engine.name << ", " << name_of(metric));
    }
  }
}

BOOST_AUTO_TEST_CASE(crowds_along_lines) {
  // 32 points per pixel. Where the slope is 1 nearly all pixels are halfway between two of them, of which the
  // one with the higher id comes first.
  const Grid grid(150, 150);
  for (const double slope : {1.0, 0.5, 0.03}) {
    std::vector<std::optional<Point>> points;
    for (int i = 0; i < 32 * 150; ++i) {
      const double along = 150 - (i + 0.5) / 32;
      points.emplace_back(Point{along, 75 + slope * (along - 75)});
    }
    for (const Metric metric : both_metrics) {  // the sums of x and y of hundreds are the same
      const Labels expected = labels_by_definition(grid, positions_of(grid, points), metric);
      for (const Engine& engine : engines_of(metric)) {
        BOOST_TEST(count_differences(labels_of(engine, grid, points, metric), expected) == 0u,
                   engine.name << ", slope " << slope << ", " << name_of(metric));
      }
    }
  }
}

BOOST_AUTO_TEST_CASE(points_on_pixel_centres_give_the_labels_of_snapped_seeds) {
  for (unsigned kind = 0; kind < kinds_of_planes; ++kind) {
    const Grid grid(150, 110, static_cast<Axes>(kind % 4));
    const std::vector<Pixel> pixels = seeds_of_plane(grid, kind, kind);
    for (const Metric metric : both_metrics) {
      Diagram snapped(test_device(), grid), true_one(test_device(), grid);
      exact_diagram(Seeds(test_device(), grid, centres(pixels), to_centres), snapped, {metric});
      exact_diagram(Seeds(test_device(), grid, centres(pixels), {Outside::count, Snap::none}), true_one,
                    {metric});
      BOOST_TEST(count_differences(snapped.read(), true_one.read()) == 0u, "kind " << kind);
    }
  }
}

BOOST_AUTO_TEST_CASE(several_points_of_a_pixel_own_pixels) {
  const Grid grid(20, 4);
  const std::vector<Point> points = {{10.25, 2}, {10.75, 2}};
  Diagram diagram(test_device(), grid);
  exact_diagram(Seeds(test_device(), grid, points, {Outside::count, Snap::none}), diagram);
  const Labels labels = diagram.read();
  for (std::size_t i = 0; i < labels.size(); ++i) BOOST_TEST(labels[i] == (i % 20 <= 10 ? 0u : 1u));
  exact_diagram(Seeds(test_device(), grid, points, to_centres), diagram);
  const Labels snapped = diagram.read();
  BOOST_TEST(std::count(snapped.begin(), snapped.end(), 1u) == 0);
}

BOOST_AUTO_TEST_CASE(positions_are_what_diagrams_take) {
  const Grid grid(Axis(100, -1, 1).periodic(), Axis(50, 0, 10).reversed());
  const std::vector<Point> points = {{-0.9999, 0.01}, {0.123456789, 3.3333}, {1, 9.99999999999}};
  const Seeds seeds(test_device(), grid, points, {Outside::count, Snap::none});
  const std::vector<Point> at = all_of(seeds.read_pixels());
  for (std::size_t id = 0; id < points.size(); ++id) {
    BOOST_TEST(std::floor(at[id].x) == grid.x().pixel(points[id].x));
    BOOST_TEST(std::floor(at[id].y) == grid.y().pixel(points[id].y));
    BOOST_TEST(at[id].x * parts == std::floor(at[id].x * parts));
    const double period = 2, dx = std::remainder(grid.x().coordinate(at[id].x) - points[id].x, period);
    BOOST_TEST(std::abs(dx) <= 2.0 / 100 / parts);
    BOOST_TEST(std::abs(grid.y().coordinate(at[id].y) - points[id].y) <= 10.0 / 50 / parts);
  }
  BOOST_TEST((points_of(seeds)[1].x == points[1].x));
}

BOOST_AUTO_TEST_CASE(what_is_too_far_is_refused_by_name) {
  const Grid grid(30, 20);
  const Seeds seeds(test_device(), grid, {{300000.0, 5.0}}, {Outside::count, Snap::none});
  Diagram diagram(test_device(), grid);
  check_error([&] { exact_diagram(seeds, diagram); }, {"seed 0", "262144 pixels", "snap"});
  // One that owns no pixel does not matter.
  const Seeds both(test_device(), grid, {{300000.0, 5.0}, {3.0, 5.0}}, {Outside::count, Snap::none});
  exact_diagram(both, diagram);
  const Labels labels = diagram.read();
  BOOST_TEST(std::count(labels.begin(), labels.end(), 1u) == 600);
}

BOOST_AUTO_TEST_CASE(seeds_are_near_across_the_ends_of_periods_of_any_length) {
  std::mt19937_64 rng(6);
  const auto below = [&](std::int64_t end) {
    return static_cast<double>(rng() % static_cast<std::uint64_t>(end));
  };
  for (const std::int64_t period : {262144, 262145, 300000, 700000, 1 << 21, 1 << 30}) {
    for (const bool along_x : {true, false}) {
      const Grid grid = along_x ? Grid(period, 24, Axes::x) : Grid(24, period, Axes::xy);
      std::vector<std::optional<Point>> points;
      for (int i = 0; i < 40; ++i) {
        // On both sides of the ends, half of them on a lattice, whose pixels are as far from several.
        const double way = i % 2 == 0 ? below(12) * 4 : below(48 * parts) / parts;
        const double across = i % 2 == 0 ? below(6) * 4 : below(24 * parts) / parts;
        const double at = i % 4 < 2 ? way : static_cast<double>(period) - 48 + way;
        points.emplace_back(along_x ? Point{at, across} : Point{across, at});
      }
      for (const std::int64_t begin : {std::int64_t{0}, period - 40, period - 20}) {
        const Window window = along_x ? Window(grid, begin, 0, 40, 24) : Window(grid, 0, begin, 24, 40);
        const auto positions = positions_of(grid, points);
        const Labels expected = labels_by_definition(window, positions, Metric::euclidean);
        for (const Engine& engine : engines_of(Metric::euclidean)) {
          Diagram diagram(engine.device, window);
          exact_diagram(Seeds(engine.device, grid, points, {Outside::count, Snap::none}), diagram);
          Field<float> distances;
          distance_field(diagram, distances);
          const std::vector<float> found = distances.read();
          std::size_t wrong = 0;
          for (std::size_t i = 0; i < found.size(); ++i) {
            const auto column = static_cast<std::int64_t>(i) % window.width() + window.x(),
                       row = static_cast<std::int64_t>(i) / window.width() + window.y();
            const Wide squared = wide_distance(grid, *positions[expected[i]], column, row, Metric::euclidean);
            const double distance = std::sqrt(static_cast<double>(squared)) / parts;
            wrong += std::abs(static_cast<double>(found[i]) - distance) > 1e-6 * (1 + distance) ? 1 : 0;
          }
          BOOST_TEST(count_differences(diagram.read(), expected) == 0u, text_of(window, points.size())
                                                                            << ", " << engine.name);
          BOOST_TEST(wrong == 0u, text_of(window, points.size()) << ", " << engine.name << ": distances");
        }
      }
    }
  }
}

BOOST_AUTO_TEST_CASE(a_frame_that_moves_and_floods_takes_pixels) {
  const Grid grid(60, 40);
  std::vector<Point> points = {{10.2, 10.9}, {10.8, 10.1}, {45.5, 30.25}};
  Seeds seeds(test_device(), grid, points, {Outside::count, Snap::none}),
      snapped(test_device(), grid, points, to_centres);
  Diagram diagram(test_device(), grid), of_pixels(test_device(), grid);
  for (int frame = 0; frame < 4; ++frame) {
    for (Point& point : points) point = {point.x + 0.3, point.y + 0.2};
    seeds.move_to(points);
    BOOST_TEST(!exact_diagram(seeds, diagram).snapped());
    BOOST_TEST(count_differences(diagram.read(), labels_by_definition(
                                                     grid, positions_of(grid, {points.begin(), points.end()}),
                                                     Metric::euclidean)) == 0u);
    snapped.move_to(points);
    BOOST_TEST(jump_flooding(seeds, diagram).snapped());
    BOOST_TEST(!jump_flooding(snapped, of_pixels).snapped());
    BOOST_TEST(count_differences(diagram.read(), of_pixels.read()) == 0u);
  }
  random_step(seeds, 0, Border::reflect, 1, 1);
  BOOST_TEST(!jump_flooding(seeds, diagram).snapped());
  exact_diagram(seeds, diagram);
  exact_diagram(snapped, of_pixels);
  BOOST_TEST(count_differences(diagram.read(), of_pixels.read()) == 0u);
}
