// The loop of frames: what it refuses, and how it goes on after errors, changes of the box and skipped
// frames.
#define BOOST_TEST_MODULE simulation
#include "brute_force.hpp"
#include "fixture.hpp"
#include "read_measures.hpp"

using namespace vorocl;

namespace {

/// Seeds so dense that the waves tell how far the labels are said to have moved: 2 L = 8.
Simulation random_walk(int most) {
  return Simulation(Seeds::random(test_device(), Grid(256, 256), 4096, 11),
                    [=](Seeds& seeds, Window&, int frame) {
                      random_step(seeds, most, Border::reflect, 12, static_cast<std::uint32_t>(frame));
                    });
}

Report by_paper(const Seeds& seeds, Diagram& diagram) {
  return dynamic_jump_flooding(seeds, diagram, {Metric::euclidean, {}, 0, Reach::paper});
}

Report exactly(const Seeds& seeds, Diagram& diagram) { return exact_diagram(seeds, diagram); }

}  // namespace

BOOST_AUTO_TEST_CASE(a_simulation_refuses_what_it_has_not) {
  const Grid grid(8, 8);
  check_error([&] { Simulation(Seeds(test_device(), grid, {}, to_centres), nullptr); }, {"motion"});
  Simulation simulation = random_walk(1);
  check_error([&] { simulation.add_engine(nullptr); }, {"engine", "empty"});
  simulation.add_engine(exactly);
  simulation.step();
  check_error([&] { simulation.add_engine(exactly); }, {"engine"});
  check_error([&] { simulation.diagram(3); }, {"1 engines", "number 3"});
  check_error([&] { simulation.report(1); }, {"number 1"});
  check_error([&] { simulation.milliseconds(1); }, {"number 1"});
  check_error([&] { simulation.host_milliseconds(1); }, {"number 1"});
}

// An engine that did not run in a frame starts from an older one: its diagram knows how far seeds moved since
// then.
BOOST_AUTO_TEST_CASE(a_simulation_goes_on_after_an_engine_has_thrown) {
  Simulation simulation = random_walk(12);
  int calls = 0;
  simulation.add_engine([&](const Seeds& seeds, Diagram& diagram) {
    if (++calls == 3) throw Error("no more");
    return exact_diagram(seeds, diagram);
  });
  simulation.add_engine(by_paper);
  std::vector<int> steps;
  for (int frame = 0; frame < 5; ++frame) {
    if (frame == 2) {
      check_error([&] { simulation.step(); }, {"no more"});
    } else {
      simulation.step();
      steps.push_back(simulation.report(1).start().first_step);
    }
  }
  BOOST_TEST(simulation.frame() == 4);
  BOOST_TEST(calls == 5);
  BOOST_TEST(steps == (std::vector<int>{128, 16, 32, 16}), boost::test_tools::per_element());
}

BOOST_AUTO_TEST_CASE(a_simulation_makes_a_frame_again_whose_motion_has_thrown) {
  std::vector<int> frames;
  Simulation simulation(Seeds::random(test_device(), Grid(30, 20), 5, 1), [&](Seeds&, Window&, int frame) {
    frames.push_back(frame);
    if (frames.size() == 2) throw Error("stuck");
  });
  simulation.add_engine(exactly);
  simulation.step();
  simulation.step();
  check_error([&] { simulation.step(); }, {"stuck"});
  BOOST_TEST(simulation.frame() == 1);
  simulation.step();
  BOOST_TEST(frames == (std::vector<int>{1, 2, 2}), boost::test_tools::per_element());
}

// A box that changes: the motion brings other seeds, on another grid.
BOOST_AUTO_TEST_CASE(a_simulation_goes_on_with_seeds_on_another_grid) {
  const Grid before(40, 30), after(50, 20, Axes::x);
  const std::vector<Pixel> pixels = random_pixels(after, 12, 8);
  for (const bool other_seeds : {false, true}) {
    Simulation simulation(Seeds::random(test_device(), before, 5, 1), [&](Seeds& seeds, Window&, int frame) {
      if (frame != 1) return;
      if (other_seeds) {
        seeds = Seeds(test_device(), after, centres(pixels), to_centres);
      } else {
        seeds.move_to(after, centres(pixels));
      }
    });
    simulation.add_engine(
        [](const Seeds& seeds, Diagram& diagram) { return dynamic_jump_flooding(seeds, diagram); });
    simulation.add_engine(exactly);
    for (int frame = 0; frame < 3; ++frame) simulation.step();
    BOOST_TEST(simulation.frame() == 2);
    BOOST_TEST((simulation.diagram(0).window() == Window(after)));
    BOOST_TEST(simulation.diagram(1).read() == brute_force(after, pixels, Metric::euclidean));
    BOOST_TEST(similarity_of(simulation.diagram(0), simulation.diagram(1)) > 99);
  }
}

// A camera: the seeds' grid stays, and the window goes over it.
BOOST_AUTO_TEST_CASE(a_simulation_can_move_its_window) {
  const Grid grid(60, 40, Axes::x);
  const std::vector<Pixel> pixels = random_pixels(grid, 12, 8);
  const std::vector<std::uint32_t> whole = brute_force(grid, pixels, Metric::euclidean);
  const int x[] = {0, 50, 50};
  Simulation simulation(
      Seeds(test_device(), grid, centres(pixels), to_centres), Window(grid, x[0], 5, 20, 30),
      [&](Seeds&, Window& window, int frame) { window = Window(grid, x[frame], 5, 20, 30); });
  simulation.add_engine(exactly);
  for (const int left : x) {
    simulation.step();
    BOOST_TEST((simulation.diagram().window() == Window(grid, left, 5, 20, 30)));
    const std::vector<std::uint32_t> labels = simulation.diagram().read();
    std::size_t wrong = 0;
    for (std::size_t i = 0; i < labels.size(); ++i) {
      const std::size_t column = (static_cast<std::size_t>(left) + i % 20) % 60, row = 5 + i / 20;
      wrong += labels[i] != whole[row * 60 + column] ? 1 : 0;
    }
    BOOST_TEST(wrong == 0u, "window from column " << left);
  }
}

BOOST_AUTO_TEST_CASE(a_window_of_another_grid_is_refused) {
  const Grid grid(60, 40);
  Simulation simulation(Seeds(test_device(), grid, {{1, 1}}, to_centres),
                        [&](Seeds&, Window& window, int) { window = Window(Grid(90, 90), 0, 0, 60, 40); });
  simulation.add_engine(exactly);
  simulation.step();
  check_error([&] { simulation.step(); }, {"grid"});
}

BOOST_AUTO_TEST_CASE(a_skipped_frame_moves_the_seeds_alone) {
  Simulation all = random_walk(3), last = random_walk(3);
  int calls = 0;
  all.add_engine(exactly);
  last.add_engine([&](const Seeds& seeds, Diagram& diagram) {
    ++calls;
    return exact_diagram(seeds, diagram);
  });
  for (int frame = 0; frame <= 4; ++frame) all.step();
  for (int frame = 0; frame < 4; ++frame) last.skip();
  BOOST_TEST(last.frame() == 3);
  BOOST_TEST(calls == 0);
  last.step();
  BOOST_TEST(calls == 1);
  BOOST_TEST((last.diagram().read() == all.diagram().read()));
}
