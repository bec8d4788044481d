// The OpenCL calls of every method and measurement fail, one after the other: each time Error is thrown, and
// the objects are as good as new afterwards.
#define BOOST_TEST_MODULE faults
#include <atomic>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <thread>

#include "faulty_calls.hpp"
#include "fixture.hpp"
#include "read_measures.hpp"

using namespace vorocl;

namespace {

/// Which call fails. Calls are counted from 1 once it is set; 0: none. And how many were kernels to launch or
/// buffers to fill.
struct Fault {
  std::atomic<int> fails_at{0};
  std::atomic<int> calls{0};
  std::atomic<int> enqueued{0};

  void set(int call) {
    calls = enqueued = 0;
    fails_at = call;
  }

  bool comes(const char* name) {
    const std::string call(name);
    enqueued += call == "clEnqueueNDRangeKernel" || call == "clEnqueueFillBuffer" ? 1 : 0;
    return ++calls == fails_at;
  }
};

Fault& fault() {
  static Fault only;
  return only;
}

/// Where a user has prepared programs (vorocl/preparation.hpp), a call that fails to load one is no error:
/// the program is built from its source.
struct WithoutKeptBinaries {
  WithoutKeptBinaries() { setenv("VOROCL_BINARY_CACHE", "0", 1); }
};
BOOST_TEST_GLOBAL_FIXTURE(WithoutKeptBinaries);

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
  dynamic_jump_flooding(seeds, fresh);
  return fresh.read();
}

}  // namespace

bool vorocl::call_fails(const char* name) { return fault().comes(name); }

VOROCL_FAULTY_CALL(clGetEventInfo,
                   (cl_event event, cl_event_info name, size_t size, void* value, size_t* used),
                   (event, name, size, value, used))

BOOST_AUTO_TEST_CASE(a_launch_that_fails_says_how_large_its_groups_were) {
  const Seeds seeds = Seeds::random(test_device(), grid, 40, 1);
  Diagram diagram(test_device(), grid);
  std::size_t launches = 0;
  for (int call = 1;; ++call) {
    fault().set(call);
    std::string text;
    try {
      exact_diagram(seeds, diagram);
    } catch (const Error& error) {
      text = error.what();
    }
    fault().set(0);
    if (text.empty()) break;
    if (text.find("launching ") != 0) continue;
    ++launches;
    BOOST_TEST(text.find(" in groups of ") != std::string::npos, text);
    BOOST_TEST(text.find(" (of which it takes at most ") != std::string::npos, text);
  }
  BOOST_TEST(launches > 0u);
}

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
        for (int frame = 0; frame < earlier_frames; ++frame) method.run(before, *diagram, {});
        diagram->wait();
        filled = false;
      };
      const auto run = [&] {
        method.run(seeds, *diagram, {});
        filled = true;
      };
      const auto judge = [&] {
        if (filled) return;
        dynamic_jump_flooding(seeds, *diagram);
        BOOST_TEST((diagram->read() == expected));
      };
      BOOST_TEST_CONTEXT(method.name << " after " << earlier_frames << " frames") {
        BOOST_TEST(fail_each_call(start, run, judge) >= 5);
      }
    }
  }
}

BOOST_AUTO_TEST_CASE(a_transform_that_fails_can_be_run_again) {
  const std::vector<std::uint8_t> image = [] {
    std::vector<std::uint8_t> pixels(grid.pixels(), 1);
    for (std::size_t i = 0; i < pixels.size(); i += 97) pixels[i] = 0;
    return pixels;
  }();
  const auto ranks_by = [&](DistanceTransform& transform) {
    std::vector<std::uint32_t> ranks(image.size());
    TransformTargets targets;
    targets.ranks = {ranks.data(), PixelType::uint32};
    transform.run({image.data(), PixelType::uint8}, targets);
    return ranks;
  };
  DistanceTransform never_failed(test_device(), grid);
  const std::vector<std::uint32_t> expected = ranks_by(never_failed);
  std::optional<DistanceTransform> transform;
  const auto start = [&] { transform.emplace(test_device(), grid); };
  const auto judge = [&] { BOOST_TEST((ranks_by(*transform) == expected)); };
  BOOST_TEST(fail_each_call(
                 start, [&] { ranks_by(*transform); }, judge) >= 10);
}

BOOST_AUTO_TEST_CASE(masks_that_fail_to_be_seeds_can_be_taken_again) {
  std::vector<std::uint8_t> mask(grid.pixels());
  for (std::size_t i = 0; i < mask.size(); i += 97) mask[i] = 1;
  const auto labels = [&] {
    Diagram diagram(test_device(), grid);
    exact_diagram(Seeds::from_mask(test_device(), grid, mask), diagram);
    return diagram.read();
  };
  const std::vector<std::uint32_t> expected = labels();
  const auto judge = [&] { BOOST_TEST((labels() == expected)); };
  BOOST_TEST(fail_each_call([] {}, [&] { labels(); }, judge) >= 10);
}

BOOST_AUTO_TEST_CASE(seeds_that_fail_to_move_have_the_points_that_they_had) {
  const auto before = some_points(20), after = some_points(30);
  const auto values = transformed(after, [](const std::optional<Point>& point) {
    return cl_float2{{static_cast<float>(point->x), static_cast<float>(point->y)}};
  });
  const cl::Buffer buffer(test_device().queue(), values.begin(), values.end(), true);
  std::optional<Seeds> seeds;
  bool moved = false;
  const auto start = [&] {
    seeds.emplace(test_device(), grid, before, to_centres);
    moved = false;
  };
  const auto judge = [&] {
    const auto& expected = moved ? after : before;
    BOOST_TEST(seeds->alive() == expected.size());
    BOOST_TEST(centres_of(*seeds)[7].x == expected[7]->x);
    random_step(*seeds, 1, Border::reflect, 1, 1);
    seeds->move_to(after);
    BOOST_TEST(centres_of(*seeds)[7].x == after[7]->x);
  };
  const auto calls = [&](const std::function<void()>& move) {
    const auto run = [&] {
      move();
      moved = true;
    };
    return fail_each_call(start, run, judge);
  };
  BOOST_TEST(calls([&] { seeds->move_to(after); }) >= 1);
  BOOST_TEST(calls([&] { seeds->move_to(PointBuffer(buffer, 30)); }) >= 4);
}

BOOST_AUTO_TEST_CASE(windows_that_fail_can_be_made_again) {
  const std::vector<Point> points = {{-9, 3}, {20, 20}, {400, 90000}};
  const Window window(Grid(95, 80, Axes::x), 60, 20, 70, 50);
  const Seeds around(test_device(), window.grid(), points, to_centres);
  Diagram fresh(test_device(), window);
  exact_diagram(around, fresh);
  const std::vector<std::uint32_t> expected = fresh.read();
  const double largest_distance = shapes_of(fresh)[0].largest_distance;

  std::optional<Seeds> seeds;
  std::optional<Diagram> diagram;
  CellShapesResult shapes;
  const auto start = [&] {
    seeds.emplace(test_device(), window.grid(), std::vector<Point>{{1, 1}, {2, 2}}, to_centres);
    diagram.emplace(test_device(), window);
    shapes = CellShapesResult();
  };
  const auto run = [&] {
    seeds->move_to(points);
    exact_diagram(*seeds, *diagram);
    cell_shapes(*diagram, shapes);
  };
  const auto judge = [&] {
    BOOST_TEST(seeds->outside() == (seeds->size() == 3 ? 1u : 0u));
    run();
    BOOST_TEST((diagram->read() == expected));
    BOOST_TEST(shapes.read()[0].largest_distance == largest_distance);
  };
  BOOST_TEST(fail_each_call(start, run, judge) >= 20);
}

BOOST_AUTO_TEST_CASE(volumes_that_fail_can_be_made_again) {
  const Grid volume(12, 10, 8);
  const std::vector<Point> points = {{9, 3, 1}, {2, 5, 6}, {11, 9, 7}};
  const Seeds whole(test_device(), volume, points);
  Diagram fresh(test_device(), volume);
  jump_flooding(whole, fresh);
  const std::vector<std::uint32_t> flooded = fresh.read();
  exact_diagram(whole, fresh);
  const std::vector<std::uint32_t> expected = fresh.read();

  std::optional<Seeds> seeds;
  std::optional<Diagram> diagram, other;
  DistanceErrorsResult errors;
  const auto start = [&] {
    seeds.emplace(test_device(), volume, std::vector<Point>{{1, 1, 1}, {2, 2, 2}});
    diagram.emplace(test_device(), volume);
    other.emplace(test_device(), volume);
    errors = DistanceErrorsResult();
  };
  const auto run = [&] {
    seeds->move_to(points);
    exact_diagram(*seeds, *diagram);
    jump_flooding(*seeds, *other);
    distance_errors(*other, *diagram, errors);
  };
  const auto judge = [&] {
    run();
    BOOST_TEST((diagram->read() == expected));
    BOOST_TEST((other->read() == flooded));
    BOOST_TEST(errors.read().pixels == volume.pixels());
  };
  BOOST_TEST(fail_each_call(start, run, judge) >= 20);
}

// The labels may be anything then: dJFA does not go on from them.
BOOST_AUTO_TEST_CASE(a_diagram_whose_wait_fails_counts_as_never_filled) {
  const Seeds seeds = Seeds::random(test_device(), grid, 40, 1);
  const auto waves = static_cast<int>(jump_flooding_plan(grid).size());
  const DynamicJumpFloodingOptions paper = {Metric::euclidean, {}, 0, Reach::paper};
  std::optional<Diagram> diagram;
  bool waited = false;
  const auto start = [&] {
    diagram.emplace(test_device(), grid);
    dynamic_jump_flooding(seeds, *diagram, paper);
    test_device().finish();
    waited = false;
  };
  const auto read = [&] {
    diagram->read();
    waited = true;
  };
  const auto judge = [&] {
    BOOST_TEST((dynamic_jump_flooding(seeds, *diagram, paper).waves() == waves) == !waited);
  };
  BOOST_TEST(fail_each_call(start, read, judge) >= 3);
}

BOOST_AUTO_TEST_CASE(programs_that_fail_to_build_are_built_the_next_time) {
  std::optional<Device> device;
  const auto start = [&] { device.emplace(Device::select()); };
  const auto run = [&] {
    Diagram diagram(*device, grid);
    Field<std::uint8_t> mask;
    border_mask(diagram, mask);
    mask.read();
  };
  BOOST_TEST(fail_each_call(start, run, run) >= 5);
}

// Results that held something before: nothing of it can be taken for what the failed call found.
BOOST_AUTO_TEST_CASE(measures_that_fail_are_empty) {
  const Seeds seeds = Seeds::random(test_device(), grid, 40, 1);
  Diagram diagram(test_device(), grid), flooded(test_device(), grid);
  exact_diagram(seeds, diagram);
  flood(seeds, flooded, {{1, Neighbourhood::moore}}, Metric::euclidean);
  CellSumsResult sums;
  CellShapesResult shapes;
  AdjacencyResult pairs;
  Field<float> field;
  CellStatisticsResult statistics;
  SimilarityResult same;
  DistanceErrorsResult errors;
  VerticesResult corners;
  const auto fails_when_measured = [&](const auto& measure, const auto& is_empty) {
    bool measured = false;
    const auto start = [&] {
      measure();
      measured = false;
    };
    const auto run = [&] {
      measure();
      measured = true;
    };
    const auto judge = [&] { BOOST_TEST(is_empty() == !measured); };
    const int calls = fail_each_call(start, run, judge);
    BOOST_TEST(calls >= 3);
  };
  fails_when_measured([&] { cell_sums(diagram, sums); },
                      [&] { return sums.size() == 0 && sums.area()() == nullptr && sums.read().empty(); });
  fails_when_measured(
      [&] { cell_shapes(diagram, shapes); },
      [&] { return shapes.size() == 0 && shapes.boxes()() == nullptr && shapes.read().empty(); });
  fails_when_measured([&] { adjacency(diagram, pairs); },
                      [&] {
                        return pairs.pairs() == 0 && pairs.neighbours()() == nullptr &&
                               pairs.read_perimeters().empty();
                      });
  fails_when_measured([&] { distance_field(diagram, field); },
                      [&] { return field.values()() == nullptr && field.read().empty(); });
  fails_when_measured([&] { cell_statistics(diagram, statistics); },
                      [&] { return statistics.read().pixels == 0; });
  fails_when_measured([&] { similarity(flooded, diagram, same); },
                      [&] { return same.differences()() == nullptr && same.read() == 100; });
  fails_when_measured([&] { distance_errors(flooded, diagram, errors); },
                      [&] { return errors.read().wrong_pixels == 0; });
  fails_when_measured([&] { vertices(diagram, corners); },
                      [&] { return corners.count() == 0 && corners.read().empty(); });
  ExactCellsResult exact;
  fails_when_measured(
      [&] { exact_cells(seeds, exact); },
      [&] { return exact.size() == 0 && exact.areas()() == nullptr && exact.read().empty(); });
  exact_cells(seeds, exact);
  const std::vector<double> lengths = exact.read_polygons().lengths;
  fail_each_call([&] { exact_cells(seeds, exact); }, [&] { exact.edges(); },
                 [&] { BOOST_TEST((exact.size() == 0 || exact.read_polygons().lengths == lengths)); });
  // A cell with more edges than the first kernel has room for is cut when it is asked for.
  std::vector<Point> star = {{20, 15}};
  for (int i = 0; i < 40; ++i) star.push_back({20 + 10 * std::cos(0.15 * i), 15 + 10 * std::sin(0.15 * i)});
  const Seeds around(test_device(), grid, star, to_centres);
  exact_cells(around, exact);
  const double area = exact.read().front().area;
  fail_each_call([&] { exact_cells(around, exact); }, [&] { exact.areas(); },
                 [&] { BOOST_TEST((exact.size() == 0 || exact.read().front().area == area)); });
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
