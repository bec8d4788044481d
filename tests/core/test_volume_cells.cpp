// Measures of the cells of volumes, against straight host code.
#define BOOST_TEST_MODULE volume_cells
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <random>

#include "fixture.hpp"

using namespace vorocl;

namespace {

using Labels = std::vector<std::uint32_t>;
using Voxel = std::array<int, 3>;

struct Case {
  std::string name;
  Grid grid;
  std::vector<Voxel> seeds;
  std::vector<bool> absent;  // by seed; empty: none is
  Labels labels;             // of the caller's; empty: jump flooding's
};

std::vector<Voxel> random_voxels(const Grid& grid, std::size_t count, unsigned rng_seed) {
  std::mt19937 rng(rng_seed);
  const auto below = [&](std::int64_t end) { return static_cast<int>(rng() % static_cast<unsigned>(end)); };
  std::vector<Voxel> voxels(count);
  for (Voxel& voxel : voxels) voxel = {below(grid.width()), below(grid.height()), below(grid.depth())};
  return voxels;
}

/// Cells in many pieces, some of the labels none's.
Labels random_labels(const Grid& grid, std::uint32_t cells, unsigned rng_seed) {
  std::mt19937 rng(rng_seed);
  Labels labels(grid.pixels());
  for (std::uint32_t& label : labels) {
    const std::uint32_t drawn = static_cast<std::uint32_t>(rng()) % (cells + cells / 8 + 1);
    label = drawn < cells ? drawn : no_label;
  }
  return labels;
}

/// These axes of a volume, made periodic.
Grid periodic(const Grid& grid, bool x, bool y, bool z) {
  return {x ? grid.x().periodic() : grid.x(), y ? grid.y().periodic() : grid.y(),
          z ? grid.z().periodic() : grid.z()};
}

/// One cell, lumps of voxels with a common label, and single voxels: along all axes cells go round, and have
/// voxels half a period away. Some seeds are absent.
void add_periodic_cases(std::vector<Case>& cases, const Grid& grid) {
  const std::string name = std::to_string(grid.width()) + " x " + std::to_string(grid.height()) + " x " +
                           std::to_string(grid.depth());
  std::vector<bool> absent(20);
  for (std::size_t id = 3; id < absent.size(); id += 7) absent[id] = true;
  const std::vector<Voxel> seeds = random_voxels(grid, absent.size(), 1);
  const Labels pieces = random_labels(grid, 20, 2);
  Labels lumps(grid.pixels());
  for (std::size_t i = 0; i < lumps.size(); ++i) {
    const std::size_t width = static_cast<std::size_t>(grid.width()), rows = i / width;
    const std::size_t row = rows % static_cast<std::size_t>(grid.height()),
                      slice = rows / static_cast<std::size_t>(grid.height());
    lumps[i] = pieces[(i % width / 11 + row / 5 * 7 + slice / 4 * 31) % pieces.size()];
  }
  cases.push_back({name + ", one cell", grid, random_voxels(grid, 20, 3), {}, Labels(grid.pixels(), 0)});
  cases.push_back({name + ", lumps", grid, seeds, absent, lumps});
  cases.push_back({name + ", pieces", grid, seeds, absent, pieces});
}

std::vector<Case> measured_cases() {
  std::vector<Case> cases;
  const auto add = [&](const std::string& name, const Grid& grid, std::size_t count) {
    cases.push_back({name, grid, random_voxels(grid, count, 5), {}, {}});
  };
  add("no seed", Grid(9, 8, 7), 0);
  add("one seed", Grid(17, 5, 3), 1);
  add("few", Grid(70, 40, 37), 9);
  add("some", Grid(70, 40, 37), 300);
  add("dense", Grid(65, 34, 35), 9000);
  add("flat", Grid(150, 70, 2), 40);
  add("a column of rows", Grid(1, 40, 90), 30);
  add("narrow", Grid(3, 1, 700), 200);
  add("several blocks along each axis", Grid(140, 72, 40), 60);
  const Grid grid(70, 33, 36);  // as many bits as the grids above have: no programs of its own
  cases.push_back({"pieces", grid, random_voxels(grid, 300, 1), {}, random_labels(grid, 300, 2)});
  cases.push_back({"no labels", grid, random_voxels(grid, 5, 1), {}, Labels(grid.pixels(), no_label)});
  // Labels that name seeds which are absent.
  cases.push_back({"absent", grid, random_voxels(grid, 60, 1), {}, random_labels(grid, 60, 3)});
  for (int i = 0; i < 60; ++i) cases.back().absent.push_back(i % 3 == 0);
  return cases;
}

/// The device in the shapes that measurements differ for: large blocks, with whole and cut vectors, and small
/// ones.
std::vector<Device> shapes() {
  const Device& device = test_device();
  return {device.with_tuning({16, 64, 1}), device.with_tuning({4, 8, 1}), device.with_tuning({1, 32, 8})};
}

struct Cell {
  std::uint32_t area = 0;
  std::array<std::int64_t, 3> sum = {};
  Voxel least = {INT32_MAX, INT32_MAX, INT32_MAX}, greatest = {INT32_MIN, INT32_MIN, INT32_MIN};
  std::int64_t farthest = -1;
  bool touches_border = false;
  std::uint32_t neighbours = 0, surface = 0;
};

struct Measured {
  std::vector<Cell> cells;
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> pairs;
};

/// Where a coordinate lies, seen from a seed's: of its images along a periodic axis the nearest, and of two
/// the greater.
int placed(int at, int seed, const Axis& axis) {
  const auto side = static_cast<int>(axis.pixels());
  int nearest = at;
  for (const int image : {at - side, at + side}) {
    if (!axis.is_periodic()) break;
    const int apart = std::abs(image - seed), least = std::abs(nearest - seed);
    if (apart < least || (apart == least && image > nearest)) nearest = image;
  }
  return nearest;
}

/// Voxel by voxel; labels that name an absent seed are none.
Measured on_host(const Case& test, const Labels& labels, Metric metric) {
  const Grid& grid = test.grid;
  const std::array<Axis, 3> axes = {grid.x(), grid.y(), grid.z()};
  const std::array<std::int64_t, 3> sides = {grid.width(), grid.height(), grid.depth()};
  const std::array<std::size_t, 3> strides = {1, static_cast<std::size_t>(sides[0]),
                                              static_cast<std::size_t>(sides[0] * sides[1])};
  const auto is_cell = [&](std::uint32_t label) {
    return label != no_label && (test.absent.empty() || !test.absent[label]);
  };
  Measured found;
  found.cells.resize(test.seeds.size());
  for (std::size_t i = 0; i < labels.size(); ++i) {
    if (!is_cell(labels[i])) continue;
    Cell& cell = found.cells[labels[i]];
    ++cell.area;
    std::int64_t distance = 0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const auto at = static_cast<int>(i / strides[axis] % static_cast<std::size_t>(sides[axis]));
      const int place = placed(at, test.seeds[labels[i]][axis], axes[axis]);
      const std::int64_t way = (place - test.seeds[labels[i]][axis]) * axes[axis].spacing();
      const bool is_last = at + 1 == sides[axis];
      cell.sum[axis] += place;
      cell.least[axis] = std::min(cell.least[axis], place);
      cell.greatest[axis] = std::max(cell.greatest[axis], place);
      const bool has_ends = !axes[axis].is_periodic() && (axis < 2 || sides[2] > 1);
      cell.touches_border |= has_ends && (at == 0 || is_last);
      distance += metric == Metric::euclidean ? way * way : std::abs(way);
      if (is_last && !axes[axis].is_periodic()) continue;
      const std::uint32_t next =
          labels[is_last ? i - static_cast<std::size_t>(at) * strides[axis] : i + strides[axis]];
      if (is_cell(next) && next != labels[i]) ++found.pairs[std::minmax({labels[i], next})];
    }
    cell.farthest = std::max(cell.farthest, distance);
  }
  for (const auto& [pair, faces] : found.pairs) {
    for (const std::uint32_t id : {pair.first, pair.second}) {
      ++found.cells[id].neighbours;
      found.cells[id].surface += faces;
    }
  }
  return found;
}

bool is(const CellSums& sums, const Cell& cell) {
  return sums.area == cell.area && sums.sum_x == cell.sum[0] && sums.sum_y == cell.sum[1] &&
         sums.sum_z == cell.sum[2];
}

bool is(const CellShape& shape, const Cell& cell) {
  return Voxel{shape.left, shape.top, shape.front} == cell.least &&
         Voxel{shape.right, shape.bottom, shape.back} == cell.greatest &&
         shape.largest_distance == static_cast<double>(cell.farthest) &&
         shape.touches_border == cell.touches_border;
}

template <typename T>
std::size_t count_wrong(const std::vector<T>& found, const std::vector<Cell>& cells) {
  BOOST_TEST_REQUIRE(found.size() == cells.size());
  std::size_t wrong = 0;
  for (std::size_t id = 0; id < found.size(); ++id) wrong += is(found[id], cells[id]) ? 0 : 1;
  return wrong;
}

/// Results that measure one diagram after the other: their buffers grow, and hold what the last one left.
struct Results {
  CellSumsResult sums;
  CellShapesResult shapes;
  CellStatisticsResult statistics, of_sums;
  AdjacencyResult pairs;
};

void check_statistics(const Case& test, const std::vector<Cell>& cells, const CellStatistics& statistics) {
  std::size_t there = 0, empty = 0, voxels = 0;
  for (std::size_t id = 0; id < cells.size(); ++id) {
    if (!test.absent.empty() && test.absent[id]) continue;
    ++there;
    empty += cells[id].area == 0 ? 1 : 0;
    voxels += cells[id].area;
  }
  BOOST_TEST(statistics.cells == there);
  BOOST_TEST(statistics.empty_cells == empty);
  BOOST_TEST(statistics.pixels == voxels);
  if (there == 0) return;
  const double mean = static_cast<double>(voxels) / static_cast<double>(there);
  double squares = 0;
  for (std::size_t id = 0; id < cells.size(); ++id) {
    if (test.absent.empty() || !test.absent[id]) squares += std::pow(cells[id].area - mean, 2);
  }
  BOOST_TEST(statistics.mean_area == mean);
  BOOST_TEST(std::abs(statistics.area_deviation - std::sqrt(squares / static_cast<double>(there))) <
             1e-6 * mean + 1e-9);
}

void check_pairs(const Measured& expected, const AdjacencyResult& pairs) {
  std::vector<CellPair> list;
  for (const auto& [ids, faces] : expected.pairs) list.push_back({ids.first, ids.second, faces});
  BOOST_TEST((pairs.read_pairs() == list));
  const auto neighbours = pairs.read_neighbours(), surfaces = pairs.read_perimeters();
  std::size_t wrong = 0;
  for (std::size_t id = 0; id < neighbours.size(); ++id) {
    const Cell& cell = expected.cells[id];
    wrong += neighbours[id] != cell.neighbours || surfaces[id] != cell.surface ? 1 : 0;
  }
  BOOST_TEST(wrong == 0u);
}

void check(const Case& test, const Diagram& diagram, Results& results) {
  BOOST_TEST_CONTEXT(test.name) {
    const Measured expected = on_host(test, diagram.read(), diagram.metric());
    cell_sums(diagram, results.sums);
    cell_shapes(diagram, results.shapes);
    cell_statistics(diagram, results.statistics);
    cell_statistics(results.sums, results.of_sums);
    adjacency(diagram, results.pairs);
    BOOST_TEST(count_wrong(results.sums.read(), expected.cells) == 0u);
    BOOST_TEST(count_wrong(results.shapes.read(), expected.cells) == 0u);
    std::vector<std::uint32_t> areas;
    for (const Cell& cell : expected.cells) areas.push_back(cell.area);
    BOOST_TEST((results.statistics.read_areas() == areas));
    check_statistics(test, expected.cells, results.statistics.read());
    check_statistics(test, expected.cells, results.of_sums.read());
    check_pairs(expected, results.pairs);
  }
}

Seeds seeds_of(const Device& device, const Case& test) {
  std::vector<double> xyz;
  for (const Voxel& at : test.seeds) xyz.insert(xyz.end(), {at[0] + 0.5, at[1] + 0.25, at[2] + 0.75});
  std::vector<std::uint8_t> present(test.seeds.size(), 1);
  for (std::size_t id = 0; id < test.absent.size(); ++id) present[id] = test.absent[id] ? 0 : 1;
  const double* const first = xyz.data();
  return {device, test.grid,
          Points(first, first + 1, first + 2, test.seeds.size(), 3 * sizeof(double)).marked(present.data()),
          to_centres};
}

void check_all(const std::vector<Case>& cases, const std::vector<Device>& devices) {
  for (const Device& device : devices) {
    Results results;
    for (const Case& test : cases) {
      const Seeds seeds = seeds_of(device, test);
      Diagram diagram(device, test.grid);
      const Metric metric = test.seeds.size() % 2 == 0 ? Metric::euclidean : Metric::manhattan;
      if (test.labels.empty()) {
        jump_flooding(seeds, diagram, {metric});
      } else {
        diagram.write(test.labels, seeds, metric);
      }
      check(test, diagram, results);
    }
  }
}

}  // namespace

BOOST_AUTO_TEST_CASE(all_measures_are_those_of_the_host) { check_all(measured_cases(), shapes()); }

/// Odd sides and even ones, and periods of one voxel and of two. Only the first grids, which share their
/// programs, are measured in large blocks too: building programs takes most of the time.
BOOST_AUTO_TEST_CASE(periodic_measures_are_those_of_the_host) {
  std::vector<Case> all_axes, others;
  add_periodic_cases(all_axes, periodic(Grid(71, 40, 34), true, true, true));
  add_periodic_cases(all_axes, periodic(Grid(66, 35, 33), true, true, true));
  add_periodic_cases(others, periodic(Grid(70, 19, 10), false, false, true));
  add_periodic_cases(others, periodic(Grid(37, 9, 12), true, true, false));
  add_periodic_cases(others, periodic(Grid(2, 1, 90), true, true, true));
  check_all(all_axes, {shapes().front(), shapes().back()});
  check_all(others, {shapes().back()});
}

/// Voxels that are longer along one axis than along another, in a volume and in a plane.
BOOST_AUTO_TEST_CASE(spaced_measures_are_those_of_the_host) {
  std::vector<Case> cases;
  for (const auto depth : {37, 1}) {
    const Grid grid(Axis(70).spaced(2), Axis(40), Axis(depth).spaced(4));
    for (const std::size_t count : {9u, 300u})
      cases.push_back({"spaced", grid, random_voxels(grid, count, 5), {}, {}});
    cases.push_back({"spaced pieces", grid, random_voxels(grid, 60, 1), {}, random_labels(grid, 60, 2)});
  }
  check_all(cases, {shapes().back()});
}

BOOST_AUTO_TEST_CASE(the_slices_of_a_plane_are_the_first_one_after_those_of_a_volume) {
  CellSumsResult sums;
  for (const Grid& grid : {Grid(9, 8, 7), Grid(9, 8)}) {
    const Seeds seeds = Seeds::random(test_device(), grid, 5, 1);
    Diagram diagram(test_device(), grid);
    jump_flooding(seeds, diagram);
    cell_sums(diagram, sums);
    std::int64_t slices = 0;
    for (const CellSums& cell : sums.read()) slices += cell.sum_z;
    BOOST_TEST((slices != 0) == grid.is_volume());
  }
}

/// Borders, labels looked up, and labels within a tolerance: of cells in pieces, round an axis and spaced.
BOOST_AUTO_TEST_CASE(fields_of_volumes_are_those_of_the_host) {
  for (const Grid& grid :
       {Grid(37, 19, 12), periodic(Grid(Axis(37).spaced(2), Axis(9), Axis(12)), true, false, true)}) {
    const Case test = {"pieces", grid, random_voxels(grid, 20, 1), {}, random_labels(grid, 20, 2)};
    const Seeds seeds = seeds_of(test_device(), test);
    Diagram diagram(test_device(), grid), flooded(test_device(), grid);
    diagram.write(test.labels, seeds, Metric::euclidean);
    jump_flooding(seeds, flooded);
    const Labels others = flooded.read();
    const std::array<Axis, 3> axes = {grid.x(), grid.y(), grid.z()};
    std::vector<std::uint8_t> borders;
    Labels looked_up, table;
    for (std::uint32_t id = 0; id < 20; ++id) table.push_back(7 * id + 3);
    std::size_t distant = 0;
    for (std::size_t i = 0; i < test.labels.size(); ++i) {
      const std::uint32_t label = test.labels[i], other = others[i];
      looked_up.push_back(label == no_label ? no_label : table[label]);
      double square = 0, square_of_other = 0;
      bool is_border = false;
      std::size_t stride = 1;
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const auto side = static_cast<std::size_t>(axes[axis].pixels());
        const std::size_t at = i / stride % side;
        const auto beside = [&](std::size_t from_end, std::size_t inside, std::size_t across) {
          if (at != from_end) return test.labels[inside];
          return axes[axis].is_periodic() ? test.labels[across] : label;
        };
        is_border |= beside(0, i - stride, i + (side - 1) * stride) != label ||
                     beside(side - 1, i + stride, i - at * stride) != label;
        const auto along = [&](std::uint32_t id) {
          const int seed = test.seeds[id][axis], place = placed(static_cast<int>(at), seed, axes[axis]);
          return std::pow((place - seed) * axes[axis].spacing(), 2);
        };
        if (label != no_label) square += along(label);
        square_of_other += along(other);
        stride *= side;
      }
      borders.push_back(is_border ? 1 : 0);
      distant += label == no_label || std::abs(std::sqrt(square) - std::sqrt(square_of_other)) > 2.3 ? 1 : 0;
    }
    Field<std::uint8_t> mask;
    Field<std::uint32_t> mapped;
    SimilarityResult similar;
    border_mask(diagram, mask);
    map_labels(diagram, table, mapped);
    similarity(diagram, flooded, 2.3, similar);
    BOOST_TEST((mask.read() == borders));
    BOOST_TEST((mapped.read() == looked_up));
    BOOST_TEST(similar.read_differences() == distant);
  }
}

/// One cell of a volume whose coordinates add up to more than 32 bits have.
BOOST_AUTO_TEST_CASE(sums_past_32_bits) {
  for (const Device& device : shapes()) {
    const Grid grid(3, 2000, 1500);
    const Seeds seeds(device, grid, std::vector<Point>{{1, 1900, 1400}}, to_centres);
    Diagram diagram(device, grid);
    diagram.write(Labels(grid.pixels(), 0), seeds, Metric::euclidean);
    CellSumsResult result;
    cell_sums(diagram, result);
    const CellSums cell = result.read().front();
    BOOST_TEST(cell.sum_y == 1999ll * 2000 / 2 * 3 * 1500);
    BOOST_TEST(cell.sum_z == 1499ll * 1500 / 2 * 3 * 2000);
    BOOST_TEST(cell.sum_z > 0xffffffffll);
    BOOST_TEST((cell.centroid().x == 1.5 && cell.centroid().y == 1000 && cell.centroid().z == 750));
  }
  BOOST_TEST(std::isnan(CellSums().centroid().z));
}

/// Two cells side by side share one face for each voxel between them, a known area.
BOOST_AUTO_TEST_CASE(halves_of_a_box_touch_in_their_section) {
  const Grid grid(20, 11, 7);
  const Seeds seeds(test_device(), grid, std::vector<Point>{{4, 5, 3}, {15, 5, 3}}, to_centres);
  Diagram diagram(test_device(), grid);
  jump_flooding(seeds, diagram);
  AdjacencyResult pairs;
  adjacency(diagram, pairs);
  BOOST_TEST((pairs.read_pairs() == std::vector<CellPair>{{0, 1, 11 * 7}}));
}

/// More neighbours than the first table has room for: they are found again in a larger one.
BOOST_AUTO_TEST_CASE(cells_with_many_neighbours_have_all_of_them) {
  const Grid grid(64, 64, 32);
  const Case test = {"confetti", grid, random_voxels(grid, 400, 1), {}, random_labels(grid, 400, 2)};
  const Seeds seeds = seeds_of(test_device(), test);
  Diagram diagram(test_device(), grid);
  diagram.write(test.labels, seeds, Metric::euclidean);
  Results results;
  check(test, diagram, results);
  BOOST_TEST(results.pairs.pairs() > 16u * 400);
}
