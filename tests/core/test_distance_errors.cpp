// Errors of diagrams against straight host code.
#define BOOST_TEST_MODULE distance_errors
#include <cmath>
#include <optional>

#include "measured_cases.hpp"
#include "read_measures.hpp"

using namespace vorocl;

namespace {

DistanceErrors on_the_host(const Grid& grid, const std::vector<Pixel>& seeds, Metric metric,
                           const std::vector<std::uint32_t>& labels,
                           const std::vector<std::uint32_t>& exact) {
  DistanceErrors errors;
  errors.pixels = grid.pixels();
  const DistanceIn distance(grid, metric);
  each_pixel(grid, exact, [&](std::uint32_t nearest, const Pixel& pixel) {
    const std::uint32_t label = label_at(grid, labels, pixel);
    const std::int64_t least = distance(pixel, seeds.at(nearest));
    if (label >= seeds.size()) {
      ++errors.wrong_pixels;
      ++errors.unlabelled_pixels;
    } else if (const std::int64_t d = distance(pixel, seeds[label]); d > least) {
      ++errors.wrong_pixels;
      const double excess = length_of(d, metric) - length_of(least, metric);
      errors.largest_excess = std::max(errors.largest_excess, excess);
      errors.mean_excess += excess / static_cast<double>(errors.pixels);
    }
  });
  return errors;
}

void check(const std::string& name, const Device& device, const Case& example, Metric metric,
           const Labels& labels, const Labels& ground_truth) {
  const Seeds seeds(device, example.grid, centres(example.seeds), to_centres);
  Diagram exact(device, example.grid), diagram(device, example.grid);
  exact.write(ground_truth, seeds, metric);
  diagram.write(labels, seeds, metric);
  const DistanceErrors found = errors_of(diagram, exact);
  const DistanceErrors expected = on_the_host(example.grid, example.seeds, metric, labels, ground_truth);
  BOOST_TEST_CONTEXT(example.name << ", " << name << ", " << name_of(metric)) {
    BOOST_TEST(found.pixels == example.grid.pixels());
    BOOST_TEST(found.wrong_pixels == expected.wrong_pixels);
    BOOST_TEST(found.unlabelled_pixels == expected.unlabelled_pixels);
    BOOST_TEST(found.largest_excess == expected.largest_excess, boost::test_tools::tolerance(1e-5));
    BOOST_TEST(found.mean_excess == expected.mean_excess, boost::test_tools::tolerance(1e-4));
  }
}

}  // namespace

BOOST_AUTO_TEST_CASE(errors_are_those_of_the_host) {
  for (const Metric metric : both_metrics) {
    std::vector<Case> examples = all_edge_cases(metric);
    for (const Grid& grid : {Grid(50, 40, 30), Grid(33, 20, 9, Axes::xyz),
                             Grid(Axis(50).spaced(2), Axis(40), Axis(30).spaced(4))}) {
      examples.push_back({"volume", grid, random_pixels(grid, 60, 7)});
    }
    for (const Case& example : examples) {
      const auto cells = static_cast<std::uint32_t>(example.seeds.size());
      const Labels ground_truth = brute_force(example.grid, example.seeds, metric);
      for (const Device& device : shapes()) {
        if (!is_for(device, example.grid)) continue;
        check("random labels", device, example, metric, random_labels(example.grid, cells, 4), ground_truth);
        check("exact labels", device, example, metric, ground_truth, ground_truth);
      }
    }
  }
}

// Whichever work-item compares a pixel, and however its group adds: the same bits.
BOOST_AUTO_TEST_CASE(comparisons_are_the_same_in_every_shape_and_group) {
  const std::vector<Tuning> tunings = {{16, 64, 1, Shape::vector},
                                       {4, 5, 3, Shape::vector},
                                       {4, 32, 8, Shape::group},
                                       {1, 5, 3, Shape::group},
                                       {1, 64, 8, Shape::group}};
  for (const Grid& grid : {Grid(700, 300), Grid(1, 1), Grid(17, 1)}) {
    const std::vector<Pixel> pixels = random_pixels(grid, 50, 6);
    const Labels labels = random_labels(grid, 50, 4);
    const Labels truth = brute_force(grid, pixels, Metric::euclidean);
    const DistanceErrors host = on_the_host(grid, pixels, Metric::euclidean, labels, truth);
    std::optional<DistanceErrors> first;
    for (const Tuning& tuning : tunings) {
      const Device device = test_device().with_tuning(tuning);
      const Seeds seeds(device, grid, centres(pixels), to_centres);
      Diagram exact(device, grid), diagram(device, grid);
      exact.write(truth, seeds, Metric::euclidean);
      diagram.write(labels, seeds, Metric::euclidean);
      const DistanceErrors errors = errors_of(diagram, exact);
      if (!first) first = errors;
      SimilarityResult different, distant;
      similarity(diagram, exact, different);
      similarity(diagram, exact, 0, distant);
      BOOST_TEST_CONTEXT(grid.width() << " pixels, shape " << static_cast<int>(tuning.shape) << ", "
                                      << tuning.group_width << " x " << tuning.group_height) {
        BOOST_TEST(errors.wrong_pixels == host.wrong_pixels);
        BOOST_TEST(errors.unlabelled_pixels == host.unlabelled_pixels);
        BOOST_TEST(errors.mean_excess == first->mean_excess);
        BOOST_TEST(errors.largest_excess == first->largest_excess);
        BOOST_TEST(errors.mean_excess == host.mean_excess, boost::test_tools::tolerance(1e-5));
        BOOST_TEST(different.read() == similarity(labels, truth));
        BOOST_TEST(distant.read_differences() == host.wrong_pixels);
      }
    }
  }
}

BOOST_AUTO_TEST_CASE(errors_of_flooding_are_few_and_small) {
  const Grid grid(700, 300);
  const Seeds seeds(test_device(), grid, centres(random_pixels(grid, 2000, 6)), to_centres);
  Diagram exact(test_device(), grid), diagram(test_device(), grid);
  exact_diagram(seeds, exact);
  jump_flooding(seeds, diagram);
  const DistanceErrors errors = errors_of(diagram, exact);
  const DistanceErrors expected =
      on_the_host(grid, random_pixels(grid, 2000, 6), Metric::euclidean, diagram.read(), exact.read());
  BOOST_TEST(errors.wrong_pixels == expected.wrong_pixels);
  BOOST_TEST(errors.wrong_pixels > 0u);
  BOOST_TEST(errors.wrong_percent() < 0.1);
  BOOST_TEST(errors.largest_excess < 2);
  BOOST_TEST(errors.mean_excess > 0);
}

BOOST_AUTO_TEST_CASE(a_tie_is_not_wrong) {
  const Grid grid(5, 1);
  const Seeds seeds(test_device(), grid, centres({{0, 0}, {4, 0}, {0, 0}}), to_centres);
  Diagram exact(test_device(), grid), diagram(test_device(), grid);
  exact_diagram(seeds, exact);
  BOOST_REQUIRE((exact.read() == std::vector<std::uint32_t>{0, 0, 0, 1, 1}));
  diagram.write(std::vector<std::uint32_t>{2, 0, 1, 1, 1}, seeds, Metric::euclidean);
  BOOST_TEST(errors_of(diagram, exact).wrong_pixels == 0u);
  diagram.write(std::vector<std::uint32_t>{2, 1, 1, 7, no_label}, seeds, Metric::euclidean);
  const DistanceErrors errors = errors_of(diagram, exact);
  BOOST_TEST(errors.wrong_pixels == 3u);
  BOOST_TEST(errors.unlabelled_pixels == 2u);
  BOOST_TEST(errors.wrong_percent() == 60);
  BOOST_TEST(errors.largest_excess == 2);
  BOOST_TEST(errors.mean_excess == 2.0 / 5, boost::test_tools::tolerance(1e-6));
}

BOOST_AUTO_TEST_CASE(the_longest_distances_there_are) {
  const Grid grid(Window::max_side, 2);
  const Seeds seeds(test_device(), grid, centres({{0, 0}, {32767, 1}}), to_centres);
  for (const Metric metric : both_metrics) {
    Diagram exact(test_device(), grid), diagram(test_device(), grid);
    exact_diagram(seeds, exact, {metric});
    diagram.write(std::vector<std::uint32_t>(grid.pixels(), 0), seeds, metric);
    const DistanceErrors errors = errors_of(diagram, exact);
    const double farthest = metric == Metric::euclidean ? std::sqrt(32767.0 * 32767.0 + 1) : 32768;
    BOOST_TEST(errors.largest_excess == farthest, boost::test_tools::tolerance(1e-6));
    BOOST_TEST(errors.unlabelled_pixels == 0u);
  }
}

// A result that serves frame after frame holds the last one's errors alone.
BOOST_AUTO_TEST_CASE(one_result_serves_one_diagram_after_another) {
  const Grid grid(31, 17);
  const Seeds seeds(test_device(), grid, centres(random_pixels(grid, 9, 1)), to_centres);
  Diagram exact(test_device(), grid), diagram(test_device(), grid);
  exact_diagram(seeds, exact);
  DistanceErrorsResult result;
  BOOST_TEST(result.read().pixels == 0u);
  diagram.write(std::vector<std::uint32_t>(grid.pixels(), no_label), seeds, Metric::euclidean);
  distance_errors(diagram, exact, result);
  BOOST_TEST(result.read().unlabelled_pixels == grid.pixels());
  distance_errors(exact, exact, result);
  BOOST_TEST(result.read().pixels == grid.pixels());
  BOOST_TEST(result.read().wrong_pixels == 0u);
}

BOOST_AUTO_TEST_CASE(diagrams_that_do_not_fit_are_refused) {
  const Grid grid(10, 20);
  Seeds seeds(test_device(), grid, {{1, 1}}, to_centres);
  const Seeds others(test_device(), Grid(20, 10), {{1, 1}}, to_centres);
  Diagram exact(test_device(), grid), diagram(test_device(), grid), other(test_device(), Grid(20, 10));
  exact_diagram(seeds, exact);
  DistanceErrorsResult result;
  check_error([&] { distance_errors(diagram, exact, result); }, {"seeds"});
  exact_diagram(others, other);
  check_error([&] { distance_errors(other, exact, result); }, {"different windows"});
  check_error([&] { distance_errors(exact, other, result); }, {"different windows"});
  exact_diagram(seeds, diagram, {Metric::manhattan});
  check_error([&] { distance_errors(diagram, exact, result); }, {"metric"});
  seeds.move_to({{2, 2}});
  exact_diagram(seeds, diagram);
  check_error([&] { distance_errors(diagram, exact, result); }, {"frame"});
  exact_diagram(seeds, exact);
  distance_errors(diagram, exact, result);
  BOOST_TEST(result.read().wrong_pixels == 0u);
}
