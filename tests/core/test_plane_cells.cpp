// Cells of a grid that is made tile by tile, against those of the whole grid at once.
#define BOOST_TEST_MODULE plane_cells
#include <algorithm>
#include <optional>

#include "brute_force.hpp"
#include "plane_image.hpp"
#include "read_measures.hpp"

using namespace vorocl;

BOOST_AUTO_TEST_CASE(cells_are_those_of_the_whole_grid) {
  for (const Axes axes : {Axes::none, Axes::x, Axes::y, Axes::xy}) {
    for (const std::size_t count : {1u, 3u, 40u, 3000u}) {
      const Grid grid(231, 190, axes);
      const std::vector<Point> points = centres(random_pixels(grid, count, 4));
      const Seeds seeds(test_device(), grid, points, to_centres);
      Diagram diagram(test_device(), grid);
      exact_diagram(seeds, diagram);
      const auto expected = sums_of(diagram);
      const auto expected_shapes = shapes_of(diagram);
      const auto expected_pairs = pairs_of(diagram);
      for (const int side : {64, 100, 231}) {
        PlaneCells cells;
        TileOptions options;
        options.cells = &cells;
        labels_of(PlaneSeeds(grid, points, to_centres), Tiling(grid, side), options);
        BOOST_TEST(cells.size() == count);
        for (std::size_t id = 0; id < count; ++id) {
          const PlaneCell cell = cells.cell(id);
          const CellShape& shape = expected_shapes[id];
          BOOST_TEST_CONTEXT(count << " seeds, tiles of " << side << ", axes " << static_cast<int>(axes)
                                   << ", cell " << id) {
            BOOST_TEST(cell.area == expected[id].area);
            if (cell.area == 0) continue;
            BOOST_TEST(cell.centroid.x == expected[id].centroid().x);
            BOOST_TEST(cell.centroid.y == expected[id].centroid().y);
            BOOST_TEST((cell.left == shape.left && cell.top == shape.top && cell.right == shape.right &&
                        cell.bottom == shape.bottom));
            BOOST_TEST(cell.touches_border == shape.touches_border);
          }
        }
        const std::vector<PlaneCellPair> found = cells.pairs();
        BOOST_TEST(found.size() == expected_pairs.size());
        for (std::size_t i = 0; i < std::min(found.size(), expected_pairs.size()); ++i) {
          BOOST_TEST((found[i].a == expected_pairs[i].a && found[i].b == expected_pairs[i].b &&
                      found[i].length == expected_pairs[i].length));
        }
      }
    }
  }
}

BOOST_AUTO_TEST_CASE(sums_can_be_given_away_and_added) {
  for (const Axes axes : {Axes::none, Axes::xy}) {
    const Grid grid(231, 190, axes);
    const std::vector<Point> points = centres(random_pixels(grid, 300, 4));
    const PlaneSeeds seeds(grid, points, to_centres);
    const Tiling tiling(grid, 50);
    PlaneCells whole;
    TileOptions options;
    options.cells = &whole;
    labels_of(seeds, tiling, options);

    // By two who have every other tile, and give away what they have after every third.
    PlaneCells sums;
    for (const std::uint64_t first : {1u, 0u}) {
      PlaneCells some;
      options.cells = &some;
      std::uint64_t number = first;
      const NextTile next = [&]() -> std::optional<std::uint64_t> {
        number += 2;
        return number - 2 < tiling.count() ? std::optional(number - 2) : std::nullopt;
      };
      int made = 0;
      exact_tiles(
          test_device(), seeds, tiling, next,
          [&](const TileLabels&) {
            if (++made % 3 == 0) sums.add(some.take());
          },
          options);
      sums.add(some.take());
      sums.add(some.take());  // nothing is left
    }
    BOOST_TEST(sums.size() == whole.size());
    for (std::size_t id = 0; id < points.size(); ++id) {
      const PlaneCell cell = sums.cell(id), expected = whole.cell(id);
      BOOST_TEST(cell.area == expected.area);
      if (cell.area == 0) continue;
      BOOST_TEST((cell.centroid.x == expected.centroid.x && cell.centroid.y == expected.centroid.y));
      BOOST_TEST((cell.left == expected.left && cell.bottom == expected.bottom));
      BOOST_TEST(cell.touches_border == expected.touches_border);
    }
    const auto pairs = sums.pairs(), expected = whole.pairs();
    BOOST_REQUIRE(pairs.size() == expected.size());
    for (std::size_t i = 0; i < pairs.size(); ++i) {
      BOOST_TEST((pairs[i].a == expected[i].a && pairs[i].b == expected[i].b &&
                  pairs[i].length == expected[i].length));
    }

    std::vector<char> taken = sums.take();
    PlaneCells of_other_tiles;
    options.cells = &of_other_tiles;
    labels_of(seeds, Tiling(grid, 64), options);
    check_error([&] { of_other_tiles.add(taken); }, {"of other tiles"});
    taken.pop_back();
    check_error([&] { PlaneCells().add(taken); }, {"these are not the sums"});
    PlaneCells none;
    none.add(PlaneCells().take());
    BOOST_TEST(none.size() == 0u);
  }
}

// One cell of 2^62 pixels is more than can be made; some tiles of it are enough for sums past 64 bits.
BOOST_AUTO_TEST_CASE(sums_may_pass_64_bits) {
  const std::int64_t side = Axis::max_pixels;
  const Grid grid(side, side);
  const Tiling tiling({grid, side - 8192, side - 4096, 8192, 4096}, 4096);
  PlaneCells cells;
  TileOptions options;
  options.cells = &cells;
  exact_tiles(
      test_device(), PlaneSeeds(grid, {{0.5, 0.5}}, to_centres), tiling, [](const TileLabels&) {}, options);
  const PlaneCell cell = cells.cell(0);
  BOOST_TEST(cell.area == 8192u * 4096u);
  BOOST_TEST(cell.centroid.x == static_cast<double>(side) - 4096);
  BOOST_TEST(cell.centroid.y == static_cast<double>(side) - 2048);
  BOOST_TEST(cell.touches_border);
}
