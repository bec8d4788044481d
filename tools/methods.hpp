// The methods that make a diagram, by the names they have on the command line: the one place to add another.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "vorocl/diagram.hpp"
#include "vorocl/plan.hpp"
#include "vorocl/report.hpp"
#include "vorocl/seeds.hpp"
#include "vorocl/simulation.hpp"

namespace vorocl::command {

/// What a method may be told. One that has no use for an option does not look at it.
struct MethodOptions {
  Metric metric = Metric::euclidean;
  std::optional<NeighbourhoodMix> neighbourhood;  ///< none: mixed for djfa, Moore for the others
  int von_neumann_waves = 2;
  int extra_waves = 0;
  int refresh_interval = 0;
};

struct Method {
  std::string name;
  bool dynamic = false;  ///< whether it goes on from the labels that the diagram holds
  /// d_max is the longest motion of a seed along an axis since the diagram was last filled, in pixels.
  std::function<Report(const Seeds&, Diagram&, double d_max, const MethodOptions&)> run;
  bool exact = false;  ///< whether its diagrams are the ground truth that others are judged by
  /// The waves that it runs from seeds alone, of which its report has said the number. Null: it has no waves.
  std::function<Plan(const Grid&, int waves, const MethodOptions&)> plan = {};
};

/// The method with its options as an engine of a simulation.
Simulation::Engine engine(const Method& method, const MethodOptions& options);

const std::vector<Method>& methods();

/// The method of a name. Throws Error if there is none.
const Method& method(const std::string& name);

std::string to_string(Metric metric);

}  // namespace vorocl::command
