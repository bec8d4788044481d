#include "vorocl/motion.hpp"

#include <string>

#include "kernel.hpp"

namespace vorocl {

void random_step(Seeds& seeds, int most, Border border, std::uint64_t rng_seed, std::uint32_t frame) {
  if (most < 0 || most > Grid::max_side) {
    throw Error("a step length of " + std::to_string(most) +
                " pixels is not possible; it must be from 0 to " + std::to_string(Grid::max_side));
  }
  const Grid& grid = seeds.grid();
  const cl_uint2 key = {{static_cast<cl_uint>(rng_seed), static_cast<cl_uint>(rng_seed >> 32)}};
  Kernel(seeds.device(), "motion.cl", "random_step", grid)
      .over_items(seeds.size(), seeds.positions(), static_cast<cl_uint>(seeds.size()), grid.width(),
                  grid.height(), cl_int{most}, cl_int{border == Border::periodic ? 1 : 0}, cl_uint{frame},
                  key);
}

}  // namespace vorocl
