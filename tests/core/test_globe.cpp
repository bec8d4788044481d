// Labels by great circles against long doubles that compare all seeds, from the degrees as they are.
#define BOOST_TEST_MODULE globe

#include <cmath>
#include <numeric>
#include <random>
#include <set>

#include "fixture.hpp"
#include "samples.hpp"

using namespace vorocl;

namespace {

constexpr long double radius = 6371.0088L, radians = 3.14159265358979323846264338328L / 180;

/// Kilometres, by the haversine of the one or the other end, which ever is near.
long double way(const Point& a, const Point& b) {
  const auto haversine = [](long double lat_a, long double lat_b, long double lon) {
    const long double north = std::sin((lat_b - lat_a) / 2), east = std::sin(lon / 2);
    return north * north + std::cos(lat_a) * std::cos(lat_b) * east * east;
  };
  const long double lat_a = a.y * radians, lat_b = b.y * radians,
                    lon = std::fmod(static_cast<long double>(b.x) - a.x, 360.0L) * radians;
  const long double here = haversine(lat_a, lat_b, lon),
                    there = haversine(lat_a, -lat_b, lon + 180 * radians);
  return here < 0.5L ? 2 * radius * std::asin(std::sqrt(here))
                     : radius * (180 * radians - 2 * std::asin(std::sqrt(there)));
}

Grid map(int width, int height, double west = -180, double south = -90, double east = 180,
         double north = 90) {
  return Grid(Axis(width, west, east), Axis(height, south, north).reversed());
}

Point centre(const Window& window, std::size_t pixel) {
  const auto width = static_cast<std::size_t>(window.width());
  const auto x = static_cast<double>(pixel % width) + static_cast<double>(window.x()),
             y = static_cast<double>(pixel / width) + static_cast<double>(window.y());
  return window.grid().point({x + 0.5, y + 0.5, 0.5});
}

std::vector<std::uint32_t> labels_of(const Window& window, const std::vector<Point>& points) {
  Diagram diagram(test_device(), window);
  exact_diagram(Seeds(test_device(), window.grid(), points), diagram, {Metric::great_circle});
  return diagram.read();
}

/// Where a label is farther than the nearest seed by more than 2 cm.
void check_labels(const char* name, const Window& window, const std::vector<Point>& points) {
  const std::vector<std::uint32_t> labels = labels_of(window, points);
  long double worst = 0;
  for (std::size_t pixel = 0; pixel < labels.size(); ++pixel) {
    BOOST_TEST_REQUIRE(labels[pixel] < points.size());
    const Point at = centre(window, pixel);
    long double least = 1e9L;
    for (const Point& point : points) least = std::min(least, way(at, point));
    worst = std::max(worst, way(at, points[labels[pixel]]) - least);
  }
  BOOST_TEST(worst <= 2e-5L, name << ": a label is farther by " << worst * 1e5L << " cm");
}

std::vector<Point> random_places(std::size_t count, unsigned rng_seed) {
  std::mt19937 rng(rng_seed);
  std::uniform_real_distribution<double> any(-1, 1);
  std::vector<Point> places;
  for (std::size_t i = 0; i < count; ++i)
    places.push_back({180 * any(rng), std::asin(any(rng)) / static_cast<double>(radians)});
  return places;
}

/// Random places in a rectangle of degrees.
std::vector<Point> places_in(double west, double south, double east, double north, std::size_t count) {
  std::mt19937 rng(7);
  std::uniform_real_distribution<double> x(west, east), y(south, north);
  std::vector<Point> places;
  for (std::size_t i = 0; i < count; ++i) places.push_back({x(rng), y(rng)});
  return places;
}

/// Random places on a circle so many degrees around 40 E, 30 N.
std::vector<Point> circle(double reach, std::size_t count) {
  std::mt19937 rng(17);
  std::uniform_real_distribution<double> any(0, 360);
  const double degree = static_cast<double>(radians), along = std::cos(reach * degree),
               across = std::sin(reach * degree), cosine = std::cos(30 * degree),
               sine = std::sin(30 * degree);
  std::vector<Point> places;
  for (std::size_t i = 0; i < count; ++i) {
    const double angle = any(rng) * degree, y = across * std::cos(angle), z = across * std::sin(angle);
    places.push_back({40 + std::atan2(y, along * cosine - z * sine) / degree,
                      std::asin(along * sine + z * cosine) / degree});
  }
  return places;
}

BOOST_AUTO_TEST_CASE(no_label_is_farther_by_two_centimetres) {
  check_labels("random", map(90, 47), random_places(300, 1));
  check_labels("many", map(64, 32), random_places(1500, 2));
  check_labels("few", map(50, 30), random_places(9, 3));
  check_labels("one meridian", map(72, 36), places_in(12.3, -90, 12.3, 90, 500));
  check_labels("the equator", map(72, 36), places_in(-180, 0, 180, 0, 500));
  check_labels("around a pole", map(72, 36), places_in(-180, 89.9, 180, 90, 500));
  check_labels("in a village", map(72, 36), places_in(8.5, 47.3, 8.501, 47.301, 500));
  check_labels("one", map(60, 30), {{20, 10}});
  check_labels("an antipodal pair", map(60, 30), {{20, 10}, {-160, -10}});
  check_labels("both poles", map(60, 30), {{20, 90}, {-160, -90}});
  check_labels("beyond 180 degrees", map(60, 30), {{190, 10}, {-530, -10}, {359, 50}, {0, -50}});
  const double sides[] = {0.01, 1, 30};
  for (const double side : sides) {
    check_labels("a part", map(60, 40, 8, 47, 8 + side, 47 + side),
                 places_in(8, 47, 8 + side, 47 + side, 200));
    check_labels("a part at a pole", map(60, 40, 170, 90 - side, 170 + 5 * side, 90),
                 places_in(-180, 90 - side, 180, 90, 200));
  }
  check_labels("a parallel near a pole", map(36, 18), places_in(-180, 89, 180, 89, 2000));
  check_labels("a great circle", map(36, 18), circle(90, 2000));
  check_labels("a circle", map(36, 18), circle(20, 2000));
  check_labels("a small circle", map(36, 18), circle(0.5, 2000));
  check_labels("in a circle", map(40, 20, 39.5, 29.5, 40.5, 30.5), circle(1, 2000));
  check_labels("the equator from a pole", map(40, 20, 0, 89.99, 1, 90), places_in(-180, 0, 180, 0, 2000));
  check_labels("one place", map(36, 18), std::vector<Point>(3000, {8.5, 47.3}));
  std::vector<Point> poles = places_in(-180, 90, 180, 90, 1500);
  for (std::size_t i = 0; i < 1500; ++i) poles.push_back({poles[i].x, -90});
  check_labels("both poles, often", map(36, 18), poles);
  std::vector<Point> clusters = places_in(29, 19, 31, 21, 500);
  for (const Point& point : places_in(-151, -21, -149, -19, 500)) clusters.push_back(point);
  check_labels("two clusters at antipodes", map(36, 18), clusters);
  check_labels("far from all", map(60, 40, 8, 47, 8.01, 47.01), random_places(3000, 5));
}

BOOST_AUTO_TEST_CASE(seeds_on_pixels_have_them) {
  const Grid grid = map(36, 18);
  std::vector<Point> centres;
  for (std::size_t pixel = 0; pixel < grid.pixels(); ++pixel) centres.push_back(centre(grid, pixel));
  std::vector<std::uint32_t> own(grid.pixels());
  std::iota(own.begin(), own.end(), 0u);
  BOOST_TEST(labels_of(grid, centres) == own);
  // Snapped seeds lie at the centres.
  Diagram diagram(test_device(), grid);
  exact_diagram(Seeds(test_device(), grid, {{1, 1}}, {Outside::count, Snap::to_pixels}), diagram,
                {Metric::great_circle});
  Field<float> distances;
  distance_field(diagram, distances);
  BOOST_TEST(distances.read()[8 * 36 + 18] < 1e-5f);
  const Point seed = cell_table(diagram).front().seed;
  BOOST_TEST(seed.x == 5);
  BOOST_TEST(seed.y == 5);
}

BOOST_AUTO_TEST_CASE(windows_are_parts_of_the_map) {
  const Grid grid(Axis(90, -180, 180).periodic(), Axis(45, -90, 90).reversed());
  // Seeds on circles are nearly equally far, so that a candidate too few would be seen here and in no
  // distance.
  const std::vector<Point> equator = places_in(-180, 0, 180, 0, 20000);
  for (const std::vector<Point>& points :
       {random_places(200, 11), random_places(20000, 12), equator, circle(90, 20000), circle(20, 20000)}) {
    const std::vector<std::uint32_t> all = labels_of(grid, points);
    for (const Window& window :
         {Window(grid, 13, 5, 31, 17), Window(grid, 80, 0, 30, 45), Window(grid, -3, 40, 7, 5)}) {
      const std::vector<std::uint32_t> part = labels_of(window, points);
      for (std::size_t pixel = 0; pixel < part.size(); ++pixel) {
        const std::size_t width = static_cast<std::size_t>(window.width());
        const std::size_t x = (static_cast<std::size_t>(window.x() + 90) + pixel % width) % 90,
                          y = static_cast<std::size_t>(window.y()) + pixel / width;
        BOOST_TEST_REQUIRE(part[pixel] == all[y * 90 + x]);
      }
    }
  }
}

BOOST_AUTO_TEST_CASE(the_northern_and_then_the_western_seed_wins_a_tie) {
  const Grid grid = map(1, 1, -10, -10, 10, 10);  // one pixel, at 0, 0
  const auto winner = [&](const std::vector<Point>& points) { return labels_of(grid, points).front(); };
  BOOST_TEST(winner({{0, -5}, {0, 5}}) == 1u);
  BOOST_TEST(winner({{5, 0}, {-5, 0}}) == 1u);
  BOOST_TEST(winner({{5, 3}, {-5, 3}, {-5, -3}, {5, -3}}) == 1u);
  BOOST_TEST(winner({{3, 4}, {3, 4}, {363, 4}}) == 0u);
  BOOST_TEST(winner({{180, 0}, {-180, 0}}) == 0u);  // one place
  BOOST_TEST(winner({{0, 90}, {40, 90}, {0, -90}}) == 0u);
}

BOOST_AUTO_TEST_CASE(distances_are_kilometres) {
  const Grid grid = map(40, 20);
  const std::vector<Point> points = {{20, 30}, {200, -30}, {-90, 89}};
  Diagram diagram(test_device(), grid);
  exact_diagram(Seeds(test_device(), grid, points), diagram, {Metric::great_circle});
  const std::vector<std::uint32_t> labels = diagram.read();
  Field<float> field;
  distance_field(diagram, field);
  const std::vector<float> distances = field.read();
  for (std::size_t pixel = 0; pixel < labels.size(); ++pixel) {
    const auto expected = static_cast<double>(way(centre(grid, pixel), points[labels[pixel]]));
    BOOST_TEST_REQUIRE(std::abs(static_cast<double>(distances[pixel]) - expected) <= 1e-5 + 1e-6 * expected);
  }
  exact_diagram(Seeds(test_device(), grid, {{0, 0}}), diagram, {Metric::great_circle});
  distance_field(diagram, field);
  BOOST_TEST(field.read()[10 * 40] > 19'000.0f);  // near the antipode
}

BOOST_AUTO_TEST_CASE(cells_have_square_kilometres) {
  const Grid grid(Axis(72, -180, 180).periodic(), Axis(36, -90, 90).reversed());
  std::vector<Point> points = random_places(30, 4);
  points.push_back(points[3]);  // an empty cell
  Diagram diagram(test_device(), grid);
  exact_diagram(Seeds(test_device(), grid, points), diagram, {Metric::great_circle});
  const std::vector<std::uint32_t> labels = diagram.read();
  std::vector<double> areas(points.size()), farthest(points.size());
  Field<float> distances;
  distance_field(diagram, distances);
  const std::vector<float> away = distances.read();
  std::set<std::pair<std::uint32_t, std::uint32_t>> pairs;
  for (std::size_t y = 0; y < 36; ++y) {
    for (std::size_t x = 0; x < 72; ++x) {
      const std::uint32_t own = labels[y * 72 + x];
      const double north = 90 - 5 * static_cast<double>(y);
      farthest[own] = std::max(farthest[own], static_cast<double>(away[y * 72 + x]));
      areas[own] += static_cast<double>(radius * radius * 5 * radians *
                                        (std::sin(north * radians) - std::sin((north - 5) * radians)));
      for (const std::uint32_t other :
           {labels[y * 72 + (x + 1) % 72], y < 35 ? labels[(y + 1) * 72 + x] : own})
        if (other != own) pairs.insert(std::minmax(own, other));
    }
  }
  double sum = 0;
  std::size_t neighbours = 0;
  for (const CellRow& cell : cell_table(diagram)) {
    BOOST_TEST(cell.area == areas[cell.id], boost::test_tools::tolerance(1e-9));
    BOOST_TEST(cell.seed.x == points[cell.id].x);
    BOOST_TEST(!cell.touches_border);
    if (cell.pixels > 0) BOOST_TEST(way(cell.centroid, cell.seed) < 6000);
    BOOST_TEST(
        (cell.pixels > 0 ? cell.largest_distance == farthest[cell.id] : std::isnan(cell.largest_distance)));
    sum += cell.area;
    neighbours += cell.neighbours;
  }
  BOOST_TEST(sum == static_cast<double>(4 * 180 * radians * radius * radius),
             boost::test_tools::tolerance(1e-9));
  BOOST_TEST(neighbours == 2 * pairs.size());
  AdjacencyResult found;
  adjacency(diagram, found);
  BOOST_TEST(found.pairs() == pairs.size());
  // A part of the globe has borders.
  const Grid part = map(10, 10, 0, 0, 10, 10);
  Diagram of_part(test_device(), part);
  exact_diagram(Seeds(test_device(), part, {{5, 5}}), of_part, {Metric::great_circle});
  BOOST_TEST(cell_table(of_part).front().touches_border);
}

BOOST_AUTO_TEST_CASE(without_seeds_there_are_no_labels) {
  const Grid grid = map(20, 10);
  BOOST_TEST(labels_of(grid, {}) == std::vector<std::uint32_t>(200, no_label));
  const std::vector<std::optional<Point>> points = {std::nullopt, Point{3, 4}};
  Diagram diagram(test_device(), grid);
  exact_diagram(Seeds(test_device(), grid, points), diagram, {Metric::great_circle});
  BOOST_TEST(diagram.read() == std::vector<std::uint32_t>(200, 1));
}

BOOST_AUTO_TEST_CASE(what_is_not_of_a_globe_is_refused) {
  const auto fill = [](const Grid& grid, const std::vector<Point>& points, const char* by) {
    Diagram diagram(test_device(), grid);
    MethodOptions options;
    options.metric = Metric::great_circle;
    method(by).run(Seeds(test_device(), grid, points), diagram, options);
  };
  const std::vector<Point> one = {{1, 1}};
  check_error([&] { fill(map(8, 4), {{0, 0}, {7, 91}}, "exact"); }, {"point 1 (7", "-90 to 90"});
  check_error([&] { fill(map(8, 4), one, "jfa"); }, {"jfa", "great circles", "exact"});
  check_error([&] { fill(map(8, 4), one, "low-resolution"); }, {"low-resolution"});
  check_error([&] { fill(map(8, 4, -180, -90, 190, 90), one, "exact"); },
              {"no longer than 360", "-180 to 190"});
  check_error([&] { fill(map(8, 4, 0, -91, 10, 0), one, "exact"); }, {"y from -91 to 0"});
  check_error([&] { fill(Grid(Axis(8, 0, 90).periodic(), Axis(4, 0, 9)), one, "exact"); },
              {"360 if it is periodic"});
  check_error([&] { fill(Grid(4, 4, 4), {{1, 1, 1}}, "exact"); }, {"volume"});
  const Grid grid = map(8, 4);
  const Seeds seeds(test_device(), grid, one);
  Diagram diagram(test_device(), grid), other(test_device(), grid);
  for (Diagram* const each : {&diagram, &other}) exact_diagram(seeds, *each, {Metric::great_circle});
  CellSumsResult sums;
  CellShapesResult shapes;
  Field<std::int32_t> squares;
  Field<std::uint32_t> grown;
  DistanceErrorsResult errors;
  check_error([&] { cell_sums(diagram, sums); }, {"great circles", "cell_table()"});
  check_error([&] { cell_shapes(diagram, shapes); }, {"great circles"});
  check_error([&] { distance_field(diagram, squares); }, {"great circles", "floats"});
  check_error([&] { expand_labels(diagram, 1, grown); }, {"great circles"});
  check_error([&] { distance_errors(diagram, other, errors); }, {"great circles"});
  check_error([&] { energy(diagram); }, {"great circles"});
}

}  // namespace
