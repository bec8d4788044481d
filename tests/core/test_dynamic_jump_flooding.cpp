// Dynamic jump flooding: against a reference label for label, similarity to JFA, and seeds that come and go.
#define BOOST_TEST_MODULE dynamic_jump_flooding
#include <algorithm>
#include <chrono>
#include <cmath>
#include <future>
#include <map>

#include "brute_force.hpp"
#include "fixture.hpp"
#include "read_measures.hpp"
#include "reference_flood.hpp"

using namespace vorocl;

namespace {

std::vector<std::optional<Point>> present(const std::vector<Pixel>& pixels) {
  return transformed(pixels, [](const Pixel& pixel) { return std::optional(centre(pixel)); });
}

/// Labels after motion: of seeds that have come to share a pixel, the lowest id has the cell.
std::vector<std::uint32_t> owners(std::vector<std::uint32_t> labels, const std::vector<Pixel>& seeds) {
  std::map<Pixel, std::uint32_t> owner;
  for (std::uint32_t id = 0; id < seeds.size(); ++id) owner.emplace(seeds[id], id);
  for (std::uint32_t& label : labels) label = owner.at(seeds[label]);
  return labels;
}

Simulation random_walk(const Grid& grid, std::size_t count, int most, Border border = Border::reflect) {
  return Simulation(Seeds::random(test_device(), grid, count, 11), [=](Seeds& seeds, Window&, int frame) {
    random_step(seeds, most, border, 12, static_cast<std::uint32_t>(frame));
  });
}

/// With the paper's plans, or its authors'.
Simulation::Engine djfa(Metric metric, DynamicPlanOptions plan = {}, int refresh_interval = 0,
                        Reach reach = Reach::paper) {
  return [=](const Seeds& seeds, Diagram& diagram) {
    return dynamic_jump_flooding(seeds, diagram, {metric, plan, refresh_interval, reach});
  };
}

Simulation::Engine jfa(Metric metric) {
  return [=](const Seeds& seeds, Diagram& diagram) { return jump_flooding(seeds, diagram, {metric}); };
}

/// Mean similarity of engine 0 to each other one, over frames 1 ... frames.
std::vector<double> mean_similarity(Simulation& simulation, std::size_t engines, int frames) {
  std::vector<double> means(engines, 0);
  simulation.step();
  for (int frame = 1; frame <= frames; ++frame) {
    simulation.step();
    for (std::size_t i = 1; i < engines; ++i) {
      means[i] += similarity_of(simulation.diagram(), simulation.diagram(i)) / frames;
    }
  }
  return means;
}

}  // namespace

BOOST_AUTO_TEST_CASE(every_frame_equals_a_reference) {
  const NeighbourhoodMix mixes[] = {NeighbourhoodMix::mixed, NeighbourhoodMix::moore,
                                    NeighbourhoodMix::von_neumann};
  for (const Metric metric : both_metrics) {
    for (const Grid& grid : {Grid(61, 47), Grid(16, 33), Grid(130, 3), Grid(1, 1)}) {
      for (const NeighbourhoodMix mix : mixes) {
        for (const int extra_waves : {0, 1, 2}) {
          const Reach reach = extra_waves == 1 ? Reach::authors : Reach::paper;
          const DynamicPlanOptions plan = {mix, 2, extra_waves};
          Simulation simulation = random_walk(grid, 60, 3);
          simulation.add_engine(djfa(metric, plan, 0, reach));
          simulation.step();
          auto expected = simulation.diagram().read();
          for (int frame = 1; frame <= 5; ++frame) {
            simulation.step();
            const auto seeds = pixels_of(points_of(simulation.seeds()));
            const Plan waves = dynamic_jump_flooding_plan(grid, seeds.size(), 3, plan, reach);
            expected = reference_flood(grid, seeds, waves, metric, owners(expected, seeds));
            BOOST_TEST((simulation.diagram().read() == expected),
                       grid.width() << " x " << grid.height() << ", " << name_of(metric) << ", waves "
                                    << to_string(waves) << ", frame " << frame);
            BOOST_TEST(simulation.report().waves() == static_cast<int>(waves.size()));
          }
        }
      }
    }
  }
}

BOOST_AUTO_TEST_CASE(the_illustration_of_the_paper) {
  // 50 seeds on 1000 x 1000: the paper and its notebook give a similarity close to 100 %.
  Simulation simulation = random_walk(Grid(1000, 1000), 50, 5);
  simulation.add_engine(djfa(Metric::euclidean));
  simulation.add_engine(jfa(Metric::euclidean));
  BOOST_TEST(mean_similarity(simulation, 2, 20)[1] >= 99.9);
}

BOOST_AUTO_TEST_CASE(similarity_at_100_pixels_per_seed) {
  Simulation euclidean = random_walk(Grid(600, 500), 3000, 5);
  euclidean.add_engine(djfa(Metric::euclidean));
  euclidean.add_engine(jfa(Metric::euclidean));
  BOOST_TEST(mean_similarity(euclidean, 2, 20)[1] >= 99.9);

  // The paper holds its Manhattan variant against the Euclidean JFA: 88 to 92 %. To its own metric it is as
  // near.
  Simulation manhattan = random_walk(Grid(600, 500), 3000, 5);
  manhattan.add_engine(djfa(Metric::manhattan));
  manhattan.add_engine(jfa(Metric::euclidean));
  manhattan.add_engine(jfa(Metric::manhattan));
  const std::vector<double> means = mean_similarity(manhattan, 3, 20);
  BOOST_TEST(means[1] >= 85);
  BOOST_TEST(means[1] <= 95);
  BOOST_TEST(means[2] >= 99.5);
}

BOOST_AUTO_TEST_CASE(the_same_film_for_every_kernel_shape) {
  const Grid grid(143, 61);
  std::vector<std::vector<std::uint32_t>> expected;
  for (const Tuning& shape : {Tuning{1, 32, 8}, Tuning{1, 7, 3}, Tuning{2, 64, 1}, Tuning{4, 1, 16},
                              Tuning{8, 64, 1}, Tuning{16, 64, 1}}) {
    Seeds seeds = Seeds::random(test_device().with_tuning(shape), grid, 200, 3);
    Diagram diagram(test_device().with_tuning(shape), grid);
    for (std::size_t frame = 0; frame < 10; ++frame) {
      dynamic_jump_flooding(seeds, diagram);
      if (expected.size() <= frame) expected.push_back(diagram.read());
      BOOST_TEST((diagram.read() == expected[frame]),
                 "vector width " << shape.vector_width << ", frame " << frame);
      random_step(seeds, 4, Border::periodic, 5, static_cast<std::uint32_t>(frame));
    }
  }
}

BOOST_AUTO_TEST_CASE(a_refresh_is_a_full_jfa) {
  Simulation simulation = random_walk(Grid(100, 100), 400, 3);
  simulation.add_engine(djfa(Metric::euclidean, {}, 4));
  simulation.add_engine(jfa(Metric::euclidean));
  for (int frame = 0; frame <= 12; ++frame) {
    simulation.step();
    const int full = simulation.report(1).waves();
    BOOST_TEST(simulation.report().waves() == (frame % 4 == 0 ? full : 5));
    if (frame % 4 == 0) BOOST_TEST(similarity_of(simulation.diagram(0), simulation.diagram(1)) == 100.0);
  }
}

void check_vanished_seeds(Reach reach) {
  const DynamicJumpFloodingOptions options = {Metric::euclidean, {}, 0, reach};
  const Grid grid(200, 150);
  std::vector<Pixel> pixels = random_pixels(grid, 300, 21);
  auto points = present(pixels);
  Seeds seeds(test_device(), grid, centres(pixels), to_centres);
  Diagram diagram(test_device(), grid);
  dynamic_jump_flooding(seeds, diagram, options);
  // All seeds on the left vanish: a hole far wider than 2 L, which only the full JFA that follows can fill.
  std::vector<Pixel> left;
  std::vector<std::uint32_t> ids;
  for (std::uint32_t id = 0; id < pixels.size(); ++id) {
    if (pixels[id].x < 140) {
      points[id].reset();
    } else {
      left.push_back(pixels[id]);
      ids.push_back(id);
    }
  }
  seeds.move_to(points);
  BOOST_TEST(seeds.alive() == left.size());
  const Report report = dynamic_jump_flooding(seeds, diagram, options);
  const auto labels = diagram.read();
  const auto ground_truth = brute_force(grid, left, Metric::euclidean);
  std::size_t wrong = 0;
  for (std::size_t i = 0; i < labels.size(); ++i) wrong += labels[i] != ids[ground_truth[i]] ? 1 : 0;
  BOOST_TEST(wrong < grid.pixels() / 500);
  // Measured labels tell that before any wave runs.
  std::size_t waves = jump_flooding_plan(grid).size();
  if (reach == Reach::paper) waves += dynamic_jump_flooding_plan(grid, left.size(), 0).size();
  BOOST_TEST(report.waves() == static_cast<int>(waves));

  seeds.move_to(std::vector<std::optional<Point>>(pixels.size()));
  dynamic_jump_flooding(seeds, diagram, options);
  BOOST_TEST((diagram.read() == std::vector<std::uint32_t>(grid.pixels(), no_label)));

  // Out of nothing, and only in a corner: again farther than the first wave reaches.
  std::vector<std::optional<Point>> corner(pixels.size());
  for (std::size_t id = 0; id < 100; ++id)
    corner[id] = Point{static_cast<double>(id % 10), std::floor(static_cast<double>(id) / 10)};
  seeds.move_to(corner);
  dynamic_jump_flooding(seeds, diagram, options);
  const auto from_corner = diagram.read();
  BOOST_TEST(std::count(from_corner.begin(), from_corner.end(), no_label) == 0);
}

BOOST_AUTO_TEST_CASE(vanished_seeds_leave_no_label_behind) {
  check_vanished_seeds(Reach::measured);
  check_vanished_seeds(Reach::paper);
}

BOOST_AUTO_TEST_CASE(single_seeds_come_and_go) {
  // One in ten seeds is absent in each frame, others each time; wrong pixels of all frames against brute
  // force.
  const Grid grid(120, 100);
  const std::vector<Pixel> pixels = random_pixels(grid, 200, 22);
  Seeds seeds(test_device(), grid, centres(pixels), to_centres);
  Diagram diagram(test_device(), grid);
  dynamic_jump_flooding(seeds, diagram);
  std::size_t wrong = 0;
  for (std::uint32_t frame = 1; frame <= 10; ++frame) {
    auto points = present(pixels);
    std::vector<Pixel> alive;
    std::vector<std::uint32_t> ids;
    for (std::uint32_t id = 0; id < pixels.size(); ++id) {
      if (id % 10 == frame % 10) {
        points[id].reset();
      } else {
        alive.push_back(pixels[id]);
        ids.push_back(id);
      }
    }
    seeds.move_to(points);
    dynamic_jump_flooding(seeds, diagram);
    const auto labels = diagram.read();
    const auto ground_truth = brute_force(grid, alive, Metric::euclidean);
    for (std::size_t i = 0; i < labels.size(); ++i) {
      BOOST_REQUIRE(labels[i] < pixels.size());
      BOOST_REQUIRE(points[labels[i]].has_value());
      const Pixel at = {static_cast<int>(i % 120), static_cast<int>(i / 120)};
      wrong += distance(at, pixels[labels[i]], Metric::euclidean) >
               distance(at, alive[ground_truth[i]], Metric::euclidean);
    }
  }
  BOOST_TEST(wrong < 10 * grid.pixels() / 200);  // half a percent
}

BOOST_AUTO_TEST_CASE(few_deaths_and_births_keep_short_plans) {
  // One of 1,250 seeds vanishes in each frame, and the one of the frame before is reborn at another place.
  const Grid grid(250, 250);
  std::vector<Pixel> pixels = random_pixels(grid, 1250, 23);
  const std::vector<Pixel> places = random_pixels(grid, 1250, 24);
  Seeds seeds(test_device(), grid, centres(pixels), to_centres);
  Diagram diagram(test_device(), grid), jfa(test_device(), grid);
  dynamic_jump_flooding(seeds, diagram);
  std::size_t wrong = 0, wrong_by_jfa = 0;
  for (std::uint32_t frame = 0; frame < 20; ++frame) {
    if (frame > 0) pixels[frame - 1] = places[frame];
    auto points = present(pixels);
    points[frame].reset();
    seeds.move_to(points);
    BOOST_TEST(seeds.displacement() == 0);  // nobody who was there has moved
    const Report report = dynamic_jump_flooding(seeds, diagram);
    BOOST_TEST(report.waves() < 8);
    jump_flooding(seeds, jfa);
    std::vector<Pixel> alive = pixels;
    alive.erase(alive.begin() + frame);
    const auto nearest = brute_force(grid, alive, Metric::euclidean);
    const auto errors = [&](const Diagram& of) {
      std::size_t count = 0;
      const auto labels = of.read();
      for (std::size_t i = 0; i < labels.size(); ++i) {
        BOOST_REQUIRE(labels[i] < pixels.size());
        BOOST_REQUIRE(labels[i] != frame);
        const Pixel at = {static_cast<int>(i % 250), static_cast<int>(i / 250)};
        count += distance(at, pixels[labels[i]], Metric::euclidean) >
                 distance(at, alive[nearest[i]], Metric::euclidean);
      }
      return count;
    };
    wrong += errors(diagram);
    wrong_by_jfa += errors(jfa);
  }
  BOOST_TEST(wrong <= wrong_by_jfa);
}

BOOST_AUTO_TEST_CASE(the_number_of_seeds_may_change) {
  const Grid grid(90, 70);
  Seeds seeds(test_device(), grid, centres(random_pixels(grid, 50, 1)), to_centres);
  Diagram diagram(test_device(), grid);
  dynamic_jump_flooding(seeds, diagram);
  for (const unsigned count : {80u, 20u, 1u, 300u}) {
    const auto pixels = random_pixels(grid, count, count);
    seeds.move_to(present(pixels));
    dynamic_jump_flooding(seeds, diagram);
    const auto ground_truth = brute_force(grid, pixels, Metric::euclidean);
    const Verdict verdict = judge(grid, pixels, Metric::euclidean, diagram.read(), ground_truth);
    BOOST_TEST(verdict.unlabelled + verdict.invalid == 0u);
    BOOST_TEST(verdict.wrong < grid.pixels() / 50);
  }
}

BOOST_AUTO_TEST_CASE(points_from_the_callers_buffer_each_frame) {
  const Grid grid(64, 64);
  Seeds seeds(test_device(), grid, {{1, 1}, {60, 60}}, to_centres);
  Diagram diagram(test_device(), grid);
  dynamic_jump_flooding(seeds, diagram);
  const std::vector<cl_float2> values = {{{60.5f, 3.f}}, {{2.f, 62.f}}};
  const cl::Buffer buffer(test_device().queue(), values.begin(), values.end(), true);
  seeds.move_to(PointBuffer(buffer, 2));
  dynamic_jump_flooding(seeds, diagram);
  BOOST_TEST((diagram.read() == brute_force(grid, {{60, 3}, {2, 62}}, Metric::euclidean)));
}

// While an event holds the queue back, a call that waits for the device does not return: the paper's reach
// needs no wait where it is told how far the seeds may have moved, and how many there are.
BOOST_AUTO_TEST_CASE(points_from_the_callers_buffer_are_not_waited_for) {
  const Grid grid(64, 64);
  const std::vector<cl_float2> values = {{{60.5f, 3.f}}, {{2.f, 62.f}}};
  const cl::Buffer buffer(test_device().queue(), values.begin(), values.end(), true);
  DynamicJumpFloodingOptions paper = {Metric::euclidean, {}, 0, Reach::paper, 64.0};
  std::vector<cl_uchar> second = {0, 1};
  const cl::Buffer marks(test_device().queue(), second.begin(), second.end(), true);
  prepare(method("djfa"), test_device(), grid, 2);
  Seeds seeds(test_device(), grid, {{1, 1}, {60, 60}}, {Outside::refuse, Snap::to_pixels});
  Diagram first(test_device(), grid), next(test_device(), grid);
  dynamic_jump_flooding(seeds, next);
  test_device().finish();
  cl::UserEvent gate(test_device().context());
  test_device().wait_for({gate});
  std::size_t all = 0;
  std::future<void> enqueued = std::async(std::launch::async, [&] {
    seeds.move_to(PointBuffer(buffer, 2));
    dynamic_jump_flooding(seeds, first, paper);
    dynamic_jump_flooding(seeds, next, paper);
    all = seeds.alive();
    // Which are there, the device alone knows.
    seeds.move_to(PointBuffer(buffer, 2, PointFormat::floats_xy, marks));
    paper.alive = 1;
    dynamic_jump_flooding(seeds, first, paper);
    dynamic_jump_flooding(seeds, next, paper);
  });
  const bool returned = enqueued.wait_for(std::chrono::seconds(20)) == std::future_status::ready;
  gate.setStatus(CL_COMPLETE);
  BOOST_TEST(returned);
  enqueued.get();
  BOOST_TEST(all == 2u);
  BOOST_TEST(seeds.alive() == 1u);
  const std::vector<std::uint32_t> expected(grid.pixels(), 1);
  BOOST_TEST((first.read() == expected));
  BOOST_TEST((next.read() == expected));
}

BOOST_AUTO_TEST_CASE(options_out_of_range_are_refused) {
  const Grid grid(8, 8);
  const Seeds seeds(test_device(), grid, {{1, 1}}, to_centres);
  Diagram diagram(test_device(), grid);
  const NeighbourhoodMix mixed = NeighbourhoodMix::mixed;
  const auto run = [&](double max_displacement, const DynamicPlanOptions& plan, int refresh) {
    dynamic_jump_flooding(seeds, diagram,
                          {Metric::euclidean, plan, refresh, Reach::measured, max_displacement});
  };
  check_error([&] { run(-1, {}, 0); }, {"-1.0"});
  check_error([&] { run(0, {mixed, 3, 0}, 0); }, {"3 von Neumann waves"});
  check_error([&] { run(0, {mixed, 2, -1}, 0); }, {"-1 extra waves"});
  check_error([&] { run(0, {}, -2); }, {"-2 frames"});
}
