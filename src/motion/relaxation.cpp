#include "vorocl/relaxation.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <memory>
#include <numeric>
#include <optional>
#include <string>
#include <vector>

#include "core/seeds_state.hpp"
#include "measures/measurement.hpp"
#include "runtime/buffer.hpp"
#include "vorocl/cells.hpp"
#include "vorocl/exact_cells.hpp"

namespace vorocl {

namespace {

constexpr double greatest_weight = 65535;
constexpr std::size_t sums_of_cell = 4;

void check_density(const Window& window, const std::vector<float>& density) {
  const PixelGrid pixels(window);
  if (density.size() != pixels.pixels()) {
    throw Error("a density of " + std::to_string(density.size()) + " values; the diagram has " +
                size_text(pixels.without_periods()) + " pixels, and each needs one");
  }
  for (std::size_t i = 0; i < density.size(); ++i) {
    // Written so that a NaN fails.
    if (density[i] >= 0 && std::isfinite(density[i])) continue;
    const auto width = static_cast<std::size_t>(pixels.width()), row = i / width;
    const auto height = static_cast<std::size_t>(pixels.height());
    throw Error("the density of pixel (" + std::to_string(i % width) + ", " + std::to_string(row % height) +
                (pixels.has_voxels() ? ", " + std::to_string(row / height) : "") + ") is " +
                std::to_string(density[i]) + "; it must be a finite number of at least 0");
  }
}

/// What the centroid of a cell follows from, as CellSums: but each pixel counts as often as it weighs.
struct CellWeight {
  std::uint64_t weight = 0;
  std::int64_t sum_x = 0, sum_y = 0, sum_z = 0;
};

/// The weights of the pixels of a diagram, and the sums of its cells, on the device.
class Density {
 public:
  /// Of a density of at least 0 for each pixel of the window. Throws Error that names the pixel if one is
  /// negative or no number, and if there are more or fewer, or all are 0.
  Density(const Device& device, const Window& window, const std::vector<float>& density) : device_(device) {
    check_density(window, density);
    const double greatest = *std::max_element(density.begin(), density.end());
    if (greatest == 0) throw Error("the density is 0 everywhere; some pixel must weigh something");
    std::vector<std::uint16_t> weights;
    weights.reserve(density.size());
    for (const double of_pixel : density) {
      weights.push_back(static_cast<std::uint16_t>(std::lround(greatest_weight * of_pixel / greatest)));
    }
    unit_ = greatest / greatest_weight;
    pixels_ = allocate_with(device, weights, "the weights of pixels");
  }

  /// Sums the cells. The energy: the sum of density times squared distance over all pixels that have a label.
  /// Waits.
  double weigh(const Diagram& diagram) {
    const MeasuredDiagram of = cells_of(diagram);
    const cl_uint count = of.count();
    const std::size_t sums = sums_of_cell * count;
    for (cl::Buffer* const zeros : {&at_home_, &elsewhere_}) {
      make_room(*zeros, of.device, sums * sizeof(cl_ulong));
      if (count > 0) fill(of.device, *zeros, cl_ulong{0}, sums);
    }
    for (cl::Buffer* const joined : {&weight_, &sum_x_, &sum_y_, &sum_z_}) {
      make_room(*joined, of.device, count * sizeof(cl_ulong));
    }
    const Blocks blocks(of.device, of.grid);
    make_room(energies_, of.device, blocks.count() * sizeof(cl_ulong));
    const char* const file = "motion/density.cl";
    const KernelOptions options = of.options_without_metric();
    blocks.run(kernels_, file, "add_weights", options, diagram.labels(), of.positions(), count, of.lattice(),
               of.size(), blocks.bits(), pixels_, at_home_, elsewhere_, energies_);
    kernels_.get(of.device, file, "join_weights", of.grid, options)
        .over_items(count, of.positions(), count, of.lattice(), of.size(), at_home_, elsewhere_, weight_,
                    sum_x_, sum_y_, sum_z_);
    diagram.wait();
    // In two parts, for the sum of all blocks may need more than 64 bits.
    std::uint64_t high = 0, low = 0;
    for (const cl_ulong energy : download<cl_ulong>(of.device, energies_, blocks.count())) {
      high += energy >> 32;
      low += energy & 0xffffffffu;
    }
    return unit_ * (std::ldexp(static_cast<double>(high), 32) + static_cast<double>(low));
  }

  // Of the cells that were weighed last: uint64, and int64 in pixels from the window's first one.
  const cl::Buffer& weight() const { return weight_; }
  const cl::Buffer& sum_x() const { return sum_x_; }
  const cl::Buffer& sum_y() const { return sum_y_; }
  const cl::Buffer& sum_z() const { return sum_z_; }  // of a plane 0

  /// The same on the host, by id.
  std::vector<CellWeight> read(std::size_t cells) const {
    const auto weight = download<cl_ulong>(device_, weight_, cells);
    const auto sum_x = download<cl_long>(device_, sum_x_, cells);
    const auto sum_y = download<cl_long>(device_, sum_y_, cells);
    const auto sum_z = download<cl_long>(device_, sum_z_, cells);
    std::vector<CellWeight> read;
    read.reserve(cells);
    for (std::size_t id = 0; id < cells; ++id) read.push_back({weight[id], sum_x[id], sum_y[id], sum_z[id]});
    return read;
  }

 private:
  Device device_;
  KernelSet kernels_;
  double unit_ = 0;                            // the density that a weight of 1 stands for
  cl::Buffer pixels_;                          // the weights: uint16
  cl::Buffer at_home_, elsewhere_, energies_;  // see density.cl
  cl::Buffer weight_, sum_x_, sum_y_, sum_z_;
};

constexpr std::size_t seeds_per_item = 256;

/// What a relaxation keeps from round to round.
struct Rounds {
  std::optional<Density> density;  // none: all pixels weigh alike
  KernelSet kernels;
  CellSumsResult cells;               // of pixels that weigh alike
  ExactCellsResult exact_cells;       // without pixels
  cl::Buffer partial;                 // the energy of each block
  cl::Buffer moved_and_displacement;  // two words: see relaxation.cl
};

/// What a round does: how many seeds it moves, and how far along an axis.
struct Move {
  std::size_t seeds = 0;
  double displacement = 0;  // in pixels
};

/// The position nearest to a centroid, given by the weight of a cell and the sum of its pixels' coordinates
/// along an axis, in fractions of a pixel.
std::int64_t position_of_centroid(std::uint64_t weight, std::int64_t sum) {
  const auto once = static_cast<std::int64_t>(weight);
  const std::int64_t twice = 2 * once, parts = fractions_of_pixel;
  // The mean of the pixels' centres, which are half a pixel behind their starts; in two steps, as the product
  // may be long.
  const std::int64_t doubled = 2 * sum + once,
                     whole = doubled >= 0 ? doubled / twice : -((twice - 1 - doubled) / twice);
  return whole * parts + ((doubled - whole * twice) * parts + once) / twice;
}

/// What the centroids of the cells follow from, by id. Waits.
std::vector<CellWeight> weights_of(const Rounds& rounds, std::size_t cells) {
  if (rounds.density) return rounds.density->read(cells);
  std::vector<CellWeight> weights;
  weights.reserve(cells);
  for (const CellSums& sums : rounds.cells.read())
    weights.push_back({sums.area, sums.sum_x, sums.sum_y, sums.sum_z});
  return weights;
}

Move move_points_to_centroids(Seeds& seeds, Rounds& rounds, double tolerance) {
  SeedsState& state = Internal::state(seeds);
  const SeedsFrame& frame = *state.frame();
  const std::vector<CellWeight> cells = weights_of(rounds, state.size());
  const auto places = state.list_of_places();
  *places = *frame.places();
  const auto go = [](const Axis& axis, std::int64_t to, std::int64_t& at) {
    const std::int64_t period = axis.is_periodic() ? in_fractions(axis.pixels()) : 0;
    const std::int64_t way = shorter_way(to - at, period);
    at = period == 0 ? to : (to % period + period) % period;
    return std::abs(way);
  };
  Move move;
  std::int64_t greatest = 0;
  for (std::size_t id = 0; id < cells.size(); ++id) {
    if (cells[id].weight == 0) continue;
    Place& at = (*places)[id];
    const std::int64_t x = go(frame.grid.x(), position_of_centroid(cells[id].weight, cells[id].sum_x), at.x);
    const std::int64_t y = go(frame.grid.y(), position_of_centroid(cells[id].weight, cells[id].sum_y), at.y);
    move.seeds += x > 0 || y > 0 ? 1 : 0;
    greatest = std::max({greatest, x, y});
  }
  move.displacement = static_cast<double>(greatest) / fractions_of_pixel;
  if (move.displacement >= tolerance) state.place(frame.grid, places, true);
  return move;
}

Move move_to_centroids(Seeds& seeds, Rounds& rounds, double tolerance) {
  SeedsState& state = Internal::state(seeds);
  if (state.options.snap == Snap::none && !has_voxels(state.grid()))
    return move_points_to_centroids(seeds, rounds, tolerance);
  const std::shared_ptr<cl::Buffer> positions = state.copy_to_move("Lloyd relaxation");
  const Device& device = state.device;
  const PixelGrid grid{Window(state.grid())};
  make_room(rounds.moved_and_displacement, device, 2 * sizeof(cl_uint));
  fill(device, rounds.moved_and_displacement, cl_uint{0}, 2);
  const auto move_to_means = [&](const char* name, const cl::Buffer& weight, const cl::Buffer& sum_x,
                                 const cl::Buffer& sum_y, const cl::Buffer& sum_z) {
    rounds.kernels.get(device, "motion/relaxation.cl", name, grid)
        .over_items((state.size() + seeds_per_item - 1) / seeds_per_item, *positions,
                    static_cast<cl_uint>(state.size()), static_cast<cl_uint>(seeds_per_item), weight, sum_x,
                    sum_y, sum_z, cl_int4{{grid.width(), grid.height(), grid.depth(), 0}},
                    rounds.moved_and_displacement);
  };
  if (rounds.density) {
    const Density& cells = *rounds.density;
    move_to_means("move_to_weighted_centroids", cells.weight(), cells.sum_x(), cells.sum_y(), cells.sum_z());
  } else {
    const CellSumsResult& cells = rounds.cells;
    move_to_means("move_to_centroids", cells.area(), cells.sum_x(), cells.sum_y(), cells.sum_z());
  }
  const auto words = download<cl_uint>(device, rounds.moved_and_displacement, 2);
  const Move move = {words[0], static_cast<double>(words[1])};
  if (move.displacement >= tolerance) state.moved(positions, move.displacement);
  return move;
}

Move move_to_exact_centroids(Seeds& seeds, ExactCellsResult& result, double tolerance) {
  exact_cells(seeds, result);
  const std::vector<ExactCell> cells = result.read();
  std::vector<std::optional<Point>> points = seeds.read();
  Move move;
  // Both may be images of each other's. Returns by how many pixels the seed moves.
  const auto go = [](const Axis& axis, double to, double& at) {
    const double length = axis.to() - axis.from(), pixel = length / static_cast<double>(axis.pixels());
    double way = to - at;
    if (axis.is_periodic()) way -= std::nearbyint(way / length) * length;
    at = to - axis.periods_beyond(to) * length;
    return std::abs(way) / pixel;
  };
  for (std::size_t id = 0; id < cells.size(); ++id) {
    if (!points[id] || cells[id].area == 0) continue;
    const Point& to = cells[id].centroid;
    const Grid& grid = seeds.grid();
    Point& at = *points[id];
    const double way = std::max({go(grid.x(), to.x, at.x), go(grid.y(), to.y, at.y),
                                 grid.is_volume() ? go(grid.z(), to.z, at.z) : 0});
    move.seeds += way > 0 ? 1 : 0;
    move.displacement = std::max(move.displacement, way);
  }
  const auto weights = Internal::state(seeds).frame()->weights;  // all the same, if there are any
  if (move.displacement >= tolerance)
    seeds.move_to(Points(points).weighted(weights ? weights->data() : nullptr));
  return move;
}

double energy_of(const Diagram& diagram, Rounds& rounds) {
  const MeasuredDiagram of = cells_of(diagram);
  refuse_seeds_beyond(*of.placement, *of.seeds, "the energy of Lloyd relaxation");
  const Blocks blocks(of.device, of.grid);
  make_room(rounds.partial, of.device, blocks.count() * sizeof(cl_ulong));
  blocks.run(rounds.kernels, "motion/relaxation.cl", "add_energy", of.options_without_metric(),
             diagram.labels(), of.positions(), of.count(), of.lattice(), of.size(), blocks.bits(),
             rounds.partial);
  diagram.wait();
  const auto energies = download<cl_ulong>(of.device, rounds.partial, blocks.count());
  return static_cast<double>(std::accumulate(energies.begin(), energies.end(), std::uint64_t{0})) /
         of.units_of_pixel();
}

}  // namespace

double energy(const Diagram& diagram) {
  Rounds rounds;
  return energy_of(diagram, rounds);
}

Relaxation relax(Seeds& seeds, Diagram& diagram, const Simulation::Engine& engine, int rounds,
                 const RelaxationObserver& observer, const RelaxOptions& options) {
  if (rounds < 0) throw Error("a relaxation of " + std::to_string(rounds) + " rounds; 0 is the least");
  // Written so that a NaN fails.
  if (!(options.tolerance > 0)) {
    throw Error("a relaxation with a tolerance of " + std::to_string(options.tolerance) +
                " pixels; it must be above 0");
  }
  if (!engine) throw Error("a relaxation needs an engine that fills the diagram");
  refuse_weights(*Internal::state(seeds).frame(), "Lloyd relaxation");
  if (options.exact && !options.density.empty()) {
    throw Error("an exact relaxation takes no density, which weighs pixels; leave one of them out");
  }
  if (options.exact && Internal::state(seeds).options.snap == Snap::to_pixels)
    throw Error(
        "an exact relaxation moves seeds to any place, and these are snapped to pixels, as methods that "
        "flood take them");
  refuse_seeds_beyond(*Internal::state(diagram).place(seeds), *Internal::state(seeds).frame(),
                      "Lloyd relaxation");
  if (!diagram.window().is_whole()) {
    throw Error("Lloyd relaxation needs a diagram of the whole grid, and this one shows a part of it");
  }
  Rounds state;
  if (!options.density.empty()) state.density.emplace(diagram.device(), diagram.window(), options.density);
  Relaxation relaxation;
  while (true) {
    engine(seeds, diagram);
    relaxation.energies.push_back(state.density ? state.density->weigh(diagram) : energy_of(diagram, state));
    const bool goes_on = !observer || observer(seeds, diagram, relaxation);
    if (!goes_on || relaxation.rounds() == rounds) return relaxation;
    if (!state.density && !options.exact) cell_sums(diagram, state.cells);
    const Move move = options.exact ? move_to_exact_centroids(seeds, state.exact_cells, options.tolerance)
                                    : move_to_centroids(seeds, state, options.tolerance);
    if (move.displacement < options.tolerance) {
      relaxation.converged = true;
      return relaxation;
    }
    relaxation.moved.push_back(move.seeds);
  }
}

}  // namespace vorocl
