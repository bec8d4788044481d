// Masks of planes, tile by tile, against brute force and the diagram of the whole mask.
#define BOOST_TEST_MODULE plane_mask
#include <cmath>
#include <cstdlib>
#include <limits>
#include <random>

#include "brute_force.hpp"
#include "plane_image.hpp"

using namespace vorocl;

namespace {

const bool long_tests = std::getenv("VOROCL_LONG_TESTS") != nullptr;

using Bytes = std::vector<std::uint8_t>;

/// Noise of some density, blocks of noise, a disc or what is around it, or a lattice, whose ties are many.
Bytes some_mask(const Grid& grid, std::mt19937& rng) {
  const auto width = static_cast<int>(grid.width()), height = static_cast<int>(grid.height());
  const auto number = [&](int end) { return static_cast<int>(rng() % static_cast<unsigned>(end)); };
  const int kind = number(8), step_x = 1 + number(9), step_y = 1 + number(9);
  const double densities[] = {0.5, 0.02, 0.98, 3.0 / (width * height), 0}, radius = 0.5 * number(height + 1);
  std::bernoulli_distribution is_seed(std::min(densities[kind % 5], 1.0));
  std::vector<bool> blocks(static_cast<std::size_t>((width / 32 + 1) * (height / 32 + 1)));
  for (std::size_t i = 0; i < blocks.size(); ++i) blocks[i] = rng() % 2 == 0;
  Bytes pixels;
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const bool in_disc = std::hypot(x - width / 2, y - height / 2) < radius;
      const bool pixel = kind < 5    ? is_seed(rng)
                         : kind == 5 ? blocks[static_cast<std::size_t>(y / 32 * (width / 32 + 1) + x / 32)]
                         : kind == 6 ? in_disc == (step_x % 2 == 0)
                                     : x % step_x == 0 && y % step_y == 0;
      pixels.push_back(pixel ? 255 : 0);
    }
  }
  return pixels;
}

PlaneMask mask_of(const Grid& grid, const Bytes& pixels) {
  PlaneMask mask(grid);
  const std::int64_t first = grid.height() / 3;
  mask.add_rows(pixels.data(), first);
  mask.add_rows(pixels.data() + first * grid.width(), grid.height() - first);
  return mask;
}

std::vector<Pixel> seeds_of(const Grid& grid, const Bytes& pixels) {
  std::vector<Pixel> seeds;
  for (std::int64_t i = 0; i < static_cast<std::int64_t>(pixels.size()); ++i) {
    if (pixels[static_cast<std::size_t>(i)] != 0) seeds.push_back({i % grid.width(), i / grid.width()});
  }
  return seeds;
}

}  // namespace

BOOST_AUTO_TEST_CASE(labels_are_those_of_the_nearest_pixels) {
  std::mt19937 rng(5);
  const auto number = [&](std::int64_t end) {
    return static_cast<std::int64_t>(rng() % static_cast<unsigned>(end));
  };
  constexpr Axes all_axes[] = {Axes::none, Axes::x, Axes::y, Axes::xy};
  for (int i = 0; i < (long_tests ? 1000 : 60); ++i) {
    const Grid grid(1 + number(90), 1 + number(90), all_axes[i % 4]);
    const Metric metric = both_metrics[number(2)];
    const Bytes pixels = some_mask(grid, rng);
    const PlaneMask mask = mask_of(grid, pixels);
    const std::vector<Pixel> seeds = seeds_of(grid, pixels);
    BOOST_TEST(mask.id_end() == seeds.size());
    const std::int64_t x = number(grid.width()), y = number(grid.height());
    for (const Window& window : {Window(grid), Window(grid, x, y, grid.width() - x, grid.height() - y)}) {
      const Tiling tiling(window, 1 + static_cast<int>(number(100)));
      const std::size_t wrong =
          count_differences(labels_of(mask, tiling, {metric}), vorocl::brute_force(window, seeds, metric));
      BOOST_TEST(wrong == 0u, "mask " << i << ", " << name_of(metric) << ", tiles of " << tiling.side());
    }
  }
}

BOOST_AUTO_TEST_CASE(distances_are_to_the_nearest_pixels) {
  std::mt19937 rng(7);
  for (int i = 0; i < 40; ++i) {
    const Grid grid(60 + i % 3, 50 - i % 5, i % 2 == 0 ? Axes::none : Axes::xy);
    const Metric metric = both_metrics[i % 3 == 0 ? 1 : 0];
    const Bytes pixels = some_mask(grid, rng);
    const std::vector<Pixel> seeds = seeds_of(grid, pixels);
    std::size_t wrong = 0, seen = 0;
    const auto use = [&](const TileLabels& tile) {
      for (std::int64_t at = 0; at < tile.tile.width() * tile.tile.height(); ++at, ++seen) {
        const std::int64_t x = tile.tile.x() + at % tile.tile.width(),
                           y = tile.tile.y() + at / tile.tile.width();
        double least = std::numeric_limits<double>::infinity();
        for (const Pixel& seed : seeds) {
          std::int64_t dx = std::abs(seed.x - x), dy = std::abs(seed.y - y);
          if (i % 2 != 0) {
            dx = std::min(dx, grid.width() - dx);
            dy = std::min(dy, grid.height() - dy);
          }
          const double away = metric == Metric::manhattan
                                  ? static_cast<double>(dx + dy)
                                  : std::hypot(static_cast<double>(dx), static_cast<double>(dy));
          least = std::min(least, away);
        }
        const auto found = static_cast<double>(tile.distances[at]);
        wrong += found != least && !(std::abs(found - least) <= 4e-7 * least);
      }
    };
    TileOptions options;
    options.metric = metric;
    options.distances = true;
    exact_tiles(test_device(), mask_of(grid, pixels), Tiling(grid, 17 + i), use, options);
    BOOST_TEST(wrong == 0u, "mask " << i << ": " << wrong);
    BOOST_TEST(seen == pixels.size());
  }
}

BOOST_AUTO_TEST_CASE(tiles_are_parts_of_the_diagram_of_the_whole_mask) {
  std::mt19937 rng(6);
  for (int i = 0; i < (long_tests ? 100 : 8); ++i) {
    const Grid grid(600 + i, 700 - i);
    const Bytes pixels = some_mask(grid, rng);
    Diagram diagram(test_device(), grid);
    exact_diagram(Seeds::from_mask(test_device(), grid, pixels), diagram);
    BOOST_TEST(count_differences(labels_of(mask_of(grid, pixels), Tiling(grid, 128)), diagram.read()) == 0u);
  }
}

BOOST_AUTO_TEST_CASE(a_plane_may_be_longer_than_a_diagram) {
  for (const auto& [width, height] : {std::pair{3, 200000}, std::pair{200000, 3}}) {
    const Grid grid(width, height);
    Bytes pixels(600000, 0);
    const std::vector<Pixel> seeds = {{width / 300, height / 300}, {width - 1, height - 1}};
    for (const Pixel& seed : seeds) pixels[static_cast<std::size_t>(seed.y * width + seed.x)] = 1;
    const PlaneMask mask = mask_of(grid, pixels);
    BOOST_TEST(count_differences(labels_of(mask, Tiling(grid, 1000)),
                                 vorocl::brute_force(grid, seeds, Metric::euclidean)) == 0u);
  }
}

BOOST_AUTO_TEST_CASE(what_a_mask_of_tiles_cannot_be_is_refused) {
  const auto says = [](const std::string& words) {
    return [words](const Error& error) { return std::string(error.what()).find(words) != std::string::npos; };
  };
  BOOST_CHECK_EXCEPTION(PlaneMask(Grid(4, 5, 6)), Error, says("volume"));
  PlaneMask mask(Grid(4, 5));
  const Bytes pixels(24, 1);
  BOOST_CHECK_EXCEPTION(mask.add_rows(pixels.data(), 6), Error, says("cannot take 6 more"));
  mask.add_rows(pixels.data(), 3);
  std::vector<PlaneSeed> near;
  BOOST_CHECK_EXCEPTION(mask.find_near(Grid(4, 5), Metric::euclidean, near), Error, says("has 3 of 5 rows"));
  BOOST_CHECK_EXCEPTION(exact_tiles(test_device(), mask, Tiling(Grid(5, 5), 4), [](const TileLabels&) {}),
                        Error, says("another grid"));
  BOOST_TEST(mask.rows() == 3);
}
