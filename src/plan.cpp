#include "vorocl/plan.hpp"

namespace vorocl {

int first_step(const Grid& grid) {
  int step = 1;
  while (step < grid.longest_side()) step *= 2;  // 2^ceil(log2 N)
  return step / 2;
}

Plan jump_flooding_plan(const Grid& grid, JumpFloodingVariant variant, Neighbourhood neighbourhood) {
  Plan plan;
  if (first_step(grid) == 0) return plan;
  if (variant == JumpFloodingVariant::one_plus_jfa) plan.push_back({1, neighbourhood});
  for (int step = first_step(grid); step >= 1; step /= 2) plan.push_back({step, neighbourhood});
  if (variant == JumpFloodingVariant::jfa_plus_2) plan.push_back({2, neighbourhood});
  if (variant == JumpFloodingVariant::jfa_plus_1 || variant == JumpFloodingVariant::jfa_plus_2) {
    plan.push_back({1, neighbourhood});
  }
  return plan;
}

std::string to_string(const Plan& plan) {
  std::string text;
  for (const Wave& wave : plan) {
    if (!text.empty()) text += ' ';
    text += std::to_string(wave.step);
    if (wave.neighbourhood == Neighbourhood::von_neumann) text += 'v';
  }
  return text;
}

}  // namespace vorocl
