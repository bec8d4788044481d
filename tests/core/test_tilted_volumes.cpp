// Diagrams of volumes whose boxes are tilted, and their measures, against all images of all seeds in 128-bit
// integers on the host.
#define BOOST_TEST_MODULE tilted_volumes
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <random>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "exact_cases.hpp"
#include "tilted_box.hpp"
#include "vorocl/adjacency.hpp"
#include "vorocl/cells.hpp"
#include "vorocl/fields.hpp"
#include "vorocl/method.hpp"
#include "vorocl/motion.hpp"
#include "vorocl/relaxation.hpp"
#include "weights.hpp"

using namespace vorocl;

namespace {

/// A random box and seeds: where they lie in the box, and points that are given for them.
struct RandomCase {
  explicit RandomCase(unsigned number) : rng(number) {
    const bool is_large = number % 20 == 19;  // more than a work-item of a CPU has
    const auto side = [&] {
      return below(4) == 0 ? 1 + below(3) : is_large ? 30 + below(12) : 1 + below(16);
    };
    // In groups few programs.
    const std::array<Axes, 4> some = {Axes::xyz, Axes::xyz, Axes::xy, Axes::xz};
    box = {{side(), side(), 1 + side()}, some[number % 4]};
    if (number % 4 < 3) box.xy = tilt(box.sides[0]);
    if (number % 4 != 2) box.xz = tilt(box.sides[0]);
    if (number % 4 < 2) box.yz = tilt(box.sides[1]);
    if (number % 7 == 6 && (number % 4 < 2 || number % 28 == 6)) box.spacing = {2, 1, 3};
    if (number % 28 == 6) box.sides[2] = 1;  // of a plane with spacings
    if (number % 11 == 10) {                 // a rod, whose near images are many periods away
      box.sides = {2, 2, 2};
      const auto along = static_cast<std::size_t>(below(3));
      box.sides[along] = 60;
      box.xy = box.xy != 0 ? tilt(box.sides[0]) : 0;
      box.xz = box.xz != 0 ? tilt(box.sides[0]) : 0;
      box.yz = box.yz != 0 ? tilt(box.sides[1]) : 0;
    }
    snap = below(5) == 0 ? Snap::to_pixels : Snap::none;
    make_seeds();
  }

  std::mt19937_64 rng;
  TiltedBox box = {};
  Snap snap = Snap::none;
  std::vector<Spot> seeds;
  std::vector<Point> points;

  std::int64_t below(std::int64_t end) {
    return static_cast<std::int64_t>(rng() % static_cast<std::uint64_t>(end));
  }

 private:
  std::int64_t tilt(std::int64_t side) {
    const std::int64_t period = side * parts, any = below(period) - period / 2;
    const std::int64_t tilts[] = {any, any, any, any / parts * parts, period / 2, -period / 2, 1, 0, 3 * any};
    return tilts[below(9)];
  }

  void make_seeds() {
    const std::int64_t kind = below(6), step = parts << below(3);
    const bool is_rod = *std::max_element(box.sides.begin(), box.sides.end()) == 60;
    const std::int64_t count =
        below(4) == 0 || is_rod ? 1 + below(3) : 1 + below(box.sides[0] > 16 ? 400 : 40);
    const bool moves = below(2) == 0;
    for (std::int64_t i = 0; i < count; ++i) {
      Spot seed = {};
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const std::int64_t size = box.sides[axis] * parts;
        std::int64_t& at = seed[axis];
        at = below(size);
        if (kind == 1) at = at / (parts / 2) * (parts / 2);           // half voxels
        if (kind == 2) at = at / step * step;                         // a lattice
        if (kind == 3) at = std::min(size - 1, size / 2 + below(9));  // a crowd
        if (kind == 4 && axis == 2) at = size / 3;                    // in a plane
        if (kind == 5 && i > 0 && axis < 2) at = seeds[0][axis];      // on a line
        if (box.sides[2] == 1 && axis == 2) at = parts / 2;
      }
      Spot given = seed;
      if (moves) {
        const std::int64_t k = has_z(box.periodic) ? below(5) - 2 : 0,
                           j = has_y(box.periodic) ? below(5) - 2 : 0;
        given[0] += (below(5) - 2) * box.sides[0] * parts + j * box.xy + k * box.xz;
        given[1] += j * box.sides[1] * parts + k * box.yz;
        given[2] += k * box.sides[2] * parts;
      }
      const std::vector<Point> point = points_at({given});
      points.push_back(point[0]);
      if (snap == Snap::to_pixels) seed = centre_of(seed[0] / parts, seed[1] / parts, seed[2] / parts);
      seeds.push_back(seed);
    }
  }
};

std::string text_of(const RandomCase& random, unsigned number) {
  const TiltedBox& box = random.box;
  std::ostringstream text;
  text << "case " << number << ": " << box.sides[0] << " x " << box.sides[1] << " x " << box.sides[2]
       << ", periodic " << static_cast<int>(box.periodic) << ", tilts " << box.xy << ", " << box.xz << ", "
       << box.yz << ", " << random.seeds.size() << " seeds";
  return text.str();
}

/// In groups, whose programs know the axes, those of most cases alone.
const Device& device_for(const RandomCase& random, unsigned number) {
  static const std::array<Device, 3> devices = {shaped(Shape::vector, ListLength::full),
                                                shaped(Shape::vector, ListLength::two_entries),
                                                shaped(Shape::group, ListLength::full)};
  const bool is_usual = random.box.periodic == Axes::xyz && random.box.spacing[0] == 1;
  return devices[number % (is_usual || number % 16 == 5 ? 3 : 2)];
}

}  // namespace

BOOST_AUTO_TEST_CASE(labels_are_those_of_all_images) {
  for (unsigned number = 0; number < (long_tests ? 20000u : 300u); ++number) {
    RandomCase random(number);
    const bool are_weighted = number % 5 > 2 && random.snap == Snap::none && number % 7 != 6;
    std::vector<double> weights;
    std::vector<std::int64_t> lags;
    if (are_weighted) {
      weights = hard_weights(random.points.size(), 4, random.rng);
      lags = lags_by_definition(weights, [](std::size_t) { return true; });
    }
    const Device& device = device_for(random, number / 4);
    Diagram diagram(device, random.box.grid());
    const Points points = Points(random.points).weighted(are_weighted ? weights.data() : nullptr);
    exact_diagram(Seeds(device, random.box.grid(), points, {Outside::count, random.snap}), diagram);
    const std::size_t wrong =
        count_differences(diagram.read(), labels_by_definition(random.box, random.seeds, lags));
    BOOST_TEST(wrong == 0u, text_of(random, number)
                                << (are_weighted ? ", weighted" : "") << ": " << wrong << " wrong");
  }
}

BOOST_AUTO_TEST_CASE(measures_are_those_of_the_nearest_images) {
  const Device& device = test_device();
  for (unsigned number = 0; number < (long_tests ? 4000u : 50u); ++number) {
    const RandomCase random(number + 1000000);
    const TiltedBox& box = random.box;
    // Each choice of axes and spacings has programs of its own.
    const bool is_usual = box.periodic == Axes::xyz || (box.periodic == Axes::xz && box.spacing[0] == 1);
    if (!long_tests && !is_usual) continue;
    const Seeds seeds(device, box.grid(), Points(random.points), {Outside::count, random.snap});
    Diagram diagram(device, box.grid());
    exact_diagram(seeds, diagram);
    const Labels labels = diagram.read();
    CellSumsResult sums;
    CellShapesResult shapes;
    CellStatisticsResult statistics;
    AdjacencyResult pairs;
    Field<float> distances;
    Field<std::uint8_t> borders;
    cell_sums(diagram, sums);
    cell_shapes(diagram, shapes);
    cell_statistics(diagram, statistics);
    adjacency(diagram, pairs);
    distance_field(diagram, distances);
    border_mask(diagram, borders);

    // The label of a voxel a period or less outside the grid: what lies between voxels has that which it
    // shares most with.
    const auto rounded = [](std::int64_t tilt) { return floor_of(2 * tilt + parts, 2 * parts); };
    const Grid::Shifts shifts = box.grid().shifts();
    const auto label_at = [&](std::int64_t x, std::int64_t y,
                              std::int64_t z) -> std::optional<std::uint32_t> {
      const std::array<std::int64_t, 3>& n = box.sides;
      const std::int64_t k = has_z(box.periodic) ? floor_of(z, n[2]) : 0;
      x -= k * rounded(shifts.xz), y -= k * rounded(shifts.yz), z -= k * n[2];
      const std::int64_t j = has_y(box.periodic) ? floor_of(y, n[1]) : 0;
      x -= j * rounded(shifts.xy), y -= j * n[1];
      x -= floor_of(x, n[0]) * n[0];
      if (y < 0 || y >= n[1] || z < 0 || z >= n[2]) return std::nullopt;
      return labels[static_cast<std::size_t>((z * n[1] + y) * n[0] + x)];
    };
    struct Cell {
      std::int64_t area = 0, rows = 0, slices = 0;
      Spot sum = {};
      Spot first = {INT32_MAX, INT32_MAX, INT32_MAX}, last = {INT32_MIN, INT32_MIN, INT32_MIN};
      double farthest = -1;
    };
    std::vector<Cell> cells(random.seeds.size());
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> expected_pairs, found_pairs;
    std::size_t wrong_distances = 0, wrong_borders = 0, i = 0;
    const std::vector<float> found_distances = distances.read();
    const std::vector<std::uint8_t> found_borders = borders.read();
    each_voxel(box, [&](std::int64_t x, std::int64_t y, std::int64_t z) {
      const std::uint32_t label = labels[i];
      const Spot seed = random.seeds[label], voxel = centre_of(x, y, z);
      const auto way = box.shortest(seed, voxel);
      const double square = static_cast<double>(box.squared(way.way)) / parts / parts;
      const double off = std::abs(static_cast<double>(found_distances[i]) - std::sqrt(square));
      wrong_distances += off > 1e-6 * (1 + std::sqrt(square)) ? 1 : 0;
      Cell& cell = cells[label];
      ++cell.area;
      cell.farthest = std::max(cell.farthest, square);
      // By the reduced tilts, of which the way goes round as often as its voxel lies outside the box.
      const std::int64_t across_z = (seed[2] + way.way[2] - voxel[2]) / (box.sides[2] * parts);
      const std::int64_t in_y = seed[1] + way.way[1] - voxel[1] - across_z * shifts.yz;
      const std::int64_t across_y = in_y / (box.sides[1] * parts);
      const std::int64_t in_x = seed[0] + way.way[0] - voxel[0] - across_z * shifts.xz - across_y * shifts.xy;
      cell.slices += across_z, cell.rows += across_y;
      const Spot own = {x + in_x / parts, y + across_y * box.sides[1], z + across_z * box.sides[2]};
      for (std::size_t axis = 0; axis < 3; ++axis) {
        cell.sum[axis] += own[axis];
        const std::int64_t at = floor_of(seed[axis] + way.way[axis], parts);
        cell.first[axis] = std::min(cell.first[axis], at), cell.last[axis] = std::max(cell.last[axis], at);
      }
      bool is_border = false;
      for (std::size_t axis = 0; axis < 3; ++axis) {
        for (const std::int64_t step : {-1, 1}) {
          Spot at = {x, y, z};
          at[axis] += step;
          const auto other = label_at(at[0], at[1], at[2]);
          if (!other || *other == label) continue;
          is_border = true;
          if (step > 0) ++expected_pairs[std::minmax(label, *other)];
        }
      }
      wrong_borders += (found_borders[i] != 0) != is_border ? 1 : 0;
      ++i;
    });
    const std::vector<CellSums> found_sums = sums.read();
    const std::vector<CellShape> found_shapes = shapes.read();
    std::size_t wrong_sums = 0, wrong_shapes = 0;
    for (std::size_t id = 0; id < cells.size(); ++id) {
      const Cell& cell = cells[id];
      const CellSums& found = found_sums[id];
      const auto whole = [](std::int64_t tilts) { return floor_of(tilts + parts / 2, parts); };
      wrong_sums += found.area != cell.area || found.sum_z != cell.sum[2] ||
                    found.sum_y != cell.sum[1] + whole(cell.slices * shifts.yz) ||
                    found.sum_x != cell.sum[0] + whole(cell.rows * shifts.xy + cell.slices * shifts.xz);
      const CellShape& shape = found_shapes[id];
      wrong_shapes += shape.largest_distance != cell.farthest ? 1 : 0;
      if (cell.area == 0) continue;
      wrong_shapes += Spot{shape.left, shape.top, shape.front} != cell.first ||
                      Spot{shape.right, shape.bottom, shape.back} != cell.last;
    }
    for (const CellPair& pair : pairs.read_pairs()) found_pairs[{pair.a, pair.b}] = pair.length;
    const std::string text = text_of(random, number);
    BOOST_TEST(wrong_sums == 0u, text << ": sums");
    BOOST_TEST(wrong_shapes == 0u, text << ": shapes");
    BOOST_TEST(wrong_distances == 0u, text << ": distances");
    BOOST_TEST(wrong_borders == 0u, text << ": border mask");
    BOOST_TEST((found_pairs == expected_pairs), text << ": pairs");
    BOOST_TEST(statistics.read().cells == cells.size());
  }
}

BOOST_AUTO_TEST_CASE(the_same_box_by_other_tilts_and_axes_has_the_same_labels) {
  // Tilts that differ by whole periods, of which one of z that goes round in y leans along x, too; and axes
  // in other units that point the other way.
  std::mt19937_64 rng(3);
  std::vector<Point> points, scaled;
  for (int i = 0; i < 60; ++i) {
    const auto at = [&](double side) {
      return std::floor(side * 4096 * static_cast<double>(rng() >> 11) * 0x1p-53) / 4096;
    };
    points.push_back({at(24), at(20), at(16)});
    scaled.push_back({points.back().x / 2 - 3, 5 - points.back().y / 2, points.back().z / 2 + 1});
  }
  const Grid grid = Grid(24, 20, 16, Axes::xyz).tilted(7, 3, -8);
  const Grid same = Grid(24, 20, 16, Axes::xyz).tilted(7 + 48, 3 + 2 * 7 - 24, -8 + 2 * 20);
  const Grid other =
      Grid(Axis(24, -3, 9).periodic(), Axis(20, -5, 5).periodic().reversed(), Axis(16, 1, 9).periodic())
          .tilted(-3.5, 1.5, 4);
  const auto labels_in = [](const Grid& of, const std::vector<Point>& seeds) {
    Diagram diagram(test_device(), of);
    exact_diagram(Seeds(test_device(), of, seeds), diagram);
    return diagram.read();
  };
  const Labels expected = labels_in(grid, points);
  BOOST_TEST(count_differences(labels_in(same, points), expected) == 0u);
  BOOST_TEST(count_differences(labels_in(other, scaled), expected) == 0u);
}

BOOST_AUTO_TEST_CASE(seeds_that_the_device_makes_are_tilted_too) {
  const TiltedBox box = {{31, 20, 12}, Axes::xyz, 9 * parts + 5, -4 * parts, 7 * parts + 1};
  const Seeds random = Seeds::random(test_device(), box.grid(), 90, 3);
  std::vector<std::uint8_t> mask(box.grid().pixels(), 0);
  for (const std::optional<Point>& at : random.read_pixels())
    mask[static_cast<std::size_t>((std::floor(at->z) * 20 + std::floor(at->y)) * 31 + std::floor(at->x))] = 1;
  const Seeds masked = Seeds::from_mask(test_device(), box.grid(), mask);
  for (const Seeds* const seeds : {&random, &masked}) {
    std::vector<Spot> spots;
    for (const std::optional<Point>& at : seeds->read_pixels())
      spots.push_back(
          centre_of(std::llround(at->x - 0.5), std::llround(at->y - 0.5), std::llround(at->z - 0.5)));
    Diagram diagram(test_device(), box.grid());
    exact_diagram(*seeds, diagram);
    BOOST_TEST(count_differences(diagram.read(), labels_by_definition(box, spots)) == 0u);
  }
}

BOOST_AUTO_TEST_CASE(seeds_move_the_shortest_way) {
  const Grid grid = Grid(100, 40, 30, Axes::xyz).tilted(30, 10, 15);
  Seeds seeds(test_device(), grid, {{50.5, 1.5, 3.5}, {10.5, 20.5, 3.5}}, to_centres);
  // Up through the first row, and into the last one 30 voxels further along x.
  seeds.move_to({{81.5, 39.5, 3.5}, {10.5, 21.5, 3.5}});
  BOOST_TEST(seeds.displacement() == 2);
  // The second one goes through the first slice.
  seeds.move_to({{81.5, 39.5, 3.5}, {20.5, 36.5, 29.5}});
  BOOST_TEST(seeds.displacement() == 4);
}

BOOST_AUTO_TEST_CASE(what_knows_no_tilt_says_so) {
  const Grid grid = Grid(24, 20, 16, Axes::xyz).tilted(7, 3, -8);
  Seeds seeds(test_device(), grid, {{3, 4, 5}, {13, 14, 15}}, to_centres);
  Diagram diagram(test_device(), grid);
  for (const Method& each : methods()) {
    if (each.exact || !each.volumes) continue;
    check_error([&] { each.run(seeds, diagram, {}); }, {"tilted", "flooding cannot take", "exact diagrams"});
  }
  check_error([&] { random_step(seeds, 3, Border::periodic, 1, 1); }, {"random motion"});
  const auto exactly = [](const Seeds& of, Diagram& into) { return exact_diagram(of, into); };
  check_error([&] { relax(seeds, diagram, exactly, 3); }, {"tilted", "Lloyd relaxation"});
  check_error([&] { Diagram(test_device(), Window(grid, 0, 0, 0, 5, 5, 5)); }, {"window"});
  check_error([&] { Grid(24, 20, 16, Axes::xy).tilted(0, 3, 0); }, {"tilted", "periodic in x and z"});
  const Grid rod = Grid(2, 4000, 2, Axes::xyz).tilted(1, 0, -1999);
  Diagram of_rod(test_device(), rod);
  check_error(
      [&] {
        exact_diagram(Seeds(test_device(), rod, {{1, 2, 1}}), of_rod);
      },
      {"2 x 4000 x 2", "so flat that the images", "exact cells"});
  // An open axis without an extent has no tilt.
  const Grid open = Grid(Axis(10, 3, 3), Axis(5).periodic(), Axis(6).periodic()).tilted(0, 0, 2);
  BOOST_TEST((open.shifts().xy == 0 && open.shifts().xz == 0 && open.shifts().yz == 2 * parts));
}
