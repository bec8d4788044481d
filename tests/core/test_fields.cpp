// Images that follow from a diagram, against straight host code.
#define BOOST_TEST_MODULE fields
#include <limits>

#include "measured_cases.hpp"
#include "vorocl/fields.hpp"

using namespace vorocl;

namespace {

void check_fields(const Case& test, const Diagram& diagram) {
  const Grid& grid = test.grid;
  const Metric metric = diagram.metric();
  const Labels labels = diagram.read();
  Field<std::int32_t> integers;
  Field<float> floats;
  Field<std::uint8_t> mask;
  distance_field(diagram, integers);
  distance_field(diagram, floats);
  border_mask(diagram, mask);
  const std::vector<std::int32_t> integer = integers.read();
  const std::vector<float> in_pixels = floats.read();
  const std::vector<std::uint8_t> border = mask.read();
  BOOST_TEST_REQUIRE((integer.size() == labels.size() && in_pixels.size() == labels.size()));
  BOOST_TEST_REQUIRE(border.size() == labels.size());
  const DistanceIn distance(grid, metric);
  std::size_t wrong_integers = 0, wrong_floats = 0, wrong_border = 0;
  for (std::size_t i = 0; i < labels.size(); ++i) {
    const Pixel pixel = pixel_at(grid, i);
    const bool is_absent = labels[i] < test.absent.size() && test.absent[labels[i]];
    if (labels[i] == no_label || is_absent) {
      wrong_integers += integer[i] != no_distance ? 1 : 0;
      wrong_floats += !std::isinf(in_pixels[i]) ? 1 : 0;
    } else {
      const std::int64_t d = distance(pixel, test.seeds[labels[i]]);
      const double length = length_of(d, metric);
      wrong_integers += integer[i] != d ? 1 : 0;
      wrong_floats += std::abs(in_pixels[i] - length) > length * 4e-7 ? 1 : 0;
    }
    const std::vector<Pixel> others = beside(grid, pixel);
    const bool expected = std::any_of(others.begin(), others.end(), [&](const Pixel& other) {
      return label_at(grid, labels, other) != labels[i];
    });
    wrong_border += border[i] != (expected ? 1 : 0) ? 1 : 0;
  }
  BOOST_TEST(wrong_integers == 0u, test.name << ": " << wrong_integers << " integer distances are wrong");
  BOOST_TEST(wrong_floats == 0u, test.name << ": " << wrong_floats << " distances in pixels are wrong");
  BOOST_TEST(wrong_border == 0u, test.name << ": " << wrong_border << " pixels are wrong about the border");
}

}  // namespace

BOOST_AUTO_TEST_CASE(fields_are_those_of_the_host) {
  for (const Device& device : shapes()) {
    for (const Case& test : measured_cases(device)) {
      Diagram diagram(device, test.grid);
      fill(test, seeds_of(device, test), diagram,
           test.seeds.size() % 2 == 0 ? Metric::euclidean : Metric::manhattan);
      check_fields(test, diagram);
    }
  }
}

BOOST_AUTO_TEST_CASE(the_longest_distance_there_is) {
  const Grid grid(Window::max_side, 3);
  const Seeds seeds(test_device(), grid, std::vector<Point>{{0.5, 0.5}}, to_centres);
  Diagram diagram(test_device(), grid);
  jump_flooding(seeds, diagram);
  Field<std::int32_t> field;
  distance_field(diagram, field);
  BOOST_TEST(field.read().back() == 32767 * 32767 + 4);
}

BOOST_AUTO_TEST_CASE(labels_are_looked_up_in_a_table) {
  for (const Device& device : shapes()) {
    for (const Grid& grid : {Grid(1, 1), Grid(97, 53), Grid(640, 3, Axes::x), Grid(37, 19, 12)}) {
      if (!is_for(device, grid)) continue;
      const Seeds seeds(device, grid, centres(random_pixels(grid, 40, 1)), to_centres);
      Diagram diagram(device, grid);
      const std::vector<std::uint32_t> labels = random_labels(grid, 40, 2);
      diagram.write(labels, seeds, Metric::euclidean);
      std::vector<std::uint32_t> table;
      for (std::uint32_t id = 0; id < 40; ++id) table.push_back(id * 2654435761u);
      const auto expected = transformed(
          labels, [&](std::uint32_t label) { return label == no_label ? no_label : table[label]; });
      Field<std::uint32_t> field;
      map_labels(diagram, table, field);
      BOOST_TEST((field.read() == expected));
      const cl::Buffer buffer(device.queue(), table.begin(), table.end(), true);
      Field<std::uint32_t> from_buffer;
      map_labels(diagram, buffer, from_buffer);
      BOOST_TEST((from_buffer.read() == expected));
    }
  }
}

BOOST_AUTO_TEST_CASE(a_table_that_cannot_be_read_is_refused) {
  const Grid grid(20, 10);
  const Seeds seeds(test_device(), grid, centres(random_pixels(grid, 40, 1)), to_centres);
  Diagram diagram(test_device(), grid);
  exact_diagram(seeds, diagram);
  Field<std::uint32_t> field;
  map_labels(diagram, std::vector<std::uint32_t>(50, 7), field);
  BOOST_TEST(field.read().front() == 7u);
  check_error([&] { map_labels(diagram, std::vector<std::uint32_t>(39), field); }, {"39", "40"});
  BOOST_TEST(field.read().empty());
  const cl::Context& context = test_device().context();
  check_error([&] { map_labels(diagram, cl::Buffer(), field); }, {"null"});
  check_error([&] { map_labels(diagram, cl::Buffer(context, CL_MEM_READ_WRITE, 156), field); },
              {"156", "160"});
  check_error([&] { map_labels(diagram, cl::Buffer(context, CL_MEM_WRITE_ONLY, 160), field); }, {"read"});
}

BOOST_AUTO_TEST_CASE(labels_expand_to_a_distance) {
  constexpr double infinite = std::numeric_limits<double>::infinity();
  for (const Device& device : shapes()) {
    for (const Grid& grid : {Grid(97, 53), Grid(64, 48, Axes::xy),
                             Grid(Axis(37).spaced(2), Axis(20), Axis(12).spaced(3).periodic())}) {
      const std::vector<Pixel> pixels = random_pixels(grid, 12, 3);
      const Seeds seeds(device, grid, centres(pixels), to_centres);
      Diagram diagram(device, grid);
      for (const Metric metric : both_metrics) {
        fill(seeds, diagram, metric);
        const std::vector<std::uint32_t> labels = diagram.read();
        for (const double most : {0.0, 0.99, 2.5, 5.0, 13.0, 1e300, infinite}) {
          const double bound = metric == Metric::euclidean ? most * most : most;
          std::vector<std::uint32_t> expected(labels.size(), no_label);
          each_pixel(grid, labels, [&](std::uint32_t label, const Pixel& pixel) {
            const auto d = static_cast<double>(distance(grid, pixel, pixels[label], metric));
            expected[index_of(grid, pixel)] = d <= bound ? label : no_label;
          });
          Field<std::uint32_t> field;
          expand_labels(diagram, most, field);
          BOOST_TEST((field.read() == expected), name_of(metric) << ", at most " << most << " pixels");
        }
      }
    }
  }
}

// Distances of more than 31 bits.
BOOST_AUTO_TEST_CASE(labels_of_seeds_far_away_expand_too) {
  const Grid grid(61, 47);
  const Seeds seeds(test_device(), grid, {{-3e6 + 0.5, 10.5}, {3e6 + 60.5, 40.5}}, to_centres);
  Diagram diagram(test_device(), grid);
  exact_diagram(seeds, diagram);
  const std::vector<std::uint32_t> labels = diagram.read();
  constexpr std::int64_t reach = 3000010;
  std::vector<std::uint32_t> expected;
  for (int y = 0, i = 0; y < 47; ++y) {
    for (int x = 0; x < 61; ++x, ++i) {
      const std::uint32_t label = labels[static_cast<std::size_t>(i)];
      const std::int64_t dx = label == 0 ? x + 3000000 : 3000060 - x, dy = label == 0 ? y - 10 : y - 40;
      expected.push_back(dx * dx + dy * dy <= reach * reach ? label : no_label);
    }
  }
  BOOST_TEST(std::count(expected.begin(), expected.end(), no_label) > 40 * 47);
  Field<std::uint32_t> field;
  expand_labels(diagram, static_cast<double>(reach), field);
  BOOST_TEST((field.read() == expected));
}

BOOST_AUTO_TEST_CASE(labels_of_no_seeds_have_no_distances) {
  const Grid grid(20, 10);
  Diagram diagram(test_device(), grid);
  Field<float> distances;
  Field<std::uint32_t> labels;
  Field<std::uint8_t> mask;
  exact_diagram(Seeds(test_device(), grid, {{1, 1}}, to_centres), diagram);
  distance_field(diagram, distances);
  BOOST_TEST(distances.read().size() == grid.pixels());
  for (const double bad : {-0.1, std::nan("")}) {
    check_error([&] { expand_labels(diagram, bad, labels); }, {"distance"});
  }
  diagram.write(std::vector<std::uint32_t>(grid.pixels(), 0));
  check_error([&] { distance_field(diagram, distances); }, {"seeds"});
  BOOST_TEST(distances.read().empty());
  BOOST_TEST(distances.values()() == nullptr);
  check_error([&] { map_labels(diagram, std::vector<std::uint32_t>(9), labels); }, {"seeds"});
  check_error([&] { expand_labels(diagram, 1, labels); }, {"seeds"});
  border_mask(diagram, mask);  // which asks for labels alone
  BOOST_TEST((mask.read() == std::vector<std::uint8_t>(grid.pixels(), 0)));
}
