#include "vorocl/motion.hpp"

#include <string>

#include "core/seeds_state.hpp"

namespace vorocl {

void random_step(Seeds& seeds, int max_displacement, Border border, std::uint64_t rng_seed,
                 std::uint32_t frame) {
  if (max_displacement < 0 || max_displacement > Window::max_side) {
    throw Error("a displacement of at most " + std::to_string(max_displacement) +
                " pixels is not possible; it must be from 0 to " + std::to_string(Window::max_side));
  }
  SeedsState& state = Internal::state(seeds);
  refuse_volume(state.grid(), "random motion");
  const std::shared_ptr<cl::Buffer> positions = state.copy_to_move("random motion");
  const PixelGrid grid{Window(state.grid())};
  const cl_uint2 key = {{static_cast<cl_uint>(rng_seed), static_cast<cl_uint>(rng_seed >> 32)}};
  const bool periodic = border == Border::periodic;
  Kernel& kernel = state.kernels.get(state.device, "motion/motion.cl", "random_step", grid);
  const std::size_t width = kernel.vector_width();
  kernel.over_items((state.size() + width - 1) / width, *positions, static_cast<cl_uint>(state.size()),
                    grid.width(), grid.height(), cl_int{max_displacement},
                    cl_int{periodic || grid.periodic_x()}, cl_int{periodic || grid.periodic_y()},
                    cl_uint{frame}, key);
  state.moved(positions, max_displacement);
}

}  // namespace vorocl
