// Planes made tile by tile: labels and the seeds that a tile needs, against the whole plane at once
// and against brute force.
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

/// Which seed is nearest to each pixel of a part, in 64-bit integers, tie rule included.
Labels brute_force(const Plane& plane, const std::vector<Point>& points, const PlaneRectangle& part,
                   Metric metric) {
  const auto away = [](std::int64_t from, std::int64_t to, bool periodic, std::int64_t period) {
    const std::int64_t distance = std::abs(from - to);
    return periodic ? std::min(distance, period - distance) : distance;
  };
  Labels labels;
  for (std::int64_t y = part.y; y < part.y + part.height; ++y) {
    for (std::int64_t x = part.x; x < part.x + part.width; ++x) {
      std::uint32_t best = no_label;
      std::int64_t least = 0, best_x = 0, best_y = 0;
      for (std::uint32_t id = 0; id < points.size(); ++id) {
        const auto seed_x = static_cast<std::int64_t>(std::floor(points[id].x));
        const auto seed_y = static_cast<std::int64_t>(std::floor(points[id].y));
        const std::int64_t dx = away(seed_x, x, has_x(plane.periodic()), plane.width());
        const std::int64_t dy = away(seed_y, y, has_y(plane.periodic()), plane.height());
        const std::int64_t distance = metric == Metric::euclidean ? dx * dx + dy * dy : dx + dy;
        if (best == no_label || distance < least ||
            (distance == least && std::make_pair(seed_y, seed_x) < std::make_pair(best_y, best_x))) {
          best = id;
          least = distance;
          best_x = seed_x;
          best_y = seed_y;
        }
      }
      labels.push_back(best);
    }
  }
  return labels;
}

}  // namespace

BOOST_AUTO_TEST_CASE(a_plane_is_cut_into_tiles) {
  const Tiling whole({100, 70}, 32);
  BOOST_TEST(whole.columns() == 4u);
  BOOST_TEST(whole.rows() == 3u);
  BOOST_TEST(whole.count() == 12u);
  const Tile last = whole.tile(11);
  BOOST_TEST((last.x == 96 && last.y == 64 && last.width == 4 && last.height == 6));
  const Tiling part({2147483647, 2147483647}, 1000, {2147480000, 5, 3647, 2000});
  BOOST_TEST(part.count() == 8u);
  const Tile corner = part.tile(3);
  BOOST_TEST((corner.x == 2147483000 && corner.y == 5 && corner.width == 647 && corner.height == 1000));
  BOOST_TEST(default_tile_side(test_device()) >= 256);
}

BOOST_AUTO_TEST_CASE(labels_are_those_of_the_whole_plane) {
  std::size_t number = 0;
  for (const Case& c : all_edge_cases()) {
    const PlaneSeeds seeds(c.grid, centres(c.seeds));
    constexpr int sides[] = {64, 33, 16, 50, 40};
    const int side = sides[number++ % std::size(sides)];
    for (const Metric metric : both_metrics) {
      const Labels labels = labels_of(seeds, Tiling(c.grid, side), {metric});
      const std::size_t wrong = count_differences(labels, vorocl::brute_force(c.grid, c.seeds, metric));
      BOOST_TEST(wrong == 0u, c.name << ", tiles of " << side << ", " << name_of(metric) << ": " << wrong);
    }
  }
}

BOOST_AUTO_TEST_CASE(tiles_and_their_order_do_not_matter) {
  for (const Periodic axes : {Periodic::none, Periodic::xy}) {
    const Grid grid(700, 500, axes);
    const std::vector<Pixel> pixels = random_pixels(grid, 900, 5);
    const PlaneSeeds seeds(grid, centres(pixels));
    Diagram diagram(test_device(), grid);
    for (const Metric metric : both_metrics) {
      exact_diagram(Seeds(test_device(), grid, centres(pixels)), diagram, {metric});
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
  for (const Periodic axes : {Periodic::none, Periodic::x, Periodic::xy}) {
    std::vector<Point> inside = points;
    if (axes != Periodic::none) inside.pop_back();
    const Plane plane(Plane::max_side, Plane::max_side, axes);
    const PlaneSeeds seeds(plane, inside);
    const std::int64_t last = Plane::max_side - 1, middle = last / 2;
    for (const PlaneRectangle& part : {PlaneRectangle{0, 0, 40, 30},
                                       {last - 39, last - 29, 40, 30},
                                       {middle, middle, 40, 30},
                                       {last / 3 - 20, middle - 15, 40, 30},
                                       {0, middle - 15, 40, 30},
                                       {last - 39, middle - 15, 40, 30},
                                       {last / 3 * 2 - 20, 0, 40, 30},
                                       {middle - 20, last / 4 - 15, 40, 30}}) {
      for (const Metric metric : both_metrics) {
        const Labels labels = labels_of(seeds, Tiling(plane, 17, part), {metric});
        BOOST_TEST(count_differences(labels, brute_force(plane, inside, part, metric)) == 0u,
                   "at (" << part.x << ", " << part.y << "), " << name_of(metric));
      }
    }
  }
}

// A cluster seen from afar: what a tile needs is little of it, and that is all it needs.
BOOST_AUTO_TEST_CASE(few_seeds_of_a_far_cluster_matter) {
  for (const Periodic axes : {Periodic::none, Periodic::xy}) {
    const Plane plane(65536, 65536, axes);
    const std::vector<Point> points = disc({20000, 30000}, 1000, 20000, 3);
    const PlaneSeeds seeds(plane, points);
    std::mt19937 rng(8);
    for (int i = 0; i < 6; ++i) {
      const PlaneRectangle tile = {static_cast<std::int64_t>(rng() % 64000),
                                   static_cast<std::int64_t>(rng() % 64000), 1024, 1024};
      for (const Metric metric : both_metrics) {
        std::vector<PlaneSeed> near;
        seeds.find_near(tile, metric, near);
        BOOST_TEST(near.size() < 200u);
        std::set<std::uint32_t> ids;
        for (const PlaneSeed& seed : near) ids.insert(seed.id);
        BOOST_TEST(ids.size() == near.size());
        const PlaneRectangle part = {tile.x + static_cast<std::int64_t>(rng() % 1000),
                                     tile.y + static_cast<std::int64_t>(rng() % 1000), 8, 8};
        for (const std::uint32_t label : brute_force(plane, points, part, metric)) {
          BOOST_TEST(ids.count(label) == 1u);
        }
        BOOST_TEST(count_differences(labels_of(seeds, Tiling(plane, 8, part), {metric}),
                                     brute_force(plane, points, part, metric)) == 0u);
      }
    }
  }
}

BOOST_AUTO_TEST_CASE(seeds_may_come_with_ids_of_their_own) {
  const Plane plane(300, 200);
  const std::vector<Point> points = {{10, 10}, {200, 100}, {10.5, 10.5}, {250, 150}};
  PlaneSeeds seeds(plane);
  const std::vector<PlaneSeed> shuffled = {{10, 10, 2}, {250, 150, 3}, {10, 10, 0}, {200, 100, 1}};
  seeds.add(shuffled.data(), shuffled.size());
  BOOST_TEST(seeds.size() == 4u);
  BOOST_TEST(seeds.ids() == 4u);
  const Tiling tiling(plane, 128);
  BOOST_TEST(count_differences(labels_of(seeds, tiling), labels_of(PlaneSeeds(plane, points), tiling)) == 0u);
}

BOOST_AUTO_TEST_CASE(what_is_not_possible_is_refused) {
  check_error([] { Plane(0, 5); }, {"width is 0", "2147483647"});
  check_error([] { Plane(5, std::int64_t{1} << 31); }, {"height is 2147483648"});
  check_error([] { Tiling({100, 100}, 40000); }, {"40000"});
  check_error([] { Tiling({100, 100}, 10, {95, 0, 6, 5}); }, {"6 pixels", "x = 95", "100"});
  check_error([] { Tiling({100, 100}, 10, {0, -1, 6, 5}); }, {"y = -1"});
  check_error([] { Tiling({100, 100}, 10).tile(100); }, {"no tile 100"});

  const double nan = std::numeric_limits<double>::quiet_NaN();
  PlaneSeeds seeds({100, 100});
  const std::vector<Point> good = {{1, 1}, {99, 99}}, bad = {{2, 2}, {nan, 3}}, far = {{3e9, 3}};
  seeds.add(good.data(), good.size());
  check_error([&] { seeds.add(bad.data(), bad.size()); }, {"point 3", "not finite"});
  check_error([&] { seeds.add(far.data(), far.size()); }, {"point 2", "too far away"});
  BOOST_TEST(seeds.size() == 2u);
  const PlaneSeed beyond = {5, INT32_MIN, 7}, none = {5, 5, no_label};
  check_error([&] { seeds.add(&beyond, 1); }, {"seed 7", "too far away"});
  check_error([&] { seeds.add(&none, 1); }, {"2^32 - 1"});
  BOOST_TEST(seeds.ids() == 2u);
  std::vector<PlaneSeed> near;
  seeds.find_near({0, 0, 100, 100}, Metric::euclidean, near);
  BOOST_TEST(near.size() == 2u);
  check_error([&] { seeds.add(good.data(), 1); }, {"asked for already"});
  const Plane other(50, 100);
  check_error([&] { exact_tiles(test_device(), seeds, Tiling(other, 10), [](const TileLabels&) {}); },
              {"another plane"});

  // What the caller's function throws comes out, and nothing more is made.
  int made = 0;
  BOOST_CHECK_THROW(exact_tiles(test_device(), seeds, Tiling(seeds.plane(), 20),
                                [&](const TileLabels&) {
                                  ++made;
                                  throw std::runtime_error("enough");
                                }),
                    std::runtime_error);
  BOOST_TEST(made == 1);
}
