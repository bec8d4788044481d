// Diagrams of tilted grids and their measures, against all images of all seeds in 128-bit integers on the
// host.
#define BOOST_TEST_MODULE tilted_grids
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <map>
#include <numeric>
#include <optional>
#include <random>
#include <set>

#include "brute_force.hpp"
#include "vorocl/adjacency.hpp"
#include "vorocl/cells.hpp"
#include "vorocl/fields.hpp"
#include "vorocl/method.hpp"
#include "vorocl/motion.hpp"
#include "vorocl/relaxation.hpp"
#include "vorocl/tiles.hpp"
#include "weights.hpp"
#include "window_cases.hpp"

using namespace vorocl;

namespace {

/// Many more cases, for minutes instead of seconds.
const bool long_tests = std::getenv("VOROCL_LONG_TESTS") != nullptr;

__extension__ using Wide = __int128;

/// Whole numbers of 1/4096 pixel.
using Position = Pixel;
constexpr std::int64_t parts = 4096;

std::int64_t floor_of(std::int64_t a, std::int64_t b) { return a >= 0 ? a / b : -((b - 1 - a) / b); }

double in_pixels(std::int64_t position) { return static_cast<double>(position) / parts; }

/// A box, by its definition: seeds repeat by (width, 0) and (shift, height).
struct TiltedBox {
  std::int64_t width, height;  // in pixels
  std::int64_t shift;          // in parts

  Grid grid() const { return Grid(width, height, Axes::xy).tilted(in_pixels(shift)); }

  Wide distance(std::int64_t x, std::int64_t y, Metric metric) const {
    return metric == Metric::euclidean ? Wide{x} * x + Wide{y} * y : Wide{std::abs(x)} + std::abs(y);
  }

  /// The shortest way from any image of a seed to a place. Of equally short ones that along y which is
  /// shorter, and of two the one that goes down; likewise along x.
  Position way(const Position& seed, const Position& to, Metric metric) const {
    const std::int64_t w = width * parts, h = height * parts;
    std::optional<Position> best;
    // No nearest image is farther along y than one in the nearest row, half a period away along both axes.
    const std::int64_t rows = (w / 2 + h / 2) / h + 2, middle = floor_of(to.y - seed.y, h);
    for (std::int64_t j = middle - rows; j <= middle + rows; ++j) {
      const std::int64_t dy = to.y - seed.y - j * h, along = to.x - seed.x - j * shift;
      for (std::int64_t i = floor_of(along, w); i <= floor_of(along, w) + 1; ++i) {
        const Position way = {along - i * w, dy};
        const auto order = [&](const Position& at) {
          return std::make_tuple(distance(at.x, at.y, metric), std::abs(at.y), at.y < 0, std::abs(at.x),
                                 at.x < 0);
        };
        if (!best || order(way) < order(*best)) best = way;
      }
    }
    return *best;
  }
};

Position centre_of(std::int64_t column, std::int64_t row) {
  return {column * parts + parts / 2, row * parts + parts / 2};
}

bool is_labelled(std::int64_t at, std::int64_t length, std::int64_t period) {
  return length <= period || (at >= 0 && at < period);
}

/// `lags`, which are added to distances: none, or by id.
Labels labels_by_definition(const TiltedBox& box, const Window& window, const std::vector<Position>& seeds,
                            Metric metric, const std::vector<std::int64_t>& lags = {}) {
  Labels labels;
  for (std::int64_t y = window.y(); y < window.y() + window.height(); ++y) {
    for (std::int64_t x = window.x(); x < window.x() + window.width(); ++x) {
      std::uint32_t best = no_label;
      Wide least = 0;
      if (is_labelled(x, window.width(), box.width) && is_labelled(y, window.height(), box.height)) {
        for (std::uint32_t id = 0; id < seeds.size(); ++id) {
          const Position way = box.way(seeds[id], centre_of(x, y), metric);
          const Wide distance = box.distance(way.x, way.y, metric) + (lags.empty() ? 0 : lags[id]);
          if (best == no_label || distance < least || (distance == least && seeds[id] < seeds[best])) {
            best = id;
            least = distance;
          }
        }
      }
      labels.push_back(best);
    }
  }
  return labels;
}

/// A random box, a window of its grid, and seeds: where they lie in the box, and points that are given for
/// them.
struct RandomCase {
  explicit RandomCase(unsigned number) : rng(number) {
    const auto side = [&] {  // some beyond the block of a CPU's work-item
      return below(3) == 0 ? 1 + below(4) : below(16) == 0 ? 257 + below(8) : 1 + below(64);
    };
    box = {side(), side(), 0};
    const std::int64_t w = box.width * parts;
    const std::int64_t shifts[] = {
        w / 2, -w / 2, below(w) - w / 2, below(w) - w / 2, (below(w) - w / 2) / parts * parts,
        1,     w / 3,  below(w) - w / 2};
    box.shift = shifts[below(8)];
    window.emplace(below(3) == 0 ? part() : Window(box.grid()));
    snap = below(4) == 0 ? Snap::to_pixels : Snap::none;
    make_seeds();
  }

  std::mt19937_64 rng;
  TiltedBox box = {};
  std::optional<Window> window;
  Snap snap = Snap::none;
  std::vector<Position> seeds;
  std::vector<Point> points;

  std::int64_t below(std::int64_t end) {
    return static_cast<std::int64_t>(rng() % static_cast<std::uint64_t>(end));
  }

 private:
  Window part() {
    const auto length = [&](std::int64_t pixels) {
      return 1 + below(below(4) == 0 ? pixels + pixels / 2 + 1 : pixels);
    };
    const std::int64_t x = below(4 * box.width) - 2 * box.width,
                       y = below(2 * box.height - 1) - box.height + 1;
    const std::int64_t width = length(box.width);
    return {box.grid(), x, y, width, length(box.height)};
  }

  void make_seeds() {
    const std::int64_t w = box.width * parts, h = box.height * parts, kind = below(5);
    const std::int64_t count = below(4) == 0 ? 1 + below(3) : 1 + below(50);
    const Position middle = {below(w), below(h)};
    const std::int64_t step = parts << below(3);
    const bool moves = below(2) == 0;
    for (std::int64_t i = 0; i < count; ++i) {
      Position seed = {below(w), below(h)};
      if (kind == 1) seed = {seed.x / (parts / 2) * (parts / 2), seed.y / (parts / 2) * (parts / 2)};
      if (kind == 2) seed = {seed.x / step * step, seed.y / step * step};
      if (kind == 3) seed = {std::min(middle.x + below(9), w - 1), std::min(middle.y + below(9), h - 1)};
      const std::int64_t x = moves ? below(9) - 4 : 0, y = moves ? below(9) - 4 : 0;
      points.push_back({in_pixels(seed.x + x * w + y * box.shift), in_pixels(seed.y + y * h)});
      if (snap == Snap::to_pixels) seed = centre_of(seed.x / parts, seed.y / parts);
      seeds.push_back(seed);
    }
  }
};

std::string text_of(const RandomCase& random, unsigned number) {
  return "case " + std::to_string(number) + ": " + text_of(*random.window, random.seeds.size()) + ", shift " +
         std::to_string(random.box.shift);
}

/// The row and column of a pixel that is a period or less outside a whole window, as its labels have it.
std::size_t index_in(const TiltedBox& box, std::int64_t x, std::int64_t y) {
  const std::int64_t shift = floor_of(2 * box.shift + parts, 2 * parts), row = floor_of(y, box.height);
  const std::int64_t column = x - row * shift;
  return static_cast<std::size_t>((y - row * box.height) * box.width + column -
                                  floor_of(column, box.width) * box.width);
}

}  // namespace

BOOST_AUTO_TEST_CASE(labels_are_those_of_all_images) {
  const unsigned cases = long_tests ? 20000 : 400;
  for (unsigned number = 0; number < cases; ++number) {
    const RandomCase random(number);
    const Metric metric = number % 7 == 0 ? Metric::manhattan : Metric::euclidean;
    const Engine& engine = long_tests && takes(Shape::vector) ? engines()[number % engines().size()]
                                                              : engine_for(*random.window, metric, number);
    Diagram diagram(engine.device, *random.window);
    exact_diagram(Seeds(engine.device, random.box.grid(), random.points, {Outside::count, random.snap}),
                  diagram, {metric});
    const std::size_t wrong = count_differences(
        diagram.read(), labels_by_definition(random.box, *random.window, random.seeds, metric));
    BOOST_TEST(wrong == 0u, text_of(random, number) << ", " << engine.name << ", " << name_of(metric) << ": "
                                                    << wrong << " wrong");
  }
}

BOOST_AUTO_TEST_CASE(flat_boxes_have_the_labels_of_images_many_rows_away) {
  // The tilts of the farthest images fit in 32 bits in some, and in others not.
  for (const std::int64_t width : {700, 1200, 1400, 2600, 4000}) {
    const TiltedBox box = {width, 1, width * parts / 2 - 7};
    std::vector<Position> seeds;
    std::vector<Point> points;
    for (std::int64_t i = 0; i < 3; ++i) {
      seeds.push_back({(i * 7919 + 13) * 1009 % (width * parts), i * 1201});
      points.push_back({in_pixels(seeds.back().x), in_pixels(seeds.back().y)});
    }
    for (const Metric metric : {Metric::euclidean, Metric::manhattan}) {
      const Labels expected = labels_by_definition(box, box.grid(), seeds, metric);
      for (const Engine& engine : engines_of(metric)) {
        Diagram diagram(engine.device, box.grid());
        exact_diagram(Seeds(engine.device, box.grid(), points), diagram, {metric});
        BOOST_TEST(count_differences(diagram.read(), expected) == 0u,
                   width << " x 1, " << engine.name << ", " << name_of(metric));
      }
    }
  }
}

BOOST_AUTO_TEST_CASE(labels_are_those_of_the_weights_of_all_images) {
  for (unsigned number = 0; number < (long_tests ? 20000 : 400); ++number) {
    RandomCase random(number);
    if (random.snap == Snap::to_pixels) continue;
    const std::vector<double> weights = hard_weights(random.points.size(), 8, random.rng);
    const Engine& engine = long_tests && takes(Shape::vector)
                               ? engines()[number % engines().size()]
                               : engine_for(*random.window, Metric::euclidean, number);
    Diagram diagram(engine.device, *random.window);
    exact_diagram(Seeds(engine.device, random.box.grid(), Points(random.points).weighted(weights.data())),
                  diagram);
    const auto lags = lags_by_definition(weights, [](std::size_t) { return true; });
    const Labels expected =
        labels_by_definition(random.box, *random.window, random.seeds, Metric::euclidean, lags);
    BOOST_TEST(count_differences(diagram.read(), expected) == 0u, text_of(random, number)
                                                                      << ", " << engine.name);
  }
}

BOOST_AUTO_TEST_CASE(measures_are_those_of_the_nearest_images) {
  std::vector<unsigned> numbers(long_tests ? 4000 : 60);
  std::iota(numbers.begin(), numbers.end(), 0u);
  // By the Manhattan metric: equally short ways by rows on both sides, and a tilt of less than half a pixel.
  for (const unsigned number : {1260u, 3057u, 2760u}) numbers.push_back(number);
  for (const unsigned number : numbers) {
    const RandomCase random(number + 1000000);
    const TiltedBox& box = random.box;
    const Window& window = *random.window;
    if (window.width() > box.width || window.height() > box.height) continue;  // some pixels have no labels
    const bool is_whole = window.periodic() == Axes::xy;
    if (!is_whole && window.periodic() != Axes::none) continue;  // of flat grids, for test_window_measures
    const Metric metric = number % 3 == 0 ? Metric::manhattan : Metric::euclidean;
    const Seeds seeds(test_device(), box.grid(), random.points, {Outside::count, random.snap});
    Diagram diagram(test_device(), window);
    exact_diagram(seeds, diagram, {metric});
    const Labels labels = diagram.read();
    CellSumsResult sums;
    CellShapesResult shapes;
    CellStatisticsResult statistics;
    AdjacencyResult pairs;
    VerticesResult corners;
    Field<float> distances;
    Field<std::uint8_t> borders;
    cell_sums(diagram, sums);
    cell_shapes(diagram, shapes);
    cell_statistics(diagram, statistics);
    adjacency(diagram, pairs);
    vertices(diagram, corners);
    distance_field(diagram, distances);
    border_mask(diagram, borders);

    struct Cell {
      std::int64_t area = 0, x = 0, y = 0, rows = 0;
      std::int64_t left = INT32_MAX, top = INT32_MAX, right = INT32_MIN, bottom = INT32_MIN;
      double farthest = -1;
    };
    std::vector<Cell> cells(random.seeds.size());
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> expected_pairs;
    std::set<std::pair<std::int64_t, std::int64_t>> expected_corners;
    std::size_t wrong_distances = 0, wrong_borders = 0;
    const std::vector<float> found_distances = distances.read();
    const std::vector<std::uint8_t> found_borders = borders.read();
    // The label of a pixel of the window, or of one beside it where that is in the diagram, too.
    const auto label_at = [&](std::int64_t x, std::int64_t y) -> std::optional<std::uint32_t> {
      const bool inside = x >= 0 && x < window.width() && y >= 0 && y < window.height();
      if (inside) return labels[static_cast<std::size_t>(y * window.width() + x)];
      if (!is_whole) return std::nullopt;
      return labels[index_in(box, x, y)];
    };
    std::size_t i = 0;
    for (std::int64_t y = 0; y < window.height(); ++y) {
      for (std::int64_t x = 0; x < window.width(); ++x, ++i) {
        const std::uint32_t label = labels[i];
        const Position& seed = random.seeds[label];
        const Position to = box.way(seed, centre_of(x + window.x(), y + window.y()), metric);
        const double length = metric == Metric::euclidean ? std::hypot(in_pixels(to.x), in_pixels(to.y))
                                                          : in_pixels(std::abs(to.x) + std::abs(to.y));
        wrong_distances +=
            std::abs(static_cast<double>(found_distances[i]) - length) > 1e-6 * (1 + length) ? 1 : 0;
        Cell& cell = cells[label];
        ++cell.area;
        cell.farthest =
            std::max(cell.farthest, metric == Metric::euclidean
                                        ? static_cast<double>(to.x * to.x + to.y * to.y) / parts / parts
                                        : length);
        // In the window's columns and rows, which may begin elsewhere in the periods.
        const std::int64_t w = box.width * parts, h = box.height * parts;
        const std::int64_t own_x = seed.x - window.x() * parts, own_y = seed.y - window.y() * parts;
        const Position at =
            is_whole ? Position{own_x - floor_of(own_x, w) * w + to.x, own_y - floor_of(own_y, h) * h + to.y}
                     : centre_of(x, y);
        const std::int64_t rows = (at.y - centre_of(x, y).y) / h;
        cell.x += x + (at.x - centre_of(x, y).x - rows * box.shift) / parts;
        cell.y += y + rows * box.height;
        cell.rows += rows;
        cell.left = std::min(cell.left, floor_of(at.x, parts));
        cell.right = std::max(cell.right, floor_of(at.x, parts));
        cell.top = std::min(cell.top, floor_of(at.y, parts));
        cell.bottom = std::max(cell.bottom, floor_of(at.y, parts));
        const auto right = label_at(x + 1, y), below = label_at(x, y + 1), corner = label_at(x + 1, y + 1);
        for (const auto& other : {right, below}) {
          if (other && *other != label) ++expected_pairs[std::minmax(label, *other)];
        }
        if (right && below && corner && std::set<std::uint32_t>{label, *right, *below, *corner}.size() >= 3)
          expected_corners.emplace(y + 1, x + 1);
        const auto left = label_at(x - 1, y), above = label_at(x, y - 1);
        const bool is_border = (right && *right != label) || (below && *below != label) ||
                               (left && *left != label) || (above && *above != label);
        wrong_borders += (found_borders[i] != 0) != is_border ? 1 : 0;
      }
    }
    const std::vector<CellSums> found_sums = sums.read();
    const std::vector<CellShape> found_shapes = shapes.read();
    std::size_t wrong_sums = 0, wrong_shapes = 0;
    for (std::size_t id = 0; id < cells.size(); ++id) {
      const Cell& cell = cells[id];
      const std::int64_t sum_x = cell.x + floor_of(cell.rows * box.shift + parts / 2, parts);
      wrong_sums +=
          found_sums[id].area != cell.area || found_sums[id].sum_x != sum_x || found_sums[id].sum_y != cell.y;
      const CellShape& shape = found_shapes[id];
      wrong_shapes += shape.largest_distance != cell.farthest ? 1 : 0;
      if (cell.area == 0) continue;
      wrong_shapes += shape.left != cell.left || shape.right != cell.right || shape.top != cell.top ||
                      shape.bottom != cell.bottom || (is_whole && shape.touches_border);
    }
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> found_pairs;
    for (const CellPair& pair : pairs.read_pairs()) found_pairs[{pair.a, pair.b}] = pair.length;
    std::set<std::pair<std::int64_t, std::int64_t>> found_corners;
    for (const Point& at : corners.read()) found_corners.emplace(std::llround(at.y), std::llround(at.x));
    const std::string text = text_of(random, number) + ", " + name_of(metric);
    BOOST_TEST(wrong_sums == 0u, text << ": sums");
    BOOST_TEST(wrong_shapes == 0u, text << ": shapes");
    BOOST_TEST(wrong_distances == 0u, text << ": distances");
    BOOST_TEST(wrong_borders == 0u, text << ": border mask");
    BOOST_TEST((found_pairs == expected_pairs), text << ": pairs");
    BOOST_TEST((found_corners == expected_corners), text << ": vertices");
    const CellStatistics all = statistics.read();
    BOOST_TEST(all.pixels == window.pixels());
    if (is_whole) BOOST_TEST(all.cells == cells.size());
  }
}

BOOST_AUTO_TEST_CASE(axes_in_data_units_tilt_the_way_that_they_point) {
  std::mt19937_64 rng(5);
  const auto between = [&](double from, double to) {
    return from + (to - from) * static_cast<double>(rng() >> 11) * 0x1p-53;
  };
  for (unsigned number = 0; number < 16; ++number) {
    Axis x(48, -3, 9), y(40, 2, 7);
    if (number % 2 == 1) x = x.reversed();
    if (number / 2 % 2 == 1) y = y.reversed();
    const double tilt = number < 8 ? between(-6, 6) : 24 + between(-6, 6);  // of which two periods are none
    const Grid grid = Grid(x.periodic(), y.periodic()).tilted(tilt);
    std::vector<Point> points, in_pixels;
    for (int i = 0; i < 30; ++i) points.push_back({between(-3, 9), between(2, 7)});
    Diagram diagram(test_device(), grid);
    const Seeds seeds(test_device(), grid, points, {Outside::count, Snap::none});
    exact_diagram(seeds, diagram);
    // In floats, with all images near: what is not a tie is the same.
    const Labels labels = diagram.read();
    const std::vector<Point> rounded =
        points_of(Seeds(test_device(), grid, points, {Outside::count, Snap::none}));
    std::size_t wrong = 0;
    for (std::size_t i = 0; i < labels.size(); ++i) {
      const Point at = grid.point({static_cast<double>(i % 48) + 0.5, static_cast<double>(i / 48) + 0.5});
      const auto distance = [&](const Point& seed) {
        double least = HUGE_VAL;
        for (int row = -3; row <= 3; ++row) {
          for (int column = -8; column <= 8; ++column) {
            // In pixels: these are no squares in the data.
            const double dx = (seed.x + column * 12 + row * tilt - at.x) * 4,
                         dy = (seed.y + row * 5 - at.y) * 8;
            least = std::min(least, dx * dx + dy * dy);
          }
        }
        return least;
      };
      double least = HUGE_VAL;
      for (const Point& seed : rounded) least = std::min(least, distance(seed));
      wrong += distance(points[labels[i]]) > least + 0.05 ? 1 : 0;
    }
    BOOST_TEST(wrong == 0u, "case " << number);
  }
}

BOOST_AUTO_TEST_CASE(images_of_points_are_one_seed) {
  const double tilt = 3.21;
  const Grid grid = Grid(Axis(100, -5, 5).periodic(), Axis(64, 1, 4).periodic().reversed()).tilted(tilt);
  const std::vector<Point> points = {{-4.9, 1.01}, {0.3, 2.2}, {4.99, 3.999}};
  std::vector<Point> images;
  for (const Point& point : points) images.push_back({point.x + 20 - 3 * tilt, point.y - 9});
  const std::vector<Point> at = centres_of({test_device(), grid, points, {Outside::count, Snap::none}});
  const std::vector<Point> found = centres_of({test_device(), grid, images, {Outside::refuse, Snap::none}});
  for (std::size_t id = 0; id < at.size(); ++id) {
    BOOST_TEST(std::abs(found[id].x - at[id].x) <= 1.0 / parts);
    BOOST_TEST(std::abs(found[id].y - at[id].y) <= 1.0 / parts);
  }
  // What lies just below an end of the box does so by the same rule along both axes.
  for (const double y : {std::nextafter(1.0, 0.0), std::nextafter(4.0, 0.0), 4.0, 1.0, 7.0}) {
    const bool is_beyond = grid.y().pixel(y) != grid.y().pixel(y < 2 ? 1 : 3.9999);
    const double periods = grid.y().periods_beyond(y);
    BOOST_TEST(periods == (y < 1 ? -1 : y < 4 ? 0 : y < 7 ? 1 : 2), y);
    BOOST_TEST((is_beyond == (y < 1 || y == 4 || y == 7)), y);
  }
}

BOOST_AUTO_TEST_CASE(grids_know_their_tilt) {
  const Grid plain(Axis(20, 0, 10).periodic(), Axis(8, 0, 4).periodic());
  BOOST_TEST(!plain.is_tilted());
  BOOST_TEST((plain.tilted(0) == plain));
  BOOST_TEST((plain.tilted(30) == plain));
  BOOST_TEST((plain.tilted(3) != plain));
  BOOST_TEST(plain.tilted(13).tilt() == 3);
  BOOST_TEST((plain.tilted(13) == plain.tilted(-7)));
  BOOST_TEST((plain.tilted(-5) == plain.tilted(5)));
  BOOST_TEST(plain.tilted(5).shifts().xy == 10 * parts);
  BOOST_TEST(plain.tilted(-1.00001).shifts().xy == -2 * parts);
  BOOST_TEST((plain.tilted(3).tilted(0) == plain));
  const Grid up(plain.x(), plain.y().reversed()), both(plain.x().reversed(), plain.y().reversed());
  BOOST_TEST(up.tilted(3).shifts().xy == -6 * parts);
  BOOST_TEST(both.tilted(3).shifts().xy == 6 * parts);
  for (const double bad : {std::nan(""), HUGE_VAL, -HUGE_VAL})
    check_error([&] { plain.tilted(bad); }, {"tilt", "finite"});
  for (const Axes axes : {Axes::none, Axes::x, Axes::y}) {
    check_error([&] { Grid(20, 8, axes).tilted(2); }, {"tilted", "periodic in x and y"});
    BOOST_TEST(!Grid(20, 8, axes).tilted(0).is_tilted());
  }
  const Grid grid = plain.tilted(3);
  BOOST_TEST((Window(grid).periodic() == Axes::xy));
  BOOST_TEST((Window(grid, 3, 0, 20, 8).periodic() == Axes::xy));
  BOOST_TEST((Window(grid, 0, 1, 20, 8).periodic() == Axes::none));
  BOOST_TEST((Window(grid, 0, 0, 20, 7).periodic() == Axes::none));
  BOOST_TEST(Window(grid, 23, -7, 5, 3).x() == 3);
  BOOST_TEST(Window(grid, 23, -7, 5, 3).y() == -7);
  for (const std::int64_t row : {-8, 8}) check_error([&] { Window(grid, 0, row, 5, 3); }, {"tilted", "y = "});
}

BOOST_AUTO_TEST_CASE(seeds_that_the_device_makes_are_tilted_too) {
  const TiltedBox box = {61, 40, 17 * parts + 5};
  const Seeds random = Seeds::random(test_device(), box.grid(), 90, 3);
  std::vector<std::uint8_t> mask(box.grid().pixels(), 0);
  for (const Point& at : centres_of(random))
    mask[static_cast<std::size_t>(at.y) * 61 + static_cast<std::size_t>(at.x)] = 1;
  const Seeds masked = Seeds::from_mask(test_device(), box.grid(), mask);
  for (const Seeds* const seeds : {&random, &masked}) {
    std::vector<Position> positions;
    for (const Pixel& pixel : pixels_of(centres_of(*seeds))) positions.push_back(centre_of(pixel.x, pixel.y));
    Diagram diagram(test_device(), box.grid());
    exact_diagram(*seeds, diagram);
    BOOST_TEST(count_differences(diagram.read(),
                                 labels_by_definition(box, box.grid(), positions, Metric::euclidean)) == 0u);
  }
}

BOOST_AUTO_TEST_CASE(seeds_move_the_shortest_way) {
  const Grid grid = Grid(100, 40, Axes::xy).tilted(30);
  Seeds seeds(test_device(), grid, {{50.5, 1.5}, {10.5, 20.5}}, to_centres);
  // Up through the first row, and into the last one 30 pixels further along x.
  seeds.move_to({{81.5, 39.5}, {10.5, 21.5}});
  BOOST_TEST(seeds.displacement() == 2);
  seeds.move_to({{82.5, 38.5}, {10.5, 20.5}});
  BOOST_TEST(seeds.displacement() == 1);
}

BOOST_AUTO_TEST_CASE(what_knows_no_tilt_says_so) {
  const Grid grid = Grid(64, 48, Axes::xy).tilted(10);
  const std::vector<Point> points = {{3, 4}, {40, 30}};
  Seeds seeds(test_device(), grid, points, to_centres);
  Diagram diagram(test_device(), grid);
  for (const Method& method : methods()) {
    if (method.exact) continue;
    check_error([&] { method.run(seeds, diagram, {}); },
                {"tilted", "flooding cannot take", "exact diagrams"});
  }
  check_error([&] { random_step(seeds, 3, Border::periodic, 1, 1); }, {"tilted", "random motion"});
  const auto exactly = [](const Seeds& of, Diagram& into) { return exact_diagram(of, into); };
  check_error([&] { relax(seeds, diagram, exactly, 3); }, {"tilted", "Lloyd relaxation"});
  exact_diagram(seeds, diagram);
  check_error([&] { energy(diagram); }, {"tilted", "Lloyd relaxation"});
  check_error([&] { Tiling(grid, 32); }, {"tilted", "tiles"});
  check_error([&] { PlaneSeeds(grid, points, to_centres); }, {"tilted", "tiles"});
  const Grid large = Grid(200000, 48, Axes::xy).tilted(10);
  Diagram part(test_device(), Window(large, 0, 0, 64, 48));
  check_error([&] { exact_diagram(Seeds(test_device(), large, points, to_centres), part); },
              {"tilted", "200000", "131072"});
  check_error(
      [&] { exact_diagram(Seeds(test_device(), Grid(64, 48, Axes::xy), points, to_centres), diagram); },
      {"grid"});
}
