// Distance fields and border masks, against straight host code.
#define BOOST_TEST_MODULE fields
#include "measured_cases.hpp"
#include "vorocl/fields.hpp"

using namespace vorocl;

namespace {

void check_fields(const std::string& name, const Seeds& seeds, const std::vector<Pixel>& pixels,
                  const Diagram& diagram, Metric metric) {
  const Grid& grid = diagram.grid();
  const std::vector<std::uint32_t> labels = diagram.read();
  Field<std::int32_t> integers;
  Field<float> floats;
  Field<std::uint8_t> mask;
  distance_field(seeds, diagram, integers, metric);
  distance_field(seeds, diagram, floats, metric);
  border_mask(diagram, mask);
  const std::vector<std::int32_t> integer = integers.read();
  const std::vector<float> in_pixels = floats.read();
  const std::vector<std::uint8_t> border = mask.read();
  BOOST_TEST_REQUIRE((integer.size() == labels.size() && in_pixels.size() == labels.size()));
  BOOST_TEST_REQUIRE(border.size() == labels.size());
  std::size_t wrong_integers = 0, wrong_floats = 0, wrong_border = 0, i = 0;
  for (int y = 0; y < grid.height(); ++y) {
    for (int x = 0; x < grid.width(); ++x, ++i) {
      if (labels[i] == no_label) {
        wrong_integers += integer[i] != no_distance ? 1 : 0;
        wrong_floats += !std::isinf(in_pixels[i]) ? 1 : 0;
      } else {
        const auto d = static_cast<double>(distance(grid, {x, y}, pixels[labels[i]], metric));
        const double length = metric == Metric::euclidean ? std::sqrt(d) : d;
        wrong_integers += integer[i] != d ? 1 : 0;
        wrong_floats += std::abs(in_pixels[i] - length) > length * 4e-7 ? 1 : 0;
      }
      const auto differs = [&](int dx, int dy) {
        const auto other = in_grid(grid, {x + dx, y + dy});
        return other && label_at(grid, labels, other->x, other->y) != labels[i];
      };
      const bool expected = differs(-1, 0) || differs(1, 0) || differs(0, -1) || differs(0, 1);
      wrong_border += border[i] != (expected ? 1 : 0) ? 1 : 0;
    }
  }
  BOOST_TEST(wrong_integers == 0u, name << ": " << wrong_integers << " integer distances are wrong");
  BOOST_TEST(wrong_floats == 0u, name << ": " << wrong_floats << " distances in pixels are wrong");
  BOOST_TEST(wrong_border == 0u, name << ": " << wrong_border << " pixels are wrong about the border");
}

}  // namespace

BOOST_AUTO_TEST_CASE(fields_are_those_of_the_host) {
  for (const Device& device : shapes()) {
    for (const Case& test : measured_cases()) {
      const Seeds seeds(device, test.grid, centres(test.seeds));
      Diagram diagram(device, test.grid);
      const Metric metric = test.seeds.size() % 2 == 0 ? Metric::euclidean : Metric::manhattan;
      jump_flooding(seeds, diagram, {metric});
      check_fields(test.name, seeds, test.seeds, diagram, metric);
    }
    const Grid grid(97, 53);
    const std::vector<Pixel> pixels = random_pixels(grid, 20, 1);
    Diagram pieces(device, grid);
    write_labels(pieces, random_labels(grid, 20, 2));
    for (const Metric metric : both_metrics) {
      check_fields("pieces", Seeds(device, grid, centres(pixels)), pixels, pieces, metric);
    }
  }
}

BOOST_AUTO_TEST_CASE(the_longest_distance_there_is) {
  const Grid grid(Grid::max_side, 3);
  const Seeds seeds(test_device(), grid, std::vector<Point>{{0.5, 0.5}});
  Diagram diagram(test_device(), grid);
  jump_flooding(seeds, diagram);
  Field<std::int32_t> field;
  distance_field(seeds, diagram, field);
  BOOST_TEST(field.read().back() == 32767 * 32767 + 4);
}

BOOST_AUTO_TEST_CASE(a_bad_call_is_refused) {
  const Seeds seeds(test_device(), Grid(10, 20), std::vector<Point>{{1, 1}});
  const Diagram diagram(test_device(), Grid(20, 10));
  Field<float> field;
  distance_field(Seeds(test_device(), diagram.grid(), {{1, 1}}), diagram, field);
  check_error([&] { distance_field(seeds, diagram, field); }, {"10 x 20", "20 x 10"});
  BOOST_TEST(field.read().empty());
  BOOST_TEST(field.values()() == nullptr);
}
