// What each choice of dJFA is worth: its variants, one choice changed in each, in accuracy and time.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "studies/error_samples.hpp"
#include "studies/evaluation.hpp"
#include "studies/samples.hpp"
#include "studies/seed_spread.hpp"
#include "vorocl/simulation.hpp"

namespace vorocl::command {

/// An engine with the motion that it runs on.
struct Variant {
  std::string study;    ///< the choice, such as "extra waves"
  std::string setting;  ///< what is chosen here, such as "2"
  Simulation::Engine engine;
  int max_displacement = 0;  ///< the paper's d_max
  Spread spread = Spread::uniform;
  bool one_pixel_per_work_item = false;  ///< instead of a run of them: as simple a kernel as on a GPU
};

/// In the Euclidean metric.
struct VariantResult {
  Samples milliseconds;            ///< the device's, of the diagrams of a timed run; one value per run
  Samples waves;                   ///< one value per frame, as the two that follow
  Samples similarity_to_exact;     ///< in percent
  Samples differing_between_runs;  ///< the pixels that two runs side by side have different labels for, in
                                   ///< percent
  ErrorSamples errors;
};

/// All variants of a configuration, the unchanged methods first.
std::vector<Variant> variants_of(const Device& device, const Configuration& configuration,
                                 const EvaluationSettings& settings);

/// Runs each variant over all frames, twice side by side, against the exact diagram; then they take turns in
/// timed runs. `made` is told the number of diagrams after each frame, and may throw to stop.
std::vector<VariantResult> measure(const Device& device, const Configuration& configuration,
                                   const EvaluationSettings& settings, const std::vector<Variant>& variants,
                                   const std::function<void(int)>& made);

/// The diagrams that measure() makes of a variant.
int diagrams_of_variant(const EvaluationSettings& settings);

}  // namespace vorocl::command
