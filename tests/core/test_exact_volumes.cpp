// Exact cells of volumes: against whole and rational numbers, where each face is a polygon on its plane that
// is clipped by all others; against what the polyhedra say; and what must hold for every set.
#define BOOST_TEST_MODULE exact_volumes
#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC diagnostic ignored "-Wmaybe-uninitialized"  // of Boost's whole numbers, where GCC is wrong
#endif
#include <array>
#include <boost/multiprecision/cpp_int.hpp>
#include <cmath>
#include <cstdlib>
#include <map>
#include <random>
#include <set>
#include <tuple>

#include "exact_cells/hilbert_order.hpp"
#include "fixture.hpp"
#include "weights.hpp"

using namespace vorocl;

namespace {

using Whole = boost::multiprecision::number<boost::multiprecision::cpp_int_backend<
    512, 512, boost::multiprecision::signed_magnitude, boost::multiprecision::unchecked, void>>;
using Rational = boost::multiprecision::cpp_rational;
using Position = std::array<std::int64_t, 3>;  // whole numbers that need not be rounded

struct Set {
  std::string name;
  Position sides;
  std::vector<Position> positions;
  std::vector<double> weights = {};  // whole numbers; none: all the same
  Position tilts = {};               // xy, xz, yz

  Whole weight(std::size_t id) const { return weights.empty() ? Whole(0) : Whole(weights[id]); }

  /// Whether another point at the same place has its cell.
  bool is_covered(std::size_t id) const {
    for (std::size_t other = 0; other < positions.size(); ++other) {
      if (other == id || positions[other] != positions[id]) continue;
      if (weight(other) > weight(id) || (weight(other) == weight(id) && other < id)) return true;
    }
    return false;
  }

  /// An image of a position, so many edges of the box away.
  Position image(const Position& at, const std::array<std::int64_t, 3>& edges) const {
    return {at[0] + edges[0] * sides[0] + edges[1] * tilts[0] + edges[2] * tilts[1],
            at[1] + edges[1] * sides[1] + edges[2] * tilts[2], at[2] + edges[2] * sides[2]};
  }
};

constexpr std::int64_t side = std::int64_t{1} << 40;
constexpr Axes all_periods[] = {Axes::none, Axes::x, Axes::yz, Axes::xyz};

Grid grid_of(const Position& sides, Axes periodic, const Position& tilts = {}) {
  const auto axis = [](std::int64_t length, bool is_periodic) {
    const Axis along(2, 0, static_cast<double>(length));
    return is_periodic ? along.periodic() : along.closed();
  };
  return Grid(axis(sides[0], has_x(periodic)), axis(sides[1], has_y(periodic)),
              axis(sides[2], has_z(periodic)))
      .tilted(static_cast<double>(tilts[0]), static_cast<double>(tilts[1]), static_cast<double>(tilts[2]));
}

std::vector<Point> points_of(const std::vector<Position>& positions) {
  std::vector<Point> points;
  for (const Position& at : positions)
    points.push_back({static_cast<double>(at[0]), static_cast<double>(at[1]), static_cast<double>(at[2])});
  return points;
}

ExactCellsResult cells_of(const Set& set, Axes periodic, const Device& device = test_device()) {
  ExactCellsResult result;
  const std::vector<Point> points = points_of(set.positions);
  const Points weighted = Points(points).weighted(set.weights.empty() ? nullptr : set.weights.data());
  exact_cells(Seeds(device, grid_of(set.sides, periodic, set.tilts), weighted), result);
  return result;
}

std::vector<Position> random_positions(const Position& sides, std::size_t count, std::uint64_t key) {
  std::mt19937_64 random(key);
  std::vector<Position> positions;
  for (std::size_t i = 0; i < count; ++i) {
    Position at;
    for (std::size_t axis = 0; axis < 3; ++axis)
      at[axis] = static_cast<std::int64_t>(random() % static_cast<std::uint64_t>(sides[axis]));
    positions.push_back(at);
  }
  return positions;
}

/// Around five places, each point nearer than half of the way of the one before it, sixteen times over.
std::vector<Position> clusters(std::size_t count) {
  std::mt19937_64 random(7);
  std::normal_distribution<double> normal;
  std::vector<Position> positions;
  while (positions.size() < count) {
    const double spread = std::ldexp(0.1 * side, -static_cast<int>(positions.size() % 16));
    Position at;
    bool is_inside = true;
    for (std::size_t k = 0; k < 3; ++k) {
      at[k] = std::llround(side * (0.2 + 0.15 * static_cast<double>(positions.size() % 5)) +
                           spread * normal(random));
      is_inside = is_inside && at[k] >= 0 && at[k] < side;
    }
    if (is_inside) positions.push_back(at);
  }
  return positions;
}

/// `count` cubes along each axis, with these points in each, in quarters.
std::vector<Position> lattice(std::int64_t sides, int count, const std::vector<Position>& basis) {
  std::vector<Position> positions;
  for (int x = 0; x < count; ++x) {
    for (int y = 0; y < count; ++y) {
      for (int z = 0; z < count; ++z) {
        for (const Position& at : basis)
          positions.push_back({(4 * x + at[0]) * sides / count / 4, (4 * y + at[1]) * sides / count / 4,
                               (4 * z + at[2]) * sides / count / 4});
      }
    }
  }
  return positions;
}
const std::vector<Position> simple_cubic = {{2, 2, 2}}, body_centred = {{1, 1, 1}, {3, 3, 3}},
                            face_centred = {{1, 1, 1}, {3, 3, 1}, {3, 1, 3}, {1, 3, 3}};

/// All points at the distance 9 from a point, so many steps apart, and that one.
std::vector<Position> sphere(std::int64_t scale) {
  std::vector<Position> positions = {{side / 2, side / 2, side / 2}};
  for (std::int64_t x = -9; x <= 9; ++x) {
    for (std::int64_t y = -9; y <= 9; ++y) {
      for (std::int64_t z = -9; z <= 9; ++z) {
        if (x * x + y * y + z * z == 81)
          positions.push_back({side / 2 + x * scale, side / 2 + y * scale, side / 2 + z * scale});
      }
    }
  }
  return positions;
}

/// Directions that are spread evenly, times a radius, around the middle.
std::vector<Position> even_sphere(std::size_t count, double radius) {
  std::vector<Position> positions;
  for (std::size_t i = 0; i < count; ++i) {
    const double z = 1 - (2 * static_cast<double>(i) + 1) / static_cast<double>(count),
                 r = std::sqrt(1 - z * z);
    const double angle = 2.399963229728653 * static_cast<double>(i);
    positions.push_back({side / 2 + std::llround(radius * r * std::cos(angle)),
                         side / 2 + std::llround(radius * r * std::sin(angle)),
                         side / 2 + std::llround(radius * z)});
  }
  return positions;
}

std::vector<Set> small_sets() {
  const Position cube = {side, side, side};
  std::vector<Position> near, line, plane, border, equal(5, {5, 6, 7});
  for (const Position& at : random_positions({side - 1, side - 1, side - 1}, 5, 3)) {
    near.push_back(at);
    near.push_back({at[0] + 1, at[1], at[2]});
  }
  for (std::int64_t i = 0; i < 9; ++i) {
    line.push_back({i * i * (side / 100) + 7, side / 3, side / 5});
    plane.push_back({i % 3 * (side / 3) + 11, i / 3 * (side / 3) + i, side / 2});
    border.push_back({i % 2 == 0 ? 0 : side - 1, i * (side / 9),
                      i % 3 == 0   ? 0
                      : i % 3 == 1 ? side / 2
                                   : side - 1});
  }
  border.push_back({0, 0, 0});
  return {{"random", cube, random_positions(cube, 14, 1)},
          {"flat", {side, side / 10, side / 100}, random_positions({side, side / 10, side / 100}, 10, 2)},
          {"simple cubic", cube, lattice(side, 2, simple_cubic)},
          {"body centred", cube, lattice(side, 2, body_centred)},
          {"face centred", cube, lattice(side, 1, face_centred)},
          {"small lattice", cube, lattice(8, 2, body_centred)},
          {"near duplicates", cube, near},
          {"line", cube, line},
          {"plane", cube, plane},
          {"border", cube, border},
          {"one", {side, side / 4, side / 3}, {{5, 7, 9}}},
          {"two", cube, {{5, 7, 9}, {side - 9, side / 2, side / 3}}},
          {"two in a row", cube, {{5, 7, 9}, {side / 2 + 5, 7, 9}}},
          {"all equal", cube, equal},
          {"no steps to spare", {2, 2, 2}, {{0, 0, 0}, {1, 1, 1}, {0, 1, 0}, {1, 0, 0}}}};
}

// --- whole and rational numbers ---

/// Where n.v <= c, in half steps from a cell's site.
struct HalfSpace {
  Position n;
  Whole c;
  std::uint32_t cell;   // behind it
  Whole distance = {};  // squared, of the site behind it
};

struct Vertex {
  std::array<Whole, 3> above;
  Whole below;  // positive
};

Whole determinant(const Position& p, const Position& q, const Position& r) {
  return Whole(p[0]) * (Whole(q[1]) * r[2] - Whole(q[2]) * r[1]) +
         Whole(p[1]) * (Whole(q[2]) * r[0] - Whole(q[0]) * r[2]) +
         Whole(p[2]) * (Whole(q[0]) * r[1] - Whole(q[1]) * r[0]);
}

Vertex crossing(const HalfSpace& p, const HalfSpace& q, const HalfSpace& r) {
  Vertex vertex;
  vertex.below = determinant(p.n, q.n, r.n);
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = (i + 1) % 3, k = (i + 2) % 3;
    const auto minor = [&](const HalfSpace& a, const HalfSpace& b) {
      return Whole(a.n[j]) * b.n[k] - Whole(a.n[k]) * b.n[j];
    };
    vertex.above[i] = p.c * minor(q, r) + q.c * minor(r, p) + r.c * minor(p, q);
  }
  if (vertex.below < 0) {
    vertex.below = -vertex.below;
    for (Whole& coordinate : vertex.above) coordinate = -coordinate;
  }
  return vertex;
}

/// 1: it is beyond the plane, 0: on it.
int side_of(const Vertex& vertex, const HalfSpace& plane) {
  const Whole over = plane.n[0] * vertex.above[0] + plane.n[1] * vertex.above[1] +
                     plane.n[2] * vertex.above[2] - plane.c * vertex.below;
  return over > 0 ? 1 : over < 0 ? -1 : 0;
}

/// The part of a plane that is in all half spaces: its vertices in order; none if that has no area.
std::vector<Vertex> face_of(const std::vector<const HalfSpace*>& spaces, std::size_t of) {
  const HalfSpace& plane = *spaces[of];
  std::size_t axis = 0;
  for (std::size_t k = 1; k < 3; ++k)
    if (std::abs(plane.n[k]) > std::abs(plane.n[axis])) axis = k;
  // A square along the other two axes, far around.
  std::array<HalfSpace, 4> ends;
  for (std::size_t k = 0; k < 4; ++k) {
    ends[k] = {{0, 0, 0}, Whole(1) << 50, no_label};
    ends[k].n[(axis + 1 + k % 2) % 3] = k < 2 ? 1 : -1;
  }
  struct Edge {
    const HalfSpace* along;
    Vertex end;
  };
  std::vector<Edge> edges;
  for (std::size_t k = 0; k < 4; ++k)
    edges.push_back({&ends[k], crossing(plane, ends[k], ends[(k + 1) % 4])});
  for (std::size_t i = 0; i < spaces.size(); ++i) {
    const HalfSpace& other = *spaces[i];
    if (i == of) continue;
    const Whole x = Whole(plane.n[1]) * other.n[2] - Whole(plane.n[2]) * other.n[1],
                y = Whole(plane.n[2]) * other.n[0] - Whole(plane.n[0]) * other.n[2],
                z = Whole(plane.n[0]) * other.n[1] - Whole(plane.n[1]) * other.n[0];
    std::vector<int> sides;
    for (const Edge& edge : edges) sides.push_back(side_of(edge.end, other));
    if (x == 0 && y == 0 && z == 0) {
      // Behind a plane that comes twice lies the farthest site; sides of the box come first.
      const bool is_same = Whole(plane.n[axis]) * other.n[axis] > 0;
      const bool is_behind = other.cell == no_label || (plane.cell != no_label && i > of);
      if (sides[0] > 0 || (sides[0] == 0 && (!is_same || is_behind))) return {};
      continue;
    }
    if (*std::max_element(sides.begin(), sides.end()) <= 0) continue;
    if (*std::min_element(sides.begin(), sides.end()) >= 0) return {};
    std::vector<Edge> kept;
    const std::size_t count = edges.size();
    for (std::size_t k = 0; k < count; ++k) {
      const bool begins_inside = sides[(k + count - 1) % count] < 0, ends_inside = sides[k] < 0;
      if (begins_inside && !ends_inside)
        kept.push_back({edges[k].along, crossing(plane, *edges[k].along, other)});
      if (ends_inside && !begins_inside) kept.push_back({&other, crossing(plane, other, *edges[k].along)});
      if (ends_inside) kept.push_back(edges[k]);
    }
    edges = kept;
    if (edges.size() < 3) return {};
  }
  std::vector<Vertex> vertices;
  for (const Edge& edge : edges) vertices.push_back(edge.end);
  return vertices;
}

/// The faces of a cell, and what is behind each. Half spaces that cut off a vertex of a few, or have all of a
/// face on their plane, join these until there is none.
std::vector<std::pair<const HalfSpace*, std::vector<Vertex>>> faces_of(const std::vector<HalfSpace>& spaces) {
  constexpr std::size_t first = 24;
  std::vector<bool> is_taken(spaces.size());
  std::fill_n(is_taken.begin(), std::min(first, spaces.size()), true);
  while (true) {
    std::vector<const HalfSpace*> taken;
    for (std::size_t i = 0; i < spaces.size(); ++i)
      if (is_taken[i]) taken.push_back(&spaces[i]);
    std::vector<std::pair<const HalfSpace*, std::vector<Vertex>>> faces;
    for (std::size_t of = 0; of < taken.size(); ++of) {
      std::vector<Vertex> face = face_of(taken, of);
      if (!face.empty()) faces.emplace_back(taken[of], std::move(face));
    }
    bool is_whole = true;
    for (const auto& face : faces) {
      std::vector<std::array<double, 3>> near;  // in doubles, which rule most half spaces out
      double away = 0;
      for (const Vertex& vertex : face.second) {
        near.emplace_back();
        for (std::size_t k = 0; k < 3; ++k) {
          near.back()[k] = vertex.above[k].convert_to<double>() / vertex.below.convert_to<double>();
          away = std::max(away, std::abs(near.back()[k]));
        }
      }
      for (std::size_t i = 0; i < spaces.size(); ++i) {
        if (is_taken[i]) continue;
        const HalfSpace& space = spaces[i];
        double most = -std::numeric_limits<double>::infinity(), length = 0;
        for (std::size_t k = 0; k < 3; ++k) length += std::abs(static_cast<double>(space.n[k]));
        for (const auto& at : near) {
          double along = 0;
          for (std::size_t k = 0; k < 3; ++k) along += static_cast<double>(space.n[k]) * at[k];
          most = std::max(most, along);
        }
        const double c = space.c.convert_to<double>();
        if (most - c < -1e-12 * (length * away + std::abs(c))) continue;
        int least_side = 1, greatest_side = -1;
        for (const Vertex& vertex : face.second) {
          least_side = std::min(least_side, side_of(vertex, space));
          greatest_side = std::max(greatest_side, side_of(vertex, space));
        }
        if (greatest_side <= 0 && least_side < 0) continue;
        is_taken[i] = true;
        is_whole = false;
        break;
      }
    }
    if (is_whole) return faces;
  }
}

using Vector = std::array<Rational, 3>;

Rational rational(const Whole& number) { return Rational(boost::multiprecision::cpp_int(number)); }

Vector rational(const Vertex& vertex) {
  Vector at;
  for (std::size_t k = 0; k < 3; ++k) at[k] = rational(vertex.above[k]) / rational(vertex.below);
  return at;
}

Rational determinant(const Vector& p, const Vector& q, const Vector& r) {
  return p[0] * (q[1] * r[2] - q[2] * r[1]) + p[1] * (q[2] * r[0] - q[0] * r[2]) +
         p[2] * (q[0] * r[1] - q[1] * r[0]);
}

struct Cell {
  Rational volume = 0;        // in half steps
  Vector moment = {0, 0, 0};  // around the site
  std::multiset<std::uint32_t> neighbours;
  double surface = 0;
};

Cell reference_cell(const Set& set, Axes periodic, std::uint32_t id) {
  const Position& own = set.positions[id];
  const bool repeats[3] = {has_x(periodic), has_y(periodic), has_z(periodic)};
  // No place is farther from all images of a site than half of the diagonal of what repeats: squared half
  // steps.
  Whole farthest = 0;
  for (std::size_t k = 0; k < 3; ++k) farthest += Whole(set.sides[k]) * set.sides[k] * (repeats[k] ? 1 : 4);
  std::vector<HalfSpace> spaces;
  for (std::uint32_t other = 0; other < set.positions.size(); ++other) {
    if (set.is_covered(other)) continue;
    const std::int64_t images = set.tilts != Position{} ? 9 : set.positions.size() > 3 ? 1 : 2;
    Position way;
    for (way[0] = -images; way[0] <= images; ++way[0]) {
      for (way[1] = -images; way[1] <= images; ++way[1]) {
        for (way[2] = -images; way[2] <= images; ++way[2]) {
          Position n = set.image(set.positions[other], way);
          Whole square = 0;
          bool is_there = true;
          for (std::size_t k = 0; k < 3; ++k) {
            is_there = is_there && (repeats[k] || way[k] == 0);
            n[k] -= own[k];
            square += Whole(n[k]) * n[k];
          }
          if (!is_there || square == 0) continue;
          const Whole c = square + set.weight(id) - set.weight(other);
          if (c <= 0 || c * c <= square * farthest) spaces.push_back({n, c, other, square});
        }
      }
    }
  }
  for (std::size_t k = 0; k < 3; ++k) {
    if (repeats[k]) continue;
    HalfSpace low = {{0, 0, 0}, 2 * own[k], no_label, 1},
              high = {{0, 0, 0}, 2 * (set.sides[k] - own[k]), no_label, 1};
    low.n[k] = -1;
    high.n[k] = 1;
    spaces.push_back(low);
    spaces.push_back(high);
  }
  std::stable_sort(spaces.begin(), spaces.end(),
                   [](const HalfSpace& p, const HalfSpace& q) { return p.distance < q.distance; });
  Cell cell;
  if (set.is_covered(id)) return cell;
  for (const auto& [space, face] : faces_of(spaces)) {
    cell.neighbours.insert(space->cell);
    const Vector first = rational(face[0]);
    Vector area = {0, 0, 0};
    for (std::size_t k = 2; k < face.size(); ++k) {
      const Vector p = rational(face[k - 1]), q = rational(face[k]);
      Rational part = determinant(first, p, q);
      if ((part < 0) != (space->c < 0)) part = -part;  // below 0 where the site is beyond the face
      cell.volume += part / 6;
      for (std::size_t i = 0; i < 3; ++i) {
        const std::size_t j = (i + 1) % 3, l = (i + 2) % 3;
        cell.moment[i] += part / 6 * (first[i] + p[i] + q[i]) / 4;
        area[i] += ((p[j] - first[j]) * (q[l] - first[l]) - (p[l] - first[l]) * (q[j] - first[j])) / 2;
      }
    }
    const Rational square = area[0] * area[0] + area[1] * area[1] + area[2] * area[2];
    cell.surface += std::sqrt(square.convert_to<double>());
  }
  return cell;
}

/// Compares a set's cells with those of rational numbers: all, or each of so many.
void check_by_rational_numbers(const Set& set, Axes periodic, std::uint32_t each = 1, double error = 1e-14) {
  const ExactCellsResult result = cells_of(set, periodic);
  const std::vector<ExactCell> cells = result.read();
  const ExactPolyhedra polyhedra = result.read_polyhedra();
  BOOST_TEST_REQUIRE(cells.size() == set.positions.size());
  for (std::uint32_t id = 0; id < cells.size(); id += each) {
    const Cell expected = reference_cell(set, periodic, id);
    const ExactCell& cell = cells[id];
    BOOST_TEST_CONTEXT("cell " << id) {
      BOOST_TEST(cell.certified);
      const double volume = Rational(expected.volume / 8).convert_to<double>();
      // With weights vertices are far from points: they are right to 2^-50 of that distance.
      const double length = static_cast<double>(set.sides[0]);
      const double doubt = set.weights.empty() ? 0 : 1e-14 * expected.surface * length;
      BOOST_TEST(std::abs(cell.area - volume) <= error * volume + doubt, cell.area << " " << volume);
      BOOST_TEST(std::abs(cell.perimeter - expected.surface / 4) <= std::max(error, 1e-13) * cell.perimeter);
      const std::multiset<std::uint32_t> found(polyhedra.neighbours.begin() + polyhedra.offsets[id],
                                               polyhedra.neighbours.begin() + polyhedra.offsets[id + 1]);
      BOOST_TEST(found == expected.neighbours);
      BOOST_TEST(cell.neighbours == found.size() - found.count(no_label));
      BOOST_TEST(cell.touches_border == (found.count(no_label) > 0));
      const double centroid[] = {cell.centroid.x, cell.centroid.y, cell.centroid.z};
      for (std::size_t k = 0; k < 3; ++k) {
        if (expected.volume == 0) {
          BOOST_TEST(std::isnan(centroid[k]));
          continue;
        }
        const double at = static_cast<double>(set.positions[id][k]) +
                          Rational(expected.moment[k] / expected.volume / 2).convert_to<double>();
        BOOST_TEST(std::abs(centroid[k] - at) <= error * length + doubt / volume * length);
      }
    }
  }
}

// --- what must hold for all sets ---

Point difference(const Point& p, const Point& q) { return {p.x - q.x, p.y - q.y, p.z - q.z}; }
Point cross(const Point& p, const Point& q) {
  return {p.y * q.z - p.z * q.y, p.z * q.x - p.x * q.z, p.x * q.y - p.y * q.x};
}
double dot(const Point& p, const Point& q) { return p.x * q.x + p.y * q.y + p.z * q.z; }

/// Each edge of a polyhedron is one of two faces, once each way; Euler's formula holds; faces look outwards;
/// and they and the volume are as large as it is said.
void check_polyhedra(const ExactCellsResult& result) {
  const std::vector<ExactCell> cells = result.read();
  const ExactPolyhedra all = result.read_polyhedra();
  std::size_t open = 0, not_euler = 0, of_other_cells = 0, areas = 0, volumes = 0;
  for (std::size_t id = 0; id < cells.size(); ++id) {
    const std::size_t first = all.vertex_offsets[id], end = all.vertex_offsets[id + 1];
    const std::size_t faces = all.offsets[id + 1] - all.offsets[id];
    std::set<std::pair<std::uint64_t, std::uint64_t>> edges;
    double volume = 0;
    for (std::size_t face = all.offsets[id]; face < all.offsets[id + 1]; ++face) {
      Point area;
      const std::size_t begin = all.corner_offsets[face], count = all.corner_offsets[face + 1] - begin;
      for (std::size_t k = 0; k < count; ++k) {
        const std::uint64_t from = all.corners[begin + k], to = all.corners[begin + (k + 1) % count];
        of_other_cells += from < first || from >= end ? 1 : 0;
        edges.insert({from, to});
        const Point part = cross(difference(all.vertices[from], all.vertices[first]),
                                 difference(all.vertices[to], all.vertices[first]));
        area = {area.x + part.x / 2, area.y + part.y / 2, area.z + part.z / 2};
      }
      const Point corner = difference(all.vertices[all.corners[begin]], all.vertices[first]);
      volume += dot(corner, area) / 3;
      areas += std::abs(std::sqrt(dot(area, area)) - all.areas[face]) <= 1e-9 * cells[id].perimeter ? 0 : 1;
    }
    for (const auto& [from, to] : edges) open += edges.count({to, from}) == 1 ? 0 : 1;
    if (faces > 0) not_euler += (end - first) + faces == edges.size() / 2 + 2 ? 0 : 1;
    double away = 0;  // of vertices, which are rounded: thin cells are wrong by that
    for (std::size_t k = first; k < end; ++k)
      away = std::max(away, std::sqrt(dot(all.vertices[k], all.vertices[k])));
    const double doubt = 1e-14 * cells[id].perimeter * away;
    volumes += std::abs(volume - cells[id].area) <= 1e-9 * cells[id].area + doubt ? 0 : 1;
  }
  BOOST_TEST(open == 0u);
  BOOST_TEST(not_euler == 0u);
  BOOST_TEST(of_other_cells == 0u);
  BOOST_TEST(areas == 0u);
  BOOST_TEST(volumes == 0u);
}

void check_as_a_whole(const ExactCellsResult& result) {
  const ExactCellsCheck check = result.check();
  BOOST_TEST(check.not_mutual == 0u);
  BOOST_TEST(check.uncertified == 0u);
  BOOST_TEST(std::abs(check.area / check.rectangle_area - 1) < 1e-13,
             check.area << " " << check.rectangle_area);
}

}  // namespace

BOOST_AUTO_TEST_CASE(small_sets_have_the_cells_of_rational_numbers) {
  for (const Set& set : small_sets()) {
    for (const Axes periodic : all_periods) {
      BOOST_TEST_CONTEXT(set.name << ", periods " << static_cast<int>(periodic)) {
        check_by_rational_numbers(set, periodic);
        const ExactCellsResult result = cells_of(set, periodic);
        check_as_a_whole(result);
        check_polyhedra(result);
      }
    }
  }
}

/// As in planes (test_exact_cells.cpp).
BOOST_AUTO_TEST_CASE(lists_that_are_tiny_beside_their_leaf_miss_no_cut) {
  constexpr std::int64_t unit = 65536;  // of floats that are so far away
  std::mt19937_64 random(5);
  const auto below = [&](std::int64_t end) {
    return static_cast<std::int64_t>(random() % static_cast<std::uint64_t>(end));
  };
  for (int i = 0; i < 60; ++i) {
    const std::int64_t x = side / 5 * 4 / unit * unit + below(side / unit / 6) * unit + unit / 2 - 1;
    const std::int64_t y = 20000000 + below(60000000), z = 20000000 + below(60000000);
    const std::int64_t reach = x / unit * 3 / 8;
    const std::int64_t way = (reach - 2000 - below(55000)) / unit * unit + 2, half = way / 2 + 200;
    const std::int64_t slanted = half * 7071 / 10000, shorter = half - half / 10;
    Set set = {"a spot", {side, side, side}, {{0, y, z}}};
    const auto add = [&](std::int64_t along, std::int64_t across, std::int64_t up) {
      set.positions.push_back({x + along, y + across, z + up});
    };
    add(0, 0, 0);
    for (const std::int64_t across : {slanted, -slanted}) {
      for (const std::int64_t up : {slanted, -slanted}) add(half, across, up);
    }
    for (const std::int64_t sideways : {shorter, -shorter}) add(0, sideways, 0), add(0, 0, sideways);
    add(-shorter, 0, 0);
    add(way, 0, 0);
    for (int k = 0; k < 1300; ++k)
      add(way + 1 + below(reach * 7 / 10), below(2 * reach) - reach, below(2 * reach) - reach);
    check_as_a_whole(cells_of(set, Axes::none));
  }
}

BOOST_AUTO_TEST_CASE(clusters_and_lattices_have_the_cells_of_rational_numbers) {
  const Position cube = {side, side, side};
  const Set sets[] = {{"clusters", cube, clusters(997)},
                      {"simple cubic", cube, lattice(side, 4, simple_cubic)},
                      {"body centred", cube, lattice(side, 3, body_centred)},
                      {"face centred", cube, lattice(side, 3, face_centred)}};
  const std::uint32_t each = std::getenv("VOROCL_LONG_TESTS") != nullptr ? 1 : 29;
  for (const Set& set : sets) {
    for (const Axes periodic : {Axes::none, Axes::xyz}) {
      BOOST_TEST_CONTEXT(set.name << ", periods " << static_cast<int>(periodic)) {
        check_by_rational_numbers(set, periodic, each, 1e-12);
        check_as_a_whole(cells_of(set, periodic));
      }
    }
  }
}

BOOST_AUTO_TEST_CASE(tilted_sets_have_the_cells_of_rational_numbers) {
  constexpr std::int64_t half = side / 2;  // as many steps as a tilted box has
  const Position cube = {half, half, half}, flat = {half, half / 8, half / 16},
                 bar = {half / 16, half, half / 8};
  const auto share = [](std::int64_t part) { return part * (half / 100) + 1; };
  const Set sets[] = {
      {"random", cube, random_positions(cube, 6, 31), {}, {share(30), share(-20), share(45)}},
      {"strongly tilted", cube, random_positions(cube, 4, 32), {}, {share(250), share(-130), share(170)}},
      {"as far as can be", cube, random_positions(cube, 4, 33), {}, {half / 2, half / 2, half / 2}},
      {"flat", flat, random_positions(flat, 3, 34), {}, {share(40), share(30), share(5)}},
      {"a bar", bar, random_positions(bar, 3, 35), {}, {share(2), share(-3), share(25)}},
      {"one", cube, {{5, 7, 9}}, {}, {share(30), share(-20), share(45)}},
      {"a body centred lattice", {8, 8, 4}, {{1, 2, 3}}, {}, {0, 4, 4}},
      {"a face centred lattice", {half, half / 2, half / 2}, {{1, 2, 3}}, {}, {half / 2, half / 2, 0}},
      {"hexagons", {8, 4, 4}, {{1, 2, 3}}, {}, {4, 0, 0}},
      {"two of a lattice", {16, 8, 4}, {{1, 2, 3}, {9, 2, 3}}, {}, {8, 4, 4}},
      {"on walls", {8, 8, 8}, {{0, 0, 0}, {4, 4, 4}, {0, 4, 0}, {7, 0, 7}}, {}, {3, -4, 1}}};
  for (Set set : sets) {
    for (const double unit : {0.0, static_cast<double>(set.sides[1]) * static_cast<double>(set.sides[1])}) {
      BOOST_TEST_CONTEXT(set.name << ", weights of " << unit) {
        if (unit > 0) set.weights = weights_of(set.positions.size(), unit);
        check_by_rational_numbers(set, Axes::xyz);
        const ExactCellsResult result = cells_of(set, Axes::xyz);
        check_as_a_whole(result);
        check_polyhedra(result);
      }
    }
  }
  BOOST_TEST(cells_of(sets[6], Axes::xyz).read()[0].neighbours == 14u);
  BOOST_TEST(cells_of(sets[7], Axes::xyz).read()[0].neighbours == 12u);
  // With walls across the third axis.
  for (const auto& [periodic, tilts] : {std::pair{Axes::xy, Position{share(40), 0, 0}},
                                        {Axes::xz, Position{0, share(-40), 0}},
                                        {Axes::yz, Position{0, 0, share(30)}}}) {
    const Set set = {"walls", cube, random_positions(cube, 5, 36), {}, tilts};
    BOOST_TEST_CONTEXT("periods " << static_cast<int>(periodic)) {
      check_by_rational_numbers(set, periodic);
      check_as_a_whole(cells_of(set, periodic));
    }
  }
}

BOOST_AUTO_TEST_CASE(tilted_boxes_are_filled_and_whole_periods_of_a_tilt_change_nothing) {
  const Position cube = {side / 2, side / 2, side / 2}, rod = {side / 2, side / 20, side / 200};
  const Set sets[] = {{"random", cube, random_positions(cube, 3000, 6), {}, {side / 5, side / 7, -side / 9}},
                      {"lattice", cube, lattice(side / 2, 8, face_centred), {}, {side / 8, side / 8, 0}},
                      {"rod", rod, random_positions(rod, 1000, 5), {}, {side / 5, side / 7, side / 50}}};
  for (const Set& set : sets) {
    Set same = set;
    for (std::size_t k = 0; k < 3; ++k) same.tilts[k] += (k < 2 ? 2 : 0) * set.sides[0];
    BOOST_TEST_CONTEXT(set.name) {
      const ExactCellsResult result = cells_of(set, Axes::xyz);
      check_as_a_whole(result);
      check_polyhedra(result);
      const std::vector<ExactCell> cells = result.read(), others = cells_of(same, Axes::xyz).read();
      std::size_t different = 0;
      for (std::size_t id = 0; id < cells.size(); ++id) {
        const bool is_same = std::abs(cells[id].area / others[id].area - 1) < 1e-13;
        different += is_same && cells[id].neighbours == others[id].neighbours ? 0 : 1;
      }
      BOOST_TEST(different == 0u);
    }
  }
}

BOOST_AUTO_TEST_CASE(weighted_sets_have_the_cells_of_rational_numbers) {
  std::size_t empty = 0;
  for (Set set : small_sets()) {
    const double length = static_cast<double>(set.sides[0]);
    for (const double unit : {length * length / 64, length * length, 40.0}) {
      set.weights = weights_of(set.positions.size(), unit);
      for (const Axes periodic : all_periods) {
        BOOST_TEST_CONTEXT(set.name << ", weights of " << unit << ", periods "
                                    << static_cast<int>(periodic)) {
          check_by_rational_numbers(set, periodic);
          const ExactCellsResult result = cells_of(set, periodic);
          check_as_a_whole(result);
          check_polyhedra(result);
          for (const ExactCell& cell : result.read()) empty += cell.area == 0 ? 1 : 0;
        }
      }
    }
  }
  BOOST_TEST(empty > 100u);
}

/// On a small lattice, with small whole weights: bisectors of several sites are one plane, and planes touch
/// cells.
BOOST_AUTO_TEST_CASE(weighted_lattices_have_the_cells_of_rational_numbers) {
  std::mt19937_64 random(8);
  for (int i = 0; i < 24; ++i) {
    Set set = {"weighted lattice " + std::to_string(i), {8, 8, 8}, {}};
    const auto below = [&random](std::uint64_t end) { return static_cast<std::int64_t>(random() % end); };
    for (int site = 0; site < 20; ++site) {
      const std::int64_t x = 1 + 2 * below(4), y = 1 + 2 * below(4), z = 1 + 4 * below(2);
      set.positions.push_back({x, y, z});
      set.weights.push_back(static_cast<double>(4 * below(3)));
    }
    BOOST_TEST_CONTEXT(set.name) {
      check_by_rational_numbers(set, Axes::none);
      const ExactCellsResult result = cells_of(set, Axes::none);
      check_as_a_whole(result);
      check_polyhedra(result);
    }
  }
}

BOOST_AUTO_TEST_CASE(places_belong_to_the_site_of_the_least_power) {
  // Few heavy sites beside many light ones, some of whose cells are empty, and others far from their sites.
  Set set = {"", {64, 64, 64}, random_positions({64, 64, 64}, 3000, 22)};
  std::mt19937_64 random(23);
  for (std::size_t id = 0; id < set.positions.size(); ++id)
    set.weights.push_back(static_cast<double>(id % 300 == 0 ? 150 + random() % 100 : random() % 12));
  for (const Axes periodic : {Axes::none, Axes::xyz}) {
    const ExactCellsResult result = cells_of(set, periodic);
    check_as_a_whole(result);
    check_polyhedra(result);
    const std::vector<ExactCell> cells = result.read();
    const ExactPolyhedra all = result.read_polyhedra();
    // No place among so many has a site that is better than that of its cell.
    std::vector<std::size_t> places(cells.size());
    std::size_t wrong = 0;
    for (int i = 0; i < 3000; ++i) {
      std::array<double, 3> at;
      for (double& coordinate : at) coordinate = static_cast<double>(random() % 4096) / 64 + 1.0 / 256;
      double least = std::numeric_limits<double>::infinity();
      std::size_t owner = 0;
      for (std::size_t id = 0; id < cells.size(); ++id) {
        double power = -set.weights[id];
        for (std::size_t k = 0; k < 3; ++k) {
          double way = std::abs(at[k] - static_cast<double>(set.positions[id][k]));
          if (periodic == Axes::xyz) way = std::min(way, 64 - way);
          power += way * way;
        }
        if (power < least) owner = id;
        least = std::min(least, power);
      }
      ++places[owner];
      // The owner's polyhedron has it, or an image of it, inside.
      bool is_inside = false;
      for (int image = 0; image < 27; ++image) {
        const Point moved = {at[0] + 64 * (image % 3 - 1), at[1] + 64 * (image / 3 % 3 - 1),
                             at[2] + 64 * (image / 9 - 1)};
        bool holds = all.offsets[owner] < all.offsets[owner + 1];
        for (std::size_t face = all.offsets[owner]; holds && face < all.offsets[owner + 1]; ++face) {
          const std::uint64_t* const corners = &all.corners[all.corner_offsets[face]];
          const Point &p = all.vertices[corners[0]], &q = all.vertices[corners[1]],
                      &r = all.vertices[corners[2]];
          holds = dot(cross(difference(q, p), difference(r, p)), difference(moved, p)) <= 1e-9;
        }
        is_inside = is_inside || holds;
      }
      wrong += is_inside ? 0 : 1;
    }
    BOOST_TEST(wrong == 0u);
    std::size_t empty = 0;
    for (const ExactCell& cell : cells) empty += cell.area == 0 ? 1 : 0;
    BOOST_TEST(empty > 400u);
    BOOST_TEST(empty < 2500u);
  }
}

BOOST_AUTO_TEST_CASE(equal_weights_change_nothing_and_bad_ones_are_refused) {
  Set set = {"", {side, side, side}, random_positions({side, side, side}, 200, 24)};
  const std::vector<ExactCell> cells = cells_of(set, Axes::xyz).read();
  set.weights.assign(200, 7.5);
  const std::vector<ExactCell> same = cells_of(set, Axes::xyz).read();
  for (std::size_t id = 0; id < cells.size(); ++id) {
    BOOST_TEST(cells[id].area == same[id].area);
    BOOST_TEST(cells[id].centroid.x == same[id].centroid.x);
  }
  set.weights.back() = std::numeric_limits<double>::quiet_NaN();
  check_error([&] { cells_of(set, Axes::xyz); }, {"seed 199", "nan", "finite"});
  // Of absent seeds they are not looked at.
  std::vector<std::optional<Point>> points = {Point{1, 1, 1}, std::nullopt, Point{3, 1, 1}};
  const std::vector<double> weights = {0, std::nan(""), 2};
  ExactCellsResult result;
  exact_cells(Seeds(test_device(), Grid(4, 2, 2), Points(points).weighted(weights.data())), result);
  const std::vector<ExactCell> three = result.read();
  BOOST_TEST(three[0].area == 1.5 * 4);  // (4 - 2) / (2 * 2) from the first one
  BOOST_TEST(three[2].area == 2.5 * 4);
}

BOOST_AUTO_TEST_CASE(large_sets_fill_the_box_and_are_mutual) {
  const Position cube = {side, side, side};
  std::vector<Position> noisy = lattice(side, 10, face_centred), coarse = random_positions(cube, 3000, 8);
  std::mt19937_64 random(7);
  for (Position& at : noisy)
    for (std::int64_t& coordinate : at) coordinate += static_cast<std::int64_t>(random() % 5) - 2;
  for (Position& at : coarse)
    for (std::int64_t& coordinate : at) coordinate = coordinate >> 36 << 36;
  const Position rod = {side, side / 10, side / 100};
  const Set sets[] = {{"random", cube, random_positions(cube, 5000, 6)},
                      {"rod", rod, random_positions(rod, 2000, 5)},
                      {"lattice with noise", cube, noisy},
                      {"duplicates", cube, coarse},
                      {"clusters", cube, clusters(4000)},
                      {"a line", {side, side, side}, random_positions({side, 1, 1}, 500, 9)},
                      {"a plane", {side, side, side}, random_positions({side, side, 1}, 500, 10)}};
  for (const Set& set : sets) {
    for (const Axes periodic : {Axes::none, Axes::xyz}) {
      BOOST_TEST_CONTEXT(set.name << ", periods " << static_cast<int>(periodic)) {
        const ExactCellsResult result = cells_of(set, periodic);
        check_as_a_whole(result);
        check_polyhedra(result);
      }
    }
  }
}

BOOST_AUTO_TEST_CASE(lattices_have_their_polyhedra) {
  const std::tuple<std::vector<Position>, std::uint32_t, std::size_t> lattices[] = {
      {simple_cubic, 6, 8}, {body_centred, 14, 24}, {face_centred, 12, 14}};  // faces and vertices
  for (const auto& [basis, faces, vertices] : lattices) {
    const ExactCellsResult result = cells_of({"", {side, side, side}, lattice(side, 8, basis)}, Axes::xyz);
    const std::vector<ExactCell> cells = result.read();
    const double volume = std::pow(static_cast<double>(side) / 8, 3) / static_cast<double>(basis.size());
    for (const ExactCell& cell : cells) {
      BOOST_TEST_REQUIRE(cell.neighbours == faces);
      BOOST_TEST_REQUIRE(std::abs(cell.area / volume - 1) < 1e-14);
    }
    BOOST_TEST(result.read_polyhedra().vertices.size() == vertices * cells.size());
    check_polyhedra(result);
  }
}

BOOST_AUTO_TEST_CASE(a_cell_of_thousands_of_faces_is_cut_in_global_memory) {
  std::vector<Position> positions = even_sphere(3000, 0.4 * static_cast<double>(side));
  positions.push_back({side / 2, side / 2, side / 2});
  for (const std::vector<Position>& of : {positions, sphere(side / 64)}) {
    const ExactCellsResult result = cells_of({"", {side, side, side}, of}, Axes::none);
    check_as_a_whole(result);
    check_polyhedra(result);
  }
  // Its faces touch a sphere of half the radius: three times its volume is its surface times that.
  const ExactCell middle = cells_of({"", {side, side, side}, positions}, Axes::none).read().back();
  BOOST_TEST(middle.neighbours == 3000u);
  BOOST_TEST(std::abs(3 * middle.area / (middle.perimeter * 0.2 * static_cast<double>(side)) - 1) < 1e-9);
}

BOOST_AUTO_TEST_CASE(faces_say_which_image_is_behind_them) {
  const Set set = {"random", {1000, 600, 800}, random_positions({1000, 600, 800}, 40, 11)};
  Set moved = set;
  std::mt19937_64 random(12);
  for (Position& at : moved.positions)
    for (std::size_t k = 0; k < 3; ++k) at[k] += (static_cast<std::int64_t>(random() % 7) - 3) * set.sides[k];
  Set tilted = moved, strongly = moved;
  tilted.tilts = {300, -200, 150};
  strongly.tilts = {-2700, 1800, 750};
  for (const Set& of : {set, moved, tilted, strongly}) {
    const ExactCellsResult result = cells_of(of, Axes::xyz);
    const std::vector<ExactFace> faces = result.read_faces();
    std::vector<Point> sums(of.positions.size());
    for (const ExactFace& face : faces) {
      BOOST_TEST_REQUIRE(face.a <= face.b);
      const Position behind = of.image(of.positions[face.b], {face.image[0], face.image[1], face.image[2]});
      const Point way = difference(points_of({behind})[0], points_of(of.positions)[face.a]);
      const double length = std::sqrt(dot(way, way));
      const double share = face.area / length;
      for (const auto& [id, sign] : {std::pair{face.a, 1}, {face.b, -1}})
        sums[id] = {sums[id].x + sign * share * way.x, sums[id].y + sign * share * way.y,
                    sums[id].z + sign * share * way.z};
    }
    BOOST_TEST(2 * faces.size() == result.edges());
    // The areas of a closed surface, along the ways to what is behind them, sum to 0.
    for (std::size_t id = 0; id < sums.size(); ++id) BOOST_TEST(dot(sums[id], sums[id]) < 1e-12);
  }
  const std::vector<ExactCell> cells = cells_of(set, Axes::xyz).read(),
                               same = cells_of(moved, Axes::xyz).read();
  for (std::size_t id = 0; id < cells.size(); ++id) BOOST_TEST(cells[id].area == same[id].area);
  const std::vector<ExactFace> own = cells_of({"one", {8, 8, 8}, {{1, 2, 3}}}, Axes::xyz).read_faces();
  BOOST_TEST_REQUIRE(own.size() == 3u);  // its own neighbour thrice
  BOOST_TEST((own[0].image == std::array<std::int32_t, 3>{0, 0, 1}));
}

BOOST_AUTO_TEST_CASE(buffers_hold_what_is_read_and_a_result_serves_planes_and_volumes) {
  const Set set = {"random", {side, side, side}, random_positions({side, side, side}, 500, 13)};
  Tuning tuning = test_device().tuning();
  tuning.group_width = 3;
  tuning.group_height = 1;
  tuning.shape = Shape::group;
  const ExactCellsResult expected = cells_of(set, Axes::x, test_device().with_tuning(tuning));
  ExactCellsResult result;
  const Seeds seeds(test_device(), grid_of(set.sides, Axes::x), points_of(set.positions));
  const Seeds of_plane(test_device(), Grid(4, 4), {{1, 1}, {3, 1}});
  exact_cells(of_plane, result);
  BOOST_TEST(result.read_pairs().size() == 1u);
  check_error([&] { result.read_faces(); }, {"those of a plane", "polygons"});
  check_error([&] { result.read_polyhedra(); }, {"those of a plane"});
  exact_cells(seeds, result);
  check_error([&] { result.read_pairs(); }, {"those of a volume", "polyhedra"});
  const ExactPolyhedra polyhedra = expected.read_polyhedra();
  const auto read = [](const cl::Buffer& buffer, auto values) {
    BOOST_TEST(test_device().queue().enqueueReadBuffer(buffer, CL_TRUE, 0, values.size() * sizeof(values[0]),
                                                       values.data()) == CL_SUCCESS);
    return values;
  };
  const std::vector<ExactCell> cells = expected.read();
  BOOST_TEST(read(result.offsets(), std::vector<std::uint32_t>(501)) == polyhedra.offsets);
  BOOST_TEST(read(result.edge_neighbours(), std::vector<std::uint32_t>(result.edges())) ==
             polyhedra.neighbours);
  BOOST_TEST(read(result.lengths(), std::vector<double>(result.edges())) == polyhedra.areas);
  BOOST_TEST(result.vertices()() == nullptr);
  const auto volumes = read(result.areas(), std::vector<double>(500));
  const auto centroids = read(result.centroids(), std::vector<double>(1500));
  for (std::size_t id = 0; id < cells.size(); ++id) {
    BOOST_TEST(cells[id].area == volumes[id]);
    BOOST_TEST(cells[id].centroid.z == centroids[3 * id + 2]);
  }
  exact_cells(of_plane, result);
  BOOST_TEST(result.read_pairs().size() == 1u);
  BOOST_TEST(result.read_pairs()[0].length == 4);
}

BOOST_AUTO_TEST_CASE(cells_are_in_the_units_of_the_data_and_absent_seeds_have_none) {
  std::vector<std::optional<Point>> points = {Point{-1, 2, 3}, std::nullopt, Point{0, 2, 3}};
  ExactCellsResult result;
  exact_cells(Seeds(test_device(), Grid(Axis(9, -2, 1), Axis(3, 1.5, 2.5), Axis(2, 0, 8)), points), result);
  const std::vector<ExactCell> cells = result.read();
  BOOST_TEST(cells[0].area == 1.5 * 8);
  BOOST_TEST(cells[0].perimeter == 2 * (1.5 + 12 + 8));
  BOOST_TEST(cells[0].centroid.x == -1.25);
  BOOST_TEST(cells[0].centroid.z == 4);
  BOOST_TEST(cells[1].area == 0);
  BOOST_TEST(std::isnan(cells[1].centroid.z));
  BOOST_TEST(cells[2].neighbours == 1u);
}

BOOST_AUTO_TEST_CASE(what_cannot_be_is_refused) {
  ExactCellsResult result;
  check_error([&] { Grid(4, 4, 4, Axes::xy).tilted(0, 1); }, {"tilted box", "periodic in x and z"});
  check_error([&] { Grid(4, 4, 4, Axes::xz).tilted(0, 0, 1); }, {"tilted box", "periodic in y and z"});
  check_error([&] { Grid(4, 4, 4, Axes::xyz).tilted(0, 1e9); }, {"x and z", "1024 periods"});
  check_error([&] { Grid(4, 4, Axes::xy).tilted(1, 1); }, {"plane", "xz and yz"});
  const Axis low = Axis(2, 0, 1e-6).periodic(), wide = Axis(2, 0, 1).periodic();
  check_error(
      [&] {
        exact_cells(Seeds(test_device(), Grid(wide, low, low).tilted(0.3, 0.2, 5e-7), {{0, 0, 0}}), result);
      },
      {"tilted", "too flat", "65535"});
  const Grid flat(Axis(2, 0, 10), Axis(2, 0, 10), Axis(2, 3, 3));
  check_error(
      [&] {
        exact_cells(Seeds(test_device(), flat, {{1, 3, 3}}), result);
      },
      {"box with an extent", "10 x 10 x 0"});
  const Grid spaced(Axis(4), Axis(4), Axis(4).spaced(2));
  check_error([&] { exact_cells(Seeds(test_device(), spaced, {{1, 3, 3}}), result); }, {"spaced"});
  exact_cells(Seeds(test_device(), Grid(4, 4, 4), Points(static_cast<const Point*>(nullptr), 0)), result);
  BOOST_TEST(result.size() == 0u);
  BOOST_TEST(result.read_faces().empty());
  BOOST_TEST(result.read_polyhedra().offsets.size() == 1u);
}

BOOST_AUTO_TEST_CASE(no_face_is_lost_to_rounding) {
  // A lattice of half steps, whose cells touch along edges: rounded sites make faces of next to nothing
  // there.
  for (const bool is_periodic : {true, false}) {
    const Axis axis = is_periodic ? Axis(8, 0, 1).periodic() : Axis(8, 0, 1);
    std::vector<Point> points;
    for (int i = 0; i < 10; ++i)
      points.push_back({(i % 3 + 0.5) / 3, (i / 3 % 3 + 0.5) / 3, (i / 9 + 0.5) / 3});
    ExactCellsResult result;
    exact_cells(Seeds(test_device(), Grid(axis, axis, axis), points), result);
    std::size_t tiny = 0;
    for (const double area : result.read_polyhedra().areas) {
      BOOST_TEST(area > 0);
      tiny += area < 1e-12 ? 1 : 0;
    }
    BOOST_TEST(tiny > 0u);
  }
}

BOOST_AUTO_TEST_CASE(the_curve_that_sorts_points_in_space_does_not_jump) {
  constexpr std::uint32_t length = 16;
  constexpr int unused = hilbert_bits - 4;
  std::map<std::uint64_t, std::array<std::uint32_t, 3>> places;
  for (std::uint32_t x = 0; x < length; ++x) {
    for (std::uint32_t y = 0; y < length; ++y) {
      for (std::uint32_t z = 0; z < length; ++z)
        places[hilbert_order({x << unused, y << unused, z << unused}) >> (3 * unused + 1)] = {x, y, z};
    }
  }
  BOOST_TEST_REQUIRE(places.size() == length * length * length);
  const std::array<std::uint32_t, 3>* last = nullptr;
  for (const auto& [order, at] : places) {
    std::uint32_t way = 0;
    for (std::size_t k = 0; last != nullptr && k < 3; ++k)
      way += at[k] > (*last)[k] ? at[k] - (*last)[k] : (*last)[k] - at[k];
    BOOST_TEST_REQUIRE(way == (last != nullptr ? 1u : 0u));
    last = &at;
  }
}
