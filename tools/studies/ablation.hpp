// What each choice of dJFA is worth: its variants, one choice changed in each, in accuracy and time.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "studies/evaluation.hpp"
#include "trials/samples.hpp"
#include "vorocl/device.hpp"
#include "vorocl/opencl.hpp"
#include "vorocl/seeds.hpp"
#include "vorocl/simulation.hpp"

namespace vorocl::command {

/// How seeds are spread. dJFA assumes that they are spread evenly.
enum class Spread {
  uniform,   ///< as Seeds::random()
  clusters,  ///< normally distributed about 16 random centres, with a fiftieth of the sides as deviation
  gradient,  ///< the density grows in proportion to x
};

Seeds spread_seeds(const Device& device, const Grid& grid, std::size_t count, Spread spread,
                   std::uint64_t rng_seed);

/// What a frame starts from, besides the labels of the last one.
enum class Stamping {
  none,   ///< nothing, as printed: a seed whose region has vanished does not come back
  seeds,  ///< the seeds' labels at their pixels
};

/// What the frames behind frame 0 were made by, of an engine whose reports do not know it.
class ScatterRecord {
 public:
  void add(int waves, const cl::Event& first, const cl::Event& last);

  /// Of the last frame.
  int waves() const { return waves_; }

  /// The device's time for the frames since it was taken last, as Simulation::milliseconds(). Waits.
  double take_milliseconds();

 private:
  int waves_ = 0;
  std::vector<std::pair<cl::Event, cl::Event>> frames_;
};

/// The paper's Algorithm 1 as it is printed, to be held against the library's waves, which gather:
/// an engine that makes Euclidean diagrams by the waves of dJFA, each scattered in place; frame 0 is a JFA.
/// Its results differ from run to run. All copies of the engine share the record.
Simulation::Engine in_place_scatter(const Device& device, Stamping stamping,
                                    const std::shared_ptr<ScatterRecord>& record);

/// An engine with the motion that it runs on.
struct Variant {
  std::string study;    ///< the choice, such as "extra waves"
  std::string setting;  ///< what is chosen here, such as "2"
  Simulation::Engine engine;
  int max_displacement = 0;  ///< the paper's d_max
  Spread spread = Spread::uniform;
  bool one_pixel_per_work_item = false;  ///< instead of a run of them: as simple a kernel as on a GPU
  std::shared_ptr<ScatterRecord> record = nullptr;  ///< null: the engine's reports say it
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
