#include "vorocl/plan.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "flooding/reaching_plan.hpp"
#include "runtime/pixel_grid.hpp"
#include "vorocl/error.hpp"

namespace vorocl {

namespace {

/// 2 L and max_displacement, the longer one, rounded up to a power of two, or for the authors' plan down;
/// from 1 to the window's first step. 2 L is compared in integers: step and 2 sqrt(pixels / seeds), both
/// squared.
int dynamic_first_step(const Window& window, std::size_t seeds, double max_displacement, Reach reach) {
  const int most = std::max(first_step(window), 1);
  const std::uint64_t length = 4 * static_cast<std::uint64_t>(window.pixels());
  const auto squared = [&](int step) {
    return static_cast<std::uint64_t>(step) * static_cast<std::uint64_t>(step) * seeds;
  };
  const auto is_shorter = [&](int step) { return squared(step) < length || step < max_displacement; };
  const auto is_longer = [&](int step) { return squared(step) > length && step > max_displacement; };
  int step = 1;
  while (step < most && (reach == Reach::authors ? !is_longer(2 * step) : is_shorter(step))) step *= 2;
  return step;
}

}  // namespace

void check_dynamic_plan(const Window& window, double max_displacement, const DynamicPlanOptions& options) {
  refuse_volume(window.grid(), "dynamic jump flooding");
  if (!std::isfinite(max_displacement) || max_displacement < 0) {
    throw Error("the greatest displacement of a seed is " + std::to_string(max_displacement) +
                "; it must be 0 pixels or more");
  }
  if (options.von_neumann_waves < 0 || options.von_neumann_waves > 2) {
    throw Error(std::to_string(options.von_neumann_waves) +
                " von Neumann waves are not possible; 0, 1 or 2 are");
  }
  if (options.extra_waves < 0 || options.extra_waves > 2) {
    throw Error(std::to_string(options.extra_waves) + " extra waves are not possible; 0, 1 or 2 are");
  }
}

void append_extra_waves(Plan& plan, int waves, Neighbourhood neighbourhood) {
  if (waves == 2) plan.push_back({2, neighbourhood});
  if (waves >= 1) plan.push_back({1, neighbourhood});
}

int first_step(const Window& window) {
  const PixelGrid grid(window);
  int step = 1;
  while (step < grid.longest_side()) step *= 2;  // 2^ceil(log2 N)
  return step / 2;
}

Plan jump_flooding_plan(const Window& window, JumpFloodingVariant variant, Neighbourhood neighbourhood) {
  Plan plan;
  if (first_step(window) == 0) return plan;
  if (variant == JumpFloodingVariant::one_plus_jfa) plan.push_back({1, neighbourhood});
  for (int step = first_step(window); step >= 1; step /= 2) plan.push_back({step, neighbourhood});
  if (variant == JumpFloodingVariant::jfa_plus_1) append_extra_waves(plan, 1, neighbourhood);
  if (variant == JumpFloodingVariant::jfa_plus_2) append_extra_waves(plan, 2, neighbourhood);
  return plan;
}

Plan dynamic_jump_flooding_plan(const Window& window, std::size_t seeds, double max_displacement,
                                const DynamicPlanOptions& options, Reach reach) {
  check_dynamic_plan(window, max_displacement, options);
  const bool von_neumann = options.neighbourhood == NeighbourhoodMix::von_neumann;
  const Neighbourhood rest = von_neumann ? Neighbourhood::von_neumann : Neighbourhood::moore;
  Plan plan;
  if (first_step(window) == 0) return plan;
  for (int step = dynamic_first_step(window, seeds, max_displacement, reach); step >= 1; step /= 2)
    plan.push_back({step, rest});
  append_extra_waves(plan, options.extra_waves, rest);
  if (options.neighbourhood == NeighbourhoodMix::mixed) {
    const std::size_t first_waves =
        std::min(plan.size() - 1, static_cast<std::size_t>(options.von_neumann_waves));
    for (std::size_t i = 0; i < first_waves; ++i) plan[i].neighbourhood = Neighbourhood::von_neumann;
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
