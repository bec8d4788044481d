#include "volumes/jump_flooding.hpp"

#include <utility>

#include "runtime/buffer.hpp"

namespace vorocl {

namespace {

/// Images of positions, which change places with every wave.
struct VolumeFloodWorkspace {
  cl::Buffer front, back;
};

}  // namespace

Report flood_volume(Filling& filling, DiagramState& state, const Plan& plan) {
  const PixelGrid& grid = filling.placement().grid;
  const cl::Buffer& positions = *filling.placement().positions;
  const int width = grid.width(), height = grid.height(), depth = grid.depth();
  const std::size_t voxels = grid.pixels() + 2 * guard, seeds = filling.seeds().size;
  const auto count = static_cast<cl_uint>(seeds);
  auto& [front, back] = state.workspace<VolumeFloodWorkspace>();
  state.reserve(front, voxels * sizeof(cl_uint));
  state.reserve(back, voxels * sizeof(cl_uint));
  const auto of_seeds = [&](const char* name, const cl::Buffer& image) {
    filling.kernel("core/seeds.cl", name).over_items(seeds + 1, positions, count, image, width, height);
  };
  const cl::Event first = fill(state.device, front, cl_uint{absent_voxel}, voxels);
  of_seeds("stamp_positions", front);
  for (const Wave& wave : plan) {
    filling.kernel("volumes/jump_flooding.cl", "wave", wave.neighbourhood)
        .over_grid(front, back, width, height, depth, wave.step);
    std::swap(front, back);
  }
  of_seeds("clear_ids", back);
  of_seeds("stamp_ids", back);
  const cl::Event last = filling.kernel("volumes/jump_flooding.cl", "write_labels")
                             .over_grid(front, back, state.labels, width, height, depth);
  return filling.commit(static_cast<int>(plan.size()), first, last, 0,
                        {plan.empty() ? 0 : plan.front().step, true});
}

}  // namespace vorocl
