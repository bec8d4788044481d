#include "vorocl/exact_diagram.hpp"

#include "core/diagram_state.hpp"
#include "exact/places.hpp"
#include "globe/globe.hpp"
#include "masks/exact_diagram.hpp"

namespace vorocl {

Report exact_diagram(const Seeds& seeds, Diagram& diagram, const ExactOptions& options) {
  Filling filling(seeds, diagram, options.metric, "exact");
  DiagramState& state = Internal::state(diagram);
  if (options.metric == Metric::great_circle) return exact_diagram_on_globe(filling, state);
  if (state.grid.has_voxels() && options.metric == Metric::manhattan) {
    throw Error(
        "exact diagrams of volumes and spaced planes are Euclidean; jump flooding takes the Manhattan "
        "metric");
  }
  if (labels_by_passes(filling, state)) return exact_diagram_by_passes(filling, state);
  return exact_diagram_by_places(filling, state);
}

}  // namespace vorocl
