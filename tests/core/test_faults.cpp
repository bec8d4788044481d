// Every OpenCL call of every method fails once: the call throws, and the objects are as good as new
// afterwards.
#define BOOST_TEST_MODULE faults
#include <atomic>
#include <chrono>
#include <functional>
#include <thread>

#include "failing_opencl.hpp"
#include "fixture.hpp"

using namespace vorocl;

namespace {

const Grid grid(70, 50);

std::vector<std::optional<Point>> some_points(std::size_t count) {
  return Seeds::random(test_device(), grid, count, count).read();
}

/// Runs an action with its first call failing, then with its second one, and so on until no call is left to
/// fail. `start` makes what the action needs, before each time; `judge` looks at it afterwards. Returns how
/// many calls there are.
int fail_each_call(const std::function<void()>& start, const std::function<void()>& action,
                   const std::function<void()>& judge) {
  for (int call = 1;; ++call) {
    start();
    fault().set(call);
    bool threw = false;
    try {
      action();
    } catch (const Error& error) {
      threw = true;
      BOOST_TEST((error.kind() == ErrorKind::device_memory), error.what());
    }
    const bool came = fault().calls >= call;
    fault().set(0);
    BOOST_REQUIRE_EQUAL(threw, came);
    BOOST_TEST_CONTEXT("call " << call) { judge(); }
    if (!came) return call - 1;
  }
}

std::vector<std::uint32_t> fresh_labels(const Seeds& seeds) {
  Diagram fresh(test_device(), grid);
  dynamic_jump_flooding(seeds, fresh, 3);
  return fresh.read();
}

}  // namespace

// With working memory still to be made, and with all of it there from earlier frames.
BOOST_AUTO_TEST_CASE(methods_that_fail_leave_a_diagram_as_never_filled) {
  const Seeds before = Seeds::random(test_device(), grid, 40, 1),
              seeds = Seeds::random(test_device(), grid, 9, 2);
  const std::vector<std::uint32_t> expected = fresh_labels(seeds);
  for (const Method& method : methods()) {
    for (const int earlier_frames : {0, 1, 2}) {
      std::optional<Diagram> diagram;
      bool filled = false;
      const auto start = [&] {
        diagram.emplace(test_device(), grid);
        for (int frame = 0; frame < earlier_frames; ++frame) method.run(before, *diagram, 3, {});
        diagram->wait();
        filled = false;
      };
      const auto run = [&] {
        method.run(seeds, *diagram, 3, {});
        filled = true;
      };
      const auto judge = [&] {
        if (filled) return;
        dynamic_jump_flooding(seeds, *diagram, 3);
        BOOST_TEST((diagram->read() == expected));
      };
      BOOST_TEST_CONTEXT(method.name << " after " << earlier_frames << " frames") {
        BOOST_TEST(fail_each_call(start, run, judge) >= 5);
      }
    }
  }
}

BOOST_AUTO_TEST_CASE(seeds_that_fail_to_move_say_so_until_they_are_moved) {
  const auto points = some_points(30);
  const std::vector<cl_float2> values(30, {{5, 5}});
  const cl::Buffer buffer(test_device().queue(), values.begin(), values.end(), true);
  std::optional<Seeds> seeds;
  const auto start = [&] { seeds.emplace(test_device(), grid, some_points(20)); };
  const auto judge = [&] {
    try {
      const std::size_t alive = seeds->alive();  // what they were, or what they are to be
      BOOST_TEST((alive == 20 || alive == 30));
    } catch (const Error& error) {
      BOOST_TEST(std::string(error.what()).find("move them again") != std::string::npos);
    }
    seeds->move_to(points);
    BOOST_TEST(seeds->alive() == 30u);
    BOOST_TEST((points_of(*seeds)[7].x == points[7]->x));
  };
  BOOST_TEST(fail_each_call(
                 start, [&] { seeds->move_to(points); }, judge) >= 1);
  BOOST_TEST(fail_each_call(
                 start, [&] { seeds->move_to(buffer, 30); }, judge) >= 4);
}

BOOST_AUTO_TEST_CASE(measures_that_fail_are_empty) {
  const Seeds seeds = Seeds::random(test_device(), grid, 40, 1);
  Diagram diagram(test_device(), grid);
  exact_diagram(seeds, diagram);
  CellSumsResult sums;
  CellShapesResult shapes;
  AdjacencyResult pairs;
  Field<float> field;
  const auto measure = [&] {
    cell_sums(seeds, diagram, sums);
    cell_shapes(seeds, diagram, shapes);
    distance_field(seeds, diagram, field);
    adjacency(seeds, diagram, pairs);
  };
  measure();
  const std::size_t expected_pairs = pairs.pairs();
  const auto start = [&] {
    sums = {};
    shapes = {};
    pairs = {};
    field = {};
  };
  const auto judge = [&] {
    BOOST_TEST((sums.size() == 0 || sums.read().size() == 40));
    BOOST_TEST((shapes.size() == 0 || shapes.read().size() == 40));
    BOOST_TEST((pairs.pairs() == 0 || pairs.read_pairs().size() == expected_pairs));
    measure();
    BOOST_TEST(pairs.pairs() == expected_pairs);
    BOOST_TEST(sums.read().size() == 40u);
    BOOST_TEST(field.read().size() == grid.pixels());
  };
  BOOST_TEST(fail_each_call(start, measure, judge) >= 30);
}

// While an event holds the queue back, a thread that makes one frame after the other stops.
BOOST_AUTO_TEST_CASE(at_most_128_commands_are_in_flight) {
  const Seeds seeds = Seeds::random(test_device(), grid, 40, 1);
  Diagram diagram(test_device(), grid);
  exact_diagram(seeds, diagram);
  const std::vector<std::uint32_t> expected = diagram.read();
  cl_int code = CL_SUCCESS;
  const cl::Event gate(clCreateUserEvent(test_device().context()(), &code));
  BOOST_REQUIRE(code == CL_SUCCESS);
  test_device().wait_for({gate});
  fault().set(0);
  std::atomic<int> frames{0};
  std::thread maker([&] {
    for (; frames < 100; ++frames) exact_diagram(seeds, diagram);
  });
  int before = -1;
  for (int now = 0; now != before; now = fault().enqueued) {
    before = now;
    std::this_thread::sleep_for(std::chrono::milliseconds(300));
  }
  BOOST_TEST(fault().enqueued >= 64);
  BOOST_TEST(fault().enqueued <= 128);
  BOOST_TEST(frames < 100);
  clSetUserEventStatus(gate(), CL_COMPLETE);
  maker.join();
  BOOST_TEST(frames == 100);
  BOOST_TEST((diagram.read() == expected));
}
