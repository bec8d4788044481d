// Volumes: exact labels without a wrong voxel, tie rule included, on any input; jump flooding, which is
// judged by them; measures; and what refuses volumes.
#define BOOST_TEST_MODULE volumes
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <optional>
#include <random>

#include "brute_force.hpp"
#include "fixture.hpp"
#include "list_length.hpp"
#include "reference_flood.hpp"
#include "runtime/pixel_grid.hpp"

using namespace vorocl;

namespace {

const bool long_tests = std::getenv("VOROCL_LONG_TESTS") != nullptr;

/// At the centres of voxels, as points snapped to them or as points themselves.
Seeds seeds_at(const Device& device, const Grid& grid, const std::vector<Pixel>& voxels,
               Snap snap = Snap::to_pixels) {
  const double aside = snap == Snap::to_pixels ? 0.25 : 0;
  const auto points = transformed(centres(voxels), [=](const Point& at) {
    return Point{at.x, at.y - aside, at.z + aside};
  });
  return {device, grid, points, {Outside::count, snap}};
}

Device with_tuning(int vector_width, std::size_t group) {
  Tuning tuning = test_device().tuning();
  tuning.vector_width = vector_width;
  tuning.group_width = group;
  tuning.group_height = 1;
  return test_device().with_tuning(tuning);
}

/// In turn of snapped points and of points that are at the centres themselves.
Labels exact_labels(const Grid& grid, const std::vector<Pixel>& voxels,
                    const Device& device = test_device()) {
  static int calls = 0;
  Diagram diagram(device, grid);
  exact_diagram(seeds_at(device, grid, voxels, ++calls % 2 == 0 ? Snap::none : Snap::to_pixels), diagram);
  return diagram.read();
}

/// These axes of a grid, made periodic.
Grid periodic(const Grid& grid, bool x, bool y, bool z) {
  return {x ? grid.x().periodic() : grid.x(), y ? grid.y().periodic() : grid.y(),
          z ? grid.z().periodic() : grid.z()};
}

Grid spaced(const Grid& grid, std::int64_t x, std::int64_t y, std::int64_t z) {
  const auto along = [](const Axis& axis, std::int64_t spacing) {
    return axis.spaced(static_cast<int>(spacing));
  };
  return {along(grid.x(), x), along(grid.y(), y), along(grid.z(), z)};
}

/// As brute_force() does, axis by axis: each voxel takes the best of its line's, of which there is one for
/// each line of the axes before.
Labels line_by_line(const Grid& grid, const std::vector<Pixel>& seeds) {
  Labels labels(grid.pixels(), no_label);
  for (std::size_t id = seeds.size(); id-- > 0;) {
    labels[index_of(grid, seeds[id])] = static_cast<std::uint32_t>(id);
  }
  const DistanceIn distance(grid, Metric::euclidean);
  const Pixel sides = {grid.width(), grid.height(), grid.depth()};
  for (const auto along : {&Pixel::x, &Pixel::y, &Pixel::z}) {
    const Labels before = labels;
    for (std::size_t i = 0; i < labels.size(); ++i) {
      const Pixel at = pixel_at(grid, i);
      std::int64_t least = INT64_MAX;
      Pixel other = at;
      // The first one stays: axes come in the order of the rule.
      for (other.*along = 0; other.*along < sides.*along; ++(other.*along)) {
        const std::uint32_t id = before[index_of(grid, other)];
        if (id == no_label) continue;
        const std::int64_t d = distance(at, seeds[id]);
        if (d >= least) continue;
        least = d;
        labels[i] = id;
      }
    }
  }
  return labels;
}

/// At most so many: a modulus of 0 is none.
class Random {
 public:
  explicit Random(unsigned seed) : rng_(seed) {}
  int below(std::int64_t end) { return static_cast<int>(rng_() % static_cast<std::uint64_t>(end)); }
  Pixel in(const Grid& grid) { return {below(grid.width()), below(grid.height()), below(grid.depth())}; }
  std::vector<Pixel> in(const Grid& grid, std::size_t count) {
    std::vector<Pixel> voxels(count);
    for (Pixel& voxel : voxels) voxel = in(grid);
    return voxels;
  }

 private:
  std::mt19937_64 rng_;
};

Pixel on_a_sphere(const Point& middle, double radius, Random& random) {
  const double u = random.below(100000) / 5e4 - 1, angle = random.below(100000) * 6.2831853e-5;
  const double flat = radius * std::sqrt(1 - u * u);
  return pixels_of(
             {{middle.x + flat * std::cos(angle), middle.y + flat * std::sin(angle), middle.z + radius * u}})
      .front();
}

/// Sets that starve some of the volume and flood the rest.
std::vector<Case> hurtful_cases(const Grid& grid) {
  const int w = static_cast<int>(grid.width()), h = static_cast<int>(grid.height()),
            d = static_cast<int>(grid.depth());
  Random random(3);
  std::vector<Pixel> plane, line, diagonal, sphere, corner, stacked, lattice, full, half, walls, slab, fading;
  for (int i = 0; i < 3000; ++i) {
    plane.push_back({random.below(w), random.below(h), d / 3});
    corner.push_back({random.below(w / 4 + 1), random.below(h / 4 + 1), random.below(d / 4 + 1)});
    stacked.push_back({w / 2, h / 2, d / 2});
    sphere.push_back(on_a_sphere({w / 2.0, h / 2.0, d / 2.0}, 0.45 * std::min({w, h, d}), random));
    walls.push_back({i % 2 == 0 ? 0 : w - 1, random.below(h), random.below(d)});
    slab.push_back({random.below(w), random.below(h), random.below(std::min(d, 4))});
  }
  for (int x = 0; x < w; ++x) line.push_back({x, h / 2, d - 1});
  for (int i = 0; i < std::min({w, h, d}); ++i) diagonal.push_back({i, i, i});
  for (int z = 0; z < d; ++z) {
    for (int y = 0; y < h; ++y) {
      for (int x = 0; x < w; ++x) {
        if (x % 8 == 0 && y % 8 == 0 && z % 8 == 0) lattice.push_back({x, y, z});
        if (x < w / 2) half.push_back({x, y, z});
        if (random.below(1000) < 500 * std::exp(-x / 10.0)) fading.push_back({x, y, z});
        full.push_back({x, y, z});
      }
    }
  }
  const Pixel middle = {w / 2, h / 2, d / 2}, last = {w - 1, h - 1, d - 1};
  return {{"no seed", grid, {}},
          {"one seed", grid, {middle}},
          {"two ends", grid, {last, {0, 0, 0}}},
          {"plane", grid, plane},
          {"line", grid, line},
          {"diagonal", grid, diagonal},
          {"sphere", grid, sphere},
          {"corner", grid, corner},
          {"one voxel", grid, stacked},
          {"lattice", grid, lattice},
          {"full", grid, full},
          {"half full", grid, half},
          {"two walls", grid, walls},
          {"slab", grid, slab},
          {"fading", grid, fading},
          {"few", grid, random.in(grid, 9)},
          {"some", grid, random.in(grid, grid.pixels() / 500 + 1)},
          {"many", grid, random.in(grid, grid.pixels() / 60 + 1)},
          {"dense", grid, random.in(grid, grid.pixels() / 9 + 1)}};
}

void check_exact(const Case& c, const Labels& expected, const Device& device, const char* how) {
  BOOST_TEST_CONTEXT(c.name << " in " << c.grid.width() << " x " << c.grid.height() << " x " << c.grid.depth()
                            << ", " << how) {
    BOOST_TEST(count_differences(exact_labels(c.grid, c.seeds, device), expected) == 0);
  }
}

/// The labels of some voxels against every seed.
void check_some(const Labels& labels, const Grid& grid, const std::vector<Pixel>& seeds,
                const std::vector<Pixel>& voxels) {
  const DistanceIn distance(grid, Metric::euclidean);
  for (const Pixel& voxel : voxels) {
    std::int64_t least = INT64_MAX;
    std::size_t nearest = 0;
    for (std::size_t id = 0; id < seeds.size(); ++id) {
      const std::int64_t d = distance(voxel, seeds[id]);
      if (d > least || (d == least && !(seeds[id] < seeds[nearest]))) continue;
      least = d;
      nearest = id;
    }
    BOOST_TEST_REQUIRE(labels[index_of(grid, voxel)] == nearest);
  }
}

}  // namespace

BOOST_AUTO_TEST_CASE(the_two_oracles_agree) {
  std::vector<Case> cases = hurtful_cases(Grid(20, 12, 9));
  for (const Case& c : hurtful_cases(periodic(Grid(13, 12, 3), true, false, true))) cases.push_back(c);
  for (const Case& c : cases) {
    BOOST_TEST(count_differences(line_by_line(c.grid, c.seeds),
                                 brute_force(c.grid, c.seeds, Metric::euclidean)) == 0,
               c.name);
  }
}

BOOST_AUTO_TEST_CASE(sets_made_to_hurt_have_no_wrong_voxel) {
  const Device short_list_device = with_lists(test_device(), ListLength::two_entries);
  for (const Grid& grid :
       {Grid(70, 44, 37), Grid(33, 65, 16), Grid(1, 40, 90), Grid(200, 3, 2), Grid(5, 1, 7),
        periodic(Grid(44, 33, 20), true, true, true), periodic(Grid(1, 3, 64), true, true, true)}) {
    for (const Case& c : hurtful_cases(grid)) {
      const Labels expected = line_by_line(c.grid, c.seeds);
      check_exact(c, expected, test_device(), "full lists");
      check_exact(c, expected, short_list_device, "short lists");
    }
  }
}

namespace {

/// Labels seeds in a part of a volume, of which all orders of magnitude come alike.
void check_random_seeds(int number, const Grid& grid, const Grid& part, Random& random) {
  const double magnitude = std::log(static_cast<double>(part.pixels()) + 1);
  const auto count = static_cast<std::size_t>(std::exp(magnitude * random.below(1001) / 1000.0) - 0.99);
  const std::vector<Pixel> seeds = random.in(part, count);
  const std::size_t wrong = count_differences(exact_labels(grid, seeds), line_by_line(grid, seeds));
  BOOST_TEST_REQUIRE(wrong == 0, "volume " << number << ", " << size_text(grid) << " with " << count
                                           << " seeds: " << wrong << " wrong voxels");
}

}  // namespace

BOOST_AUTO_TEST_CASE(small_volumes_have_no_wrong_voxel) {
  Random random(1);
  for (int i = 0; i < (long_tests ? 100000 : 2000); ++i) {
    const int most = i % 16 == 0 ? 72 : 24;
    const Grid open(1 + random.below(most), 1 + random.below(most), 2 + random.below(most));
    // There is a program for each choice, and the long tests have one choice more.
    const bool along_y = i % 2 == 0, along_others = i % 3 == 2 && (along_y || long_tests);
    const Grid grid = periodic(open, along_others, along_y, along_others);
    // In a part of the volume, so that some of it is empty.
    const Grid part(1 + random.below(grid.width()), 1 + random.below(grid.height()),
                    1 + random.below(grid.depth()));
    check_random_seeds(i, grid, part, random);
  }
}

/// Where seeds are dense, voxels near an end see the seeds at the other one, in another order than the tie
/// rule's; within a short period more than once.
BOOST_AUTO_TEST_CASE(dense_seeds_round_the_ends_have_no_wrong_voxel) {
  Random random(29);
  for (const Grid& grid :
       {periodic(Grid(40, 37, 50), true, true, true), periodic(Grid(4, 32, 33), true, true, true),
        periodic(Grid(70, 33, 40), false, true, false), periodic(Grid(10, 32, 33), true, false, false),
        periodic(Grid(32, 33, 11), false, false, true)}) {
    for (const std::uint64_t voxels_per_seed : {2u, 6u, 14u, 30u, 80u}) {
      const std::vector<Pixel> seeds = random.in(grid, grid.pixels() / voxels_per_seed);
      const std::size_t wrong = count_differences(exact_labels(grid, seeds), line_by_line(grid, seeds));
      BOOST_TEST(wrong == 0u, size_text(grid) << ", a seed for " << voxels_per_seed << " voxels");
    }
  }
}

/// Of these spacings two leave room for passes where seeds are dense: for both reaches and for the shorter
/// one. Two leave room for none: a microscope's, and the longest, with which the long tests go on.
BOOST_AUTO_TEST_CASE(spaced_volumes_have_no_wrong_voxel) {
  Random random(21);
  const Device short_list_device = with_lists(test_device(), ListLength::two_entries);
  for (const auto& spacing : {Pixel{3, 3, 4}, Pixel{2, 1, 4}, Pixel{13, 13, 40}, Pixel{62, 63, 64}}) {
    if (spacing.z == 64 && !long_tests) continue;
    const auto grid_of = [&](std::int64_t width, std::int64_t height, std::int64_t depth) {
      const bool ends_meet = spacing.y == 1;
      const Grid grid = periodic(Grid(width, height, depth), ends_meet, ends_meet, ends_meet);
      return spaced(grid, spacing.x, spacing.y, spacing.z);
    };
    for (const Grid& grid : {grid_of(70, 44, 37), grid_of(90, 70, 1), grid_of(500, 3, 2)}) {
      for (const Case& c : hurtful_cases(grid)) {
        const Labels expected = line_by_line(c.grid, c.seeds);
        check_exact(c, expected, test_device(), "spaced, full lists");
        if (spacing.x == 3) check_exact(c, expected, short_list_device, "spaced, short lists");
      }
    }
    for (int i = 0; i < (long_tests ? 20000 : 300); ++i) {
      const Grid grid = grid_of(1 + random.below(40), 1 + random.below(40), 1 + random.below(24));
      check_random_seeds(i, grid, grid, random);
    }
  }
}

/// A side has at most 16,384 units.
BOOST_AUTO_TEST_CASE(the_longest_spaced_volumes_are_right) {
  Random random(23);
  const Grid grid = spaced(Grid(1024, 64, 2), 16, 3, 7);
  for (const std::size_t count : {3u, 300u}) {
    const std::vector<Pixel> seeds = random.in(grid, count);
    check_some(exact_labels(grid, seeds), grid, seeds, random.in(grid, 2000));
  }
}

BOOST_AUTO_TEST_CASE(long_volumes_pack_positions_in_their_own_way) {
  const Grid grid(3, 5, 2100);
  Random random(5);
  for (const std::size_t count : {1u, 30u, 3000u}) {
    const std::vector<Pixel> seeds = random.in(grid, count);
    BOOST_TEST(count_differences(exact_labels(grid, seeds), line_by_line(grid, seeds)) == 0);
  }
}

BOOST_AUTO_TEST_CASE(a_large_volume_is_right_where_it_is_looked_at) {
  Random random(7);
  for (const std::size_t count : {100u, 4096u, 40000u, 300000u}) {
    const bool some_periodic = count == 100 || count == 300000;
    const Grid grid = periodic(Grid(256, 250, 256), some_periodic, some_periodic, some_periodic);
    const std::vector<Pixel> seeds = random.in(grid, count);
    check_some(exact_labels(grid, seeds), grid, seeds, random.in(grid, long_tests ? 5000 : 100));
  }
}

/// Then most voxels are nearest to images in other periods, of seeds that are far inside the volume.
BOOST_AUTO_TEST_CASE(seeds_in_a_corner_reach_round_all_ends) {
  Random random(15);
  for (const Grid& open : {Grid(150, 97, 130), Grid(64, 200, 71)}) {
    const Grid grid = periodic(open, true, true, true);
    for (const int corner : {0, 1}) {
      std::vector<Pixel> seeds = random.in(Grid(9, 9, 9), 4);
      for (Pixel& seed : seeds) {
        seed.x += corner * (grid.width() - 9);
        seed.z += corner * (grid.depth() - 9);
      }
      check_some(exact_labels(grid, seeds), grid, seeds, random.in(grid, 20000));
    }
  }
}

/// Nearly all seeds are candidates next to the middle of a sphere: more than a full list holds.
BOOST_AUTO_TEST_CASE(the_middle_of_a_sphere_is_right) {
  const Grid grid(256, 256, 256);
  Random random(9);
  for (const int middle : {128, 130}) {  // between parts of boxes, and within one
    std::vector<Pixel> seeds(32768);
    for (Pixel& seed : seeds) seed = on_a_sphere({middle + 0.0, middle + 0.0, middle + 0.0}, 115, random);
    std::vector<Pixel> voxels = random.in(Grid(24, 24, 24), long_tests ? 5000 : 300);
    for (Pixel& voxel : voxels) voxel = {voxel.x + middle - 12, voxel.y + middle - 12, voxel.z + middle - 12};
    check_some(exact_labels(grid, seeds), grid, seeds, voxels);
  }
}

BOOST_AUTO_TEST_CASE(absent_seeds_have_no_voxel) {
  const Grid grid(20, 10, 6);
  const double xyz[] = {2.5, 2.5, 2.5, 11, 3, 4, 17.5, 9.5, 5.5, 90, 3, 4};
  const std::uint8_t present[] = {1, 0, 1, 1};
  const Points points = Points(xyz, xyz + 1, xyz + 2, 4, 3 * sizeof(double)).marked(present);
  const Seeds seeds(test_device(), grid, points, {Outside::absent, Snap::to_pixels});
  BOOST_TEST(seeds.size() == 4u);
  BOOST_TEST(seeds.alive() == 2u);
  const auto voxels = seeds.read_pixels();
  BOOST_TEST((!voxels[1] && !voxels[3]));
  BOOST_TEST((voxels[2]->x == 17.5 && voxels[2]->y == 9.5 && voxels[2]->z == 5.5));
  Labels expected = brute_force(grid, {{2, 2, 2}, {17, 9, 5}}, Metric::euclidean);
  for (std::uint32_t& label : expected) label = label == 1 ? 2 : label;
  Diagram diagram(test_device(), grid);
  for (const Method& method : methods()) {
    if (!method.volumes) continue;
    method.run(seeds, diagram, {});
    BOOST_TEST(count_differences(diagram.read(), expected) == 0, method.name);
  }
}

BOOST_AUTO_TEST_CASE(points_lie_in_the_voxel_of_their_axes) {
  const Grid grid(Axis(8, -4, 4), Axis(4, 0, 1).reversed(), Axis(2, 10, 12).closed());
  const Seeds seeds(test_device(), grid, std::vector<Point>{{-4, 0, 10}, {3.9, 0.99, 12}}, to_centres);
  const auto voxels = seeds.read_pixels();
  BOOST_TEST((voxels[0]->x == 0.5 && voxels[0]->y == 3.5 && voxels[0]->z == 0.5));
  BOOST_TEST((voxels[1]->x == 7.5 && voxels[1]->y == 0.5 && voxels[1]->z == 1.5));
}

BOOST_AUTO_TEST_CASE(seeds_say_how_far_they_went) {
  const Grid grid(20, 30, 40);
  Seeds seeds(test_device(), grid, std::vector<Point>{{1, 2, 3}, {10, 20, 30}, {5, 5, 5}}, to_centres);
  seeds.move_to(std::vector<Point>{{3, 1, 3}, {10, 20, 37.5}, {5, 5, 4}});
  BOOST_TEST(seeds.displacement() == 7);
  seeds.move_to(std::vector<Point>{{3, 12, 3}});
  BOOST_TEST(seeds.displacement() == 11);
  Seeds wrapping(test_device(), periodic(grid, true, false, true),
                 std::vector<Point>{{1, 2, 3}, {10, 20, 30}, {5, 5, 5}}, to_centres);
  wrapping.move_to(std::vector<Point>{{-2, 1, -6}, {10, 22, 30}, {26, 5, 5}});
  BOOST_TEST(wrapping.displacement() == 9);
  Seeds random = Seeds::random(test_device(), grid, 3, 1);
  random.move_to(std::vector<Point>{{1, 2, 3}});
  Diagram diagram(test_device(), grid);
  BOOST_TEST((jump_flooding(random, diagram).snapped() && !jump_flooding(seeds, diagram).snapped()));
  BOOST_TEST(!jump_flooding(Seeds::random(test_device(), grid, 4, 1), diagram).snapped());
  BOOST_TEST((random.read_pixels()[0]->z == 3 && random.read()[0]->z == 3));
}

BOOST_AUTO_TEST_CASE(a_mask_gives_its_voxels_in_the_order_of_the_slices) {
  const Grid grid(5, 4, 3);
  std::vector<std::uint8_t> mask(grid.pixels());
  mask[7] = mask[23] = mask[59] = 1;
  const Seeds seeds = Seeds::from_mask(test_device(), grid, mask);
  const auto voxels = seeds.read_pixels();
  BOOST_TEST_REQUIRE(voxels.size() == 3u);
  for (std::size_t id = 0; id < 3; ++id) {
    BOOST_TEST(mask[index_of(grid, pixels_of({*voxels[id]}).front())] == 1);
  }
  BOOST_TEST(voxels[1]->z == 1.5);
}

BOOST_AUTO_TEST_CASE(random_voxels_are_the_same_for_all_widths_and_fill_the_volume) {
  const Grid grid(40, 30, 20);
  const auto expected = Seeds::random(test_device(), grid, 4001, 9).read_pixels();
  double sums[3] = {};
  for (const auto& voxel : expected) sums[0] += voxel->x, sums[1] += voxel->y, sums[2] += voxel->z;
  for (int axis = 0; axis < 3; ++axis) {  // the middle, within five standard errors
    const double side = axis == 0 ? 40 : axis == 1 ? 30 : 20;
    BOOST_TEST(std::abs(sums[axis] / 4001 - side / 2) < 5 * side / std::sqrt(12.0 * 4001));
  }
  for (const int width : {1, 8}) {
    const auto voxels = Seeds::random(with_tuning(width, 4), grid, 4001, 9).read_pixels();
    for (std::size_t id = 0; id < voxels.size(); ++id) {
      BOOST_TEST_REQUIRE((voxels[id]->x == expected[id]->x && voxels[id]->y == expected[id]->y &&
                          voxels[id]->z == expected[id]->z));
    }
  }
}

BOOST_AUTO_TEST_CASE(jump_flooding_runs_its_waves_in_volumes) {
  Random random(17);
  for (const Grid& grid : {Grid(37, 20, 11), Grid(6, 3, 50), periodic(Grid(21, 3, 14), true, true, true)}) {
    for (const std::size_t count : {1u, 7u, 300u}) {
      const std::vector<Pixel> voxels = random.in(grid, count);
      for (const Metric metric : {Metric::euclidean, Metric::manhattan}) {
        for (const Neighbourhood neighbourhood : {Neighbourhood::moore, Neighbourhood::von_neumann}) {
          const JumpFloodingOptions options = {metric, neighbourhood, JumpFloodingVariant::jfa_plus_1};
          const Plan plan = jump_flooding_plan(grid, options.variant, neighbourhood);
          const Labels expected = reference_flood(grid, voxels, plan, metric);
          for (const int width : {1, 8, 16}) {
            const Device device = with_tuning(width, 8);
            Diagram diagram(device, grid);
            const Report report = jump_flooding(seeds_at(device, grid, voxels), diagram, options);
            BOOST_TEST(report.waves() == static_cast<int>(plan.size()));
            BOOST_TEST(count_differences(diagram.read(), expected) == 0);
          }
        }
      }
    }
  }
}

BOOST_AUTO_TEST_CASE(a_volume_of_one_slice_is_a_plane) {
  BOOST_TEST((!Grid(8, 4, 1).is_volume() && !spaced(Grid(8, 4), 1, 2, 1).is_volume()));
  BOOST_TEST((Grid(8, 4, 1) == Grid(8, 4)));
  BOOST_TEST((Grid(8, 4, 2) != Grid(8, 4)));
  BOOST_TEST((Grid(8, 4, 2).pixels() == 64 && Window(Grid(8, 4, 2)).pixels() == 64));
}

BOOST_AUTO_TEST_CASE(what_volumes_cannot_be_is_refused) {
  const Device& device = test_device();
  const std::string too_large = "is too large: its sides can have 16384 voxels";
  check_error([&] { Diagram(device, Grid(2049, 1024, 1024)); }, {too_large});
  check_error([&] { Diagram(device, Grid(16385, 2, 2)); }, {too_large});
  check_error([&] { Seeds::random(device, Grid(4096, 4096, 4096), 1, 1); }, {too_large});
  check_error([&] { Diagram(device, periodic(Grid(2, 2, 8193), false, false, true)); },
              {"8193 voxels, periodic in z is too large"});
  check_error([&] { Diagram(device, periodic(Grid(2048, 1024, 512), true, true, false)); },
              {"periodic in x and y " + too_large});
  check_error(
      [&] { Diagram(device, spaced(Grid(3, 3, 2000), 1, 1, 9)); },
      {"3 x 3 x 2000 voxels spaced 1 x 1 x 9 is too large: its sides can have 16384 units of the spacing"});
  check_error([&] { Diagram(device, spaced(periodic(Grid(3, 3, 1025), false, false, true), 1, 1, 8)); },
              {"a periodic side can have 8192 units"});
  for (const int spacing : {0, 65})
    check_error([&] { (void)Axis(3).spaced(spacing); }, {"it must be from 1 to 64"});
  const Grid grid(8, 8, 8);
  check_error([&] { Diagram(device, Window(grid, 0, 0, 4, 4)); }, {"a window of a part cannot take"});
  check_error([&] { Diagram(device, Window(grid, 0, 0, 1, 8, 8, 7)); }, {"a window of a part cannot take"});
  check_error([&] { Diagram(device, Window(spaced(Grid(8, 8), 1, 2, 1), 0, 0, 4, 8)); },
              {"a window of a part cannot take"});
  check_error([&] { Window(grid, 0, 0, 2, 8, 8, 7); }, {"from z = 2 on; the grid has 8"});
  BOOST_TEST((Window(grid, 0, 0, 0, 8, 8, 8) == Window(grid) && !Window(grid, 0, 0, 0, 8, 8, 7).is_whole()));
  BOOST_TEST((Window(Grid(8, 8, 8, Axes::xz), 0, 0, -1, 8, 8, 8).z() == 7));
  const double one = 1;
  check_error([&] { Seeds(device, grid, Points(&one, &one, 1), to_centres); }, {"the points have no z"});
  const std::vector<Point> outside = {{1, 2, 3}, {1, 2, 8}}, not_a_number = {{1, 2, NAN}};
  for (const Outside count_or_refuse : {Outside::count, Outside::refuse}) {
    check_error([&] { Seeds(device, grid, outside, {count_or_refuse}); },
                {"8) is outside the grid; x must be in [0, 8), y in [0, 8) and z in [0, 8)"});
  }
  check_error(
      [&] {
        Seeds(device, grid, not_a_number, {Outside::absent, Snap::to_pixels});
      },
      {"is not finite"});
}

BOOST_AUTO_TEST_CASE(points_of_volumes_come_in_buffers) {
  const Grid grid(Axis(8, 0, 4), Axis(6), Axis(4).periodic());
  std::vector<Point> points = {{0.3, 2, 1.5}, {3.9, 5.5, -1}, {1, NAN, 1}};
  std::vector<float> in_floats;
  for (const Point& point : points) {
    for (const double along : {point.x, point.y, point.z}) in_floats.push_back(static_cast<float>(along));
  }
  std::vector<std::uint8_t> present = {1, 1, 0};
  const cl::Context& context = test_device().context();
  const cl::Buffer doubles(context, CL_MEM_COPY_HOST_PTR, sizeof(Point) * 3, points.data()),
      floats(context, CL_MEM_COPY_HOST_PTR, sizeof(float) * 9, in_floats.data()),
      marks(context, CL_MEM_COPY_HOST_PTR, present.size(), present.data());
  const auto expected = Seeds(test_device(), grid, Points(points).marked(present.data())).read_pixels();
  Seeds seeds(test_device(), grid, PointBuffer(floats, 3, PointFormat::floats_xyz, marks));
  for (int frame = 0; frame < 2; ++frame) {
    const auto found = seeds.read_pixels();
    for (std::size_t id = 0; id < 2; ++id) {
      BOOST_TEST((found[id]->x == expected[id]->x && found[id]->y == expected[id]->y &&
                  found[id]->z == expected[id]->z));
    }
    BOOST_TEST((found[1]->z == 3 && !found[2]));
    seeds.move_to(PointBuffer(doubles, 3, PointFormat::doubles_xyz, marks));
  }
  check_error([&] { seeds.move_to(PointBuffer(doubles, 3, PointFormat::doubles_xy)); },
              {"the points have no z"});
  check_error([&] { seeds.move_to(PointBuffer(doubles, 4, PointFormat::doubles_xyz)); },
              {"the buffer of 4 points"});
  seeds.move_to(PointBuffer(doubles, 3, PointFormat::doubles_xyz));
  check_error([&] { seeds.check(); }, {"point 2"});
}

/// A plane is the one slice of its grid: it has the points whose z lies in it, or that have none.
BOOST_AUTO_TEST_CASE(points_of_planes_lie_in_their_slice) {
  const Device& device = test_device();
  const std::vector<Point> points = {{1.25, 2, 5.5}, {6, 3, 7}, {4, 4, 4.99}};
  const Grid slab(Axis(8), Axis(6), Axis(1, 5, 7).closed());
  const Seeds seeds(device, slab, points, {Outside::absent, Snap::to_pixels});
  BOOST_TEST((seeds.alive() == 2u && seeds.read()[0]->z == 5.5 && seeds.read()[1]->z == 7));
  BOOST_TEST((seeds.read_pixels()[1]->z == 0.5 && !seeds.read()[2]));
  for (const Outside count_or_refuse : {Outside::count, Outside::refuse}) {
    check_error(
        [&] {
          Seeds(device, slab, points, {count_or_refuse, Snap::to_pixels});
        },
        {"point 2 (4, 4, 4.99) is outside the grid; x must be in [0, 8), y in [0, 6) "
         "and z in [5, 7]"});
  }
  const std::vector<float> x = {1.25f, 6}, y = {2, 3};
  const Seeds without_z(device, slab, Points(x.data(), y.data(), 2), {Outside::refuse, Snap::none});
  BOOST_TEST((without_z.read()[0]->x == 1.25 && without_z.read()[0]->z == 5 && without_z.read()[1]->y == 3));
  check_error(
      [&] {
        Seeds(device, Grid(8, 6), {{1, 1, 1}}, to_centres);
      },
      {"(1, 1, 1) is outside the grid; x must be in [0, 8), y in [0, 6) and z in [0, "
       "1)"});
  check_error(
      [&] {
        Seeds(device, Grid(8, 6), {{1, 1, NAN}}, {Outside::absent, Snap::to_pixels});
      },
      {"nan) is not finite"});
  PlaneSeeds of_tiles(slab, {Outside::absent, Snap::to_pixels});
  of_tiles.add(points);
  BOOST_TEST(of_tiles.alive() == 2u);
}

BOOST_AUTO_TEST_CASE(seeds_of_another_spacing_are_refused) {
  const Grid grid(7, 5);
  Diagram diagram(test_device(), spaced(grid, 2, 1, 1));
  check_error([&] { jump_flooding(Seeds::random(test_device(), grid, 5, 1), diagram); },
              {"the seeds' grid is 7 x 5, the diagram's 7 x 5 spaced 2 x 1 x 1"});
}

BOOST_AUTO_TEST_CASE(what_knows_planes_alone_refuses_volumes_by_name) {
  const Device& device = test_device();
  const Grid grid(8, 8, 8);
  Seeds seeds = Seeds::random(device, grid, 5, 1);
  Diagram diagram(device, grid);
  const std::string what = "the grid is a volume of 8 x 8 x 8 voxels, which ";
  for (const Method& method : methods()) {
    if (method.volumes) continue;
    check_error([&] { method.run(seeds, diagram, {}); }, {what + "flooding"});
  }
  check_error([&] { exact_diagram(seeds, diagram, {Metric::manhattan}); }, {"are Euclidean"});
  jump_flooding(seeds, diagram);
  VerticesResult corners;
  check_error([&] { vertices(diagram, corners); }, {what + "the vertices of a diagram"});
  check_error([&] { random_step(seeds, 1, Border::reflect, 1, 1); }, {what + "random motion"});
  check_error([&] { Tiling(grid, 4); }, {what + "tiles"});
  check_error([&] { PlaneSeeds{grid}; }, {what + "a plane of tiles"});
}
