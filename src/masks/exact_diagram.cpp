#include "masks/exact_diagram.hpp"

#include <optional>

#include "masks/mask_engine.hpp"

namespace vorocl {

namespace {

/// The engine's working memory.
struct PassesWorkspace {
  std::optional<MaskEngine> engine;  // by the metric that was last asked for
};

MaskEngine& engine_of(DiagramState& state, const PixelGrid& grid, Metric metric) {
  std::optional<MaskEngine>& engine = state.workspace<PassesWorkspace>().engine;
  if (engine && engine->metric() == metric && engine->shape() == ImageShape(grid)) return *engine;
  const auto [x, y, z] = grid.spacing();
  const PixelSize size = {double(x), double(y), double(z)};
  return engine.emplace(state.device, ImageShape(grid), size, whole_sizes(size, grid.longest_side()), metric);
}

}  // namespace

bool labels_by_passes(const Filling& filling, const DiagramState& state) {
  const bool is_whole = filling.seeds().whole.get() == &filling.placement();
  return filling.seeds().marks && is_whole && state.device.tuning().shape == Shape::vector;
}

Report exact_diagram_by_passes(Filling& filling, DiagramState& state) {
  NearestTargets targets;
  targets.ranks = state.labels;
  const auto [first, last] = engine_of(state, filling.placement().grid, filling.metric())
                                 .run(state.kernels, *filling.seeds().marks, targets);
  return filling.commit(0, first, last);
}

}  // namespace vorocl
