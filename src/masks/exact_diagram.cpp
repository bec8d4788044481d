#include "masks/exact_diagram.hpp"

#include <optional>

#include "masks/mask_engine.hpp"

namespace vorocl {

namespace {

/// The engine's working memory.
struct PassesWorkspace {
  MaskWorkspace buffers;
  std::optional<MaskEngine> engine;  // by the metric that was last asked for
  std::optional<Marks> seeds;
};

MaskEngine& engine_of(const DiagramState& state, PassesWorkspace& memory, const PixelGrid& grid,
                      Metric metric) {
  const ImageShape shape(grid);
  std::optional<MaskEngine>& engine = memory.engine;
  if (engine && engine->metric() == metric && engine->shape() == shape) return *engine;
  const auto [x, y, z] = grid.spacing();
  const PixelSize size = {double(x), double(y), double(z)};
  memory.seeds.emplace(state.device, shape);
  return engine.emplace(state.device, shape, size, whole_sizes(size, shape.sides()), metric);
}

/// Whether the diagram shows all of a mask that the seeds were made from.
bool shows_marks(const Filling& filling) {
  return filling.seeds().marks && filling.seeds().whole.get() == &filling.placement();
}

}  // namespace

bool labels_by_passes(const Filling& filling, const DiagramState& state) {
  const bool in_groups = state.device.tuning().shape == Shape::group;
  if (in_groups && filling.metric() != Metric::euclidean) return false;  // groups know squares alone
  if (filling.takes_places()) return false;
  if (shows_marks(filling)) return true;
  const Placement& placement = filling.placement();
  // Of fewer seeds the ways by their index take a shorter time (measured).
  const std::size_t in_voxels = in_groups ? 128 : 24, in_pixels = in_groups ? 10 : 28, by_manhattan = 40;
  const std::size_t pixels_per_seed = placement.grid.has_voxels()             ? in_voxels
                                      : filling.metric() == Metric::euclidean ? in_pixels
                                                                              : by_manhattan;
  return placement.is_crowded || filling.seeds().size > placement.grid.pixels() / pixels_per_seed;
}

Report exact_diagram_by_passes(Filling& filling, DiagramState& state) {
  const Placement& placement = filling.placement();
  PassesWorkspace& memory = state.workspace<PassesWorkspace>();
  MaskEngine& engine = engine_of(state, memory, placement.grid, filling.metric());
  NearestTargets targets;
  if (shows_marks(filling)) {
    targets.ranks = state.labels;
    const auto [first, last] =
        engine.run(state.kernels, *filling.seeds().marks, targets, memory.buffers, state.memory);
    return filling.commit(0, first, last);
  }
  const cl::Event first = memory.seeds->paint(state.kernels, placement.grid, *placement.positions,
                                              filling.seeds().size, state.labels);
  targets.labels = state.labels;
  const cl::Event last = engine.run(state.kernels, *memory.seeds, targets, memory.buffers, state.memory).last;
  return filling.commit(0, first, last);
}

}  // namespace vorocl
