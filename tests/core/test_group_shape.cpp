// The exact engine's group shape on any device: sizes around multiples of the patch, sets that fill its
// lists, and random cases; judged by brute force, or by a k-d tree where that takes long.
#define BOOST_TEST_MODULE group_shape
#include "exact_cases.hpp"
#include "seed_tree.hpp"

using namespace vorocl;

namespace {

struct Engine {
  std::string name;
  Device device;
};

/// Groups of both sizes and lists of both lengths, each with one of the other: kernels are built anew for
/// each pair and metric.
std::vector<Engine> engines(Metric metric) {
  std::vector<Engine> some;
  for (const ListLength lists : both_lengths) {
    const bool large = (lists == ListLength::full) == (metric == Metric::manhattan);
    const std::size_t items = large ? 256 : 64;
    some.push_back({std::to_string(items) + " items, " + name_of(lists), shaped(Shape::group, lists, items)});
  }
  return some;
}

Labels true_labels(const Grid& grid, const std::vector<Pixel>& seeds, Metric metric) {
  const bool few = grid.pixels() * seeds.size() < 1000000;
  return few ? brute_force(grid, seeds, metric) : tree_labels(grid, seeds, metric);
}

void check(const Case& c, Metric metric, const Engine& engine, const Labels& expected) {
  const std::size_t wrong = count_differences(exact_labels(engine.device, c.grid, c.seeds, metric), expected);
  BOOST_TEST(wrong == 0, c.name << ", " << c.grid.width() << " x " << c.grid.height() << ", "
                                << vorocl::name_of(metric) << ", " << engine.name << ": " << wrong
                                << " wrong pixels");
}

void check_all(const Case& c) {
  for (const Metric metric : both_metrics) {
    const Labels expected = true_labels(c.grid, c.seeds, metric);
    for (const Engine& engine : engines(metric)) check(c, metric, engine, expected);
  }
}

/// With one size of groups, and lists of these lengths: kernels are built anew for each kind of axes.
void check_lists(const Case& c, Metric metric, const std::vector<ListLength>& lengths) {
  const Labels expected = true_labels(c.grid, c.seeds, metric);
  for (const ListLength lists : lengths) {
    check(c, metric, {name_of(lists), shaped(Shape::group, lists)}, expected);
  }
}

int below(std::mt19937& rng, std::int64_t n) { return static_cast<int>(rng() % static_cast<unsigned>(n)); }

/// Seeds at so many places round a circle, in the middle of the grid.
std::vector<Pixel> circle(const Grid& grid, int seeds, double radius) {
  std::vector<Pixel> pixels;
  for (int i = 0; i < seeds; ++i) {
    const double angle = 2 * 3.14159265358979 * i / seeds;
    pixels.push_back({static_cast<int>(static_cast<double>(grid.width()) / 2 + radius * std::cos(angle)),
                      static_cast<int>(static_cast<double>(grid.height()) / 2 + radius * std::sin(angle))});
  }
  return pixels;
}

/// Seeds of some kind, with all orders of magnitude of their number alike.
std::vector<Pixel> random_set(std::mt19937& rng, const Grid& grid) {
  const double most = std::log(static_cast<double>(grid.pixels()) + 1);
  const auto count = static_cast<std::size_t>(std::exp(most * below(rng, 1001) / 1000.0) - 0.99);
  const Grid part(1 + below(rng, grid.width()), 1 + below(rng, grid.height()));
  const int right = below(rng, grid.width() - part.width() + 1);
  const int down = below(rng, grid.height() - part.height() + 1);
  const int kind = below(rng, 4);
  std::vector<Pixel> seeds = random_pixels(part, count, static_cast<unsigned>(rng()));
  for (Pixel& seed : seeds) {
    if (kind == 1) seed.y = 0;                                      // a row
    if (kind == 2) seed = {seed.x / 4 * 4, seed.y / 4 * 4};         // a lattice: ties everywhere
    if (kind == 3 && rng() % 64 != 0) seed = {seed.x / 8, seed.y};  // a crowd, and a few elsewhere
    seed = {seed.x + right, seed.y + down};
  }
  return seeds;
}

}  // namespace

BOOST_AUTO_TEST_CASE(sizes_around_multiples_of_the_patch) {
  for (const int width : {1, 31, 32, 33, 63, 65, 96}) {
    for (const int height : {1, 15, 32, 33, 64, 97}) {
      const Grid grid(width, height);
      for (const std::size_t pixels_per_seed : {1000u, 60u, 5u}) {
        const std::size_t seeds = grid.pixels() / pixels_per_seed + 1;
        check_all({std::to_string(seeds) + " seeds", grid, random_pixels(grid, seeds, 1)});
      }
    }
  }
  check_all({"no seeds", {97, 65}, {}});
  check_all({"every pixel", {97, 65}, every_pixel({97, 65})});
}

BOOST_AUTO_TEST_CASE(lists_that_are_nearly_full) {
  const Grid grid(301, 287);
  // The patch in the middle has all of them as candidates.
  for (const int seeds : {126, 128, 130, 200, 254, 257, 300, 800}) {
    check_all({std::to_string(seeds) + " seeds round a circle", grid, circle(grid, seeds, 140)});
  }
  // Patches that are far from all seeds look at all of them.
  for (const int side : {63, 64, 65}) {
    check_all({"block", grid, every_pixel({side, 64})});
  }
}

BOOST_AUTO_TEST_CASE(rows_within_reach) {
  // One seed at every distance from the border of what rows look at, and dense seeds elsewhere in the patch.
  const Grid grid(96, 96);
  for (int away = 12; away <= 18; ++away) {
    std::vector<Pixel> left, above, right, below;
    for (const Pixel& pixel : every_pixel({8, 8})) {
      left.push_back({44 - away - pixel.x, 44 + pixel.y});
      right.push_back({44 + away + pixel.x, 44 + pixel.y});
      above.push_back({44 + pixel.x, 44 - away - pixel.y});
      below.push_back({44 + pixel.x, 44 + away + pixel.y});
    }
    for (const auto& [name, seeds] :
         {std::pair{"left", left}, {"right", right}, {"above", above}, {"below", below}}) {
      check_all({std::string(name) + " " + std::to_string(away), grid, seeds});
    }
  }
}

// Of two seeds the one outside the patch wins at a corner alone, by 1,089 to 1,105, and is the first one of
// its bin.
BOOST_AUTO_TEST_CASE(farthest_seed_that_can_win) {
  const Grid grid(160, 160);
  for (int variant = 0; variant < 8; ++variant) {
    std::vector<Pixel> seeds = {{71, 72}, {95, 128}};
    for (Pixel& seed : seeds) {
      if (variant & 1) seed.x = 159 - seed.x;
      if (variant & 2) seed.y = 159 - seed.y;
      if (variant & 4) std::swap(seed.x, seed.y);
    }
    check_all({"variant " + std::to_string(variant), grid, seeds});
  }
}

// Seeds near the borders of periods and far, ties across them, and periods shorter than the surroundings of a
// patch.
BOOST_AUTO_TEST_CASE(periodic_axes) {
  const auto cases = [](const Grid& grid) {
    std::vector<Case> all = {{"every pixel", grid, every_pixel(grid)}, {"no seeds", grid, {}}};
    for (const std::size_t pixels_per_seed : {100000u, 1000u, 60u, 5u}) {
      const std::size_t seeds = grid.pixels() / pixels_per_seed + 1;
      all.push_back({std::to_string(seeds) + " seeds", grid, random_pixels(grid, seeds, 4)});
    }
    std::vector<Pixel> lattice, border;
    for (int y = 0; y < grid.height(); y += 4) {
      for (int x = 0; x < grid.width(); x += 4) lattice.push_back({x, y});
    }
    for (int x = 0; x < grid.width(); x += 7) border.push_back({x, x % 2 == 0 ? 0 : grid.height() - 1});
    all.push_back({"lattice", grid, lattice});
    all.push_back({"border", grid, border});
    return all;
  };
  const std::vector<ListLength> both = {std::begin(both_lengths), std::end(both_lengths)},
                                full = {ListLength::full};
  for (const auto& [width, height] : {std::pair{64, 97}, {161, 95}, {128, 64}}) {
    for (const Case& c : cases({width, height, Axes::xy})) {
      check_lists(c, Metric::euclidean, both);
      check_lists(c, Metric::manhattan, full);
    }
    for (const Case& c : cases({width, height, Axes::x})) check_lists(c, Metric::euclidean, full);
    for (const Case& c : cases({width, height, Axes::y})) check_lists(c, Metric::manhattan, full);
  }
  for (const auto& [width, height] : {std::pair{33, 70}, {1, 40}, {90, 7}}) {
    for (const Case& c : cases({width, height, Axes::xy})) check_lists(c, Metric::euclidean, both);
  }
  check_lists({"circle", {300, 290, Axes::xy}, circle({300, 290}, 300, 140)}, Metric::euclidean, both);
  check_lists({"torus", {1001, 700, Axes::xy}, random_pixels({1001, 700}, 3000, 5)}, Metric::euclidean, both);
  check_lists({"long", {16001, 90, Axes::x}, random_pixels({16001, 90}, 40, 6)}, Metric::euclidean, full);
  const Grid tall(70, 31999, Axes::xy);
  for (const std::size_t seeds : {3u, 900u})
    check_lists({"tall", tall, random_pixels(tall, seeds, 7)}, Metric::manhattan, full);
}

BOOST_AUTO_TEST_CASE(rows_of_many_bins) {
  for (const int width : {1040, 4111}) check_all({"wide", {width, 40}, random_pixels({width, 40}, 700, 2)});
}

BOOST_AUTO_TEST_CASE(hurtful_sets) {
  for (const Case& c : hurtful_cases({321, 255})) check_all(c);
}

BOOST_AUTO_TEST_CASE(random_cases) {
  constexpr int sets_of_a_grid = 20;
  std::mt19937 rng(1);
  for (int i = 0; i < (long_tests ? 100000 : 2000) / sets_of_a_grid; ++i) {
    const auto side = [&] { return std::max(32 * below(rng, 5) + below(rng, 5) - 2, 1 + below(rng, 32)); };
    const Grid plain(side(), side());
    const Grid grid(plain.width(), plain.height(), long_tests && i / 2 % 2 == 0 ? Axes::xy : Axes::none);
    const Metric metric = both_metrics[i % 2];
    const std::vector<Engine> some = engines(metric);
    std::vector<Diagram> diagrams;
    for (const Engine& engine : some) diagrams.emplace_back(engine.device, grid);
    for (int set = 0; set < sets_of_a_grid; ++set) {
      const std::size_t which = static_cast<std::size_t>(set) % some.size();
      const std::vector<Pixel> seeds = random_set(rng, grid);
      exact_diagram(Seeds(some[which].device, grid, centres(seeds), to_centres), diagrams[which], {metric});
      const std::size_t wrong = count_differences(diagrams[which].read(), true_labels(grid, seeds, metric));
      BOOST_TEST(wrong == 0, "grid " << i << ", set " << set << ": " << wrong << " wrong pixels of "
                                     << grid.width() << " x " << grid.height() << " with " << seeds.size()
                                     << " seeds, " << vorocl::name_of(metric) << ", " << some[which].name);
      if (wrong > 0) return;
    }
  }
}
