// Plans: the steps of the waves, against the paper's formula.
#define BOOST_TEST_MODULE plan
#include <cmath>

#include "fixture.hpp"
#include "flooding/reaching_plan.hpp"

using namespace vorocl;

BOOST_AUTO_TEST_CASE(first_step_is_the_formula_of_the_paper) {
  // k1 = 2^(ceil(log2 N) - 1), from the paper's Eq. 2, for N at and around powers of two.
  const std::pair<int, int> expected[] = {{1, 0},        {2, 1},        {3, 2},         {4, 2},
                                          {5, 4},        {7, 4},        {8, 4},         {9, 8},
                                          {100, 64},     {1000, 512},   {1024, 512},    {1025, 1024},
                                          {10000, 8192}, {16384, 8192}, {16385, 16384}, {32768, 16384}};
  for (const auto& [side, step] : expected) {
    BOOST_TEST(first_step(Grid(side, 1)) == step);
    BOOST_TEST(first_step(Grid(1, side)) == step);
  }
}

BOOST_AUTO_TEST_CASE(a_window_counts_and_not_its_grid) {
  const Grid large(2000000000, 100);
  BOOST_TEST(first_step(Window(large, 5, 7, 1000, 1)) == 512);
  BOOST_TEST(to_string(jump_flooding_plan(Window(large, 0, 0, 8, 3))) == "4 2 1");
  check_error([&] { first_step(large); }, {"2000000000"});
  check_error([&] { jump_flooding_plan(Window(large, 0, 0, 32769, 1)); }, {"32769"});
  check_error([&] { dynamic_jump_flooding_plan(Grid(1, 40000), 3, 0); }, {"40000"});
}

BOOST_AUTO_TEST_CASE(plans_of_the_variants) {
  const Grid grid(8, 8);
  BOOST_TEST(to_string(jump_flooding_plan(grid)) == "4 2 1");
  BOOST_TEST(to_string(jump_flooding_plan(grid, JumpFloodingVariant::jfa_plus_1)) == "4 2 1 1");
  BOOST_TEST(to_string(jump_flooding_plan(grid, JumpFloodingVariant::jfa_plus_2)) == "4 2 1 2 1");
  BOOST_TEST(to_string(jump_flooding_plan(grid, JumpFloodingVariant::one_plus_jfa)) == "1 4 2 1");
  BOOST_TEST(to_string(jump_flooding_plan(Grid(5, 3), JumpFloodingVariant::jfa,
                                          Neighbourhood::von_neumann)) == "4v 2v 1v");
  BOOST_TEST(jump_flooding_plan(Grid(1, 1), JumpFloodingVariant::jfa_plus_2).empty());
}

BOOST_AUTO_TEST_CASE(dynamic_plans_follow_the_formula_of_the_paper) {
  const auto plan = [](const Grid& grid, std::size_t seeds, double max_displacement = 0) {
    return to_string(dynamic_jump_flooding_plan(grid, seeds, max_displacement));
  };
  // delta_1 = 2^ceil(log2(max(2 L, d_max))): 100 pixels per seed give 2 L = 20, and so 32.
  BOOST_TEST(plan(Grid(1000, 1000), 10000) == "32v 16v 8 4 2 1");
  // L = 10 at 10,000 seeds; 2 L = 16 exactly at 15,625 seeds; one seed less makes the next power of two.
  BOOST_TEST(plan(Grid(1000, 1000), 15625) == "16v 8v 4 2 1");
  BOOST_TEST(plan(Grid(1000, 1000), 15624) == "32v 16v 8 4 2 1");
  // The staircase: a factor of four in density is one wave less.
  BOOST_TEST(plan(Grid(1024, 1024), 1024) == "64v 32v 16 8 4 2 1");
  BOOST_TEST(plan(Grid(1024, 1024), 4096) == "32v 16v 8 4 2 1");
  BOOST_TEST(plan(Grid(1024, 1024), 16384) == "16v 8v 4 2 1");
  // At most the first step of JFA, and at least 1.
  BOOST_TEST(plan(Grid(8, 8), 1) == "4v 2v 1");
  BOOST_TEST(plan(Grid(64, 64), 16384) == "1");
  // d_max takes over where it is longer than 2 L.
  BOOST_TEST(plan(Grid(1000, 1000), 10000, 33) == "64v 32v 16 8 4 2 1");
  BOOST_TEST(plan(Grid(1000, 1000), 10000, 32) == "32v 16v 8 4 2 1");
  BOOST_TEST(plan(Grid(1, 1), 1).empty());
}

BOOST_AUTO_TEST_CASE(plans_of_the_authors_program_round_down) {
  const auto plan = [](const Grid& grid, std::size_t seeds, double max_displacement = 0) {
    return to_string(dynamic_jump_flooding_plan(grid, seeds, max_displacement, {}, Reach::authors));
  };
  // Their first step is 2^max(int(log2(d_max)), int(log2(L)) + 1), from 1 to JFA's.
  for (const std::size_t seeds : {1, 90, 250, 1000, 3906, 15625, 62499, 62500, 250000}) {
    for (const double most : {1.0, 6.0, 31.0, 32.0, 700.0}) {
      const double length = std::sqrt(1e6 / static_cast<double>(seeds));
      const int power = std::max(static_cast<int>(std::log2(most)), static_cast<int>(std::log2(length)) + 1);
      const Plan waves = dynamic_jump_flooding_plan(Grid(1000, 1000), seeds, most, {}, Reach::authors);
      BOOST_TEST(waves.front().step == std::min(1 << power, 512), seeds << " seeds, d_max " << most);
    }
  }
  BOOST_TEST(plan(Grid(1000, 1000), 10000) == "16v 8v 4 2 1");
  BOOST_TEST(plan(Grid(1000, 1000), 10000, 33) == "32v 16v 8 4 2 1");
  // Where 2 L is a power of two, it is the paper's plan.
  BOOST_TEST(plan(Grid(1024, 1024), 4096) == "32v 16v 8 4 2 1");
  BOOST_TEST(plan(Grid(1024, 1024), 4097) == "16v 8v 4 2 1");
  BOOST_TEST(plan(Grid(8, 8), 1) == "4v 2v 1");
  BOOST_TEST(plan(Grid(64, 64), 16384) == "1");
}

// Whether a plan starts from the seeds, and its waves.
std::string reaching(const Grid& grid, std::size_t seeds, double max_displacement,
                     const LabelDistances& distances, Metric metric = Metric::euclidean,
                     const DynamicPlanOptions& options = {}) {
  const DynamicPlan plan = reaching_plan(grid, seeds, max_displacement, distances, metric, options);
  return (plan.from_seeds ? "seeds: " : "labels: ") + to_string(plan.waves);
}

BOOST_AUTO_TEST_CASE(a_plan_that_reaches_is_the_papers_where_that_can_be_relied_on) {
  const Grid grid(1000, 1000);  // with 10,000 seeds L = 10, and the steps 32 to 1 reach 63
  BOOST_TEST(reaching(grid, 10000, 5, {27, 0.05}) == "labels: 32v 16v 8 4 2 1");
  BOOST_TEST(reaching(grid, 10000, 5, {27, 0.1, 0.01}) == "labels: 32v 16v 8 4 2 1");
  BOOST_TEST(reaching(grid, 10000, 5, {27, 0.05, 0.0101}) == "seeds: 16 8 4 2 1");
  BOOST_TEST(reaching(grid, 10000, 5, {27, 0.101, 0.001}) == "seeds: 16 8 4 2 1");
  BOOST_TEST(reaching(grid, 10000, 5, {89, 0.05}) == "labels: 32v 16v 8 4 2 1");  // 63 sqrt 2 = 89.1
  BOOST_TEST(reaching(grid, 10000, 5, {90, 0.05}) == "seeds: 64 32 16 8 4 2 1");
  BOOST_TEST(reaching(grid, 10000, 5, {126, 0.05}, Metric::manhattan) == "labels: 32v 16v 8 4 2 1");
  BOOST_TEST(reaching(grid, 10000, 5, {127, 0.05}, Metric::manhattan) == "seeds: 64 32 16 8 4 2 1");
  BOOST_TEST(reaching(grid, 10000, 19.9, {27, 0.05}) == "labels: 32v 16v 8 4 2 1");
  BOOST_TEST(reaching(grid, 10000, 20, {27, 0.05}) == "seeds: 16 8 4 2 1");
  // One seed in a thousand may have appeared.
  BOOST_TEST(reaching(grid, 10000, 5, {27, 0.05, 0.001, 0, 1, 10}) == "labels: 32v 16v 8 4 2 1");
  BOOST_TEST(reaching(grid, 10000, 5, {27, 0.05, 0.001, 0, 1, 11}) == "seeds: 16 8 4 2 1");
  // The paper's plan of 50 seeds has all of JFA's steps: the labels must be nearly right already. L = 141.4.
  BOOST_TEST(reaching(grid, 50, 70, {300, 0.05}) == "labels: 512v 256v 128 64 32 16 8 4 2 1");
  BOOST_TEST(reaching(grid, 50, 71, {600, 0.05}) == "seeds: 512 256 128 64 32 16 8 4 2 1");
}

BOOST_AUTO_TEST_CASE(a_plan_from_the_seeds_covers_the_greatest_distance) {
  const Grid grid(1000, 700);
  BOOST_TEST(reaching(grid, 100, 0, {0, 1}) == "seeds: 1");
  BOOST_TEST(reaching(grid, 100, 0, {1, 1}) == "seeds: 1");
  BOOST_TEST(reaching(grid, 100, 0, {1.1, 1}) == "seeds: 2 1");
  BOOST_TEST(reaching(grid, 100, 0, {3, 1}) == "seeds: 2 1");
  BOOST_TEST(reaching(grid, 100, 0, {511, 1}) == "seeds: 256 128 64 32 16 8 4 2 1");
  BOOST_TEST(reaching(grid, 100, 0, {511.5, 1}) == "seeds: " + to_string(jump_flooding_plan(grid)));
  BOOST_TEST(reaching(grid, 100, 0, {3, 1, 1, 0, 13}) == "seeds: 8 4 2 1");
  BOOST_TEST(reaching(grid, 100, 0, {1024, 1}) == "seeds: " + to_string(jump_flooding_plan(grid)));
  const DynamicPlanOptions options = {NeighbourhoodMix::von_neumann, 0, 2};
  BOOST_TEST(reaching(grid, 100, 0, {6, 1}, Metric::euclidean, options) == "seeds: 4v 2v 1v 2v 1v");
  BOOST_TEST(reaching(Grid(1, 1), 1, 0, {0, 1}) == "seeds: ");
}

// A pixel without a label is as far from one with a label as the hole is wide, which its pixels bound.
BOOST_AUTO_TEST_CASE(labels_that_are_missing_lengthen_a_plan) {
  const Grid grid(1000, 1000);
  const auto missing = [&](std::size_t pixels) {
    return reaching(grid, 10000, 5, {27, 0.05, 0.001, pixels, 8});
  };
  BOOST_TEST(missing(286) == "labels: 32v 16v 8 4 2 1");  // 27 + sqrt(4 / pi 8 286) + 8 = 88.98
  BOOST_TEST(missing(288) == "seeds: 64 32 16 8 4 2 1");
  BOOST_TEST(missing(709) == "seeds: 64 32 16 8 4 2 1");  // 27 + 84.98 + 8 + 7 = 126.98
  BOOST_TEST(missing(710) == "seeds: 128 64 32 16 8 4 2 1");
  BOOST_TEST(missing(125000) == "seeds: " + to_string(jump_flooding_plan(grid)));
  // A strip has no quarter of a disc.
  BOOST_TEST(reaching(Grid(1000, 8), 100, 5, {27, 0, 0, 80, 1}) == "seeds: 512 256 128 64 32 16 8 4 2 1");
}

BOOST_AUTO_TEST_CASE(plans_from_labels_know_whether_they_fill_all_pixels) {
  const auto fills = [](std::size_t seeds, std::size_t missing, int row_interval) {
    const LabelDistances distances = {4, 0.05, 0.001, missing, row_interval};
    const DynamicPlan plan = reaching_plan(Grid(1000, 1000), seeds, 1, distances, Metric::euclidean);
    BOOST_TEST(!plan.from_seeds);
    return plan.fills;
  };
  BOOST_TEST(fills(10000, 63, 8));  // 32v 16v 8 4 2 1: a gap in a row, no wider than the steps reach
  BOOST_TEST(!fills(10000, 64, 8));
  // The Moore waves of 8v 4v 2 1 reach 3 pixels along both axes, and 7 rows may lie between measured ones.
  BOOST_TEST(fills(62500, 0, 8));
  BOOST_TEST(fills(62500, 1, 4));
  BOOST_TEST(!fills(62500, 1, 8));
  BOOST_TEST(!fills(1000000, 0, 8));  // 2v 1 reach 3 rows
}

BOOST_AUTO_TEST_CASE(the_neighbourhoods_of_dynamic_plans) {
  const auto plan = [](std::size_t seeds, NeighbourhoodMix mix, int von_neumann_waves, int extra_waves) {
    return to_string(
        dynamic_jump_flooding_plan(Grid(256, 256), seeds, 0, {mix, von_neumann_waves, extra_waves}));
  };
  BOOST_TEST(plan(4096, NeighbourhoodMix::mixed, 0, 0) == "8 4 2 1");
  BOOST_TEST(plan(4096, NeighbourhoodMix::mixed, 1, 1) == "8v 4 2 1 1");
  BOOST_TEST(plan(4096, NeighbourhoodMix::moore, 2, 2) == "8 4 2 1 2 1");
  BOOST_TEST(plan(4096, NeighbourhoodMix::von_neumann, 0, 1) == "8v 4v 2v 1v 1v");
  // The last wave is Moore, however short the plan is.
  BOOST_TEST(plan(65536, NeighbourhoodMix::mixed, 2, 0) == "2v 1");
  BOOST_TEST(plan(262144, NeighbourhoodMix::mixed, 2, 0) == "1");
}
