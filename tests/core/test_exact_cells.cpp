// Exact cells: against rational numbers, where for each pair of seeds the part of their bisector is found
// that no other seed is nearer to; against Boost.Polygon's Voronoi diagram; and what must hold for every set.
#define BOOST_TEST_MODULE exact_cells
#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC diagnostic ignored "-Wmaybe-uninitialized"  // of Boost's whole numbers, where GCC is wrong
#endif
#include <boost/multiprecision/cpp_int.hpp>
#include <cmath>
#include <limits>
#include <optional>
#include <set>

#include "brute_force.hpp"
#include "fixture.hpp"
#include "samples.hpp"
#include "vorocl/exact_cells.hpp"

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
};

constexpr std::int64_t side = std::int64_t{1} << 30;
constexpr Periodic all_periods[] = {Periodic::none, Periodic::x, Periodic::y, Periodic::xy};

Grid grid_of(const Set& set, Periodic periodic) {
  const Axis x(10, 0, static_cast<double>(set.width)), y(10, 0, static_cast<double>(set.height));
  return {has_x(periodic) ? x.periodic() : x, has_y(periodic) ? y.periodic() : y};
}

std::vector<Point> points_of(const std::vector<Position>& positions) {
  return transformed(positions, [](const Position& position) {
    return Point{static_cast<double>(position.x), static_cast<double>(position.y)};
  });
}

ExactCellsResult cells_of(const Set& set, Periodic periodic) {
  ExactCellsResult result;
  exact_cells(Seeds(test_device(), grid_of(set, periodic), points_of(set.positions)), result);
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
        positions.push_back({side / 2 + p * scale, side / 2 + sign * q * scale});
        positions.push_back({side / 2 - p * scale, side / 2 + sign * q * scale});
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

Fraction fraction(Whole above, Whole below) {
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
      // Of one line that comes twice the first counts.
      if (rest < 0 || (rest == 0 && Whole(line.a) * plane.a + Whole(line.b) * plane.b > 0 && i < of))
        return {};
      continue;
    }
    const Fraction at = fraction(rest, slope);
    if (slope > 0 && (!to || at < *to)) to = at;
    if (slope < 0 && (!from || *from < at)) from = at;
  }
  if (!from || !to || !(*from < *to)) return {};
  return std::pair{*from, *to};
}

Cell reference_cell(const Set& set, Periodic periodic, std::uint32_t id) {
  const Position& own = set.positions[id];
  std::vector<HalfPlane> planes;
  const std::int64_t images_x = has_x(periodic) ? 2 : 0, images_y = has_y(periodic) ? 2 : 0;
  for (std::uint32_t other = 0; other < set.positions.size(); ++other) {
    const Position& at = set.positions[other];
    if (at == own && other < id) return {};
    if (at == own && other > id) continue;
    // Of coincident points the first one.
    if (std::find(set.positions.begin(), set.positions.begin() + other, at) != set.positions.begin() + other)
      continue;
    for (std::int64_t x = -images_x; x <= images_x; ++x) {
      for (std::int64_t y = -images_y; y <= images_y; ++y) {
        const std::int64_t a = at.x + x * set.width - own.x, b = at.y + y * set.height - own.y;
        if (a != 0 || b != 0) planes.push_back({a, b, Whole(a) * a + Whole(b) * b, other});
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
void check_by_rational_numbers(const Set& set, Periodic periodic) {
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
    for (const Periodic periodic : all_periods) {
      BOOST_TEST_CONTEXT(set.name << ", periods " << static_cast<int>(periodic)) {
        check_by_rational_numbers(set, periodic);
        check_as_a_whole(cells_of(set, periodic), set.name);
      }
    }
  }
}
