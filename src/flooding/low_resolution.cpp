#include "vorocl/low_resolution.hpp"

#include <array>
#include <utility>

#include "core/diagram_state.hpp"
#include "core/placement.hpp"
#include "flooding/flood.hpp"
#include "runtime/buffer.hpp"
#include "vorocl/plan.hpp"

namespace vorocl {

namespace {

/// Coarse pixels of 4 x 4: with coarser ones the diagram takes hardly less time, and more cells around
/// clusters are wrong.
constexpr int coarsest = 2;

/// Two images of packed positions. `seeds` holds those that the pixels keep, until the level's waves need it.
struct Level {
  PixelGrid grid = {1, 1};
  cl::Buffer seeds, labels;
  KernelSet kernels;
};

/// 8 bytes per pixel of each level.
struct LowResolutionWorkspace {
  std::array<Level, coarsest + 1> levels;  // by the binary logarithm of the pixels' side
};

class Reconstruction {
 public:
  Reconstruction(const Seeds& seeds, Diagram& diagram)
      : diagram_(Internal::state(diagram)),
        filling_(seeds, diagram, Metric::euclidean, "low-resolution"),
        levels_(diagram_.workspace<LowResolutionWorkspace>().levels),
        positions_(*filling_.placement().positions),
        count_(static_cast<cl_uint>(filling_.seeds().size)) {
    refuse_what_floods_cannot_take(filling_, diagram_);
    PixelGrid grid = filling_.placement().grid;
    for (Level& level : levels_) {
      level.grid = grid;
      const std::size_t bytes = (grid.pixels() + 2 * guard) * sizeof(std::uint32_t);
      diagram_.reserve(level.seeds, bytes);
      diagram_.reserve(level.labels, bytes);
      grid = {(grid.width() + 1) / 2, (grid.height() + 1) / 2, grid.periodic()};
    }
  }

  Report run() {
    const cl::Event first = stamp();
    for (int level = 1; level <= coarsest; ++level) coarsen(level);
    std::swap(levels_.back().seeds, levels_.back().labels);
    for (const Wave& each : jump_flooding_plan(Grid(width(coarsest), height(coarsest))))
      wave(coarsest, each.step);
    for (int level = coarsest - 1; level >= 0; --level) {
      refine(level);
      // A coarse wave costs little, and mends what the next level inherits.
      if (level > 0) wave(level, 4);
      wave(level, 2);
      if (level > 0) wave(level, 1);
    }
    const Level& finest = at(0);
    return filling_.commit(
        0, first,
        label_by_last_wave(filling_, diagram_, finest.labels, finest.seeds, {1, Neighbourhood::moore}));
  }

 private:
  Level& at(int level) { return levels_[static_cast<std::size_t>(level)]; }
  int width(int level) { return at(level).grid.width(); }
  int height(int level) { return at(level).grid.height(); }

  /// With five candidates, as a von Neumann wave has, or nine.
  Kernel& kernel(int level, const char* name, Neighbourhood neighbourhood) {
    return at(level).kernels.get(diagram_.device, "flooding/low_resolution.cl", name, at(level).grid,
                                 {filling_.metric(), neighbourhood});
  }

  cl::Event stamp() {
    cl::Event first = fill(diagram_.device, at(0).seeds, absent_position, at(0).grid.pixels() + 2 * guard);
    filling_.kernel("core/seeds.cl", "stamp_positions")
        .over_items(count_, positions_, count_, at(0).seeds, width(0), at(0).grid.height());
    return first;
  }

  void coarsen(int level) {
    kernel(level, "coarsen_seeds", Neighbourhood::von_neumann)
        .over_grid(at(level - 1).seeds, width(level - 1), height(level - 1), at(level).seeds, width(level),
                   height(level), level, width(0), height(0));
  }

  void refine(int level) {
    kernel(level, "refine", Neighbourhood::von_neumann)
        .over_grid(at(level + 1).labels, width(level + 1), at(level).seeds, at(level).labels, width(level),
                   height(level), level, width(0), height(0));
  }

  void wave(int level, int step) {
    kernel(level, "level_wave", Neighbourhood::moore)
        .over_grid(at(level).labels, at(level).seeds, width(level), height(level), step, level, width(0),
                   height(0));
    std::swap(at(level).labels, at(level).seeds);
  }

  DiagramState& diagram_;
  Filling filling_;
  std::array<Level, coarsest + 1>& levels_;
  const cl::Buffer& positions_;
  const cl_uint count_;  // of the seeds
};

}  // namespace

Report low_resolution(const Seeds& seeds, Diagram& diagram) { return Reconstruction(seeds, diagram).run(); }

}  // namespace vorocl
