// Exact diagrams of points within their voxels, judged by every voxel's distances to all seeds in 128-bit
// integers; and measures of such diagrams.
#define BOOST_TEST_MODULE volume_points
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <map>
#include <random>
#include <string>
#include <tuple>
#include <vector>

#include "fixture.hpp"
#include "list_length.hpp"
#include "runtime/pixel_grid.hpp"
#include "volume_points.hpp"
#include "weights.hpp"

using namespace vorocl;

namespace {

/// Many more cases, for minutes instead of seconds.
const bool long_tests = std::getenv("VOROCL_LONG_TESTS") != nullptr;

Labels labels_of(const Device& device, const Grid& grid, const std::vector<Spot>& seeds,
                 const std::vector<double>& weights = {}) {
  Diagram diagram(device, grid);
  const std::vector<Point> points = points_at(seeds);
  exact_diagram(Seeds(device, grid, Points(points).weighted(weights.empty() ? nullptr : weights.data())),
                diagram);
  return diagram.read();
}

/// Calls a function with each voxel and its index among the labels.
template <typename Use>
void each_voxel(const Grid& grid, Use use) {
  std::size_t i = 0;
  for (std::int64_t z = 0; z < grid.depth(); ++z) {
    for (std::int64_t y = 0; y < grid.height(); ++y) {
      for (std::int64_t x = 0; x < grid.width(); ++x, ++i) use(Spot{x, y, z}, i);
    }
  }
}

/// One random case: a volume or a spaced plane, and points that are hard for some part of the engine.
struct RandomCase {
  explicit RandomCase(unsigned number) : rng(number), kind(number / 2 % 9) {
    const std::int64_t most = number % 3 == 0 ? 8 : number % 32 == 1 ? 64 : 30;
    // In groups few programs: none, all, one of the axes is periodic.
    static constexpr std::array<Axes, 6> some = {Axes::xyz, Axes::x, Axes::y, Axes::xy, Axes::xz, Axes::yz};
    const bool in_groups = test_device().tuning().shape == Shape::group;
    const std::array<Axes, 4> periodic = {Axes::none, in_groups ? Axes::xyz : some[number / 4 % 6], Axes::z,
                                          Axes::none};
    const auto side = [&] { return 1 + below(most); };
    const std::int64_t width = side(), height = side();
    grid = Grid(width, height, 1 + side(), periodic[number % 4]);
    if (number % 4 == 3) grid = Grid(grid.x().spaced(2), grid.y(), grid.z().spaced(3));
    if (number % 8 == 7) {  // a plane with spacings
      const auto axis = [&](int spacing, bool is_periodic) {
        const Axis open = Axis(4 * side()).spaced(spacing);
        return is_periodic ? open.periodic() : open;
      };
      grid = Grid(axis(3, number % 3 == 0), axis(2, number % 9 == 0));
    }
    make_seeds();
  }

  std::mt19937_64 rng;
  unsigned kind;
  Grid grid = Grid(1, 1, 2);
  std::vector<Spot> seeds;

 private:
  std::int64_t below(std::int64_t end) {
    return static_cast<std::int64_t>(rng() % static_cast<std::uint64_t>(end));
  }

  void make_seeds() {
    const Spot size = {grid.width() * parts, grid.height() * parts, grid.depth() * parts};
    const auto voxels = static_cast<std::int64_t>(grid.pixels());
    const std::int64_t most = kind == 0 ? 10 : std::min<std::int64_t>(1500, 2 + voxels / (1 + below(30)));
    const std::int64_t step = parts * (1 + below(5)), grain = 1 + below(3 * parts);
    const auto along = static_cast<std::size_t>(below(3));
    seeds.resize(static_cast<std::size_t>(below(most) + (kind == 0 ? 0 : 1)));
    for (Spot& seed : seeds) {
      for (std::size_t axis = 0; axis < 3; ++axis) {
        std::int64_t& at = seed[axis];
        at = below(size[axis]);
        if (kind == 1) at = at / (parts / 2) * (parts / 2);                           // half voxels
        if (kind == 2) at = at / step * step;                                         // a lattice
        if (kind == 3) at = std::min(size[axis] - 1, size[axis] / 2 + below(grain));  // a crowd
        if (kind == 4 && axis == 2) at = size[axis] / 3;                              // in a plane
        if (kind == 5 && axis != along) at = size[axis] / 2;                          // on a line
        if (kind == 6) at = at / (parts / 4) * (parts / 4);                           // quarters
        if (grid.depth() == 1 && axis == 2) at = parts / 2;
      }
    }
    if (kind == 7) {  // repeats, and near ties
      for (std::size_t i = 0; i < seeds.size(); ++i) {
        seeds[i] = seeds[static_cast<std::size_t>(below(static_cast<std::int64_t>(i) + 1))];
        if (below(2) == 0)
          seeds[i][0] = std::max<std::int64_t>(0, std::min(size[0] - 1, seeds[i][0] + below(3) - 1));
      }
    }
    if (kind == 8) {  // a sphere: nearly all win around its middle
      for (Spot& seed : seeds) {
        const double u = 2 * (static_cast<double>(rng() >> 11) * 0x1p-53) - 1,
                     angle = 6.2831853 * (static_cast<double>(rng() >> 11) * 0x1p-53),
                     flat = std::sqrt(1 - u * u);
        const std::array<double, 3> at = {flat * std::cos(angle), flat * std::sin(angle), u};
        for (std::size_t axis = 0; axis < 3; ++axis)
          seed[axis] = static_cast<std::int64_t>(static_cast<double>(size[axis]) * (0.5 + 0.45 * at[axis]));
        if (grid.depth() == 1) seed[2] = parts / 2;
      }
    }
  }
};

}  // namespace

BOOST_AUTO_TEST_CASE(labels_are_those_of_the_points_and_of_their_weights) {
  const Device short_list_device = with_lists(test_device(), ListLength::two_entries);
  const bool in_groups = test_device().tuning().shape == Shape::group;  // which take longer on a CPU
  for (unsigned number = 0; number < (long_tests ? 200000 : in_groups ? 1000 : 4000); ++number) {
    const bool are_weighted = number % 2 == 1;
    const unsigned of_pair = number / 2;
    if (are_weighted && of_pair % 4 == 3) continue;  // no cubes
    RandomCase random(of_pair);
    const Grid& grid = random.grid;
    const std::size_t count = random.seeds.size();
    std::vector<double> weights;
    std::vector<std::int64_t> lags;
    if (are_weighted) {
      const double side = std::cbrt(static_cast<double>(grid.pixels()) / static_cast<double>(count + 1)) + 1;
      weights = hard_weights(count, side, random.rng);
      lags = lags_by_definition(weights, [](std::size_t) { return true; });
    }
    const bool short_lists_too = of_pair % 4 == 1 && of_pair % 5 == 0;
    const Labels labels =
        labels_of(short_lists_too ? short_list_device : test_device(), grid, random.seeds, weights);
    std::size_t wrong = 0;
    each_voxel(grid, [&](const Spot& voxel, std::size_t i) {
      if (count * labels.size() > 400000 && i % 7 != of_pair % 7) return;
      wrong += labels[i] != label_by_definition(grid, random.seeds, voxel, lags) ? 1 : 0;
    });
    BOOST_TEST(wrong == 0u, "case " << number << ", kind " << random.kind << ": " << size_text(grid) << ", "
                                    << count << " seeds: " << wrong << " wrong");
  }
}

BOOST_AUTO_TEST_CASE(sides_of_thousands_of_voxels_are_right_where_they_are_looked_at) {
  std::mt19937_64 rng(3);
  const auto below = [&](std::int64_t end) {
    return static_cast<std::int64_t>(rng() % static_cast<std::uint64_t>(end));
  };
  for (const Grid& grid : {Grid(16384, 9, 2), Grid(3, 8192, 7, Axes::y), Grid(5, 3, 16000),
                           Grid(Axis(1000).spaced(16), Axis(70).spaced(3), Axis(4).spaced(7))}) {
    for (const std::size_t count : {2u, 60u, 5000u}) {
      std::vector<Spot> seeds(count);
      for (Spot& seed : seeds)
        seed = {below(grid.width() * parts), below(grid.height() * parts), below(grid.depth() * parts)};
      const Labels labels = labels_of(test_device(), grid, seeds);
      std::size_t wrong = 0;
      for (int i = 0; i < 1000; ++i) {
        const Spot voxel = {below(grid.width()), below(grid.height()), below(grid.depth())};
        const auto at =
            static_cast<std::size_t>((voxel[2] * grid.height() + voxel[1]) * grid.width() + voxel[0]);
        wrong += labels[at] != label_by_definition(grid, seeds, voxel) ? 1 : 0;
      }
      BOOST_TEST(wrong == 0u, size_text(grid) << ", " << count << " seeds");
    }
  }
}

BOOST_AUTO_TEST_CASE(labels_of_stamps_go_past_the_caches_where_they_are_many) {
  std::mt19937_64 rng(6);
  const auto below = [&](std::int64_t end) {
    return static_cast<std::int64_t>(rng() % static_cast<std::uint64_t>(end));
  };
  const Grid grid(176, 161, 152);
  std::vector<Spot> seeds(300000);
  for (Spot& seed : seeds)
    seed = {below(grid.width() * parts), below(grid.height() * parts), below(grid.depth() * parts)};
  const Labels labels = labels_of(test_device(), grid, seeds);
  std::size_t wrong = 0;
  for (int i = 0; i < 300; ++i) {
    const auto at = static_cast<std::size_t>(below(static_cast<std::int64_t>(grid.pixels())));
    const auto number = static_cast<std::int64_t>(at);
    const Spot voxel = {number % grid.width(), number / grid.width() % grid.height(),
                        number / grid.width() / grid.height()};
    wrong += labels[at] != label_by_definition(grid, seeds, voxel) ? 1 : 0;
  }
  BOOST_TEST(wrong == 0u);
}

BOOST_AUTO_TEST_CASE(crowds_have_no_wrong_voxel) {
  std::mt19937_64 rng(4);
  const auto below = [&](std::int64_t end) {
    return static_cast<std::int64_t>(rng() % static_cast<std::uint64_t>(end));
  };
  enum Kind : std::size_t { along_x, along_y, along_z, in_one_voxel, at_one_point, in_a_plane, on_a_sphere };
  for (const Grid& grid : {Grid(40, 35, 66), Grid(40, 35, 66, Axes::xz)}) {
    for (const Kind kind : {along_x, along_y, along_z, in_one_voxel, at_one_point, in_a_plane, on_a_sphere}) {
      // Of a surface so many that they are too many for the lists of most boxes.
      std::vector<Spot> seeds(kind < in_a_plane ? 6000 : 60000);
      for (Spot& seed : seeds) {
        seed = {20 * parts + 5, 17 * parts + 1000, 30 * parts + 77};
        if (kind <= along_z) seed[kind] = below(35 * parts);
        if (kind == in_one_voxel)
          seed = {seed[0] + below(parts), seed[1] + below(parts), seed[2] + below(parts)};
        if (kind == in_a_plane) seed = {below(40 * parts), below(35 * parts), seed[2]};
        if (kind == on_a_sphere) {
          const double height = static_cast<double>(below(parts)) / parts * 2 - 1;
          const double angle = static_cast<double>(below(parts)) / parts * 2 * std::acos(-1.0);
          const double flat = 15 * parts * std::sqrt(1 - height * height);
          seed = {seed[0] + std::llround(flat * std::cos(angle)),
                  seed[1] + std::llround(flat * std::sin(angle)),
                  seed[2] + std::llround(15 * parts * height)};
        }
      }
      const Labels labels = labels_of(test_device(), grid, seeds);
      std::size_t wrong = 0;
      each_voxel(grid, [&](const Spot& voxel, std::size_t i) {
        if (i % (kind < in_a_plane ? 97 : 499) != 0) return;
        wrong += labels[i] != label_by_definition(grid, seeds, voxel) ? 1 : 0;
      });
      BOOST_TEST(wrong == 0u, size_text(grid) << ", kind " << kind);
      if (kind == at_one_point) {
        BOOST_TEST(std::count(labels.begin(), labels.end(), 0u) ==
                   static_cast<std::ptrdiff_t>(grid.pixels()));
      }
    }
  }
}

namespace {

/// A cell by its definition: along periodic axes its voxels lie the shorter way round from the seed.
struct HostCell {
  std::uint32_t area = 0;
  std::array<std::int64_t, 3> sums = {}, first = {INT32_MAX, INT32_MAX, INT32_MAX},
                              last = {INT32_MIN, INT32_MIN, INT32_MIN};
  Wide farthest = -1;
};

/// Where a voxel lies, seen from a seed.
std::int64_t placed(const Axis& axis, std::int64_t seed, std::int64_t voxel) {
  if (!axis.is_periodic()) return voxel;
  const std::int64_t period = axis.pixels() * parts;
  std::int64_t way = voxel * parts + parts / 2 - seed;
  while (2 * way > period) way -= period;
  while (2 * way <= -period) way += period;
  return (seed + way - parts / 2) / parts;
}

}  // namespace

BOOST_AUTO_TEST_CASE(measures_take_the_points_themselves) {
  std::mt19937_64 rng(5);
  for (const Grid& grid : {Grid(50, 41, 30), Grid(70, 33, 40, Axes::xyz),
                           Grid(Axis(40).spaced(2).periodic(), Axis(30), Axis(20).spaced(3).periodic())}) {
    std::vector<Spot> seeds(90);
    for (Spot& seed : seeds) {
      for (std::size_t axis = 0; axis < 3; ++axis)
        seed[axis] = static_cast<std::int64_t>(
            rng() % static_cast<std::uint64_t>(axes_of(grid)[axis].pixels() * parts));
    }
    const Seeds points(test_device(), grid, points_at(seeds));
    Diagram exact(test_device(), grid), flooded(test_device(), grid);
    BOOST_TEST(!exact_diagram(points, exact).snapped());
    BOOST_TEST(jump_flooding(points, flooded).snapped());
    const Labels labels = exact.read(), approximate = flooded.read();
    const auto at = points.read_pixels();
    BOOST_TEST((at[7]->x == points_at(seeds)[7].x && at[7]->z == points_at(seeds)[7].z));

    Field<float> field;
    distance_field(exact, field);
    const std::vector<float> distances = field.read();
    std::vector<HostCell> cells(seeds.size());
    std::size_t wrong_distances = 0, wrong_labels = 0;
    each_voxel(grid, [&](const Spot& voxel, std::size_t i) {
      const Spot& seed = seeds[labels[i]];
      const Wide squared = squared_distance(grid, seed, voxel);
      const double distance = std::sqrt(static_cast<double>(squared)) / parts;
      wrong_distances +=
          std::abs(static_cast<double>(distances[i]) - distance) > 1e-6 * (1 + distance) ? 1 : 0;
      wrong_labels += squared_distance(grid, seeds[approximate[i]], voxel) > squared ? 1 : 0;
      HostCell& cell = cells[labels[i]];
      ++cell.area;
      cell.farthest = std::max(cell.farthest, squared);
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const std::int64_t along = placed(axes_of(grid)[axis], seed[axis], voxel[axis]);
        cell.sums[axis] += along;
        cell.first[axis] = std::min(cell.first[axis], along);
        cell.last[axis] = std::max(cell.last[axis], along);
      }
    });
    BOOST_TEST(wrong_distances == 0u);
    DistanceErrorsResult errors;
    distance_errors(flooded, exact, errors);
    BOOST_TEST(errors.read().wrong_pixels == wrong_labels);

    CellSumsResult sums;
    CellShapesResult shapes;
    cell_sums(exact, sums);
    cell_shapes(exact, shapes);
    const auto sums_read = sums.read();
    const auto shapes_read = shapes.read();
    for (std::size_t id = 0; id < seeds.size(); ++id) {
      const HostCell& cell = cells[id];
      BOOST_TEST(sums_read[id].area == cell.area);
      if (cell.area == 0) continue;
      BOOST_TEST((sums_read[id].sum_x == cell.sums[0] && sums_read[id].sum_y == cell.sums[1] &&
                  sums_read[id].sum_z == cell.sums[2]),
                 "sums of cell " << id);
      const CellShape& shape = shapes_read[id];
      BOOST_TEST((shape.left == cell.first[0] && shape.right == cell.last[0] && shape.top == cell.first[1] &&
                  shape.bottom == cell.last[1] && shape.front == cell.first[2] && shape.back == cell.last[2]),
                 "the box of cell " << id);
      const double farthest = static_cast<double>(cell.farthest) / parts / parts;
      BOOST_TEST(std::abs(shape.largest_distance - farthest) < 1e-9 * (1 + farthest));
    }
  }
}
