// Grids made tile by tile: labels and the seeds that a tile needs, against the whole grid at once and against
// brute force.
#define BOOST_TEST_MODULE tiles
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <random>
#include <set>

#include "brute_force.hpp"
#include "plane_image.hpp"

using namespace vorocl;

namespace {

/// Seeds in a disc.
std::vector<Point> disc(Point middle, double radius, std::size_t count, unsigned rng_seed) {
  std::mt19937 rng(rng_seed);
  std::uniform_real_distribution<double> uniform(-radius, radius);
  std::vector<Point> points;
  while (points.size() < count) {
    const double x = uniform(rng), y = uniform(rng);
    if (x * x + y * y <= radius * radius) points.push_back({middle.x + x, middle.y + y});
  }
  return points;
}

Labels brute_force(const Window& window, const std::vector<Point>& points, Metric metric) {
  return vorocl::brute_force(window, pixels_of(points), metric);
}

}  // namespace

BOOST_AUTO_TEST_CASE(a_grid_is_cut_into_tiles) {
  const Grid grid(100, 70), large(2147483647, 2147483647), torus(100, 70, Axes::xy);
  const Tiling whole(grid, 32);
  BOOST_TEST(whole.columns() == 4u);
  BOOST_TEST(whole.rows() == 3u);
  BOOST_TEST(whole.count() == 12u);
  BOOST_TEST((whole.window() == grid));
  BOOST_TEST((whole.tile(11) == Window(grid, 96, 64, 4, 6)));
  const Tiling part({large, 2147480000, 5, 3647, 2000}, 1000);
  BOOST_TEST(part.count() == 8u);
  BOOST_TEST((part.tile(3) == Window(large, 2147483000, 5, 647, 1000)));
  const Tiling turned({torus, 90, -10, 100, 70}, 32);
  BOOST_TEST(turned.count() == 12u);
  BOOST_TEST((turned.tile(0) == Window(torus, 90, 60, 32, 32)));
  BOOST_TEST((turned.tile(11) == Window(torus, 86, 54, 4, 6)));
  BOOST_TEST(default_tile_side(test_device()) >= 256);
}

BOOST_AUTO_TEST_CASE(labels_are_those_of_the_whole_grid) {
  std::size_t number = 0;
  for (const Metric metric : both_metrics) {
    for (const Case& c : all_edge_cases(metric)) {
      const PlaneSeeds seeds(c.grid, centres(c.seeds), to_centres);
      constexpr int sides[] = {64, 33, 16, 50, 40};
      const int side = sides[number++ % std::size(sides)];
      const Labels labels = labels_of(seeds, Tiling(c.grid, side), {metric});
      const std::size_t wrong = count_differences(labels, vorocl::brute_force(c.grid, c.seeds, metric));
      BOOST_TEST(wrong == 0u, c.name << ", tiles of " << side << ", " << name_of(metric) << ": " << wrong);
    }
  }
}

BOOST_AUTO_TEST_CASE(tiles_and_their_order_do_not_matter) {
  for (const Axes axes : {Axes::none, Axes::xy}) {
    const Grid grid(700, 500, axes);
    const std::vector<Pixel> pixels = random_pixels(grid, 900, 5);
    const PlaneSeeds seeds(grid, centres(pixels), to_centres);
    Diagram diagram(test_device(), grid);
    for (const Metric metric : both_metrics) {
      exact_diagram(Seeds(test_device(), grid, centres(pixels), to_centres), diagram, {metric});
      const Labels expected = diagram.read();
      for (const int side : {100, 256, 700}) {
        const Tiling tiling(grid, side);
        BOOST_TEST(count_differences(labels_of(seeds, tiling, {metric}), expected) == 0u);
        Image backwards(tiling);
        std::uint64_t left = tiling.count();
        const NextTile next = [&] { return left > 0 ? std::optional<std::uint64_t>(--left) : std::nullopt; };
        exact_tiles(test_device(), seeds, tiling, next, [&](const TileLabels& tile) { backwards.add(tile); },
                    {metric});
        BOOST_TEST(backwards.each_tile_once());
        BOOST_TEST(count_differences(backwards.labels, expected) == 0u);
      }
    }
  }
}

BOOST_AUTO_TEST_CASE(distances_may_pass_32_bits) {
  const double side = 2147483647;
  const std::vector<Point> points = {{0.5, 0.5},           {side - 0.5, side - 0.5},     {side - 0.5, 0.5},
                                     {side / 3, side / 2}, {side / 3 + 1, side / 2 - 1}, {1.5, side / 2},
                                     {-0.5, side / 2}};
  for (const Axes axes : {Axes::none, Axes::x, Axes::xy}) {
    const Grid grid(Axis::max_pixels, Axis::max_pixels, axes);
    const PlaneSeeds seeds(grid, points, to_centres);
    const std::int64_t last = Axis::max_pixels - 1, middle = last / 2;
    std::vector<Window> windows = {{grid, 0, 0, 40, 30},
                                   {grid, last - 39, last - 29, 40, 30},
                                   {grid, middle, middle, 40, 30},
                                   {grid, last / 3 - 20, middle - 15, 40, 30},
                                   {grid, 0, middle - 15, 40, 30},
                                   {grid, last - 39, middle - 15, 40, 30},
                                   {grid, last / 3 * 2 - 20, 0, 40, 30},
                                   {grid, middle - 20, last / 4 - 15, 40, 30}};
    if (axes == Axes::xy) windows.push_back({grid, -20, -15, 40, 30});
    for (const Window& window : windows) {
      for (const Metric metric : both_metrics) {
        const Labels labels = labels_of(seeds, Tiling(window, 17), {metric});
        BOOST_TEST(count_differences(labels, brute_force(window, points, metric)) == 0u,
                   "at (" << window.x() << ", " << window.y() << "), " << name_of(metric));
      }
    }
  }
}

// A cluster seen from afar: what a tile needs is little of it, and that is all it needs.
BOOST_AUTO_TEST_CASE(few_seeds_of_a_far_cluster_matter) {
  for (const Axes axes : {Axes::none, Axes::xy}) {
    const Grid grid(65536, 65536, axes);
    const std::vector<Point> points = disc({20000, 30000}, 1000, 20000, 3);
    const PlaneSeeds seeds(grid, points, to_centres);
    std::mt19937 rng(8);
    const auto below = [&](unsigned end) { return static_cast<std::int64_t>(rng() % end); };
    for (int i = 0; i < 6; ++i) {
      const std::int64_t left = below(64000);
      const Window tile(grid, left, below(64000), 1024, 1024);
      for (const Metric metric : both_metrics) {
        std::vector<PlaneSeed> near;
        seeds.find_near(tile, metric, near);
        BOOST_TEST(near.size() < 200u);
        std::set<std::uint32_t> ids;
        for (const PlaneSeed& seed : near) ids.insert(seed.id);
        BOOST_TEST(ids.size() == near.size());
        const std::int64_t right = below(1000);
        const Window part(grid, tile.x() + right, tile.y() + below(1000), 8, 8);
        const Labels expected = brute_force(part, points, metric);
        for (const std::uint32_t label : expected) BOOST_TEST(ids.count(label) == 1u);
        BOOST_TEST(count_differences(labels_of(seeds, Tiling(part, 8), {metric}), expected) == 0u);
      }
    }
  }
}

// Also those that cross the end of a period, and begin anywhere in it.
BOOST_AUTO_TEST_CASE(tiles_of_windows) {
  std::mt19937_64 rng(9);
  const auto below = [&](std::int64_t end) {
    return static_cast<std::int64_t>(rng() % static_cast<unsigned>(end));
  };
  for (int number = 0; number < 40; ++number) {
    const auto axes = static_cast<Axes>(number % 4);
    const std::int64_t columns = 20 + below(150);
    const Grid grid(columns, 20 + below(150), axes);
    const std::int64_t width = 1 + below(grid.width()), height = 1 + below(grid.height());
    const Window window(grid, below(has_x(axes) ? 500 : grid.width() - width + 1),
                        below(has_y(axes) ? 500 : grid.height() - height + 1), width, height);
    // Outside too: along periodic axes they wrap.
    std::vector<Point> points;
    for (int i = 0; i < 60; ++i)
      points.push_back(
          centre({below(3 * grid.width()) - grid.width(), below(3 * grid.height()) - grid.height()}));
    const PlaneSeeds seeds(grid, points, to_centres);
    BOOST_TEST(seeds.outside() == Seeds(test_device(), grid, points, to_centres).outside());
    const Metric metric = both_metrics[number % 2];
    BOOST_TEST(count_differences(labels_of(seeds, Tiling(window, 1 + below(60)), {metric}),
                                 brute_force(window, points, metric)) == 0u);
  }
}

// Points within their pixels, several in most of them: tiles are windows of one diagram, bit for bit.
BOOST_AUTO_TEST_CASE(tiles_of_points_are_one_grid) {
  std::mt19937 rng(12);
  const auto within = [&](std::int64_t low, std::int64_t high, bool coarse) {
    const double at =
        static_cast<double>(low) + static_cast<double>(rng()) * 0x1p-32 * static_cast<double>(high - low);
    return coarse ? std::floor(at * 2) / 2 : at;  // many are as far from a pixel
  };
  for (const std::size_t count : {1u, 7u, 300u, 9000u}) {
    for (const Axes axes : {Axes::none, Axes::x, Axes::xy}) {
      const Grid grid(120, 90, axes);
      std::vector<Point> points;
      for (std::size_t i = 0; i < count; ++i) {
        points.push_back({within(-30, 150, i % 2 == 0), within(-30, 120, i % 2 == 0)});
        if (i % 5 == 0) points.push_back(points[i / 2]);  // at one place
      }
      const PlaneSeeds seeds(grid, points, {Outside::count, Snap::none});
      const Seeds whole(test_device(), grid, points, {Outside::count, Snap::none});
      Diagram diagram(test_device(), grid), snapped(test_device(), grid);
      for (const Metric metric : both_metrics) {
        exact_diagram(whole, diagram, {metric});
        const Labels expected = diagram.read();
        for (const int side : {17, 50, 128}) {
          BOOST_TEST(count_differences(labels_of(seeds, Tiling(grid, side), {metric}), expected) == 0u,
                     count << " points, tiles of " << side << ", " << name_of(metric));
        }
        exact_diagram(Seeds(test_device(), grid, points, to_centres), snapped, {metric});
        if (count > 7) BOOST_TEST(count_differences(snapped.read(), expected) > 100u);
        BOOST_TEST(
            count_differences(labels_of(PlaneSeeds(grid, points, to_centres), Tiling(grid, 50), {metric}),
                              snapped.read()) == 0u);
      }
    }
  }
}

// The cells of tiles are those of one diagram.
BOOST_AUTO_TEST_CASE(cells_of_tiles_of_points_are_those_of_one_grid) {
  std::mt19937 rng(13);
  const Grid grid(100, 80, Axes::xy);
  std::vector<Point> points;
  for (int i = 0; i < 40; ++i)
    points.push_back({static_cast<double>(rng()) * 0x1p-32 * 100, static_cast<double>(rng()) * 0x1p-32 * 80});
  // One owns more than half a period, along which pixels lie the shorter way round from it.
  for (const std::size_t count : {points.size(), std::size_t{2}, std::size_t{1}}) {
    points.resize(count);
    const PlaneSeeds seeds(grid, points, {Outside::count, Snap::none});
    PlaneCells cells;
    TileOptions options;
    options.cells = &cells;
    exact_tiles(
        test_device(), seeds, Tiling(grid, 33), [](const TileLabels&) {}, options);
    Diagram diagram(test_device(), grid);
    exact_diagram(Seeds(test_device(), grid, points, {Outside::count, Snap::none}), diagram);
    CellSumsResult sums;
    CellShapesResult shapes;
    cell_sums(diagram, sums);
    cell_shapes(diagram, shapes);
    const std::vector<CellSums> expected = sums.read();
    const std::vector<CellShape> boxes = shapes.read();
    for (std::size_t id = 0; id < count; ++id) {
      const PlaneCell cell = cells.cell(id);
      BOOST_TEST(cell.area == expected[id].area);
      if (cell.area == 0) continue;
      BOOST_TEST(cell.centroid.x == expected[id].centroid().x, boost::test_tools::tolerance(1e-12));
      BOOST_TEST(cell.centroid.y == expected[id].centroid().y, boost::test_tools::tolerance(1e-12));
      BOOST_TEST((cell.left == boxes[id].left && cell.right == boxes[id].right && cell.top == boxes[id].top &&
                  cell.bottom == boxes[id].bottom));
    }
  }
}

BOOST_AUTO_TEST_CASE(seeds_may_come_with_ids_of_their_own) {
  const Grid grid(300, 200);
  const std::vector<Point> points = {{10, 10}, {200, 100}, {10.5, 10.5}, {250, 150}};
  PlaneSeeds seeds(grid, to_centres);
  const std::vector<PlaneSeed> shuffled = {{10, 10, 2}, {250, 150, 3}, {10, 10, 0}, {200, 100, 1}};
  seeds.add(shuffled.data(), shuffled.size());
  BOOST_TEST(seeds.alive() == 4u);
  BOOST_TEST(seeds.id_end() == 4u);
  const Tiling tiling(grid, 128);
  BOOST_TEST(count_differences(labels_of(seeds, tiling),
                               labels_of(PlaneSeeds(grid, points, to_centres), tiling)) == 0u);
}

BOOST_AUTO_TEST_CASE(points_are_taken_as_by_seeds) {
  const Grid grid(Axis(90, -180, 180).periodic(), Axis(45, -90, 90).reversed());
  const std::vector<std::optional<Point>> points = {Point{190, 80},   std::nullopt,   Point{0, 90.1},
                                                    Point{-700, -90}, Point{17, -17}, Point{0, -90.1}};
  for (const Outside outside : {Outside::count, Outside::absent}) {
    PlaneSeeds seeds(grid, {outside, Snap::to_pixels});
    seeds.add(Points(points));
    seeds.add(std::vector<Point>{{100, 3}});
    BOOST_TEST(seeds.id_end() == 7u);
    std::vector<std::optional<Point>> all = points;
    all.push_back(Point{100, 3});
    const Seeds expected(test_device(), grid, all, {outside, Snap::to_pixels});
    BOOST_TEST(seeds.alive() == expected.alive());
    BOOST_TEST(seeds.outside() == expected.outside());
    Diagram diagram(test_device(), grid);
    exact_diagram(expected, diagram);
    BOOST_TEST(count_differences(labels_of(seeds, Tiling(grid, 32)), diagram.read()) == 0u);
  }
  check_error(
      [&] {
        PlaneSeeds(grid, points, {Outside::refuse, Snap::to_pixels});
      },
      {"point 2", "outside the grid", "[-90, 90)"});
}

BOOST_AUTO_TEST_CASE(what_is_not_possible_is_refused) {
  const Grid grid(100, 100), torus(100, 100, Axes::x);
  check_error([&] { Tiling(grid, 40000); }, {"40000"});
  check_error([&] { Tiling(grid, 0); }, {"0 pixels"});
  check_error([&] { Tiling({torus, 0, 0, 101, 5}, 10); }, {"101 pixels along x", "repeats after 100"});
  check_error([&] { Tiling(grid, 10).tile(100); }, {"no tile 100"});

  const double nan = std::numeric_limits<double>::quiet_NaN();
  PlaneSeeds seeds(grid, to_centres), periodic(torus, to_centres);
  const std::vector<Point> good = {{1, 1}, {99, 99}}, bad = {{2, 2}, {nan, 3}}, far = {{3e9, 3}};
  seeds.add(good);
  check_error([&] { seeds.add(bad); }, {"point 3", "not finite"});
  check_error([&] { seeds.add(far); }, {"point 2", "too far away"});
  BOOST_TEST(seeds.alive() == 2u);
  const PlaneSeed beyond = {5, INT32_MIN, 7}, none = {5, 5, no_label}, wrapped = {100, 5, 7};
  check_error([&] { seeds.add(&beyond, 1); }, {"seed 7", "too far away"});
  check_error([&] { seeds.add(&none, 1); }, {"2^32 - 1"});
  check_error([&] { periodic.add(&wrapped, 1); }, {"seed 7", "outside the grid's period"});
  const PlaneSeed apart = {5, 5, 7, 4096, 0};
  check_error([&] { seeds.add(&apart, 1); }, {"seed 7", "4096 and 0 parts"});
  BOOST_TEST(seeds.id_end() == 2u);
  std::vector<PlaneSeed> near;
  seeds.find_near(grid, Metric::euclidean, near);
  BOOST_TEST(near.size() == 2u);
  check_error([&] { seeds.add(good); }, {"asked for already"});
  check_error(
      [&] { PlaneSeeds(Grid(40000, 1), to_centres).find_near(Grid(40000, 1), Metric::euclidean, near); },
      {"40000 x 1", "32768"});
  check_error([&] { exact_tiles(test_device(), seeds, Tiling(Grid(50, 100), 10), [](const TileLabels&) {}); },
              {"another grid"});

  // What the caller's function throws comes out, and nothing more is made.
  int made = 0;
  BOOST_CHECK_THROW(exact_tiles(test_device(), seeds, Tiling(seeds.grid(), 20),
                                [&](const TileLabels&) {
                                  ++made;
                                  throw std::runtime_error("enough");
                                }),
                    std::runtime_error);
  BOOST_TEST(made == 1);
}
