// The exact engine: no wrong pixel, tie rule included, on any input; judged by brute force on the host, by
// the reference kernel and by a k-d tree.
#define BOOST_TEST_MODULE exact_diagram
#include <algorithm>
#include <cmath>
#include <numeric>

#include "exact_cases.hpp"
#include "reference.hpp"
#include "samples.hpp"
#include "seed_tree.hpp"

using namespace vorocl;

namespace {

/// The ways in which the engine works: its shapes and work-groups, and its lists.
struct Engine {
  std::string name;
  Device device;
  ListLength lists;
};

const std::vector<Engine>& engines() {
  static const std::vector<Engine> all = [] {
    std::vector<Engine> made;
    for (const ListLength lists : both_lengths) {
      const std::string of_lists = std::string(", ") + name_of(lists);
      if (takes(Shape::vector))
        made.push_back({"vector shape" + of_lists, shaped(Shape::vector, lists), lists});
      for (const std::size_t items : {64u, 256u}) {
        if (items != 64 && lists != ListLength::full) continue;
        made.push_back({"group shape, " + std::to_string(items) + " items" + of_lists,
                        shaped(Shape::group, lists, items), lists});
      }
    }
    return made;
  }();
  return all;
}

/// Those for a grid and a metric: kernels are built anew for each kind of axes, and for narrow grids.
/// test_group_shape.cpp has the group shape's periodic axes.
std::vector<Engine> engines(const Grid& grid, Metric metric) {
  std::vector<Engine> some;
  const bool periodic = grid.periodic() != Axes::none;
  for (const Engine& engine : engines()) {
    if (periodic && engine.device.tuning().shape == Shape::group) continue;
    if (grid.periodic() != Axes::xy && periodic && engine.lists != ListLength::full) continue;
    if (grid.width() < 16 && engine.lists != ListLength::full && (periodic || metric == Metric::manhattan))
      continue;
    some.push_back(engine);
  }
  return some;
}

Labels reference_labels(const Grid& grid, const std::vector<Pixel>& seeds, Metric metric) {
  return vorocl::reference_labels(Seeds(test_device(), grid, centres(seeds), to_centres), metric);
}

void check_against_tree(const Grid& grid, const std::vector<Pixel>& seeds, Metric metric = Metric::euclidean,
                        bool short_lists_too = false) {
  const Labels expected = tree_labels(grid, seeds, metric);
  for (const Engine& engine : engines(grid, metric)) {
    if (engine.lists != ListLength::full && !short_lists_too) continue;
    BOOST_TEST_CONTEXT(grid.width() << " x " << grid.height() << ", " << seeds.size() << " seeds, "
                                    << vorocl::name_of(metric) << ", " << engine.name) {
      BOOST_TEST(count_differences(exact_labels(engine.device, grid, seeds, metric), expected) == 0);
    }
  }
}

}  // namespace

BOOST_AUTO_TEST_CASE(edge_cases_against_brute_force_and_the_reference) {
  for (const Metric metric : both_metrics) {
    for (const Case& c : all_edge_cases(metric)) {
      const Labels expected = brute_force(c.grid, c.seeds, metric);
      BOOST_TEST_CONTEXT(c.name << ", " << vorocl::name_of(metric) << ", reference") {
        BOOST_TEST(count_differences(reference_labels(c.grid, c.seeds, metric), expected) == 0);
      }
      for (const Engine& engine : engines(c.grid, metric)) {
        BOOST_TEST_CONTEXT(c.name << ", " << vorocl::name_of(metric) << ", " << engine.name) {
          const Labels labels = exact_labels(engine.device, c.grid, c.seeds, metric);
          BOOST_TEST(count_differences(labels, expected) == 0);
        }
      }
    }
  }
}

BOOST_AUTO_TEST_CASE(random_small_cases_against_brute_force_and_the_reference) {
  std::mt19937 rng(1);
  const auto below = [&](std::int64_t n) { return static_cast<int>(rng() % static_cast<unsigned>(n)); };
  for (int i = 0; i < (long_tests ? 100000 : 3000); ++i) {
    // Some are large enough for rows across the border of a period.
    const int most_pixels = i % 32 == 0 ? 160 : 64;
    const bool periodic = rng() % 2 == 0;
    const Grid grid((periodic ? 16 : 1) + below(most_pixels), 1 + below(most_pixels),
                    periodic ? Axes::xy : Axes::none);
    // All orders of magnitude alike, in a part of the grid, so that some of it is empty.
    const Grid part(1 + below(grid.width()), 1 + below(grid.height()));
    const double most = std::log(static_cast<double>(grid.pixels()) + 1);
    const auto count = static_cast<std::size_t>(std::exp(most * below(1001) / 1000.0) - 0.99);
    auto seeds = random_pixels(part, count, static_cast<unsigned>(rng()));
    const int right = below(grid.width() - part.width() + 1);
    for (Pixel& seed : seeds) seed.x += right;
    const Metric drawn = both_metrics[rng() % 2];
    const Metric metric = is_narrow(grid) && !long_tests ? Metric::euclidean : drawn;
    const Labels expected = brute_force(grid, seeds, metric);
    BOOST_TEST(count_differences(reference_labels(grid, seeds, metric), expected) == 0);
    for (const Engine& engine : engines(grid, metric)) {
      // The usual ways each time, the others now and then.
      const bool usual = engine.lists == ListLength::full && engine.device.tuning().patch_items == 64;
      if (!usual && rng() % 4 != 0) continue;
      const Labels labels = exact_labels(engine.device, grid, seeds, metric);
      const std::size_t wrong = count_differences(labels, expected);
      BOOST_TEST(wrong == 0, "case " << i << ": " << wrong << " wrong pixels of " << grid.width() << " x "
                                     << grid.height() << " (periodic " << static_cast<int>(grid.periodic())
                                     << ") with " << count << " seeds, " << vorocl::name_of(metric) << ", "
                                     << engine.name);
      if (wrong > 0) return;
    }
  }
}

BOOST_AUTO_TEST_CASE(hurtful_sets_against_a_tree) {
  for (const Axes axes : {Axes::none, Axes::xy}) {
    const Grid grid = long_tests ? Grid(2048, 2048, axes) : Grid(509, 384, axes);
    for (const Metric metric : both_metrics) {
      for (const Case& c : hurtful_cases(grid)) {
        BOOST_TEST_CONTEXT(c.name) { check_against_tree(grid, c.seeds, metric, !long_tests); }
      }
    }
  }
}

BOOST_AUTO_TEST_CASE(large_diagrams_against_a_tree) {
  const Grid square(2048, 2048), wide(2064, 2040);
  check_against_tree(square, random_pixels(square, 16384, 21));
  check_against_tree(wide, random_pixels(wide, 200000, 32));  // by passes, whose labels go past the caches
  check_against_tree({32768, 64}, random_pixels({32768, 64}, 1, 22));
  check_against_tree({64, 32768}, random_pixels({64, 32768}, 3000, 23), Metric::manhattan);
  // Seeds that are as far apart as they can be: distances just below 2^31.
  check_against_tree({32768, 40}, {{0, 0}, {32767, 39}});
  // The longest periods, and seeds half of one away.
  check_against_tree({32000, 40, Axes::xy}, {{31999, 39}});
  check_against_tree({40, 32000, Axes::xy}, {{39, 31999}});
  check_against_tree({32000, 64, Axes::x}, random_pixels({32000, 64}, 30, 26));
  check_against_tree({40, 31999, Axes::xy}, random_pixels({40, 31999}, 900, 27), Metric::manhattan);
  // Regions that have one list, ways longer than 4,096 pixels, and labels that go past the caches line by
  // line.
  for (const Metric metric : both_metrics) {
    check_against_tree({9008, 600}, random_pixels({9008, 600}, 30, 29), metric, true);
    check_against_tree({9008, 600}, random_pixels({500, 600}, 400, 30), metric);
  }
  // Boxes in the middle have so many candidates, 36 of each 8 x 8, and so far away, that keys are relative to
  // one of them: 5,793 squared and the six bits of a rank reach 2^31.
  std::vector<Pixel> columns;
  for (int y = 0; y < 64; ++y)
    for (const int x : {0, 2 * 5793}) columns.push_back({x, y});
  check_against_tree({2 * 5793 + 1, 64}, columns);
  const Grid torus(2048, 2048, Axes::xy);
  for (const std::size_t count : {3u, 400u, 20000u})
    check_against_tree(torus, random_pixels(torus, count, 28));
  if (!long_tests) return;
  for (const Metric metric : both_metrics) {
    for (const std::size_t count : {1u, 2u, 64u, 1024u, 16384u, 65536u, 262144u}) {
      check_against_tree(square, random_pixels(square, count, 24), metric);
    }
    check_against_tree(square, every_pixel(square), metric);
    check_against_tree({4096, 1000}, random_pixels({4096, 1000}, 5000, 25), metric);
  }
}

BOOST_AUTO_TEST_CASE(real_seeds_against_a_tree) {
  const Grid map(1440, 720);
  for (const Metric metric : both_metrics) check_against_tree(map, cities(map), metric);
  const Grid box(600, 500);
  for (const char* dump : {"lj-clusters.lammpstrj", "lj-melt.lammpstrj"}) {
    for (const Metric metric : both_metrics) check_against_tree(box, particles(dump, box), metric);
  }
}

BOOST_AUTO_TEST_CASE(same_labels_for_every_tuning) {
  const Grid grid(301, 203);
  std::vector<Case> cases = hurtful_cases(grid);
  cases.push_back({"sparse and dense", grid, random_pixels(grid, 3000, 31)});
  std::vector<Tuning> tunings(8, test_device().tuning());
  for (std::size_t i = 0; i < 5; ++i) tunings[i].vector_width = 1 << i;
  for (std::size_t i = 5; i < 8; ++i) {
    tunings[i].group_width = std::size_t{1} << (2 * (i - 5));
    tunings[i].group_height = 3;
  }
  for (const Case& c : cases) {
    const Labels expected[] = {exact_labels(test_device(), c.grid, c.seeds, both_metrics[0]),
                               exact_labels(test_device(), c.grid, c.seeds, both_metrics[1])};
    for (std::size_t i = 0; i < tunings.size(); ++i) {
      const Tuning& tuning = tunings[i];
      // Each kind of lists and each metric for some: every pair builds all kernels anew.
      const ListLength lists = both_lengths[i % 2];
      const std::size_t metric = i / 2 % 2;
      BOOST_TEST_CONTEXT(c.name << ", width " << tuning.vector_width << ", groups of " << tuning.group_width
                                << " x " << tuning.group_height << ", " << name_of(lists) << ", "
                                << vorocl::name_of(both_metrics[metric])) {
        const Labels labels = exact_labels(with_lists(test_device().with_tuning(tuning), lists), c.grid,
                                           c.seeds, both_metrics[metric]);
        BOOST_TEST(count_differences(labels, expected[metric]) == 0);
      }
    }
  }
}

BOOST_AUTO_TEST_CASE(order_of_the_seeds_does_not_matter) {
  const Grid grid(200, 150);
  std::vector<Pixel> seeds = every_pixel(grid);
  std::mt19937 rng(41);
  std::shuffle(seeds.begin(), seeds.end(), rng);
  seeds.resize(700);
  std::vector<std::uint32_t> old_id(seeds.size());
  std::iota(old_id.begin(), old_id.end(), 0u);
  const Labels labels = exact_labels(test_device(), grid, seeds);
  std::shuffle(old_id.begin(), old_id.end(), rng);
  const auto shuffled = transformed(old_id, [&](std::uint32_t id) { return seeds[id]; });
  Labels again = exact_labels(test_device(), grid, shuffled);
  for (std::uint32_t& label : again) label = old_id[label];
  BOOST_TEST(count_differences(labels, again) == 0);
}

// Seeds that come in one order and again in the reverse one: where two parts of the list are placed at the
// same time, some pixels meet the higher id first. Not at every try.
BOOST_AUTO_TEST_CASE(lowest_id_of_a_shared_pixel) {
  const Grid grid(300, 200);
  std::vector<Pixel> seeds = random_pixels(grid, 60000, 51);
  const std::vector<Pixel> reverse(seeds.rbegin(), seeds.rend());
  seeds.insert(seeds.end(), reverse.begin(), reverse.end());
  const Labels expected = tree_labels(grid, seeds, Metric::euclidean);
  for (int attempt = 0; attempt < 50; ++attempt) {
    BOOST_TEST(count_differences(exact_labels(test_device(), grid, seeds), expected) == 0);
  }
}

// What earlier frames left in the diagram's working memory must not show.
BOOST_AUTO_TEST_CASE(frame_after_frame_in_one_diagram) {
  const Grid grid(150, 120);
  Diagram diagram(test_device(), grid);
  for (unsigned frame = 0; frame < 40; ++frame) {
    const auto seeds = random_pixels(grid, frame % 2 == 0 ? 12000 : frame, frame);
    if (frame % 5 == 4) jump_flooding(Seeds(test_device(), grid, centres(seeds), to_centres), diagram);
    const Report report = exact_diagram(Seeds(test_device(), grid, centres(seeds), to_centres), diagram);
    BOOST_TEST(count_differences(diagram.read(), tree_labels(grid, seeds, Metric::euclidean)) == 0);
    BOOST_TEST(report.waves() == 0);
    BOOST_TEST(report.milliseconds() > 0);
  }
}

BOOST_AUTO_TEST_CASE(bad_input) {
  const Grid grid(20, 10);
  Diagram diagram(test_device(), grid);
  const Seeds seeds(test_device(), {10, 20}, {{1, 1}}, to_centres);
  check_error([&] { exact_diagram(seeds, diagram); }, {"10 x 20", "20 x 10"});
  // A point in a device buffer that turns out bad leaves no seed, and is named at the next wait.
  const std::vector<cl_float2> points = {{{3, 3}}, {{7, 70}}};
  cl::Buffer buffer(test_device().context(), CL_MEM_READ_WRITE, sizeof(cl_float2) * points.size());
  test_device().queue().enqueueWriteBuffer(buffer, CL_TRUE, 0, sizeof(cl_float2) * points.size(),
                                           points.data());
  exact_diagram(Seeds(test_device(), grid, PointBuffer(buffer, points.size()), kept_on_device), diagram);
  check_error([&] { diagram.read(); }, {"point 1", "outside"});
}
