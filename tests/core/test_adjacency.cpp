// Pairs of cells and vertices: against a host recount of the same image, and against Boost.Polygon's Voronoi
// diagram.
#define BOOST_TEST_MODULE adjacency
#include <boost/polygon/voronoi.hpp>

#include "measured_cases.hpp"
#include "vorocl/adjacency.hpp"

using namespace vorocl;

namespace {

using Ids = std::pair<std::uint32_t, std::uint32_t>;

Ids in_order(std::uint32_t a, std::uint32_t b) { return {std::min(a, b), std::max(a, b)}; }

bool same(const std::vector<Point>& a, const std::vector<Point>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](const Point& p, const Point& q) { return p.x == q.x && p.y == q.y; });
}

/// Adjacency and vertices of a diagram of so many seeds, whose window is its grid.
void recount(const std::string& name, std::size_t seeds, const Diagram& diagram, AdjacencyResult& result,
             VerticesResult& corners) {
  const Grid& grid = diagram.window().grid();
  const std::vector<std::uint32_t> labels = diagram.read();
  std::map<Ids, std::uint32_t> lengths;  // sorted, as the result must be
  std::vector<std::uint32_t> neighbours(seeds), perimeters(seeds);
  each_pixel(grid, labels, [&](std::uint32_t label, int x, int y) {
    for (const auto& [right, below] : {std::pair{1, 0}, std::pair{0, 1}}) {
      const auto next = in_grid(grid, {x + right, y + below});
      if (!next) continue;
      const std::uint32_t other = label_at(grid, labels, next->x, next->y);
      if (other != label && other != no_label) ++lengths[in_order(label, other)];
    }
  });
  std::vector<CellPair> expected;
  for (const auto& [ids, length] : lengths) {
    expected.push_back({ids.first, ids.second, length});
    for (const std::uint32_t id : {ids.first, ids.second}) {
      ++neighbours[id];
      perimeters[id] += length;
    }
  }
  adjacency(diagram, result);
  BOOST_TEST(result.pairs() == expected.size(), name);
  BOOST_TEST((result.read_pairs() == expected), name << ": the pairs are others than on the host");
  BOOST_TEST((result.read_neighbours() == neighbours), name);
  BOOST_TEST((result.read_perimeters() == perimeters), name);

  std::vector<Point> meetings;  // in row-major order
  for (int y = 0; y < grid.height(); ++y) {
    for (int x = 0; x < grid.width(); ++x) {
      const auto opposite = in_grid(grid, {x + 1, y + 1});
      if (!opposite) continue;
      std::set<std::uint32_t> cells = {label_at(grid, labels, x, y), label_at(grid, labels, opposite->x, y),
                                       label_at(grid, labels, x, opposite->y),
                                       label_at(grid, labels, opposite->x, opposite->y)};
      cells.erase(no_label);
      if (cells.size() >= 3) meetings.push_back({x + 1.0, y + 1.0});
    }
  }
  vertices(diagram, corners);
  BOOST_TEST(corners.count() == meetings.size(), name);
  BOOST_TEST(same(corners.read(), meetings), name << ": the vertices are elsewhere than on the host");
}

/// A Voronoi edge inside the grid, from Boost.Polygon: the seeds on its sides, and how much of it is between
/// the centres of the outermost pixels.
double length_inside(const Grid& grid, double x0, double y0, double x1, double y1) {
  double from = 0, to = 1;
  const auto clip = [&](double start, double step, double most) {  // Liang and Barsky, an axis at a time
    if (step == 0) {
      if (start < 0 || start > most) to = -1;
      return;
    }
    const double a = -start / step, b = (most - start) / step;
    from = std::max(from, std::min(a, b));
    to = std::min(to, std::max(a, b));
  };
  clip(x0, x1 - x0, static_cast<double>(grid.width() - 1));
  clip(y0, y1 - y0, static_cast<double>(grid.height() - 1));
  return to > from ? (to - from) * std::hypot(x1 - x0, y1 - y0) : 0;
}

std::map<Ids, double> delaunay_edges(const Grid& grid, const std::vector<Pixel>& seeds) {
  // Of the seeds on one pixel the lowest id has the cell.
  std::map<Pixel, std::uint32_t> owners;
  for (std::uint32_t id = 0; id < seeds.size(); ++id) owners.emplace(seeds[id], id);
  std::vector<boost::polygon::point_data<int>> points;
  std::vector<std::uint32_t> ids;
  for (const auto& [pixel, id] : owners) {
    points.emplace_back(pixel.x, pixel.y);
    ids.push_back(id);
  }
  boost::polygon::voronoi_diagram<double> diagram;
  boost::polygon::construct_voronoi(points.begin(), points.end(), &diagram);
  std::map<Ids, double> edges;
  for (const auto& edge : diagram.edges()) {
    const std::size_t i = edge.cell()->source_index(), j = edge.twin()->cell()->source_index();
    if (i > j) continue;  // its twin comes too
    // An infinite edge runs along the bisector, far past the grid.
    const auto side = static_cast<double>(Window(grid).longest_side());
    const double far = 4 * side * side;
    const double dx = points[i].y() - points[j].y(), dy = points[j].x() - points[i].x();
    const double norm = far / std::hypot(dx, dy);
    const double x = (points[i].x() + points[j].x()) / 2.0, y = (points[i].y() + points[j].y()) / 2.0;
    const auto *v0 = edge.vertex0(), *v1 = edge.vertex1();
    // Boost's edge has its cell to the left, in a system where y points up.
    const double x0 = v0 != nullptr ? v0->x() : x - dx * norm, y0 = v0 != nullptr ? v0->y() : y - dy * norm;
    const double x1 = v1 != nullptr ? v1->x() : x + dx * norm, y1 = v1 != nullptr ? v1->y() : y + dy * norm;
    edges[in_order(ids[i], ids[j])] += length_inside(grid, x0, y0, x1, y1);
  }
  return edges;
}

}  // namespace

BOOST_AUTO_TEST_CASE(pairs_and_vertices_are_those_of_a_recount) {
  for (const Device& device : shapes()) {
    AdjacencyResult result;  // one for all: its buffers grow, and hold what the last case left
    VerticesResult corners;
    for (const Case& test : measured_cases(device)) {
      const Seeds seeds(device, test.grid, centres(test.seeds), to_centres);
      Diagram diagram(device, test.grid);
      fill(seeds, diagram);
      recount(test.name, seeds.size(), diagram, result, corners);
    }
  }
}

BOOST_AUTO_TEST_CASE(more_pairs_than_the_first_table_holds) {
  const Grid grid(600, 290);
  for (const Device& device : shapes()) {
    const Seeds seeds(device, grid, centres(random_pixels(grid, 120, 1)), to_centres);
    Diagram diagram(device, grid);
    // 7140 pairs, nearly all there are
    diagram.write(random_labels(grid, 120, 2), seeds, Metric::euclidean);
    AdjacencyResult result;
    VerticesResult corners;
    recount("pieces", seeds.size(), diagram, result, corners);
    BOOST_TEST(result.pairs() > 7000u);
  }
}

BOOST_AUTO_TEST_CASE(one_cell_around_all_others) {
  const Grid grid(301, 201);
  std::vector<std::uint32_t> labels(grid.pixels(), 0);
  std::uint32_t id = 0;
  for (int y = 1; y < grid.height() - 1; y += 2) {
    for (int x = 1; x < grid.width() - 1; x += 2) {
      labels[static_cast<std::size_t>(y) * 301 + static_cast<std::size_t>(x)] = ++id;
    }
  }
  const Seeds seeds(test_device(), grid, centres(random_pixels(grid, id + 1, 1)), to_centres);
  Diagram diagram(test_device(), grid);
  diagram.write(labels, seeds, Metric::euclidean);
  AdjacencyResult result;
  VerticesResult corners;
  recount("islands", seeds.size(), diagram, result, corners);
  BOOST_TEST(result.pairs() == id);
}

// Cells may touch in the image that do not in the plane: a third cell is between them, thinner than a pixel.
// That takes a Voronoi edge of a pixel's length, so it is rare where cells are large, and such cells share
// hardly more than one pixel edge.
BOOST_AUTO_TEST_CASE(exact_diagrams_have_the_delaunay_neighbours) {
  const Grid large(6000, 6000), wide(1000, 700), map(1440, 720);
  const Case cases[] = {{"sparse", large, random_pixels(large, 1500, 1)},
                        {"random", wide, random_pixels(wide, 2000, 2)},
                        {"dense", wide, random_pixels(wide, 15000, 3)},
                        {"clusters", wide, clusters(wide, 3000)},
                        {"cities", map, cities(map)}};
  for (const Case& test : cases) {
    const Seeds seeds(test_device(), test.grid, centres(test.seeds), to_centres);
    Diagram diagram(test_device(), test.grid);
    exact_diagram(seeds, diagram);
    AdjacencyResult result;
    adjacency(diagram, result);
    const std::map<Ids, double> edges = delaunay_edges(test.grid, test.seeds);
    std::set<Ids> pairs;
    const std::uint32_t least_length = test.name == "sparse" ? 1 : 2;
    std::size_t judged = 0, not_delaunay = 0, long_edges = 0, missing = 0;
    for (const CellPair& pair : result.read_pairs()) {
      pairs.insert({pair.a, pair.b});
      if (pair.length < least_length) continue;
      ++judged;
      not_delaunay += edges.count({pair.a, pair.b}) == 0 ? 1 : 0;
    }
    for (const auto& [ids, length] : edges) {
      if (length <= 3) continue;
      ++long_edges;
      missing += pairs.count(ids) == 0 ? 1 : 0;
    }
    BOOST_TEST(static_cast<double>(not_delaunay) <= 0.001 * static_cast<double>(judged),
               test.name << ": " << not_delaunay << " of " << judged << " pairs are no Delaunay edges");
    BOOST_TEST(missing == 0u,
               test.name << ": " << missing << " of " << long_edges << " long edges are missing");
    BOOST_TEST(judged > test.seeds.size() / 2);
    BOOST_TEST(long_edges > test.seeds.size() / 10);
  }
}

// The table may be too small for the pairs: the result finds them again, if the labels are still there.
BOOST_AUTO_TEST_CASE(a_diagram_that_was_filled_anew_has_lost_the_pairs_that_did_not_fit) {
  const Grid grid(600, 290);
  const Seeds seeds(test_device(), grid, centres(random_pixels(grid, 120, 1)), to_centres);
  Diagram diagram(test_device(), grid);
  AdjacencyResult result;
  diagram.write(random_labels(grid, 120, 2), seeds, Metric::euclidean);
  adjacency(diagram, result);
  exact_diagram(seeds, diagram);
  check_error([&] { result.read_pairs(); }, {"since"});
  adjacency(diagram, result);
  BOOST_TEST(result.pairs() > 120u);
  BOOST_TEST(result.pairs() < 360u);
}

BOOST_AUTO_TEST_CASE(corners_of_three_cells_and_of_four) {
  const Grid grid(4, 3);
  Diagram diagram(test_device(), grid);
  diagram.write({0, 0, 1, 1,  //
                 0, 0, 2, 2,  //
                 3, 3, 4, 4});
  VerticesResult corners;
  BOOST_TEST(corners.count() == 0u);
  vertices(diagram, corners);
  BOOST_TEST(same(corners.read(), {{2, 1}, {2, 2}}));
}

BOOST_AUTO_TEST_CASE(labels_of_no_seeds_have_no_adjacency) {
  const Grid grid(20, 10);
  Diagram diagram(test_device(), grid);
  AdjacencyResult result;
  exact_diagram(Seeds(test_device(), grid, {{1, 1}, {9, 9}}, to_centres), diagram);
  adjacency(diagram, result);
  BOOST_TEST(result.pairs() == 1u);
  diagram.write(diagram.read());
  check_error([&] { adjacency(diagram, result); }, {"seeds"});
  BOOST_TEST(result.read_pairs().empty());
}
