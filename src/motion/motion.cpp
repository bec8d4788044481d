#include "vorocl/motion.hpp"

#include <string>

#include "core/seeds_state.hpp"

namespace vorocl {

void random_step(Seeds& seeds, int max_displacement, Border border, std::uint64_t rng_seed,
                 std::uint32_t frame) {
  if (max_displacement < 0 || max_displacement > Grid::max_side) {
    throw Error("a displacement of at most " + std::to_string(max_displacement) +
                " pixels is not possible; it must be from 0 to " + std::to_string(Grid::max_side));
  }
  SeedsState& state = Internal::state(seeds);
  state.frame()->refuse_outer_seeds("random motion");
  const Grid& grid = state.grid;
  const cl_uint2 key = {{static_cast<cl_uint>(rng_seed), static_cast<cl_uint>(rng_seed >> 32)}};
  const bool periodic = border == Border::periodic;
  state.kernels.get(state.device, "motion/motion.cl", "random_step", grid)
      .over_items(state.size(), state.positions, static_cast<cl_uint>(state.size()), grid.width(),
                  grid.height(), cl_int{max_displacement}, cl_int{periodic || grid.periodic_x()},
                  cl_int{periodic || grid.periodic_y()}, cl_uint{frame}, key);
  state.moved();
}

}  // namespace vorocl
