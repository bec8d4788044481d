// Jump flooding: against brute force, the paper's example, and the same result whatever the kernels' shape.
#define BOOST_TEST_MODULE jump_flooding
#include <algorithm>
#include <numeric>

#include "brute_force.hpp"
#include "fixture.hpp"
#include "reference_flood.hpp"

using namespace vorocl;

namespace {

constexpr JumpFloodingVariant all_variants[] = {JumpFloodingVariant::jfa, JumpFloodingVariant::jfa_plus_1,
                                                JumpFloodingVariant::jfa_plus_2,
                                                JumpFloodingVariant::one_plus_jfa};

std::vector<std::uint32_t> labels_of(const Device& device, const Grid& grid, const std::vector<Pixel>& seeds,
                                     const JumpFloodingOptions& options = {}) {
  Diagram diagram(device, grid);
  jump_flooding(Seeds(device, grid, centres(seeds), to_centres), diagram, options);
  return diagram.read();
}

std::size_t count_labelled(const std::vector<std::uint32_t>& labels) {
  return labels.size() - static_cast<std::size_t>(std::count(labels.begin(), labels.end(), no_label));
}

}  // namespace

BOOST_AUTO_TEST_CASE(edge_cases_against_brute_force_and_a_reference) {
  for (const Metric metric : both_metrics) {
    for (const Case& c : all_edge_cases(metric)) {
      const auto ground_truth = brute_force(c.grid, c.seeds, metric);
      for (const Neighbourhood neighbourhood : {Neighbourhood::moore, Neighbourhood::von_neumann}) {
        for (const JumpFloodingVariant variant : all_variants) {
          BOOST_TEST_CONTEXT(c.name << ", " << name_of(metric) << ", " << name_of(neighbourhood)
                                    << ", variant " << static_cast<int>(variant)) {
            const auto labels = labels_of(test_device(), c.grid, c.seeds, {metric, neighbourhood, variant});
            const Plan plan = jump_flooding_plan(c.grid, variant, neighbourhood);
            BOOST_TEST((labels == reference_flood(c.grid, c.seeds, plan, metric)));
            const Verdict verdict = judge(c.grid, c.seeds, metric, labels, ground_truth);
            BOOST_TEST(verdict.invalid == 0);
            BOOST_TEST(verdict.too_near == 0);
            if (neighbourhood == Neighbourhood::moore) {
              BOOST_TEST(verdict.unlabelled == 0);
              // Rong & Tan report errors of a fraction of a percent on large grids. A seed that stands in the
              // way of another one's only path costs more on small ones: at most 14 pixels of 256 were
              // measured here.
              BOOST_TEST(verdict.wrong <= c.grid.pixels() / 18);
            }
          }
        }
      }
    }
  }
}

BOOST_AUTO_TEST_CASE(the_example_of_the_paper) {
  // 8 x 8 pixels and steps 4, 2, 1: from a corner each wave doubles the flooded pixels along both axes.
  const Grid grid(8, 8);
  const Plan plan = jump_flooding_plan(grid);
  BOOST_TEST(to_string(plan) == "4 2 1");
  const Seeds seeds(test_device(), grid, {{0, 0}}, to_centres);
  Diagram diagram(test_device(), grid);
  const std::size_t expected[] = {1, 4, 16, 64};
  for (std::size_t waves = 0; waves <= plan.size(); ++waves) {
    const Report report =
        flood(seeds, diagram, Plan(plan.begin(), plan.begin() + static_cast<long>(waves)), {});
    BOOST_TEST(report.waves() == static_cast<int>(waves));
    BOOST_TEST(count_labelled(diagram.read()) == expected[waves]);
  }
  // A von Neumann wave reaches the 2 neighbours along the axes instead of 3.
  flood(seeds, diagram, {{4, Neighbourhood::von_neumann}}, {});
  BOOST_TEST(count_labelled(diagram.read()) == 3);
}

BOOST_AUTO_TEST_CASE(steps_out_of_range_are_refused) {
  const Grid grid(8, 8);
  const Seeds seeds(test_device(), grid, {{0, 0}}, to_centres);
  Diagram diagram(test_device(), grid);
  check_error([&] { flood(seeds, diagram, {{4}, {0}}, {}); }, {"step is 0"});
  check_error([&] { flood(seeds, diagram, {{1 << 20}}, {}); }, {"step is 1048576"});
}

BOOST_AUTO_TEST_CASE(a_part_of_a_grid_is_not_flooded) {
  const Grid grid(8, 8), ring(40000, 8, Axes::x);
  Diagram whole(test_device(), grid), part(test_device(), Window(grid, 2, 2, 4, 4));
  check_error([&] { jump_flooding(Seeds(test_device(), grid, {{3, 3}}, to_centres), part); }, {"exact"});
  check_error(
      [&] {
        jump_flooding(Seeds(test_device(), grid, {{3, 3}, {-1, 3}}, to_centres), whole);
      },
      {"exact"});
  check_error(
      [&] {
        jump_flooding(Seeds(test_device(), Grid(9, 8), {{3, 3}}, to_centres), whole);
      },
      {"grid"});
  Diagram zoom(test_device(), Window(ring, 0, 0, 8, 8));
  check_error([&] { jump_flooding(Seeds(test_device(), ring, {{3, 3}}, to_centres), zoom); }, {"exact"});
  // Outside is where the point is, and not where its pixel would be after wrapping.
  jump_flooding(Seeds(test_device(), Grid(8, 8), {{3, 3}, {-1, 3}}, {Outside::absent, Snap::to_pixels}),
                whole);
  BOOST_TEST((whole.read() == std::vector<std::uint32_t>(64, 0)));
}

// A window of the whole grid is the grid.
BOOST_AUTO_TEST_CASE(points_are_in_the_units_of_the_data) {
  const Grid pixels(90, 60, Axes::y);
  const Grid data(Axis(90, 10, 11).reversed(), Axis(60, -180, 180).periodic());
  const std::vector<Pixel> seeds = random_pixels(pixels, 200, 3);
  Diagram diagram(test_device(), Window(data, 0, 0, 90, 60));
  const auto points = transformed(seeds, [&](const Pixel& pixel) {
    Point point = data.point(centre(pixel));
    point.y += 360 * static_cast<double>(pixel.x % 3 - 1);  // which wraps
    return point;
  });
  jump_flooding(Seeds(test_device(), data, points, to_centres), diagram);
  BOOST_TEST((diagram.read() == labels_of(test_device(), pixels, seeds)));
}

BOOST_AUTO_TEST_CASE(von_neumann_waves_alone_go_wrong) {
  // The paper's figure of a wrong diagram: regions that are concave or have saw-tooth borders.
  const Grid grid(256, 256);
  const auto seeds = random_pixels(grid, 60, 4);
  const auto ground_truth = brute_force(grid, seeds, Metric::euclidean);
  const auto wrong = [&](Neighbourhood neighbourhood) {
    const auto labels = labels_of(test_device(), grid, seeds, {Metric::euclidean, neighbourhood});
    const Verdict verdict = judge(grid, seeds, Metric::euclidean, labels, ground_truth);
    return verdict.wrong + verdict.unlabelled;
  };
  BOOST_TEST(wrong(Neighbourhood::moore) < grid.pixels() / 1000);
  BOOST_TEST(wrong(Neighbourhood::von_neumann) > grid.pixels() / 100);
}

BOOST_AUTO_TEST_CASE(the_same_labels_for_every_kernel_shape) {
  const Grid grid(143, 61);
  const auto seeds = random_pixels(grid, 300, 6);
  const std::vector<Tuning> shapes = {{1, 32, 8}, {1, 7, 3},  {2, 64, 1}, {4, 1, 16},
                                      {8, 64, 1}, {16, 5, 2}, {16, 64, 1}};
  for (const Metric metric : both_metrics) {
    const auto expected = labels_of(test_device(), grid, seeds, {metric});
    for (const Tuning& shape : shapes) {
      BOOST_TEST_CONTEXT("vector width " << shape.vector_width << ", group " << shape.group_width << " x "
                                         << shape.group_height << ", " << name_of(metric)) {
        BOOST_TEST((labels_of(test_device().with_tuning(shape), grid, seeds, {metric}) == expected));
      }
    }
  }
}

BOOST_AUTO_TEST_CASE(the_same_labels_in_every_run) {
  const Grid grid(300, 200);
  const auto seeds = random_pixels(grid, 500, 7);
  const auto expected = labels_of(test_device(), grid, seeds);
  Diagram diagram(test_device(), grid);
  for (int run = 0; run < 20; ++run) {
    jump_flooding(Seeds(test_device(), grid, centres(seeds), to_centres), diagram);
    BOOST_TEST((diagram.read() == expected));
  }
}

BOOST_AUTO_TEST_CASE(the_same_cells_for_a_permuted_list) {
  const Grid grid(120, 90);
  auto seeds = every_pixel(grid);
  std::mt19937 rng(8);
  std::shuffle(seeds.begin(), seeds.end(), rng);
  seeds.resize(400);  // distinct pixels
  std::vector<std::uint32_t> order(seeds.size());
  std::iota(order.begin(), order.end(), 0u);
  std::shuffle(order.begin(), order.end(), rng);
  const auto permuted = transformed(order, [&](std::uint32_t id) { return seeds[id]; });

  auto labels = labels_of(test_device(), grid, permuted);
  for (std::uint32_t& label : labels) label = order[label];
  BOOST_TEST((labels == labels_of(test_device(), grid, seeds)));
}

BOOST_AUTO_TEST_CASE(the_largest_coordinates) {
  // 32768 wide: a squared distance of nearly 2^30, an empty pixel's coordinates next to real ones.
  const Grid grid(32768, 64);
  for (const Pixel& seed : {Pixel{0, 0}, Pixel{32767, 63}, Pixel{20000, 30}}) {
    for (const Metric metric : both_metrics) {
      BOOST_TEST(
          (labels_of(test_device(), grid, {seed}, {metric}) == std::vector<std::uint32_t>(grid.pixels(), 0)));
    }
  }
  const std::vector<Pixel> ends = {{0, 0}, {32767, 63}};
  BOOST_TEST((labels_of(test_device(), grid, ends) == brute_force(grid, ends, Metric::euclidean)));
  const Grid tall(64, 32768);
  const std::vector<Pixel> tall_ends = {{0, 0}, {63, 32767}};
  BOOST_TEST((labels_of(test_device(), tall, tall_ends) == brute_force(tall, tall_ends, Metric::euclidean)));
}

BOOST_AUTO_TEST_CASE(one_diagram_serves_one_set_of_seeds_after_another) {
  const Grid grid(90, 110);
  Diagram diagram(test_device(), grid);
  for (const unsigned count : {2000u, 3u, 0u, 70u}) {
    const auto seeds = random_pixels(grid, count, count);
    jump_flooding(Seeds(test_device(), grid, centres(seeds), to_centres), diagram);
    BOOST_TEST((diagram.read() == labels_of(test_device(), grid, seeds)));
  }
}
