#include "exact/reference.hpp"

#include "core/diagram_state.hpp"
#include "core/seeds_state.hpp"

namespace vorocl {

Report reference_diagram(const Seeds& seeds, Diagram& diagram, Metric metric) {
  Internal::state(seeds).frame()->refuse_outer_seeds("the reference of exact diagrams");
  Filling filling(seeds, diagram);
  DiagramState& state = Internal::state(diagram);
  const cl::Event event =
      state.kernel("exact/reference.cl", "label_by_all_seeds", {metric})
          .over_items(state.grid.pixels(), seeds.positions(), static_cast<cl_uint>(seeds.size()),
                      state.labels, state.grid.width(), state.grid.height());
  return filling.commit(0, event, event);
}

}  // namespace vorocl
