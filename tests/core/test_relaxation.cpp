// Lloyd relaxation: energies, motions and where it ends.
#define BOOST_TEST_MODULE relaxation
#include <cmath>

#include "measured_cases.hpp"
#include "read_measures.hpp"
#include "vorocl/cells.hpp"
#include "vorocl/motion.hpp"
#include "vorocl/relaxation.hpp"

using namespace vorocl;

namespace {

Report exactly(const Seeds& seeds, Diagram& diagram) { return exact_diagram(seeds, diagram); }

/// An engine that all shapes of measures share.
Report by_one_engine(const Seeds& seeds, Diagram& diagram) { return fill(seeds, diagram); }

/// The weights of pixels, as whole numbers: empty if all weigh 1.
using Weights = std::vector<std::int64_t>;

std::int64_t weight_at(const Grid& grid, const Weights& weights, const Pixel& pixel) {
  return weights.empty() ? 1 : weights[index_of(grid, pixel)];
}

double energy_on_host(const Grid& grid, const std::vector<std::uint32_t>& labels,
                      const std::vector<Pixel>& seeds, const Weights& weights = {}) {
  const DistanceIn distance(grid, Metric::euclidean);
  std::int64_t sum = 0;
  each_pixel(grid, labels, [&](std::uint32_t label, const Pixel& pixel) {
    sum += weight_at(grid, weights, pixel) * distance(pixel, seeds[label]);
  });
  return static_cast<double>(sum);
}

struct Sums {
  std::int64_t weight = 0, x = 0, y = 0, z = 0;
};

/// Of the pixels of each cell, where they are nearest to its seed.
std::vector<Sums> sums_on_host(const Grid& grid, const std::vector<std::uint32_t>& labels,
                               const std::vector<Pixel>& seeds, const Weights& weights) {
  std::vector<Sums> sums(seeds.size());
  each_pixel(grid, labels, [&](std::uint32_t label, const Pixel& pixel) {
    const Pixel image = nearest_image(grid, pixel, seeds[label]);
    const std::int64_t weight = weight_at(grid, weights, pixel);
    sums[label].weight += weight;
    sums[label].x += weight * image.x;
    sums[label].y += weight * image.y;
    sums[label].z += weight * image.z;
  });
  return sums;
}

/// A round as its definition says it: of all pixels the one nearest to the centroid, the seed's own first.
std::vector<Pixel> round_on_host(const Grid& grid, const std::vector<std::uint32_t>& labels,
                                 std::vector<Pixel> seeds, const Weights& weights = {}) {
  const std::vector<Sums> sums = sums_on_host(grid, labels, seeds, weights);
  const auto nearest = [](std::int64_t weight, std::int64_t sum, std::int64_t present, std::int64_t size) {
    std::int64_t best = present;
    for (std::int64_t at = -size; at < 2 * size; ++at) {
      if (std::abs(at * weight - sum) < std::abs(best * weight - sum)) best = at;
    }
    return best;
  };
  for (std::size_t id = 0; id < seeds.size(); ++id) {
    if (sums[id].weight == 0) continue;
    const Pixel image = {nearest(sums[id].weight, sums[id].x, seeds[id].x, grid.width()),
                         nearest(sums[id].weight, sums[id].y, seeds[id].y, grid.height()),
                         nearest(sums[id].weight, sums[id].z, seeds[id].z, grid.depth())};
    seeds[id] = in_grid(grid, image).value();
  }
  return seeds;
}

bool same(const std::vector<Pixel>& a, const std::vector<Pixel>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](const Pixel& p, const Pixel& q) { return !(p < q) && !(q < p); });
}

}  // namespace

BOOST_AUTO_TEST_CASE(rounds_are_those_of_the_definition) {
  for (const Device& device : shapes()) {
    for (const Case& test : measured_cases(device)) {
      if (test.grid.pixels() > 300000 || !test.labels.empty()) continue;
      std::vector<Pixel> pixels = test.seeds;
      Seeds seeds(device, test.grid, centres(pixels), to_centres);
      Diagram diagram(device, test.grid);
      by_one_engine(seeds, diagram);
      for (int round = 0; round < 2; ++round) {
        const double expected = energy_on_host(test.grid, diagram.read(), pixels);
        const std::vector<Pixel> next = round_on_host(test.grid, diagram.read(), pixels);
        BOOST_TEST(energy(diagram) == expected, test.name);
        const Relaxation relaxation = relax(seeds, diagram, by_one_engine, 1);
        BOOST_TEST(relaxation.energies.front() == expected, test.name);
        BOOST_TEST(relaxation.converged == same(next, pixels), test.name);
        BOOST_TEST(same(pixels_of(points_of(seeds)), next),
                   test.name << ": seeds moved elsewhere than on the host");
        pixels = next;
      }
    }
  }
}

BOOST_AUTO_TEST_CASE(seeds_of_whole_pixels_relax_as_the_points_at_their_centres) {
  const Grid grid(200, 140);
  std::vector<std::uint8_t> mask(grid.pixels(), 0);
  for (std::size_t i = 0; i < mask.size(); i += 271) mask[i] = 1;
  Seeds walked = Seeds::random(test_device(), grid, 90, 4);
  random_step(walked, 3, Border::reflect, 1, 1);
  Seeds random = Seeds::random(test_device(), grid, 90, 4);
  Seeds masked = Seeds::from_mask(test_device(), grid, mask);
  for (Seeds* const seeds : {&random, &walked, &masked}) {
    Seeds points(test_device(), grid, points_of(*seeds), {Outside::count, Snap::none});
    Diagram diagram(test_device(), grid), of_points(test_device(), grid);
    const Relaxation one = relax(*seeds, diagram, exactly, 40), other = relax(points, of_points, exactly, 40);
    BOOST_TEST(!one.converged);  // whole pixels end earlier
    BOOST_TEST(one.energies == other.energies, boost::test_tools::per_element());
    BOOST_TEST(one.moved == other.moved, boost::test_tools::per_element());
    const std::vector<Point> found = points_of(*seeds), expected = points_of(points);
    for (std::size_t id = 0; id < found.size(); ++id)
      BOOST_TEST((found[id].x == expected[id].x && found[id].y == expected[id].y));
  }
  Seeds snapped(test_device(), grid, points_of(Seeds::random(test_device(), grid, 90, 4)), to_centres);
  Diagram diagram(test_device(), grid);
  BOOST_TEST(relax(snapped, diagram, exactly, 40).converged);
}

// --- polygons ---

namespace {

/// The centroid of a cell: of the rectangle around its point that the bisectors with all others clip.
Point centroid_by_clipping(const Grid& grid, const std::vector<Point>& points, std::size_t id) {
  const Point& at = points[id];
  const auto length = [](const Axis& axis) { return axis.to() - axis.from(); };
  const auto ends = [&](const Axis& axis, double middle) {
    const double half = length(axis) / 2;
    return axis.is_periodic() ? std::pair(-half, half) : std::pair(axis.from() - middle, axis.to() - middle);
  };
  const auto [left, right] = ends(grid.x(), at.x);
  const auto [low, high] = ends(grid.y(), at.y);
  std::vector<Point> polygon = {{left, low}, {right, low}, {right, high}, {left, high}};
  for (std::size_t other = 0; other < points.size(); ++other) {
    for (int image = 0; image < 9; ++image) {
      const int along_x = image % 3 - 1, along_y = image / 3 - 1;
      if ((along_x != 0 && !grid.x().is_periodic()) || (along_y != 0 && !grid.y().is_periodic())) continue;
      const Point n = {points[other].x + along_x * length(grid.x()) - at.x,
                       points[other].y + along_y * length(grid.y()) - at.y};
      const auto beyond = [&](const Point& p) { return p.x * n.x + p.y * n.y - (n.x * n.x + n.y * n.y) / 2; };
      std::vector<Point> left_over;
      for (std::size_t i = 0; i < polygon.size(); ++i) {
        const Point &p = polygon[i], &q = polygon[(i + 1) % polygon.size()];
        const double from = beyond(p), to = beyond(q);
        if (from <= 0) left_over.push_back(p);
        if ((from < 0 && to > 0) || (from > 0 && to < 0)) {
          const double part = from / (from - to);
          left_over.push_back({p.x + part * (q.x - p.x), p.y + part * (q.y - p.y)});
        }
      }
      polygon = left_over;
    }
  }
  double area = 0, x = 0, y = 0;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Point &p = polygon[i], &q = polygon[(i + 1) % polygon.size()];
    const double doubled = p.x * q.y - p.y * q.x;
    area += doubled / 2;
    x += doubled * (p.x + q.x) / 6;
    y += doubled * (p.y + q.y) / 6;
  }
  return {at.x + x / area, at.y + y / area};
}

}  // namespace

BOOST_AUTO_TEST_CASE(exact_rounds_go_to_the_centroids_of_polygons) {
  RelaxOptions options;
  options.exact = true;
  for (const bool is_periodic : {false, true}) {
    const Axis x(31, -1, 3), y = Axis(19, 0, 3).reversed();  // few pixels, which are no squares
    const Grid grid(x, is_periodic ? y.periodic() : y);
    std::mt19937 random(5);
    std::uniform_real_distribution<double> uniform(0.01, 2.99);
    std::vector<Point> points;
    for (int i = 0; i < 40; ++i) points.push_back({uniform(random) - 0.5, uniform(random)});
    std::vector<Point> given = points;
    if (is_periodic) given[7].y += 6;
    Seeds seeds(test_device(), grid, given);
    Diagram diagram(test_device(), grid);
    const Relaxation done = relax(seeds, diagram, exactly, 3, {}, options);
    BOOST_TEST(done.moved == std::vector<std::size_t>(3, 40), boost::test_tools::per_element());
    BOOST_TEST(done.energies.back() == energy(diagram));
    for (int round = 0; round < 3; ++round) {
      std::vector<Point> next;
      for (std::size_t id = 0; id < points.size(); ++id) {
        next.push_back(centroid_by_clipping(grid, points, id));
        next.back().y -= 3 * std::floor(next.back().y / 3);
      }
      points = next;
    }
    for (std::size_t id = 0; id < points.size(); ++id) {
      const Point found = points_of(seeds)[id];
      const double above = (points[id].y - found.y) / 3;
      BOOST_TEST(std::abs(found.x - points[id].x) < 1e-7);  // points are rounded to 2^-29 of the longer side
      BOOST_TEST(std::abs(above - (is_periodic ? std::nearbyint(above) : 0)) < 1e-7);
      BOOST_TEST((found.y >= 0 && found.y <= 3));
    }
    BOOST_TEST(relax(seeds, diagram, exactly, 1000, {}, options).converged);
  }
  const Grid ring(Axis(8, 0, 4).periodic(), Axis(2, 0, 1));
  Seeds even(test_device(), ring, {{1, 0.5}, {11, 0.5}});
  Diagram of_ring(test_device(), ring);
  const Relaxation nothing = relax(even, of_ring, exactly, 9, {}, options);
  BOOST_TEST((nothing.converged && nothing.moved.empty()));
  const Grid box(Axis(16, 0, 8), Axis(3, 0, 2), Axis(3, 0, 2));
  Seeds two(test_device(), box, {{1, 0.5, 1}, {2, 0.5, 1}});
  Diagram diagram(test_device(), box);
  relax(two, diagram, exactly, 1, {}, options);
  const std::vector<Point> found = points_of(two);
  BOOST_TEST((found[0].x == 0.75 && found[0].y == 1 && found[0].z == 1));
  BOOST_TEST((found[1].x == 4.75 && found[1].y == 1 && found[1].z == 1));
}

BOOST_AUTO_TEST_CASE(what_exact_rounds_cannot_take_is_refused) {
  const Grid grid(20, 10);
  RelaxOptions options;
  options.exact = true;
  Seeds seeds(test_device(), grid, {{3, 4}, {12, 5}}), snapped(test_device(), grid, {{3, 4}}, to_centres);
  Diagram diagram(test_device(), grid);
  check_error([&] { relax(snapped, diagram, exactly, 1, {}, options); }, {"exact", "snapped to pixels"});
  options.density.assign(grid.pixels(), 1);
  check_error([&] { relax(seeds, diagram, exactly, 1, {}, options); }, {"exact", "no density"});
}

// --- densities ---

namespace {

std::vector<Point> random_points(const Grid& grid, std::size_t count, unsigned rng_seed) {
  std::mt19937 rng(rng_seed);
  const auto along = [&](std::int64_t pixels) {
    return static_cast<double>(pixels) * static_cast<double>(rng()) * 0x1p-32;
  };
  std::vector<Point> points;
  for (std::size_t i = 0; i < count; ++i) {
    const double x = along(grid.width());
    points.push_back({x, along(grid.height())});
  }
  return points;
}

/// Of random values, a part of them 0.
std::vector<float> random_density(const Grid& grid) {
  std::mt19937 rng(11);
  std::vector<float> density(grid.pixels());
  for (float& value : density) value = rng() % 4 == 0 ? 0.0F : static_cast<float>(rng() % 100000) * 0.37F;
  return density;
}

/// The whole numbers that stand for it: of 65535 to the greatest, the nearest.
Weights weights_of(const std::vector<float>& density) {
  const double greatest = *std::max_element(density.begin(), density.end());
  Weights weights;
  for (const double value : density)
    weights.push_back(static_cast<std::int64_t>(std::floor(value / greatest * 65535 + 0.5)));
  return weights;
}

RelaxOptions with_density(std::vector<float> density) {
  RelaxOptions options;
  options.density = std::move(density);
  return options;
}

}  // namespace

BOOST_AUTO_TEST_CASE(weighted_rounds_are_those_of_the_definition) {
  for (const Device& device : shapes()) {
    for (const Case& test : measured_cases(device)) {
      if (test.grid.pixels() > 300000 || !test.labels.empty()) continue;
      const std::vector<float> density = random_density(test.grid);
      const Weights weights = weights_of(density);
      const double unit = *std::max_element(density.begin(), density.end()) / 65535.0;
      if (unit == 0) continue;
      std::vector<Pixel> pixels = test.seeds;
      Seeds seeds(device, test.grid, centres(pixels), to_centres);
      Diagram diagram(device, test.grid);
      by_one_engine(seeds, diagram);
      for (int round = 0; round < 2; ++round) {
        const std::vector<std::uint32_t> labels = diagram.read();
        const double expected = unit * energy_on_host(test.grid, labels, pixels, weights);
        const std::vector<Pixel> next = round_on_host(test.grid, labels, pixels, weights);
        const Relaxation relaxation = relax(seeds, diagram, by_one_engine, 1, {}, with_density(density));
        BOOST_TEST(relaxation.energies.front() == expected, test.name);
        BOOST_TEST(relaxation.converged == same(next, pixels), test.name);
        BOOST_TEST(same(pixels_of(points_of(seeds)), next), test.name << ": seeds moved elsewhere");
        pixels = next;
      }
    }
  }
}

// With points themselves a seed goes to the whole number of 1/4096 pixel that is nearest to the weighted mean
// of the centres.
BOOST_AUTO_TEST_CASE(points_go_to_their_weighted_centroids) {
  constexpr std::int64_t parts = 4096;
  // Each kind of axes in one shape: kernels are built anew for each pair.
  constexpr Axes kinds_of_axes[] = {Axes::none, Axes::x, Axes::xy};
  for (std::size_t kind = 0; kind < shapes().size(); ++kind) {
    const Device device = shapes()[kind];
    const Axes periodic = kinds_of_axes[kind % std::size(kinds_of_axes)];
    const Grid grid(300, 190, periodic);
    const std::vector<float> density = random_density(grid);
    const Weights weights = weights_of(density);
    Seeds seeds(device, grid, random_points(grid, 200, 5), {Outside::count, Snap::none});
    Diagram diagram(device, grid);
    exact_diagram(seeds, diagram);
    // From the seeds' pixels the way to a pixel is not always the shorter one: cells are too small here.
    const std::vector<Sums> sums = sums_on_host(grid, diagram.read(), pixels_of(points_of(seeds)), weights);
    const double start = energy(diagram);
    const Relaxation relaxation = relax(seeds, diagram, exactly, 1, {}, with_density(density));
    BOOST_TEST(relaxation.energies.size() == 2u);
    BOOST_TEST(relaxation.energies.front() < start * *std::max_element(density.begin(), density.end()));
    const std::vector<Point> moved = points_of(seeds);
    const auto nearest = [&](std::int64_t weight, std::int64_t sum, std::int64_t size, bool repeats) {
      const std::int64_t at = ((2 * sum + weight) * parts + weight) / (2 * weight);
      return static_cast<double>(repeats ? (at + size * parts) % (size * parts) : at) / parts;
    };
    for (std::size_t id = 0; id < moved.size(); ++id) {
      const Sums& of = sums[id];
      BOOST_TEST_REQUIRE(of.weight > 0);
      // Negative sums lie a period away, where division rounds down as well.
      const std::int64_t x = of.x + (has_x(periodic) ? of.weight * grid.width() : 0);
      const std::int64_t y = of.y + (has_y(periodic) ? of.weight * grid.height() : 0);
      BOOST_TEST(moved[id].x == nearest(of.weight, x, grid.width(), has_x(periodic)));
      BOOST_TEST(moved[id].y == nearest(of.weight, y, grid.height(), has_y(periodic)));
    }
  }
}

BOOST_AUTO_TEST_CASE(seeds_whose_weights_are_the_same_move_as_without) {
  const Grid grid(40, 30);
  const std::vector<Point> points = random_points(grid, 12, 3);
  const std::vector<double> weights(points.size(), 7);
  RelaxOptions by_polygons;
  by_polygons.exact = true;
  const auto moved = [&](const Points& given, Snap snap, const auto& move) {
    Seeds seeds(test_device(), grid, given, {Outside::count, snap});
    Diagram diagram(test_device(), grid);
    move(seeds, diagram);
    exact_diagram(seeds, diagram);
    return diagram.read();
  };
  const auto is_same = [&](Snap snap, const auto& move) {
    return moved(points, snap, move) == moved(Points(points).weighted(weights.data()), snap, move);
  };
  for (const Snap snap : {Snap::to_pixels, Snap::none}) {
    BOOST_TEST(is_same(snap, [](Seeds& seeds, Diagram& diagram) { relax(seeds, diagram, exactly, 3); }));
    BOOST_TEST(is_same(snap, [](Seeds& seeds, Diagram&) { random_step(seeds, 1, Border::reflect, 1, 1); }));
  }
  BOOST_TEST(is_same(Snap::none, [&](Seeds& seeds, Diagram& diagram) {
    relax(seeds, diagram, exactly, 3, {}, by_polygons);
  }));
}

BOOST_AUTO_TEST_CASE(a_density_that_is_the_same_everywhere_changes_nothing) {
  const Grid grid(200, 150, Axes::x);
  for (const Snap snap : {Snap::to_pixels, Snap::none}) {
    const std::vector<Point> points = random_points(grid, 120, 2);
    Seeds one(test_device(), grid, points, {Outside::count, snap});
    Seeds other(test_device(), grid, points, {Outside::count, snap});
    Diagram of_one(test_device(), grid), of_other(test_device(), grid);
    const Relaxation evenly = relax(one, of_one, exactly, 8);
    const Relaxation weighted =
        relax(other, of_other, exactly, 8, {}, with_density(std::vector<float>(grid.pixels(), 3.0F)));
    BOOST_TEST(evenly.moved == weighted.moved, boost::test_tools::per_element());
    BOOST_TEST((of_one.read() == of_other.read()));
    for (std::size_t round = 0; round < evenly.energies.size(); ++round) {
      // Each block of pixels rounds its energy down, in another unit; GPUs have more blocks.
      const double tolerance = takes(Shape::vector) ? 1e-9 : 1e-7;
      BOOST_TEST(3 * evenly.energies[round] == weighted.energies[round],
                 boost::test_tools::tolerance(tolerance));
    }
  }
}

// Gersho's law in the plane: many seeds come to lie as densely as the square root of the density.
BOOST_AUTO_TEST_CASE(seeds_come_to_lie_as_the_square_root_of_the_density) {
  const Grid grid(384, 384, Axes::xy);
  const auto wanted = [](std::size_t x) {
    return 2 + std::cos(2 * 3.14159265358979 * (static_cast<double>(x % 384) + 0.5) / 384);  // 3 to 1
  };
  std::vector<float> density(grid.pixels());
  for (std::size_t i = 0; i < density.size(); ++i) density[i] = static_cast<float>(std::pow(wanted(i), 2));
  Seeds seeds(test_device(), grid, random_points(grid, 320, 4), {Outside::count, Snap::none});
  Diagram diagram(test_device(), grid);
  const Relaxation relaxation = relax(seeds, diagram, exactly, 1500, {}, with_density(density));
  for (std::size_t round = 1; round < relaxation.energies.size(); ++round) {
    BOOST_TEST(relaxation.energies[round] < relaxation.energies[round - 1] * (1 + 1e-6));
  }

  std::vector<double> counted(4), expected(4);
  for (const Point& point : points_of(seeds)) ++counted[static_cast<std::size_t>(point.x / 96)];
  for (std::size_t x = 0; x < 384; ++x) expected[x / 96] += wanted(x) / 768 * 320;
  for (std::size_t i = 0; i < 4; ++i) {
    BOOST_TEST(counted[i] == expected[i],
               boost::test_tools::tolerance(0.08));  // 105 and 55; by the density itself 125 and 35
  }
}

BOOST_AUTO_TEST_CASE(seeds_whose_cells_weigh_nothing_stay) {
  const Grid grid(40, 20);
  std::vector<float> density(grid.pixels());
  for (std::size_t i = 0; i < density.size(); ++i) density[i] = i % 40 < 20 ? 0.0F : 1.0F;
  for (const Snap snap : {Snap::to_pixels, Snap::none}) {
    Seeds seeds(test_device(), grid, {{3.5, 4.5}, {7.5, 9.5}, {25.5, 9.5}}, {Outside::count, snap});
    Diagram diagram(test_device(), grid);
    const Relaxation relaxation = relax(seeds, diagram, exactly, 1, {}, with_density(density));
    const std::vector<Point> moved = points_of(seeds);
    BOOST_TEST((moved[0].x == 3.5 && moved[0].y == 4.5));
    BOOST_TEST((moved[1].x == 7.5 && moved[1].y == 9.5));
    BOOST_TEST(moved[2].x > 29);
    BOOST_TEST(relaxation.moved.front() == 1u);
  }
}

BOOST_AUTO_TEST_CASE(densities_that_cannot_be_are_refused) {
  const Grid grid(10, 20);
  Seeds seeds(test_device(), grid, std::vector<Point>{{5, 5}}, to_centres);
  Diagram diagram(test_device(), grid);
  const auto refused = [&](std::vector<float> density, std::initializer_list<std::string> parts) {
    check_error([&] { relax(seeds, diagram, exactly, 1, {}, with_density(std::move(density))); }, parts);
  };
  refused(std::vector<float>(199, 1.0F), {"199", "10 x 20"});
  refused(std::vector<float>(200, 0.0F), {"0 everywhere"});
  std::vector<float> density(200, 1.0F);
  for (const float bad :
       {-1.0F, std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()}) {
    density[73] = bad;
    refused(density, {"pixel (3, 7)", "at least 0"});
  }
}

BOOST_AUTO_TEST_CASE(with_the_exact_engine_the_energy_falls_until_no_seed_moves) {
  const Grid grid(240, 160);
  const Case cases[] = {{"random", grid, random_pixels(grid, 60, 1)},
                        {"dense", grid, random_pixels(grid, 4000, 2)},
                        {"clusters", grid, clusters(grid, 300)},
                        {"corner", grid, {{0, 0}, {1, 0}, {0, 1}, {1, 1}, {2, 0}}}};
  for (const Case& test : cases) {
    Seeds seeds(test_device(), grid, centres(test.seeds), to_centres);
    Diagram diagram(test_device(), grid);
    const Relaxation relaxation = relax(seeds, diagram, exactly, 1000);
    BOOST_TEST_MESSAGE(test.name << ": " << relaxation.rounds() << " rounds, energy "
                                 << relaxation.energies.front() << " to " << relaxation.energies.back());
    BOOST_TEST(relaxation.converged, test.name);
    BOOST_TEST(relaxation.rounds() > 2, test.name);
    for (std::size_t round = 1; round < relaxation.energies.size(); ++round) {
      BOOST_TEST(relaxation.energies[round] < relaxation.energies[round - 1],
                 test.name << ", round " << round);
    }
    const std::vector<Pixel> pixels = pixels_of(points_of(seeds));
    BOOST_TEST(relaxation.energies.back() == energy_on_host(grid, diagram.read(), pixels), test.name);
    BOOST_TEST(same(round_on_host(grid, diagram.read(), pixels), pixels), test.name << ": not centroidal");
    Diagram fresh(test_device(), grid);
    exact_diagram(seeds, fresh);
    BOOST_TEST(similarity_of(diagram, fresh) == 100.0, test.name << ": the diagram is not that of the seeds");
  }
}

BOOST_AUTO_TEST_CASE(any_engine_relaxes_and_can_ask_how_far_seeds_moved) {
  const Grid grid(300, 200);
  Seeds seeds(test_device(), grid, centres(random_pixels(grid, 200, 1)), to_centres);
  Diagram diagram(test_device(), grid);
  std::vector<Pixel> before = pixels_of(points_of(seeds));
  const auto engine = [&](const Seeds& moved, Diagram& filled) {
    const std::vector<Pixel> now = pixels_of(points_of(moved));
    std::int64_t longest = 0;
    for (std::size_t id = 0; id < now.size(); ++id) {
      longest = std::max({longest, std::abs(now[id].x - before[id].x), std::abs(now[id].y - before[id].y)});
    }
    BOOST_TEST(moved.displacement() == static_cast<double>(longest));
    before = now;
    return dynamic_jump_flooding(moved, filled);
  };
  const Relaxation relaxation = relax(seeds, diagram, engine, 10);
  BOOST_TEST(relaxation.rounds() == 10);
  BOOST_TEST(!relaxation.converged);
  BOOST_TEST(10 * relaxation.energies.back() < 9 * relaxation.energies.front());
}

BOOST_AUTO_TEST_CASE(a_diagram_from_before_a_move_is_no_start) {
  const Grid grid(256, 256);
  std::vector<Pixel> pixels = random_pixels(Grid(32, 32), 256, 1);
  Seeds seeds(test_device(), grid, centres(pixels), to_centres);
  Diagram diagram(test_device(), grid);
  jump_flooding(seeds, diagram);
  for (Pixel& pixel : pixels) pixel = {pixel.x + 224, pixel.y + 224};
  seeds.move_to(centres(pixels));
  relax(seeds, diagram, engine(method("djfa")), 0);
  BOOST_TEST(similarity(diagram.read(), brute_force(grid, pixels, Metric::euclidean)) > 99);
}

BOOST_AUTO_TEST_CASE(an_observer_sees_every_round_and_can_end_it) {
  const Grid grid(120, 90);
  Seeds seeds(test_device(), grid, centres(random_pixels(grid, 60, 1)), to_centres);
  Diagram diagram(test_device(), grid);
  std::vector<Pixel> before;
  int calls = 0;
  const auto observer = [&](const Seeds& at, const Diagram& filled, const Relaxation& so_far) {
    const std::vector<Pixel> now = pixels_of(points_of(at));
    BOOST_TEST(so_far.rounds() == calls++);
    BOOST_TEST(so_far.energies.back() == energy_on_host(grid, filled.read(), now));
    BOOST_TEST_REQUIRE(so_far.moved.size() == static_cast<std::size_t>(so_far.rounds()));
    std::size_t moved = 0;
    for (std::size_t id = 0; id < before.size(); ++id) {
      moved += before[id].x != now[id].x || before[id].y != now[id].y ? 1 : 0;
    }
    if (!so_far.moved.empty()) BOOST_TEST(so_far.moved.back() == moved);
    before = now;
    return so_far.rounds() < 3;
  };
  const Relaxation relaxation = relax(seeds, diagram, exactly, 100, observer);
  BOOST_TEST(relaxation.rounds() == 3);
  BOOST_TEST(calls == 4);
  BOOST_TEST(!relaxation.converged);
  BOOST_TEST(same(pixels_of(points_of(seeds)), before));
}

// Pixels are what seeds move on, whatever the unit of their points.
BOOST_AUTO_TEST_CASE(rounds_are_the_same_in_units_of_the_data) {
  const Grid pixels(120, 90, Axes::x);
  const Grid data(Axis(120, -6, 6).periodic(), Axis(90, 0, 1).reversed());
  const std::vector<Pixel> from = random_pixels(pixels, 60, 1);
  Seeds a(test_device(), pixels, centres(from), to_centres);
  Seeds b(test_device(), data,
          transformed(from, [&](const Pixel& pixel) { return data.point(centre(pixel)); }), to_centres);
  Diagram of_a(test_device(), pixels), of_b(test_device(), data);
  const Relaxation first = relax(a, of_a, exactly, 5), second = relax(b, of_b, exactly, 5);
  BOOST_TEST(first.energies == second.energies, boost::test_tools::per_element());
  BOOST_TEST((of_a.read() == of_b.read()));
  const std::vector<Point> in_pixels = points_of(a), in_units = points_of(b);
  for (std::size_t id = 0; id < from.size(); ++id) {
    const Point expected = data.point(in_pixels[id]);
    BOOST_TEST((in_units[id].x == expected.x && in_units[id].y == expected.y));
  }
}

BOOST_AUTO_TEST_CASE(seeds_without_a_cell_stay) {
  const Grid grid(9, 9);
  Seeds seeds(test_device(), grid, {{0.5, 0.5}, {0.5, 0.5}}, to_centres);
  seeds.move_to(std::vector<std::optional<Point>>{Point{0.5, 0.5}, Point{0.5, 0.5}, std::nullopt});
  Diagram diagram(test_device(), grid);
  const Relaxation relaxation = relax(seeds, diagram, exactly, 1);
  BOOST_TEST(!relaxation.converged);
  const std::vector<std::optional<Point>> points = seeds.read();
  BOOST_TEST((points[0]->x == 4.5 && points[0]->y == 4.5));
  BOOST_TEST((points[1]->x == 0.5 && points[1]->y == 0.5));
  BOOST_TEST(!points[2].has_value());
}

BOOST_AUTO_TEST_CASE(bad_calls_and_nothing_to_do) {
  const Grid grid(10, 20);
  Seeds seeds(test_device(), grid, std::vector<Point>{{5, 5}}, to_centres);
  Diagram diagram(test_device(), grid), other(test_device(), Grid(20, 10));
  check_error([&] { relax(seeds, diagram, exactly, -1); }, {"-1 rounds"});
  check_error([&] { relax(seeds, other, exactly, 1); }, {"10 x 20", "20 x 10"});
  check_error([&] { energy(other); }, {"seeds"});
  Seeds outside(test_device(), grid, {{5, 5}, {-3, 5}}, to_centres);
  check_error([&] { relax(outside, diagram, exactly, 1); }, {"outside"});
  exact_diagram(outside, diagram);
  check_error([&] { energy(diagram); }, {"outside"});
  check_error([&] { relax(seeds, diagram, {}, 1); }, {"engine"});
  BOOST_TEST(relax(seeds, diagram, exactly, 0).rounds() == 0);
  BOOST_TEST(points_of(seeds).front().x == 5);  // where it was put, for nothing moved it
  Seeds none(test_device(), grid, std::vector<Point>{}, to_centres);
  const Relaxation nothing = relax(none, diagram, exactly, 5);
  BOOST_TEST(nothing.converged);
  BOOST_TEST(nothing.energies == std::vector<std::uint64_t>{0}, boost::test_tools::per_element());
}
