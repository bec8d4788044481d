// Pairs of cells against Boost.Polygon's Voronoi diagram, and vertices against straight host code.
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

/// Corners of pixels where three cells meet or four, in row-major order.
std::vector<Point> vertices_on_host(const Grid& grid, const Labels& labels) {
  std::vector<Point> meetings;
  for (int y = 0; y < grid.height(); ++y) {
    for (int x = 0; x < grid.width(); ++x) {
      const auto opposite = in_grid(grid, {x + 1, y + 1});
      if (!opposite) continue;
      std::set<std::uint32_t> cells;
      for (const Pixel& at : {Pixel{x, y}, Pixel{opposite->x, y}, Pixel{x, opposite->y}, *opposite}) {
        cells.insert(label_at(grid, labels, at));
      }
      cells.erase(no_label);
      if (cells.size() >= 3) meetings.push_back({x + 1.0, y + 1.0});
    }
  }
  return meetings;
}

void check_vertices(const std::string& name, const Diagram& diagram, VerticesResult& corners) {
  const std::vector<Point> expected = vertices_on_host(diagram.window().grid(), diagram.read());
  vertices(diagram, corners);
  BOOST_TEST(corners.count() == expected.size(), name);
  BOOST_TEST(same(corners.read(), expected), name << ": the vertices are elsewhere than on the host");
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

BOOST_AUTO_TEST_CASE(vertices_are_those_of_the_host) {
  for (const Device& device : shapes()) {
    VerticesResult corners;  // one for all: its buffers grow, and hold what the last case left
    for (const Case& test : measured_cases(device)) {
      if (test.grid.is_volume() || test.grid.x().spacing() > 1) continue;  // which have none
      Diagram diagram(device, test.grid);
      fill(test, seeds_of(device, test), diagram, Metric::euclidean);
      check_vertices(test.name, diagram, corners);
    }
  }
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
