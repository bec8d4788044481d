// The registry of methods: each by its name does what its function does, and prepare() leaves nothing to
// build.
#define BOOST_TEST_MODULE method
#include <dlfcn.h>

#include "brute_force.hpp"
#include "fixture.hpp"

using namespace vorocl;

namespace {
int builds = 0;
}

/// Stands before the OpenCL loader's function and counts its calls.
extern "C" __attribute__((visibility("default"))) cl_int CL_API_CALL
clBuildProgram(cl_program program, cl_uint count, const cl_device_id* devices, const char* options,
               void(CL_CALLBACK* notify)(cl_program, void*), void* data) {
  static const auto next = reinterpret_cast<decltype(&clBuildProgram)>(dlsym(RTLD_NEXT, "clBuildProgram"));
  ++builds;
  return next(program, count, devices, options, notify, data);
}

BOOST_AUTO_TEST_CASE(methods_by_name) {
  for (const Method& each : methods()) BOOST_TEST(&method(each.name) == &each);
  check_error([] { method("jfa+3"); }, {"\"jfa+3\"", "standard-flooding", "1+jfa", "exact"});
}

// What a method says of itself is so: its waves, whether it is exact, whether it goes on from the last
// labels.
BOOST_AUTO_TEST_CASE(methods_are_what_they_say) {
  const Grid grid(90, 61);
  const std::vector<Pixel> pixels = random_pixels(grid, 400, 5);
  const Seeds seeds(test_device(), grid, centres(pixels), to_centres);
  for (const Metric metric : both_metrics) {
    const std::vector<std::uint32_t> ground_truth = brute_force(grid, pixels, metric);
    for (const Method& each : methods()) {
      if (each.name == "low-resolution" && metric == Metric::manhattan) continue;
      BOOST_TEST_CONTEXT(each.name << ", " << name_of(metric)) {
        Diagram diagram(test_device(), grid);
        const Report report = engine(each, {metric})(seeds, diagram);
        const double percent = similarity(diagram.read(), ground_truth);
        BOOST_TEST(percent >= 99.0);
        if (each.exact) BOOST_TEST(percent == 100.0);
        BOOST_TEST(diagram.method() == each.name);
        BOOST_TEST((diagram.metric() == metric));
        BOOST_TEST((each.plan == nullptr) == (report.waves() == 0));
        if (each.plan) {
          BOOST_TEST(each.plan(grid, report.waves(), {metric}).size() ==
                     static_cast<std::size_t>(report.waves()));
        }
        // Labels that are all of one seed: a method that starts anew does not see them.
        diagram.write(std::vector<std::uint32_t>(grid.pixels(), 0), seeds, metric);
        BOOST_TEST(diagram.method().empty());
        MethodOptions options;
        options.metric = metric;
        options.reach = Reach::paper;  // which does not measure the labels
        const Report again = each.run(seeds, diagram, options);
        BOOST_TEST((similarity(diagram.read(), ground_truth) != percent) == each.continues);
        BOOST_TEST((again.waves() < report.waves()) == each.continues);
      }
    }
  }
}

// Mixed waves are djfa's alone. Who checks the options beforehand hears the same.
BOOST_AUTO_TEST_CASE(impossible_options_are_refused) {
  const Grid grid(9, 5);
  const Seeds seeds(test_device(), grid, {{1, 1}}, to_centres);
  Diagram diagram(test_device(), grid);
  const MethodOptions mixed = {Metric::euclidean, NeighbourhoodMix::mixed};
  for (const Method& each : methods()) {
    BOOST_TEST_CONTEXT(each.name) {
      if (each.name == "djfa") {
        check_options(each, mixed);
        each.run(seeds, diagram, mixed);
        BOOST_TEST(to_string(each.plan(grid, 0, mixed)) == "8 4 2 1");
      } else {
        check_error([&] { check_options(each, mixed); }, {"mixed", "djfa"});
        check_error([&] { each.run(seeds, diagram, mixed); }, {"mixed", "djfa"});
      }
    }
  }
  check_error([&] { method("standard-flooding").plan(grid, -1, {}); }, {"-1 waves"});
  const MethodOptions von_neumann = {Metric::euclidean, NeighbourhoodMix::von_neumann};
  check_error([&] { check_options(method("low-resolution"), von_neumann); }, {"Moore", "von-neumann"});
  check_error([&] { method("low-resolution").run(seeds, diagram, von_neumann); }, {"Moore", "von-neumann"});
  check_error([&] { check_options(method("low-resolution"), {Metric::manhattan}); }, {"Euclidean", "jfa"});
  check_error([&] { method("low-resolution").run(seeds, diagram, {Metric::manhattan}); },
              {"Euclidean", "jfa"});
}

// Those that say so take a window, and seeds outside it; the others refuse them.
BOOST_AUTO_TEST_CASE(windows_are_for_those_that_say_so) {
  const Grid grid(60, 40, Axes::y);
  const Seeds seeds(test_device(), grid, {{3, 3}, {50, 30}}, to_centres);
  for (const Method& each : methods()) {
    BOOST_TEST_CONTEXT(each.name) {
      Diagram part(test_device(), Window(grid, 10, 35, 20, 10));
      if (each.windows) {
        each.run(seeds, part, {});
        BOOST_TEST(part.read()[0] == 0u);
        BOOST_TEST(part.read()[19] == 1u);
        BOOST_TEST(part.method() == each.name);
      } else {
        check_error([&] { each.run(seeds, part, {}); }, {"exact"});
        BOOST_TEST(part.method().empty());
      }
    }
  }
}

BOOST_AUTO_TEST_CASE(after_prepare_nothing_is_built) {
  const Grid grid(130, 70);
  for (const Method& each : methods()) {
    const Device device = Device::select();  // with no program yet
    const MethodOptions options = {each.name == "low-resolution" ? Metric::euclidean : Metric::manhattan};
    prepare(each, device, grid, 50, options, Snap::to_pixels);
    Seeds seeds(device, grid, Seeds::random(device, grid, 50, 3).read(), to_centres);
    Diagram diagram(device, grid);
    const int before = builds;
    BOOST_TEST(before > 0);
    for (int frame = 0; frame < 3; ++frame) {
      each.run(seeds, diagram, options);
      seeds.move_to({Point{1, 1}, Point{2, 2}});
    }
    diagram.wait();
    BOOST_TEST(builds == before, each.name << " built a program");
  }
}

// Labels written from a buffer are copied on the device; the wrong size is refused, and nothing is lost.
BOOST_AUTO_TEST_CASE(labels_are_written) {
  const Grid grid(40, 30);
  Diagram diagram(test_device(), grid), other(test_device(), grid);
  std::vector<std::uint32_t> labels(grid.pixels());
  for (std::size_t i = 0; i < labels.size(); ++i) labels[i] = static_cast<std::uint32_t>(i * 7);
  diagram.write(labels);
  BOOST_TEST((diagram.read() == labels));
  other.write(diagram.labels());
  BOOST_TEST((other.read() == labels));
  check_error([&] { diagram.write(std::vector<std::uint32_t>{1, 2, 3}); }, {"3 labels", "1200 pixels"});
  check_error([&] { diagram.write(cl::Buffer()); }, {"labels to write", "null"});
  BOOST_TEST((diagram.read() == labels));

  BOOST_TEST(diagram.method().empty());
  check_error([&] { diagram.metric(); }, {"metric"});

  // dJFA goes on from them: with the right ones it has nothing to mend.
  const std::vector<Pixel> pixels = random_pixels(grid, 20, 1);
  const Seeds seeds(test_device(), grid, centres(pixels), to_centres);
  const std::vector<std::uint32_t> ground_truth = brute_force(grid, pixels, Metric::euclidean);
  const auto waves = static_cast<int>(dynamic_jump_flooding_plan(grid, pixels.size(), 0).size());
  DynamicJumpFloodingOptions unmoved;
  unmoved.max_displacement = 0;
  diagram.write(ground_truth);
  BOOST_TEST(dynamic_jump_flooding(seeds, diagram, unmoved).waves() == waves);
  BOOST_TEST((diagram.read() == ground_truth));
  diagram.write(ground_truth, seeds, Metric::euclidean);
  BOOST_TEST((diagram.metric() == Metric::euclidean));
  BOOST_TEST(dynamic_jump_flooding(seeds, diagram).waves() ==
             waves);  // the seeds know that they did not move
  BOOST_TEST((diagram.read() == ground_truth));

  // Seeds of another grid have no labels here.
  const Seeds others(test_device(), Grid(30, 40), {{1, 1}}, to_centres);
  check_error([&] { diagram.write(ground_truth, others, Metric::euclidean); }, {"grid"});

  const Diagram taken = std::move(diagram);
  BOOST_TEST((taken.read() == ground_truth));
  check_error([&] { diagram.read(); }, {"moved from"});  // NOLINT(bugprone-use-after-move)
}
