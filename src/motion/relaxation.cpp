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

/// Returns how many seeds moved.
std::size_t move_to_centroids(Seeds& seeds, Rounds& rounds) {
  SeedsState& state = Internal::state(seeds);
  const std::shared_ptr<cl::Buffer> positions = state.copy_to_move("Lloyd relaxation");
  const Device& device = state.device;
  const PixelGrid grid{Window(state.grid())};
  make_room(rounds.moved_and_displacement, device, 2 * sizeof(cl_uint));
  fill(device, rounds.moved_and_displacement, cl_uint{0}, 2);
  rounds.kernels.get(device, "motion/relaxation.cl", "move_to_centroids", grid)
      .over_items((state.size() + seeds_per_item - 1) / seeds_per_item, *positions,
                  static_cast<cl_uint>(state.size()), static_cast<cl_uint>(seeds_per_item),
                  rounds.cells.area(), rounds.cells.sum_x(), rounds.cells.sum_y(), grid.width(),
                  grid.height(), rounds.moved_and_displacement);
  const auto words = download<cl_uint>(device, rounds.moved_and_displacement, 2);
  if (words[0] > 0) state.moved(positions, words[1]);
  return words[0];
}

std::uint64_t energy_of(const Diagram& diagram, Rounds& rounds) {
  const MeasuredDiagram of = cells_of(diagram);
  refuse_outer_seeds(*of.placement, *of.seeds, "the energy of Lloyd relaxation");
  const Blocks blocks(of.device, of.grid);
  make_room(rounds.partial, of.device, blocks.count() * sizeof(cl_ulong));
  blocks.run(rounds.kernels, "motion/relaxation.cl", "add_energy", {}, diagram.labels(), of.positions(),
             of.count(), of.periods(), of.grid.width(), of.grid.height(), blocks.wide(), blocks.high(),
             rounds.partial);
  diagram.wait();
  const auto energies = download<cl_ulong>(of.device, rounds.partial, blocks.count());
  return std::accumulate(energies.begin(), energies.end(), std::uint64_t{0});
}

}  // namespace

std::uint64_t energy(const Diagram& diagram) {
  Rounds rounds;
  return energy_of(diagram, rounds);
}

Relaxation relax(Seeds& seeds, Diagram& diagram, const Simulation::Engine& engine, int rounds,
                 const RelaxationObserver& observer) {
  if (rounds < 0) throw Error("a relaxation of " + std::to_string(rounds) + " rounds; 0 is the least");
  if (!engine) throw Error("a relaxation needs an engine that fills the diagram");
  refuse_outer_seeds(*Internal::state(diagram).place(seeds), *Internal::state(seeds).frame(),
                     "Lloyd relaxation");
  if (!diagram.window().is_whole()) {
    throw Error("Lloyd relaxation needs a diagram of the whole grid, and this one shows a part of it");
  }
  Rounds state;
  Relaxation relaxation;
  while (true) {
    engine(seeds, diagram);
    relaxation.energies.push_back(energy_of(diagram, state));
    const bool goes_on = !observer || observer(seeds, diagram, relaxation);
    if (!goes_on || relaxation.rounds() == rounds) return relaxation;
    cell_sums(diagram, state.cells);
    const std::size_t moved = move_to_centroids(seeds, state);
    if (moved == 0) {
      relaxation.converged = true;
      return relaxation;
    }
    relaxation.moved.push_back(moved);
  }
}

}  // namespace vorocl
