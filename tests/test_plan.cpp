// Plans: the steps of the waves, against the paper's formula.
#define BOOST_TEST_MODULE plan
#include "fixture.hpp"

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
