// Diagrams remember what they were made from: measures taken after the seeds have moved on are those of the
// frame, the metric and the grid of the diagram.
#define BOOST_TEST_MODULE diagram_memory
#include <cmath>
#include <functional>
#include <limits>

#include "all_measures.hpp"
#include "brute_force.hpp"
#include "fixture.hpp"

using namespace vorocl;

namespace {

using Move = std::function<void(std::optional<Seeds>&)>;

cl::Buffer buffer_of(const std::vector<Point>& points) {
  const auto values = transformed(points, [](const Point& point) {
    return cl_float2{{static_cast<float>(point.x), static_cast<float>(point.y)}};
  });
  return cl::Buffer(test_device().queue(), values.begin(), values.end(), true);
}

/// Points all over a grid, in its units.
std::vector<Point> points_on(const Grid& grid, std::size_t count, unsigned rng_seed) {
  return transformed(random_pixels(grid, count, rng_seed),
                     [&](const Pixel& pixel) { return grid.point(centre(pixel)); });
}

std::vector<std::pair<std::string, Move>> moves(const Grid& grid) {
  const auto points = [=](unsigned rng_seed) { return points_on(grid, 60, rng_seed); };
  return {
      {"once", [=](std::optional<Seeds>& seeds) { seeds->move_to(points(2)); }},
      {"twice",
       [=](std::optional<Seeds>& seeds) {
         seeds->move_to(points(2));
         seeds->move_to(points(3));
       }},
      {"to fewer and to more",
       [=](std::optional<Seeds>& seeds) {
         seeds->move_to(points_on(grid, 3, 2));
         seeds->move_to(points_on(grid, 700, 3));
       }},
      {"by random steps",
       [=](std::optional<Seeds>& seeds) {
         for (std::uint32_t frame = 1; frame <= 3; ++frame) {
           random_step(*seeds, 9, Border::reflect, 1, frame);
         }
       }},
      {"by relaxing",
       [=](std::optional<Seeds>& seeds) {
         Diagram other(test_device(), grid);
         relax(*seeds, other, engine(method("exact")), 3);
       }},
      {"by buffers",
       [=](std::optional<Seeds>& seeds) {
         seeds->move_to(PointBuffer(buffer_of(points(2)), 60));
         seeds->move_to(PointBuffer(buffer_of(points(3)), 60));
       }},
      {"to another grid",
       [=](std::optional<Seeds>& seeds) {
         const Grid other(500, 30, Axes::xy);
         seeds->move_to(other, points_on(other, 60, 2));
       }},
      {"away", [](std::optional<Seeds>& seeds) { seeds.reset(); }},
  };
}

}  // namespace

BOOST_AUTO_TEST_CASE(measures_are_of_the_frame_that_the_diagram_was_made_from) {
  const Grid pixels(130, 70), torus(130, 70, Axes::xy), data(Axis(130, -1, 1).periodic(), Axis(70, 0, 7));
  for (const Grid& grid : {pixels, torus, data}) {
    for (const Window& window : {Window(grid), Window(grid, 40, 11, 50, 37)}) {
      for (const Metric metric : both_metrics) {
        for (const auto& [name, move] : moves(grid)) {
          std::optional<Seeds> seeds(std::in_place, test_device(), grid, points_on(grid, 60, 1), to_centres);
          Diagram exact(test_device(), window), diagram(test_device(), window);
          exact_diagram(*seeds, exact, {metric});
          std::vector<std::uint32_t> labels = exact.read();
          for (std::size_t i = 0; i < labels.size(); i += 5) labels[i] = static_cast<std::uint32_t>(i % 61);
          for (std::uint32_t& label : labels) label = label == 60 ? no_label : label;
          diagram.write(labels, *seeds, metric);
          AllMeasures before, after;
          before.take(diagram, exact);
          const std::vector<double> expected = before.read(), table = table_of(diagram);
          const double sum = window.is_whole() ? energy(diagram) : 0;
          move(seeds);
          after.take(diagram, exact);
          BOOST_TEST_CONTEXT(name << ", " << name_of(metric) << ", from column " << window.x()) {
            BOOST_TEST((after.read() == expected));
            BOOST_TEST((before.read() == expected));
            BOOST_TEST((table_of(diagram) == table));
            if (window.is_whole()) BOOST_TEST(energy(diagram) == sum);
            BOOST_TEST((diagram.metric() == metric));
          }
        }
      }
    }
  }
}

// Each engine leaves the metric that it was told.
BOOST_AUTO_TEST_CASE(a_manhattan_diagram_is_measured_by_manhattan) {
  const Grid grid(97, 53);
  const std::vector<Pixel> pixels = random_pixels(grid, 40, 1);
  const Seeds seeds(test_device(), grid, centres(pixels), to_centres);
  for (const Method& each : methods()) {
    for (const Metric metric : both_metrics) {
      if (each.name == "low-resolution" && metric == Metric::manhattan) continue;
      Diagram diagram(test_device(), grid);
      each.run(seeds, diagram, {metric});
      const std::vector<std::uint32_t> labels = diagram.read();
      Field<std::int32_t> field;
      CellShapesResult shapes;
      distance_field(diagram, field);
      cell_shapes(diagram, shapes);
      const std::vector<std::int32_t> distances = field.read();
      std::vector<double> largest(pixels.size(), -1);
      std::size_t wrong = 0;
      for (std::size_t i = 0; i < labels.size(); ++i) {
        const Pixel at = {static_cast<int>(i % 97), static_cast<int>(i / 97)};
        const std::int64_t d = distance(at, pixels[labels[i]], metric);
        largest[labels[i]] = std::max(largest[labels[i]], static_cast<double>(d));
        wrong += distances[i] != d ? 1 : 0;
      }
      BOOST_TEST(wrong == 0u, each.name << ", " << name_of(metric));
      const auto found =
          transformed(shapes.read(), [](const CellShape& cell) { return cell.largest_distance; });
      BOOST_TEST((found == largest), each.name << ", " << name_of(metric));
    }
  }
}

BOOST_AUTO_TEST_CASE(labels_written_without_seeds_cannot_be_measured) {
  const Grid grid(30, 20);
  const Seeds seeds(test_device(), grid, centres(random_pixels(grid, 9, 1)), to_centres);
  Diagram diagram(test_device(), grid), exact(test_device(), grid);
  exact_diagram(seeds, diagram);
  exact_diagram(seeds, exact);
  const std::vector<std::uint32_t> labels = diagram.read();
  AllMeasures measures;
  measures.take(diagram, exact);
  const std::vector<double> expected = measures.read();

  const cl::Buffer other = exact.labels();
  for (const bool from_buffer : {false, true}) {
    if (from_buffer) {
      diagram.write(other);
    } else {
      diagram.write(labels);
    }
    BOOST_TEST(diagram.method().empty());
    check_error([&] { diagram.metric(); }, {"metric"});
    check_error([&] { energy(diagram); }, {"seeds"});
    check_error([&] { cell_table(diagram); }, {"seeds"});
    check_error([&] { AllMeasures().take(diagram, exact); }, {"seeds"});
    Field<std::uint8_t> mask;
    VerticesResult corners;
    SimilarityResult same;
    border_mask(diagram, mask);  // labels alone are enough for these
    vertices(diagram, corners);
    similarity(diagram, exact, same);
    BOOST_TEST(same.read() == 100.0);

    if (from_buffer) {
      diagram.write(other, seeds, Metric::euclidean);
    } else {
      diagram.write(labels, seeds, Metric::euclidean);
    }
    measures.take(diagram, exact);
    BOOST_TEST((measures.read() == expected));
    BOOST_TEST((diagram.read() == labels));
  }
}

// A bad point is found when the device comes to it: whatever was made from its frame says so, and nothing
// that was made later.
BOOST_AUTO_TEST_CASE(a_bad_point_is_remembered_with_its_frame) {
  const Grid grid(64, 64);
  const cl::Buffer good = buffer_of({{3, 3}, {60, 60}});
  const cl::Buffer bad = buffer_of({{3, 3}, {std::numeric_limits<double>::quiet_NaN(), 60}});
  Seeds seeds(test_device(), grid, PointBuffer(bad, 2), kept_on_device);
  Diagram from_bad(test_device(), grid), from_good(test_device(), grid);
  exact_diagram(seeds, from_bad);
  CellSumsResult sums;
  Field<float> distances;
  cell_sums(from_bad, sums);
  seeds.move_to(PointBuffer(good, 2));
  exact_diagram(seeds, from_good);
  distance_field(from_bad, distances);
  const auto check_bad = [](const std::function<void()>& use) {
    BOOST_CHECK_EXCEPTION(use(), BadPoint, [](const BadPoint& error) { return error.index() == 1; });
  };
  check_bad([&] { from_bad.read(); });
  check_bad([&] { from_bad.wait(); });
  check_bad([&] { sums.read(); });
  check_bad([&] { distances.read(); });
  check_bad([&] { cell_table(from_bad); });
  BOOST_TEST((from_good.read() == brute_force(grid, {{3, 3}, {60, 60}}, Metric::euclidean)));
  BOOST_TEST(cell_table(from_good).size() == 2u);
}
