// The methods that make a diagram, by name: one registry for the command, its benchmark, C and other
// languages.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "vorocl/diagram.hpp"
#include "vorocl/export.h"
#include "vorocl/plan.hpp"
#include "vorocl/report.hpp"
#include "vorocl/seeds.hpp"
#include "vorocl/simulation.hpp"

namespace vorocl {

/// The options of all methods. A method ignores those that it has no use for; mixed neighbourhoods, which
/// djfa alone has, are refused by the others.
struct MethodOptions {
  Metric metric = Metric::euclidean;
  std::optional<NeighbourhoodMix> neighbourhood = {};  ///< none: mixed for djfa, Moore for the others
  int von_neumann_waves = 2;                           ///< of djfa: see DynamicPlanOptions
  int extra_waves = 0;                                 ///< of djfa: see DynamicPlanOptions
  int refresh_interval = 0;                            ///< of djfa: see DynamicJumpFloodingOptions
  Reach reach = Reach::measured;                       ///< of djfa: see dynamic_jump_flooding()
  std::optional<double> max_displacement = {};         ///< of djfa: see DynamicJumpFloodingOptions
};

/// A way to make a diagram from seeds.
struct Method {
  std::string name;  ///< such as "jfa+1"
  bool exact;        ///< every pixel gets its nearest seed: other methods are judged by it
  bool continues;    ///< it goes on from the labels that the diagram holds, so frames must come in order
  bool windows;      ///< it takes any window of a grid and seeds outside it: others refuse them
  bool volumes;      ///< it takes volumes: others refuse them

  /// Fills the diagram.
  Report (*run)(const Seeds& seeds, Diagram& diagram, const MethodOptions& options);

  /// The waves that it runs from seeds alone; null if it has none. `waves` is the number that its report has
  /// said. Throws Error if that is negative.
  Plan (*plan)(const Window& window, int waves, const MethodOptions& options);
};

/// All methods.
VOROCL_API const std::vector<Method>& methods();

/// The method of a name. Throws Error, which lists the names, if there is none.
VOROCL_API const Method& method(std::string_view name);

/// Throws Error if the method refuses the options, as run() would.
VOROCL_API void check_options(const Method& method, const MethodOptions& options);

/// The method with its options as an engine of a simulation.
VOROCL_API Simulation::Engine engine(const Method& method, const MethodOptions& options = {});

/// Builds all kernels that the method needs for a number of seeds on the window's grid, so that the first
/// diagram takes no longer than the next. Drivers finish a kernel when it is first launched: so this runs the
/// method on random seeds and a diagram of its own, of this size, which it gives back. `snap` is that of the
/// seeds. Waits. Throws as the method.
VOROCL_API void prepare(const Method& method, const Device& device, const Window& window, std::size_t seeds,
                        const MethodOptions& options = {}, Snap snap = Snap::none);

}  // namespace vorocl
