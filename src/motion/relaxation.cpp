#include "vorocl/relaxation.hpp"

#include <numeric>
#include <string>

#include "core/seeds_state.hpp"
#include "measures/measurement.hpp"
#include "runtime/buffer.hpp"
#include "vorocl/cells.hpp"

namespace vorocl {

namespace {

constexpr std::size_t seeds_per_item = 256;

/// What a relaxation keeps from round to round.
struct Rounds {
  KernelSet kernels;
  CellSumsResult cells;
  cl::Buffer partial;                 // the energy of each block
  cl::Buffer moved_and_displacement;  // two words: see relaxation.cl
};

struct Motion {
  cl_uint moved = 0;             // seeds
  cl_uint max_displacement = 0;  // along an axis, in pixels
};

Motion move_to_centroids(Seeds& seeds, Rounds& rounds) {
  const Device& device = seeds.device();
  make_room(rounds.moved_and_displacement, device, 2 * sizeof(cl_uint));
  fill(device, rounds.moved_and_displacement, cl_uint{0}, 2);
  rounds.kernels.get(device, "motion/relaxation.cl", "move_to_centroids", seeds.grid())
      .over_items((seeds.size() + seeds_per_item - 1) / seeds_per_item, seeds.positions(),
                  static_cast<cl_uint>(seeds.size()), static_cast<cl_uint>(seeds_per_item),
                  rounds.cells.area(), rounds.cells.sum_x(), rounds.cells.sum_y(), seeds.grid().width(),
                  seeds.grid().height(), rounds.moved_and_displacement);
  Internal::state(seeds).moved();
  const auto words = download<cl_uint>(device, rounds.moved_and_displacement, 2);
  return {words[0], words[1]};
}

std::uint64_t energy_of(const Seeds& seeds, const Diagram& diagram, Rounds& rounds) {
  const auto measured = frames_of(seeds, diagram);
  measured.seeds->refuse_outer_seeds("the energy of Lloyd relaxation");
  const Device& device = diagram.device();
  const Grid& grid = diagram.grid();
  const Blocks blocks(device, grid);
  make_room(rounds.partial, device, blocks.count() * sizeof(cl_ulong));
  blocks.run(rounds.kernels, "motion/relaxation.cl", "add_energy", {}, diagram.labels(), seeds.positions(),
             static_cast<cl_uint>(seeds.size()), grid.width(), grid.height(), blocks.wide(), blocks.high(),
             rounds.partial);
  diagram.wait();
  measured.check();
  const auto energies = download<cl_ulong>(device, rounds.partial, blocks.count());
  return std::accumulate(energies.begin(), energies.end(), std::uint64_t{0});
}

}  // namespace

std::uint64_t energy(const Seeds& seeds, const Diagram& diagram) {
  Rounds rounds;
  return energy_of(seeds, diagram, rounds);
}

Relaxation relax(Seeds& seeds, Diagram& diagram, const Simulation::Engine& engine, int rounds,
                 const RelaxationObserver& observer) {
  if (rounds < 0) throw Error("a relaxation of " + std::to_string(rounds) + " rounds; 0 is the least");
  if (!engine) throw Error("a relaxation needs an engine that fills the diagram");
  Internal::state(seeds).frame()->refuse_outer_seeds("Lloyd relaxation");
  Rounds state;
  Relaxation relaxation;
  double max_displacement = diagram.grid().longest_side();  // since whatever the diagram holds
  while (true) {
    engine(seeds, diagram, max_displacement);
    relaxation.energies.push_back(energy_of(seeds, diagram, state));
    const bool goes_on = !observer || observer(seeds, diagram, relaxation);
    if (!goes_on || relaxation.rounds() == rounds) return relaxation;
    cell_sums(seeds, diagram, state.cells);
    const Motion motion = move_to_centroids(seeds, state);
    if (motion.moved == 0) {
      relaxation.converged = true;
      return relaxation;
    }
    relaxation.moved.push_back(motion.moved);
    max_displacement = motion.max_displacement;
  }
}

}  // namespace vorocl
