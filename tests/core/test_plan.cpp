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

std::string reaching(const Grid& grid, std::size_t seeds, const LabelDistances& distances,
                     Metric metric = Metric::euclidean, const DynamicPlanOptions& options = {}) {
  return to_string(reaching_plan(grid, seeds, distances, metric, options));
}

BOOST_AUTO_TEST_CASE(a_measured_plan_covers_the_greatest_distance) {
  const Grid grid(1000, 700);  // JFA has 10 waves
  const auto plan = [&](const LabelDistances& distances) { return reaching(grid, 700000, distances); };
  BOOST_TEST(plan({0}) == "1 1");  // the paper's plan is 2 1
  BOOST_TEST(plan({1}) == "1 1");
  BOOST_TEST(plan({1.1}) == "2 1");
  BOOST_TEST(plan({3}) == "2 1");
  BOOST_TEST(plan({3, 0, 8}) == "4 2 1");
  BOOST_TEST(plan({4, 0, 8}) == "8 4 2 1");
  BOOST_TEST(plan({511}) == "256 128 64 32 16 8 4 2 1");
  BOOST_TEST(plan({511.5}) == to_string(jump_flooding_plan(grid)));
  BOOST_TEST(plan({1024}) == to_string(jump_flooding_plan(grid)));
  BOOST_TEST(reaching(Grid(1, 1), 1, {0}) == "");
  BOOST_TEST(reaching(Grid(2, 2), 1, {1}) == "1");
}

BOOST_AUTO_TEST_CASE(a_wave_that_the_paper_s_plan_has_more_mends) {
  const Grid grid(1000, 700);
  const auto plan = [&](double greatest) { return reaching(grid, 7000, {greatest}); };  // 32v 16v 8 4 2 1
  BOOST_TEST(plan(15) == "8 4 2 1 1");
  BOOST_TEST(plan(31) == "16 8 4 2 1 1");
  BOOST_TEST(plan(31.5) == "32 16 8 4 2 1");
  BOOST_TEST(plan(64) == "64 32 16 8 4 2 1");
}

// There JFA's longer waves come back around the period, and mend what others leave.
BOOST_AUTO_TEST_CASE(a_wave_mends_on_periodic_grids_what_fewer_ways_leave) {
  for (const Axes axes : {Axes::x, Axes::y, Axes::xy}) {
    const Grid grid(1000, 700, axes);
    const auto plan = [&](double greatest) { return reaching(grid, 7000, {greatest}); };
    BOOST_TEST(plan(31) == "16 8 4 2 1 1");
    BOOST_TEST(plan(31.5) == "32 16 8 4 2 1 1");
    BOOST_TEST(plan(511) == "256 128 64 32 16 8 4 2 1 1");
    BOOST_TEST(plan(511.5) == to_string(jump_flooding_plan(grid)));
  }
}

BOOST_AUTO_TEST_CASE(extra_waves_that_are_asked_for_follow_instead) {
  const Grid grid(1000, 700);
  const auto plan = [&](double greatest, NeighbourhoodMix mix, int extra_waves) {
    return reaching(grid, 7000, {greatest}, Metric::euclidean, {mix, 2, extra_waves});
  };
  BOOST_TEST(plan(6, NeighbourhoodMix::mixed, 0) == "4 2 1 1");
  BOOST_TEST(plan(6, NeighbourhoodMix::mixed, 1) == "4 2 1 1");
  BOOST_TEST(plan(6, NeighbourhoodMix::von_neumann, 2) == "4v 2v 1v 2v 1v");
  BOOST_TEST(plan(1024, NeighbourhoodMix::moore, 1) == "512 256 128 64 32 16 8 4 2 1 1");
}

// A pixel without a label is as far from one with a label as the hole is wide, which its pixels bound.
BOOST_AUTO_TEST_CASE(labels_that_are_missing_lengthen_a_plan) {
  const Grid grid(1000, 1000);
  const auto missing = [&](std::size_t pixels, Metric metric = Metric::euclidean) {
    return reaching(grid, 10000, {28, pixels, 8}, metric);
  };
  BOOST_TEST(missing(0) == "32 16 8 4 2 1");
  BOOST_TEST(missing(742) == "64 32 16 8 4 2 1");  // 28 + sqrt(4 / pi 8 742) + 8 + 4 = 126.94
  BOOST_TEST(missing(744) == "128 64 32 16 8 4 2 1");
  BOOST_TEST(missing(125000) == to_string(jump_flooding_plan(grid)));
  // By the Manhattan metric such a quarter is a triangle: 28 + sqrt(2 8 470) + 8 + 4 = 126.7.
  BOOST_TEST(missing(470, Metric::manhattan) == "64 32 16 8 4 2 1");
  BOOST_TEST(missing(476, Metric::manhattan) == "128 64 32 16 8 4 2 1");
  // A strip has no quarter of a disc.
  BOOST_TEST(reaching(Grid(1000, 8), 80, {27, 80, 1}) == "512 256 128 64 32 16 8 4 2 1");
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
