// The paper's Algorithm 1 as it is printed, with waves that scatter in place: part of the evaluation, to be
// held against the library's waves, which gather.
#pragma once

#include "vorocl/device.hpp"
#include "vorocl/simulation.hpp"

namespace vorocl::command {

/// What a frame starts from, besides the labels of the last one.
enum class Stamping {
  none,   ///< nothing, as printed: a seed whose region has vanished does not come back
  seeds,  ///< the seeds' labels at their pixels
};

/// An engine that makes Euclidean diagrams by the waves of dJFA, each scattered in place; frame 0 is a JFA.
/// Its results differ from run to run.
Simulation::Engine in_place_scatter(const Device& device, Stamping stamping);

}  // namespace vorocl::command
