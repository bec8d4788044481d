#include "vorocl/relaxation.hpp"

#include <numeric>
#include <string>

#include "buffer.hpp"
#include "measurement.hpp"
#include "vorocl/cells.hpp"

namespace vorocl {

namespace {

constexpr std::size_t seeds_per_item = 256;

struct Motion {
  cl_uint moved = 0;    // seeds
  cl_uint longest = 0;  // along an axis, in pixels
};

Motion move_to_centroids(Seeds& seeds, const CellSumsResult& cells, const cl::Buffer& moved_and_longest) {
  const Device& device = seeds.device();
  fill(device, moved_and_longest, cl_uint{0}, 2);
  Kernel(device, "relaxation.cl", "move_to_centroids", seeds.grid())
      .over_items((seeds.size() + seeds_per_item - 1) / seeds_per_item, seeds.positions(),
                  static_cast<cl_uint>(seeds.size()), static_cast<cl_uint>(seeds_per_item), cells.area(),
                  cells.sum_x(), cells.sum_y(), moved_and_longest);
  const auto words = download<cl_uint>(device, moved_and_longest, 2);
  return {words[0], words[1]};
}

/// Each block's energy is summed on the device, in `partial`.
std::uint64_t energy_of(const Seeds& seeds, const Diagram& diagram, cl::Buffer& partial) {
  diagram.check_fits(seeds);
  const Device& device = diagram.device();
  const Grid& grid = diagram.grid();
  const Blocks blocks(device, grid);
  make_room(partial, device, blocks.count() * sizeof(cl_ulong));
  blocks.run("relaxation.cl", "add_energy", diagram.labels(), seeds.positions(),
             static_cast<cl_uint>(seeds.size()), grid.width(), grid.height(), blocks.wide(), blocks.high(),
             partial);
  diagram.wait();
  seeds.check();
  const auto energies = download<cl_ulong>(device, partial, blocks.count());
  return std::accumulate(energies.begin(), energies.end(), std::uint64_t{0});
}

}  // namespace

std::uint64_t energy(const Seeds& seeds, const Diagram& diagram) {
  cl::Buffer partial;
  return energy_of(seeds, diagram, partial);
}

Relaxation relax(Seeds& seeds, Diagram& diagram, const Simulation::Engine& engine, int rounds,
                 const RelaxationObserver& observer) {
  if (rounds < 0) throw Error("a relaxation of " + std::to_string(rounds) + " rounds; 0 is the least");
  if (!engine) throw Error("a relaxation needs an engine that fills the diagram");
  diagram.check_fits(seeds);
  CellSumsResult cells;
  cl::Buffer partial;
  const cl::Buffer moved_and_longest = allocate(diagram.device(), 2 * sizeof(cl_uint), "the relaxation");

  Relaxation relaxation;
  double longest = 0;
  while (true) {
    engine(seeds, diagram, longest);
    relaxation.energies.push_back(energy_of(seeds, diagram, partial));
    const bool goes_on = !observer || observer(seeds, diagram, relaxation);
    if (!goes_on || relaxation.rounds() == rounds) return relaxation;
    cell_sums(seeds, diagram, cells);
    const Motion motion = move_to_centroids(seeds, cells, moved_and_longest);
    if (motion.moved == 0) {
      relaxation.converged = true;
      return relaxation;
    }
    relaxation.moved.push_back(motion.moved);
    longest = motion.longest;
  }
}

}  // namespace vorocl
