// Exact cells: against rational numbers, where for each pair of seeds the part of their bisector is found
// that no other seed is nearer to; against Boost.Polygon's Voronoi diagram; and what must hold for every set.
#define BOOST_TEST_MODULE exact_cells
#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC diagnostic ignored "-Wmaybe-uninitialized"  // of Boost's whole numbers, where GCC is wrong
#endif
#include <dlfcn.h>

#include <boost/multiprecision/cpp_int.hpp>
#include <boost/polygon/voronoi.hpp>
#include <cmath>
#include <cstring>
#include <limits>
#include <map>
#include <optional>
#include <tuple>

#include "brute_force.hpp"
#include "exact_cells/hilbert_order.hpp"
#include "fixture.hpp"
#include "samples.hpp"
#include "weights.hpp"

using namespace vorocl;

namespace {

using Whole = boost::multiprecision::number<boost::multiprecision::cpp_int_backend<
    512, 512, boost::multiprecision::signed_magnitude, boost::multiprecision::unchecked, void>>;
using Rational = boost::multiprecision::cpp_rational;

/// The positions of the tests are whole numbers that need not be rounded.
struct Position {
  std::int64_t x, y;
  friend bool operator==(const Position& p, const Position& q) { return p.x == q.x && p.y == q.y; }
};

struct Set {
  std::string name;
  std::int64_t width, height;
  std::vector<Position> positions;
  std::int64_t tilt = 0;
  std::vector<double> weights = {};  // whole numbers; none: all the same

  Whole weight(std::size_t id) const { return weights.empty() ? Whole(0) : Whole(weights[id]); }

  /// Whether another point at the same place has its cell.
  bool is_covered(std::size_t id) const {
    for (std::size_t other = 0; other < positions.size(); ++other) {
      if (other == id || !(positions[other] == positions[id])) continue;
      if (weight(other) > weight(id) || (weight(other) == weight(id) && other < id)) return true;
    }
    return false;
  }
};

constexpr std::int64_t side = std::int64_t{1} << 30;
constexpr Axes all_periods[] = {Axes::none, Axes::x, Axes::y, Axes::xy};

Grid grid_of(const Set& set, Axes periodic) {
  const Axis x(10, 0, static_cast<double>(set.width)), y(10, 0, static_cast<double>(set.height));
  return Grid(has_x(periodic) ? x.periodic() : x, has_y(periodic) ? y.periodic() : y)
      .tilted(static_cast<double>(set.tilt));
}

std::vector<Point> points_of(const std::vector<Position>& positions) {
  return transformed(positions, [](const Position& position) {
    return Point{static_cast<double>(position.x), static_cast<double>(position.y)};
  });
}

ExactCellsResult cells_of(const Set& set, Axes periodic) {
  ExactCellsResult result;
  const std::vector<Point> points = points_of(set.positions);
  const Points weighted = Points(points).weighted(set.weights.empty() ? nullptr : set.weights.data());
  exact_cells(Seeds(test_device(), grid_of(set, periodic), weighted, to_centres), result);
  return result;
}

std::int64_t below(std::mt19937_64& random, std::int64_t end) {
  return static_cast<std::int64_t>(random() % static_cast<std::uint64_t>(end));
}

std::vector<Position> random_positions(std::int64_t width, std::int64_t height, std::size_t count,
                                       std::uint64_t key) {
  std::mt19937_64 random(key);
  std::vector<Position> positions;
  for (std::size_t i = 0; i < count; ++i) positions.push_back({below(random, width), below(random, height)});
  return positions;
}

std::vector<Position> lattice(std::int64_t step, int columns, int rows, std::int64_t slant = 0) {
  std::vector<Position> positions;
  for (int row = 0; row < rows; ++row) {
    for (int column = 0; column < columns; ++column)
      positions.push_back({step / 2 + column * step + row % 2 * slant, step / 2 + row * step});
  }
  return positions;
}

/// Points at the whole distance 65 from a point, and that one, so many steps apart.
std::vector<Position> circle(std::int64_t scale) {
  std::vector<Position> positions = {{side / 2, side / 2}};
  for (const auto& [a, b] : {std::pair{16, 63}, {25, 60}, {33, 56}, {39, 52}, {0, 65}}) {
    for (const auto& [p, q] : {std::pair{a, b}, {b, a}}) {
      for (const int sign : {-1, 1}) {
        positions.push_back({side / 2 + p * scale, side / 2 + sign * (q * scale)});
        positions.push_back({side / 2 - p * scale, side / 2 + sign * (q * scale)});
      }
    }
  }
  return positions;
}

std::vector<Set> hurtful_sets() {
  std::vector<Position> near, line, diagonal, border, equal(7, {5, 6});
  for (const Position& position : random_positions(side - 1, side - 1, 12, 3)) {
    near.push_back(position);
    near.push_back({position.x + 1, position.y});
    if (near.size() % 4 == 0) near.push_back({position.x + 1, position.y + 1});
  }
  for (std::int64_t i = 0; i < 15; ++i) {
    line.push_back({i * i * 4000000 + 7, side / 3});
    diagonal.push_back({i * 50000000, i * 50000000});
    border.push_back({i * 60000000, i % 3 == 0 ? 0 : i % 3 == 1 ? 5 : side - 1});
    border.push_back({i % 2 == 0 ? 0 : side - 1, i * 70000000});
  }
  border.push_back({0, 0});
  border.push_back({side - 1, side - 1});
  return {{"random", side, side, random_positions(side, side, 40, 1)},
          {"flat", side, 1000, random_positions(side, 1000, 30, 2)},
          {"lattice", side, side, lattice(side / 6, 6, 6)},
          {"lattice that fits the period", side, side, lattice(side / 4, 4, 4)},
          {"slanted lattice", side, side, lattice(side / 8, 7, 5, side / 16)},
          {"small lattice", side, side, lattice(1, 5, 5)},
          {"circle", side, side, circle(1000000)},
          {"small circle", side, side, circle(1)},
          {"line", side, side, line},
          {"diagonal", side, side, diagonal},
          {"near duplicates", side, side, near},
          {"border", side, side, border},
          {"one", side, side / 4, {{5, 7}}},
          {"two", side, side, {{5, 7}, {side - 9, side / 2}}},
          {"two in a row", side, side, {{5, 7}, {side / 2 + 5, 7}}},
          {"three", side, side, random_positions(side, side, 3, 4)},
          {"all equal", side, side, equal},
          {"GEOS 1040", 200, 200, {{84, 30}, {76, 36}, {70, 48}, {72, 42}}},  // on a circle
          {"longest steps", side / 2 + 1, side / 2 + 1, random_positions(side / 2, side / 2, 9, 38)},
          {"no steps to spare", 2, 2, {{0, 0}, {1, 1}, {0, 1}}}};
}

// --- rational numbers ---

/// A whole number over a positive one.
struct Fraction {
  Whole above, below;
  friend bool operator<(const Fraction& p, const Fraction& q) {
    return p.above * q.below < q.above * p.below;
  }
};

Fraction fraction(const Whole& above, const Whole& below) {
  if (below < 0) return {-above, -below};
  return {above, below};
}

Rational rational(const Fraction& fraction) {
  return Rational(boost::multiprecision::cpp_int(fraction.above),
                  boost::multiprecision::cpp_int(fraction.below));
}

/// Where a x + b y <= c, in half steps from a cell's site.
struct HalfPlane {
  std::int64_t a, b;
  Whole c;
  std::uint32_t cell;  // behind it
};

struct Edge {
  std::uint32_t cell;
  double length;
};

struct Cell {
  Rational area = 0, moment_x = 0, moment_y = 0;  // moments in half steps from the site
  std::vector<Edge> edges;
};

double square_root(const Rational& number) { return std::sqrt(number.convert_to<double>()); }

/// The part of a line's a x + b y = c that is in all other half planes, as multiples of (-b, a) from the foot
/// of its normal; none if that is a point or nothing. The foot is c (a, b) / (a^2 + b^2).
std::optional<std::pair<Fraction, Fraction>> visible_part(const std::vector<HalfPlane>& planes,
                                                          std::size_t of) {
  const HalfPlane& line = planes[of];
  const Whole square = Whole(line.a) * line.a + Whole(line.b) * line.b;
  std::optional<Fraction> from, to;
  for (std::size_t i = 0; i < planes.size(); ++i) {
    if (i == of) continue;
    const HalfPlane& plane = planes[i];
    // With t: square (c' - a' x - b' y) = square c' - c (a a' + b b') - t (a b' - a' b) must not be
    // negative.
    const Whole slope = Whole(line.a) * plane.b - Whole(plane.a) * line.b;
    const Whole rest = square * plane.c - line.c * (Whole(line.a) * plane.a + Whole(line.b) * plane.b);
    if (slope == 0) {
      // Behind a line that comes twice lies the farthest site; sides of the rectangle come first.
      const auto square_of = [](const HalfPlane& p) { return Whole(p.a) * p.a + Whole(p.b) * p.b; };
      const bool is_same = Whole(line.a) * plane.a + Whole(line.b) * plane.b > 0;
      const bool is_behind = plane.cell == no_label || (line.cell != no_label && square_of(plane) > square);
      if (rest < 0 || (rest == 0 && (!is_same || is_behind))) return {};
      continue;
    }
    const Fraction at = fraction(rest, slope);
    if (slope > 0 && (!to || at < *to)) to = at;
    if (slope < 0 && (!from || *from < at)) from = at;
  }
  if (!from || !to || !(*from < *to)) return {};
  return std::pair{*from, *to};
}

Cell reference_cell(const Set& set, Axes periodic, std::uint32_t id) {
  if (set.is_covered(id)) return {};
  const Position& own = set.positions[id];
  std::vector<HalfPlane> planes;
  // Each way. The lattices of tilted sets have short vectors a few periods away.
  const std::int64_t images = set.tilt != 0 ? 4 : set.positions.size() > 8 ? 1 : 2;
  const std::int64_t images_x = has_x(periodic) ? images : 0, images_y = has_y(periodic) ? images : 0;
  for (std::uint32_t other = 0; other < set.positions.size(); ++other) {
    const Position& at = set.positions[other];
    if (set.is_covered(other)) continue;
    for (std::int64_t x = -images_x; x <= images_x; ++x) {
      for (std::int64_t y = -images_y; y <= images_y; ++y) {
        const std::int64_t a = at.x + x * set.width + y * set.tilt - own.x, b = at.y + y * set.height - own.y;
        const Whole square = Whole(a) * a + Whole(b) * b;
        if (square != 0) planes.push_back({a, b, square + set.weight(id) - set.weight(other), other});
      }
    }
  }
  if (!has_x(periodic)) {
    planes.push_back({-1, 0, 2 * own.x, no_label});
    planes.push_back({1, 0, 2 * (set.width - own.x), no_label});
  }
  if (!has_y(periodic)) {
    planes.push_back({0, -1, 2 * own.y, no_label});
    planes.push_back({0, 1, 2 * (set.height - own.y), no_label});
  }
  Cell cell;
  for (std::size_t i = 0; i < planes.size(); ++i) {
    const auto part = visible_part(planes, i);
    if (!part) continue;
    const HalfPlane& line = planes[i];
    const boost::multiprecision::cpp_int c(line.c), square(Whole(line.a) * line.a + Whole(line.b) * line.b);
    const Rational from = rational(part->first), to = rational(part->second), length = (to - from) / square;
    // The triangle of the edge and the site: its ends are (c (a, b) + t (-b, a)) / square.
    const Rational triangle = Rational(c) * length / 2;
    const Rational both = from + to;
    cell.area += triangle;
    cell.moment_x += triangle * (2 * Rational(c) * line.a - both * line.b) / square / 3;
    cell.moment_y += triangle * (2 * Rational(c) * line.b + both * line.a) / square / 3;
    cell.edges.push_back({line.cell, square_root(length * length * square) / 2});
  }
  return cell;
}

/// Compares a set's cells with those of rational numbers, in steps.
void check_by_rational_numbers(const Set& set, Axes periodic) {
  const ExactCellsResult result = cells_of(set, periodic);
  const std::vector<ExactCell> cells = result.read();
  const ExactPolygons polygons = result.read_polygons();
  const double unit = static_cast<double>(std::max(set.width, set.height)), tolerance = 1e-14 * unit;
  BOOST_TEST_REQUIRE(cells.size() == set.positions.size());
  for (std::uint32_t id = 0; id < cells.size(); ++id) {
    const Cell expected = reference_cell(set, periodic, id);
    const ExactCell& cell = cells[id];
    BOOST_TEST_CONTEXT("cell " << id) {
      BOOST_TEST(cell.certified);
      const double area = Rational(expected.area / 4).convert_to<double>();
      BOOST_TEST(std::abs(cell.area - area) <= 1e-14 * unit * std::sqrt(area) + 1e-15 * area);
      if (expected.edges.empty()) {
        BOOST_TEST(std::isnan(cell.centroid.x));
      } else {
        const Rational half_area = expected.area * 2;
        const double x = static_cast<double>(set.positions[id].x) +
                         Rational(expected.moment_x / half_area).convert_to<double>();
        const double y = static_cast<double>(set.positions[id].y) +
                         Rational(expected.moment_y / half_area).convert_to<double>();
        BOOST_TEST(std::abs(cell.centroid.x - x) <= tolerance);
        BOOST_TEST(std::abs(cell.centroid.y - y) <= tolerance);
      }
      double perimeter = 0;
      std::uint32_t neighbours = 0;
      std::vector<std::pair<std::uint32_t, double>> there, here;
      for (const Edge& edge : expected.edges) {
        perimeter += edge.length;
        neighbours += edge.cell == no_label ? 0 : 1;
        there.emplace_back(edge.cell, edge.length);
      }
      for (std::uint32_t i = polygons.offsets[id]; i < polygons.offsets[id + 1]; ++i)
        here.emplace_back(polygons.neighbours[i], polygons.lengths[i]);
      BOOST_TEST(std::abs(cell.perimeter - perimeter) <= 8 * tolerance);
      BOOST_TEST(cell.neighbours == neighbours);
      BOOST_TEST(cell.touches_border == (neighbours < expected.edges.size()));
      std::sort(there.begin(), there.end());
      std::sort(here.begin(), here.end());
      BOOST_TEST_REQUIRE(here.size() == there.size());
      for (std::size_t i = 0; i < here.size(); ++i) {
        BOOST_TEST(here[i].first == there[i].first);
        BOOST_TEST(std::abs(here[i].second - there[i].second) <= tolerance);
      }
    }
  }
}

/// What must hold for all sets.
void check_as_a_whole(const ExactCellsResult& result, const std::string& name) {
  const ExactCellsCheck check = result.check();
  BOOST_TEST(check.not_mutual == 0u, name << ": " << check.not_mutual << " edges are not mutual");
  BOOST_TEST(check.uncertified == 0u, name);
  BOOST_TEST(std::abs(check.area / check.rectangle_area - 1) < 1e-14, name << ": " << check.area);
}

}  // namespace

BOOST_AUTO_TEST_CASE(hurtful_sets_have_the_cells_of_rational_numbers) {
  for (const Set& set : hurtful_sets()) {
    for (const Axes periodic : all_periods) {
      BOOST_TEST_CONTEXT(set.name << ", periods " << static_cast<int>(periodic)) {
        check_by_rational_numbers(set, periodic);
        check_as_a_whole(cells_of(set, periodic), set.name);
      }
    }
  }
}

BOOST_AUTO_TEST_CASE(weighted_sets_have_the_cells_of_rational_numbers) {
  std::size_t empty = 0;
  for (Set set : hurtful_sets()) {
    const double length = static_cast<double>(set.width);
    for (const double unit : {length * length / 64, length * length, 40.0}) {
      set.weights = weights_of(set.positions.size(), unit);
      for (const Axes periodic : all_periods) {
        BOOST_TEST_CONTEXT(set.name << ", weights of " << unit << ", periods "
                                    << static_cast<int>(periodic)) {
          check_by_rational_numbers(set, periodic);
          const ExactCellsResult result = cells_of(set, periodic);
          check_as_a_whole(result, set.name);
          for (const ExactCell& cell : result.read()) empty += cell.area == 0 ? 1 : 0;
        }
      }
    }
  }
  BOOST_TEST(empty > 100u);
}

BOOST_AUTO_TEST_CASE(tilted_boxes_have_the_cells_of_rational_numbers) {
  const std::int64_t wide = side / 2;
  std::vector<Position> hexagons;  // a lattice of its own, whose rows fit the tilt
  for (std::int64_t row = 0; row < 4; ++row)
    for (std::int64_t column = 0; column < 4; ++column)
      hexagons.push_back({(wide / 4 * column + wide / 8 * row) % wide, wide / 4 * row});
  const std::vector<Position> some = random_positions(wide, wide, 12, 31);
  const Set sets[] = {
      {"random", wide, wide, some, wide / 3 + 1},
      {"random, tilted to the left", wide, wide, some, -wide / 5},
      {"half a period", wide, wide, some, wide / 2},
      {"one and a third", wide, wide, some, wide + wide / 3},
      {"flat", wide, wide / 3, random_positions(wide, wide / 3, 9, 32), wide / 2 - 7},
      {"high", wide / 4, wide, random_positions(wide / 4, wide, 9, 33), wide / 9},
      {"lattice", wide, wide, lattice(wide / 4, 4, 4), wide / 4},
      {"hexagons", wide, wide, hexagons, wide / 2},
      {"one", wide, wide, {{5, 7}}, wide / 3},
      {"one, flat", wide, wide / 3, {{5, 7}}, wide / 2},
      {"two", wide, wide / 2, {{5, 7}, {wide - 9, wide / 4}}, wide / 2 - 1},
      {"small", 20, 16, {{5, 7}, {19, 0}, {19, 15}, {0, 0}, {0, 15}}, 9},
      // Of sides just above a power of two steps are the longest, beside them.
      {"longest steps", wide / 2 + 1, wide / 2 + 1, random_positions(wide / 2, wide / 2, 9, 37), wide / 7},
  };
  for (Set set : sets) {
    const double area = static_cast<double>(set.width) * static_cast<double>(set.height);
    for (const double unit : {0.0, area / 40}) {
      if (unit > 0) set.weights = weights_of(set.positions.size(), unit);
      BOOST_TEST_CONTEXT(set.name << ", weights of " << unit) {
        check_by_rational_numbers(set, Axes::xy);
        check_as_a_whole(cells_of(set, Axes::xy), set.name);
      }
    }
  }
}

BOOST_AUTO_TEST_CASE(behind_bisectors_that_are_one_line_lies_the_farthest_site) {
  // The middle site's cell has just become empty: its bisectors with both others are one line.
  for (const auto& order : {std::vector<std::size_t>{0, 1, 2}, {2, 1, 0}, {1, 0, 2}, {1, 2, 0}}) {
    const std::vector<Position> places = {{10, 8}, {12, 8}, {14, 8}};
    const std::vector<double> weights = {4, 0, 4};  // 4 - 4 = 16 - 16 = 0 from the middle one
    Set set = {"", 32, 16, {}};
    for (const std::size_t i : order) {
      set.positions.push_back(places[i]);
      set.weights.push_back(weights[i]);
    }
    check_by_rational_numbers(set, Axes::none);
    check_by_rational_numbers(set, Axes::xy);
    const ExactCellsResult result = cells_of(set, Axes::none);
    check_as_a_whole(result, "");
    BOOST_TEST(result.read_pairs().size() == 1u);
    BOOST_TEST(result.read_pairs()[0].length == 16);
  }
}

BOOST_AUTO_TEST_CASE(a_very_flat_tilted_box_is_filled) {
  // Its short vectors are 500 rows away.
  for (const std::size_t count : {1, 3, 200}) {
    const Set set = {"very flat", side / 2, side / 2000, random_positions(side / 2, side / 2000, count, 34),
                     side / 4 - 3};
    check_as_a_whole(cells_of(set, Axes::xy), set.name);
  }
}

BOOST_AUTO_TEST_CASE(images_of_a_tilted_box_have_its_cells) {
  const Set set = {"random", 1000, 600, random_positions(1000, 600, 50, 35), 300};
  const std::vector<ExactCell> cells = cells_of(set, Axes::xy).read();
  Set moved = set;
  std::mt19937_64 random(36);
  for (Position& position : moved.positions) {
    const std::int64_t i = below(random, 7) - 3, j = below(random, 7) - 3;
    position = {position.x + i * set.width + j * set.tilt, position.y + j * set.height};
  }
  const std::vector<ExactCell> found = cells_of(moved, Axes::xy).read();
  BOOST_TEST_REQUIRE(found.size() == cells.size());
  for (std::size_t id = 0; id < cells.size(); ++id) {
    BOOST_TEST(found[id].area == cells[id].area);
    BOOST_TEST(found[id].centroid.x == cells[id].centroid.x);
    BOOST_TEST(found[id].perimeter == cells[id].perimeter);
  }
}

BOOST_AUTO_TEST_CASE(seeds_outside_the_rectangle_have_what_of_it_is_nearest_to_them) {
  std::vector<Position> positions = {{-300, 500}, {1400, 400}, {500, -1}, {1001, 1003}, {-5000, 7000}};
  for (const Position& position : random_positions(1000, 1000, 8, 5)) positions.push_back(position);
  const Set set = {"outside", 1000, 1000, positions};
  check_by_rational_numbers(set, Axes::none);
  check_as_a_whole(cells_of(set, Axes::none), set.name);
}

/// More seeds than a list holds, and some so far outside that boxes of the tree are far longer than the
/// rectangle.
BOOST_AUTO_TEST_CASE(outliers_leave_a_crowd_its_cells) {
  constexpr std::int64_t length = 1 << 20;
  for (std::uint64_t key = 1; key <= 40; ++key) {
    Set set = {"a crowd and outliers " + std::to_string(key), length, length,
               random_positions(length, length, 400, key)};
    for (const auto& [x, y] : random_positions(400 * length, 400 * length, 22, 100 + key))
      set.positions.push_back({x - 200 * length, y - 200 * length});
    check_as_a_whole(cells_of(set, Axes::none), set.name);
  }
}

/// A leaf with one site far from the others is so long that none of its cells can share a list with it, and a
/// list around one of them reaches to a 2^16th of it. There lies a site that cuts, just within reach or
/// beyond it; those around it are so many that no longer list has room.
BOOST_AUTO_TEST_CASE(lists_that_are_tiny_beside_their_leaf_miss_no_cut) {
  constexpr std::int64_t length = 1 << 30;
  std::mt19937_64 random(5);
  for (const int lags : {0, 1, 2}) {  // none, that of one site, those of all
    for (int i = 0; i < 100; ++i) {
      const std::int64_t x =
          (length / 80 + below(random, length / 400)) * 64 + 31;  // floats are multiples of 64 there
      const std::int64_t y = 40000 + below(random, 60000);
      const std::int64_t way = ((x >> 16) - 40 + below(random, 60)) / 64 * 64 + 2, half = way / 2 + 2;
      Set set = {"a spot " + std::to_string(i), length, length, {{0, y}}};
      const auto add = [&](std::int64_t along, std::int64_t across) {
        set.positions.push_back({x + along, y + across});
      };
      add(0, 0);
      for (const std::int64_t across : {half, -half}) add(half, across);
      for (const std::int64_t across : {half, -half}) add(0, across - across / 10);
      add(half / 10 - half, 0);
      add(way, 0);
      for (int k = 0; k < 400; ++k) add(way + 1 + below(random, 14000), below(random, 30000) - 15000);
      if (lags > 0) {
        set.weights.resize(set.positions.size());
        set.weights.back() = -1;
      }
      for (std::size_t k = 0; lags == 2 && k < set.weights.size(); ++k)
        set.weights[k] = static_cast<double>(below(random, way * way / 4));
      check_as_a_whole(cells_of(set, Axes::none), set.name);
    }
  }
}

namespace {

using Ids = std::pair<std::uint32_t, std::uint32_t>;

/// The edges inside the rectangle by Boost.Polygon, and their lengths, of different positions.
std::map<Ids, double> edges_by_boost(const Set& set) {
  std::vector<boost::polygon::point_data<int>> points;
  for (const Position& at : set.positions)
    points.emplace_back(static_cast<int>(at.x), static_cast<int>(at.y));
  boost::polygon::voronoi_diagram<double> diagram;
  boost::polygon::construct_voronoi(points.begin(), points.end(), &diagram);
  std::map<Ids, double> edges;
  for (const auto& edge : diagram.edges()) {
    const std::size_t i = edge.cell()->source_index(), j = edge.twin()->cell()->source_index();
    if (i > j) continue;
    const double dx = points[i].y() - static_cast<double>(points[j].y());
    const double dy = points[j].x() - static_cast<double>(points[i].x());
    const double far = 8 * static_cast<double>(side) / std::hypot(dx, dy);
    const double x = (points[i].x() + static_cast<double>(points[j].x())) / 2;
    const double y = (points[i].y() + static_cast<double>(points[j].y())) / 2;
    const auto *v0 = edge.vertex0(), *v1 = edge.vertex1();
    const Point from = v0 != nullptr ? Point{v0->x(), v0->y()} : Point{x - dx * far, y - dy * far};
    const Point to = v1 != nullptr ? Point{v1->x(), v1->y()} : Point{x + dx * far, y + dy * far};
    double begin = 0, end = 1;
    const auto clip = [&](double start, double step, double most) {
      if (step == 0) {
        if (start < 0 || start > most) end = -1;
        return;
      }
      begin = std::max(begin, std::min(-start / step, (most - start) / step));
      end = std::min(end, std::max(-start / step, (most - start) / step));
    };
    clip(from.x, to.x - from.x, static_cast<double>(set.width));
    clip(from.y, to.y - from.y, static_cast<double>(set.height));
    if (end > begin) {
      edges[{static_cast<std::uint32_t>(i), static_cast<std::uint32_t>(j)}] =
          (end - begin) * std::hypot(to.x - from.x, to.y - from.y);
    }
  }
  return edges;
}

std::vector<Position> without_doubles(std::vector<Position> positions) {
  const auto before = [](const Position& p, const Position& q) {
    return std::tie(p.x, p.y) < std::tie(q.x, q.y);
  };
  std::sort(positions.begin(), positions.end(), before);
  positions.erase(std::unique(positions.begin(), positions.end()), positions.end());
  std::shuffle(positions.begin(), positions.end(), std::mt19937(1));
  return positions;
}

/// Points around a few places, ever denser.
std::vector<Position> clusters(std::size_t count) {
  std::mt19937_64 random(7);
  std::normal_distribution<double> normal;
  std::vector<Position> positions;
  while (positions.size() < count) {
    const double spread =
        static_cast<double>(side) * std::ldexp(0.1, -static_cast<int>(positions.size() % 16));
    const double x = static_cast<double>(side) * (0.2 + 0.15 * static_cast<double>(positions.size() % 5));
    const Position at = {std::llround(x + spread * normal(random)),
                         std::llround(side * 0.4 + spread * normal(random))};
    if (at.x >= 0 && at.x < side && at.y >= 0 && at.y < side) positions.push_back(at);
  }
  return positions;
}

/// A point with all others around it, on a circle but for rounding.
std::vector<Position> star(int rays) {
  std::vector<Position> positions = {{side / 2, side / 2}};
  for (int i = 0; i < rays; ++i) {
    const double angle = 2 * 3.14159265358979323846 * i / rays, radius = 0.4 * static_cast<double>(side);
    positions.push_back({side / 2 + std::llround(radius * std::cos(angle)),
                         side / 2 + std::llround(radius * std::sin(angle))});
  }
  return positions;
}

/// Points close to each other along curves, whose cells are long and thin: a wave, and an ellipse around its
/// middle.
std::vector<Position> curves(std::size_t count) {
  std::vector<Position> positions;
  for (std::size_t i = 0; i < count; ++i) {
    const double at = static_cast<double>(i) / static_cast<double>(count),
                 angle = 2 * 3.14159265358979323846 * at;
    const Point point = i % 2 == 0 ? Point{at, 0.5 + 0.25 * std::sin(12 * at)}
                                   : Point{0.5 + 0.45 * std::cos(angle), 0.5 + 0.2 * std::sin(angle)};
    positions.push_back({std::llround(point.x * side), std::llround(point.y * side)});
  }
  return positions;
}

}  // namespace

BOOST_AUTO_TEST_CASE(large_sets_have_the_edges_that_another_library_finds) {
  const Set sets[] = {{"random", side, side, without_doubles(random_positions(side, side, 20000, 6))},
                      {"clusters", side, side, without_doubles(clusters(20000))},
                      {"curves", side, side, without_doubles(curves(20000))},
                      {"star", side, side, star(3000)}};
  for (const Set& set : sets) {
    const ExactCellsResult result = cells_of(set, Axes::none);
    const std::map<Ids, double> expected = edges_by_boost(set);
    std::map<Ids, double> found;
    for (const ExactPair& pair : result.read_pairs()) found[{pair.a, pair.b}] = pair.length;
    // Boost's vertices are right to about a millionth of a step for inner cells, and it does not compute
    // exactly beyond.
    const double least = 1e-3, tolerance = 1e-5;
    std::size_t compared = 0, missing = 0, different = 0, other = 0;
    for (const auto& [ids, length] : expected) {
      if (length < least) continue;
      ++compared;
      const auto same = found.find(ids);
      missing += same == found.end() ? 1 : 0;
      different +=
          same != found.end() && std::abs(same->second - length) > tolerance * std::max(length, 1.0) ? 1 : 0;
    }
    for (const auto& [ids, length] : found) other += length >= least && expected.count(ids) == 0 ? 1 : 0;
    BOOST_TEST(compared > 2 * set.positions.size() - 100, set.name << ": " << compared);
    BOOST_TEST(missing == 0u, set.name << ": " << missing);
    BOOST_TEST(different == 0u, set.name << ": " << different << " of " << compared);
    BOOST_TEST(other == 0u, set.name << ": " << other);
    for (const Axes periodic : all_periods) check_as_a_whole(cells_of(set, periodic), set.name);
  }
}

BOOST_AUTO_TEST_CASE(large_lattices_and_duplicates_are_mutual_and_fill_the_rectangle) {
  std::vector<Position> coarse = random_positions(side, side, 20000, 8), samples;
  for (Position& at : coarse) at = {at.x >> 23 << 23, at.y >> 23 << 23};
  const Grid map(36000, 18000);
  for (const Pixel& city : cities(map)) samples.push_back({city.x, city.y});
  const Set sets[] = {{"lattice", side, side, lattice(side / 128, 128, 128)},
                      {"duplicates", side, side, coarse},
                      {"cities", 36000, 18000, samples}};
  for (const Set& set : sets) {
    for (const Axes periodic : all_periods) check_as_a_whole(cells_of(set, periodic), set.name);
  }
  const ExactCellsResult torus = cells_of(sets[0], Axes::xy);
  const double step = static_cast<double>(side) / 128;
  for (const ExactCell& cell : torus.read()) {
    BOOST_TEST_REQUIRE(cell.neighbours == 4u);
    BOOST_TEST_REQUIRE(cell.area == step * step);
  }
}

BOOST_AUTO_TEST_CASE(the_four_points_that_geos_cuts_wrong) {
  const std::vector<Point> points = {{6.6584, 53.583000000000006},
                                     {6.6576, 53.583600000000004},
                                     {6.657, 53.5848},
                                     {6.6572000000000005, 53.5842}};
  const Grid grid(Axis(10, 6.65, 6.67), Axis(10, 53.57, 53.6));
  ExactCellsResult result;
  exact_cells(Seeds(test_device(), grid, points, to_centres), result);
  check_as_a_whole(result, "GEOS 1040");
  for (const ExactCell& cell : result.read()) BOOST_TEST((cell.neighbours >= 1 && cell.neighbours <= 3));
}

BOOST_AUTO_TEST_CASE(cells_are_in_the_units_of_the_data_and_absent_seeds_have_none) {
  const double unit = 1.0 / 1024;
  const Set set = {"random", 4096, 2048, random_positions(4096, 2048, 50, 9)};
  const ExactCellsResult steps = cells_of(set, Axes::none);
  std::vector<std::optional<Point>> points;
  for (const Position& at : set.positions)
    points.emplace_back(Point{-3 + static_cast<double>(at.x) * unit, 10 + static_cast<double>(at.y) * unit});
  points.emplace(points.begin() + 20, std::nullopt);
  const Grid grid(Axis(77, -3, 1), Axis(5, 10, 12).reversed());  // pixels do not count
  ExactCellsResult result;
  BOOST_TEST(result.size() == 0u);
  BOOST_TEST(result.read().empty());
  BOOST_TEST(result.areas()() == nullptr);
  exact_cells(Seeds(test_device(), grid, points, to_centres), result);
  const auto cells = result.read(), in_steps = steps.read();
  BOOST_TEST_REQUIRE(cells.size() == in_steps.size() + 1);
  BOOST_TEST(cells[20].area == 0);
  BOOST_TEST(std::isnan(cells[20].centroid.y));
  BOOST_TEST(cells[20].neighbours == 0u);
  for (std::size_t id = 0; id < in_steps.size(); ++id) {
    const ExactCell& cell = cells[id < 20 ? id : id + 1];
    BOOST_TEST(cell.area == in_steps[id].area * unit * unit);
    BOOST_TEST(cell.perimeter == in_steps[id].perimeter * unit);
    BOOST_TEST(std::abs(cell.centroid.x - (-3 + in_steps[id].centroid.x * unit)) < 1e-14);
    BOOST_TEST(std::abs(cell.centroid.y - (10 + in_steps[id].centroid.y * unit)) < 1e-14);
    BOOST_TEST(cell.neighbours == in_steps[id].neighbours);
  }
}

BOOST_AUTO_TEST_CASE(each_two_edges_of_a_cell_with_itself_are_one_pair) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> part;
  for (int i = 0; i < 400; ++i) {
    const double width = i % 2 == 0 ? 1 : 0.3, height = 1.3 - width;
    Grid grid(Axis(10, 0, width).periodic(), Axis(10, 0, height).periodic());
    if (i % 4 >= 2) grid = grid.tilted(width * (part(random) - 0.5));
    std::vector<Point> points(1 + random() % 5);
    for (Point& point : points) point = {width * part(random), height * part(random)};
    ExactCellsResult result;
    exact_cells(Seeds(test_device(), grid, points), result);
    std::vector<double> lengths(points.size());
    for (const ExactPair& pair : result.read_pairs()) {
      lengths[pair.a] += pair.length;
      lengths[pair.b] += pair.length;
    }
    const std::vector<ExactCell> cells = result.read();
    for (std::size_t id = 0; id < cells.size(); ++id)
      BOOST_TEST(std::abs(lengths[id] - cells[id].perimeter) < 1e-12);
  }
}

BOOST_AUTO_TEST_CASE(polygons_begin_in_their_lowest_vertex) {
  const Set sets[] = {{"random", side, side, random_positions(side, side, 500, 39)},
                      {"lattice", side, side, lattice(side / 8, 8, 8)},
                      {"star", side, side, star(100)}};
  for (const Set& set : sets) {
    for (const Axes periodic : all_periods) {
      const ExactPolygons polygons = cells_of(set, periodic).read_polygons();
      for (std::size_t id = 0; id < set.positions.size(); ++id) {
        const auto begin = polygons.vertices.begin() + polygons.offsets[id];
        const auto end = polygons.vertices.begin() + polygons.offsets[id + 1];
        const auto lowest = std::min_element(begin, end, [](const Point& p, const Point& q) {
          return std::tie(p.y, p.x) < std::tie(q.y, q.x);
        });
        BOOST_TEST_REQUIRE((lowest - begin) == 0, set.name << ", cell " << id);
      }
    }
  }
}

BOOST_AUTO_TEST_CASE(the_curve_that_sorts_points_does_not_jump) {
  constexpr std::uint32_t length = 64;
  std::vector<std::pair<std::uint64_t, Position>> places;
  for (std::uint32_t x = 0; x < length; ++x) {
    for (std::uint32_t y = 0; y < length; ++y) places.push_back({hilbert_order(x, y), {x, y}});
  }
  std::sort(places.begin(), places.end(), [](const auto& p, const auto& q) { return p.first < q.first; });
  for (std::size_t i = 0; i < places.size(); ++i) {
    BOOST_TEST_REQUIRE(places[i].first == i);
    if (i == 0) continue;
    const Position &last = places[i - 1].second, &here = places[i].second;
    BOOST_TEST_REQUIRE(std::abs(here.x - last.x) + std::abs(here.y - last.y) == 1);
  }
}

BOOST_AUTO_TEST_CASE(buffers_hold_what_is_read_and_work_groups_change_no_bit) {
  const Set set = {"random", side, side, random_positions(side, side, 500, 10)};
  Tuning tuning = test_device().tuning();
  tuning.group_width = 2;  // with 3, LLVM 18 under PoCL 6.0 ends the process: pocl issue 1608
  tuning.group_height = 1;
  tuning.vector_width = 1;
  tuning.shape = Shape::group;
  const Seeds seeds(test_device(), grid_of(set, Axes::x), points_of(set.positions), to_centres);
  const Seeds others(test_device().with_tuning(tuning), grid_of(set, Axes::x), points_of(set.positions),
                     to_centres);
  ExactCellsResult result, other;
  exact_cells(seeds, result);
  exact_cells(others, other);
  const ExactPolygons polygons = result.read_polygons(), same = other.read_polygons();
  BOOST_TEST(polygons.offsets == same.offsets);
  BOOST_TEST(polygons.neighbours == same.neighbours);
  BOOST_TEST(polygons.lengths == same.lengths);
  const auto read = [](const cl::Buffer& buffer, auto values) {
    BOOST_TEST(test_device().queue().enqueueReadBuffer(buffer, CL_TRUE, 0, values.size() * sizeof(values[0]),
                                                       values.data()) == CL_SUCCESS);
    return values;
  };
  const std::vector<ExactCell> cells = result.read();
  const auto areas = read(result.areas(), std::vector<double>(cells.size()));
  const auto centroids = read(result.centroids(), std::vector<cl_double2>(cells.size()));
  const auto perimeters = read(result.perimeters(), std::vector<double>(cells.size()));
  const auto neighbours = read(result.neighbours(), std::vector<std::uint32_t>(cells.size()));
  const auto flags = read(result.flags(), std::vector<std::uint8_t>(cells.size()));
  for (std::size_t id = 0; id < cells.size(); ++id) {
    BOOST_TEST(cells[id].area == areas[id]);
    BOOST_TEST(cells[id].centroid.x == centroids[id].s[0]);
    BOOST_TEST(cells[id].perimeter == perimeters[id]);
    BOOST_TEST(cells[id].neighbours == neighbours[id]);
    BOOST_TEST(flags[id] == (cells[id].touches_border ? 3 : 2));
  }
  BOOST_TEST_REQUIRE(result.edges() == polygons.vertices.size());
  const auto vertices = read(result.vertices(), std::vector<cl_double2>(result.edges()));
  for (std::size_t i = 0; i < vertices.size(); ++i) BOOST_TEST(vertices[i].s[1] == polygons.vertices[i].y);
  BOOST_TEST(read(result.offsets(), std::vector<std::uint32_t>(cells.size() + 1)) == polygons.offsets);
  BOOST_TEST(read(result.edge_neighbours(), std::vector<std::uint32_t>(result.edges())) ==
             polygons.neighbours);
  BOOST_TEST(read(result.lengths(), std::vector<double>(result.edges())) == polygons.lengths);
}

namespace {

bool doubles_are_hidden = false;

}  // namespace

/// Stands before the OpenCL loader's function, and can hide that a device has doubles.
extern "C" __attribute__((visibility("default"))) cl_int clGetDeviceInfo(cl_device_id device,
                                                                         cl_device_info name,
                                                                         std::size_t size, void* value,
                                                                         std::size_t* needed) {
  static const auto next = reinterpret_cast<decltype(&clGetDeviceInfo)>(dlsym(RTLD_NEXT, "clGetDeviceInfo"));
  const cl_int code = next(device, name, size, value, needed);
  if (doubles_are_hidden && name == CL_DEVICE_EXTENSIONS && value != nullptr) {
    auto* const text = static_cast<char*>(value);
    for (char* at = std::strstr(text, "fp64"); at != nullptr; at = std::strstr(at, "fp64")) *at = 'x';
  }
  return code;
}

BOOST_AUTO_TEST_CASE(points_in_a_buffer_have_the_cells_of_their_places) {
  const std::vector<cl_float2> floats = {{{0.25F, 0.5F}}, {{3.75F, 0.5F}}, {{2.5F, 3.25F}}};
  const cl::Buffer buffer(test_device().context(), CL_MEM_READ_ONLY | CL_MEM_COPY_HOST_PTR,
                          floats.size() * sizeof(cl_float2), const_cast<cl_float2*>(floats.data()));
  const PointBuffer points(buffer, floats.size());
  const Grid grid(4, 4);
  ExactCellsResult expected, found;
  exact_cells(Seeds(test_device(), grid, {{0.25, 0.5}, {3.75, 0.5}, {2.5, 3.25}}), expected);
  for (const Outside outside : {Outside::count, Outside::refuse, Outside::absent}) {
    for (const Snap snap : {Snap::none, Snap::to_pixels}) {
      exact_cells(Seeds(test_device(), grid, points, {outside, snap}), found);
      for (std::size_t i = 0; i < floats.size(); ++i)
        BOOST_TEST(found.read()[i].area == expected.read()[i].area);
    }
  }
}

BOOST_AUTO_TEST_CASE(what_cannot_be_is_refused_and_leaves_an_empty_result) {
  const Set set = {"random", side, side, random_positions(side, side, 10, 11)};
  const Seeds seeds(test_device(), grid_of(set, Axes::none), points_of(set.positions), to_centres);
  ExactCellsResult result;
  exact_cells(seeds, result);
  doubles_are_hidden = true;
  check_error([&] { exact_cells(seeds, result); }, {"double precision", "cl_khr_fp64", "another device"});
  doubles_are_hidden = false;
  BOOST_TEST(result.size() == 0u);
  BOOST_TEST(result.read_polygons().offsets.size() == 1u);
  const Grid flat(Axis(10, 0, 10), Axis(10, 3, 3));
  check_error(
      [&] {
        exact_cells(Seeds(test_device(), flat, {{1, 3}}, to_centres), result);
      },
      {"extent", "10 x 0"});
  exact_cells(Seeds(test_device(), Grid(10, 10), Points(static_cast<const Point*>(nullptr), 0), to_centres),
              result);
  BOOST_TEST(result.size() == 0u);
  BOOST_TEST(result.read_pairs().empty());
  exact_cells(seeds, result);
  BOOST_TEST(result.size() == 10u);
}
