// Tables of cells in the units of the data, against straight host code.
#define BOOST_TEST_MODULE cell_table
#include "measured_cases.hpp"
#include "vorocl/cells.hpp"

using namespace vorocl;

namespace {

/// The pixel of a coordinate along an axis, as Axis says it.
int pixel_along(const Axis& axis, double coordinate) {
  const auto pixels = static_cast<double>(axis.pixels());
  double pixel = std::floor((coordinate - axis.from()) * pixels / (axis.to() - axis.from()));
  if (axis.is_reversed()) pixel = pixels - 1 - pixel;
  if (axis.is_periodic()) pixel -= pixels * std::floor(pixel / pixels);
  return static_cast<int>(pixel);
}

/// The coordinate of a position in pixels.
double coordinate_along(const Axis& axis, double position) {
  const auto pixels = static_cast<double>(axis.pixels());
  const double share = (axis.is_reversed() ? pixels - position : position) / pixels;
  return axis.from() + share * (axis.to() - axis.from());
}

/// A row, and its centroid's sums in pixels of the grid.
struct Row {
  std::uint32_t pixels = 0;
  double sum_x = 0, sum_y = 0;
  bool touches_border = false;
  std::set<std::uint32_t> neighbours;
};

std::vector<Row> rows_on_host(const Grid& grid, const std::vector<Pixel>& pixels,
                              const std::vector<std::uint32_t>& labels) {
  std::vector<Row> rows(pixels.size());
  each_pixel(grid, labels, [&](std::uint32_t label, int x, int y) {
    Row& row = rows[label];
    const Pixel image = nearest_image(grid, {x, y}, pixels[label]);
    ++row.pixels;
    row.sum_x += centre(image).x;
    row.sum_y += centre(image).y;
    row.touches_border |= (!has_x(grid.periodic()) && (x == 0 || x == grid.width() - 1)) ||
                          (!has_y(grid.periodic()) && (y == 0 || y == grid.height() - 1));
    for (const auto& [dx, dy] : {std::pair{1, 0}, std::pair{-1, 0}, std::pair{0, 1}, std::pair{0, -1}}) {
      const auto next = in_grid(grid, {x + dx, y + dy});
      if (!next) continue;
      const std::uint32_t other = label_at(grid, labels, next->x, next->y);
      if (other != label && other != no_label) row.neighbours.insert(other);
    }
  });
  return rows;
}

void check_table(const Grid& grid, const std::vector<std::optional<Point>>& points, Metric metric) {
  const auto pixels = transformed(points, [&](const std::optional<Point>& point) {
    return point ? Pixel{pixel_along(grid.x(), point->x), pixel_along(grid.y(), point->y)} : Pixel{0, 0};
  });
  const Seeds seeds(test_device(), grid, points, to_centres);
  Diagram diagram(test_device(), grid);
  exact_diagram(seeds, diagram, {metric});
  const std::vector<Row> expected = rows_on_host(grid, pixels, diagram.read());
  const double area_of_one = (grid.x().to() - grid.x().from()) / static_cast<double>(grid.width()) *
                             (grid.y().to() - grid.y().from()) / static_cast<double>(grid.height());
  const std::vector<CellRow> table = cell_table(diagram);
  std::size_t at = 0;
  const auto close = boost::test_tools::tolerance(1e-9);
  for (std::uint32_t id = 0; id < points.size(); ++id) {
    if (!points[id]) continue;
    BOOST_TEST_REQUIRE(at < table.size());
    const CellRow& found = table[at++];
    const Row& right = expected[id];
    BOOST_TEST(found.id == id);
    BOOST_TEST(found.seed.x == points[id]->x);
    BOOST_TEST(found.seed.y == points[id]->y);
    BOOST_TEST(found.pixels == right.pixels);
    BOOST_TEST(found.area == right.pixels * area_of_one, close);
    BOOST_TEST(found.touches_border == right.touches_border);
    BOOST_TEST(found.neighbours == right.neighbours.size());
    if (right.pixels == 0) {
      BOOST_TEST((std::isnan(found.centroid.x) && std::isnan(found.centroid.y)));
    } else {
      BOOST_TEST(found.centroid.x == coordinate_along(grid.x(), right.sum_x / right.pixels), close);
      BOOST_TEST(found.centroid.y == coordinate_along(grid.y(), right.sum_y / right.pixels), close);
    }
  }
  BOOST_TEST(at == table.size());
}

/// Points all over a grid, some of which are absent, and two of which share a pixel.
std::vector<std::optional<Point>> points_on(const Grid& grid, std::size_t count) {
  std::mt19937 rng(5);
  const auto between = [&](const Axis& axis) {
    return axis.from() + (axis.to() - axis.from()) * (static_cast<double>(rng()) + 0.5) / 4294967296.0;
  };
  std::vector<std::optional<Point>> points;
  for (std::size_t id = 0; id < count; ++id) {
    const double x = between(grid.x());
    points.emplace_back(Point{x, between(grid.y())});
  }
  points[1].reset();
  points[count / 2] = points[0];
  return points;
}

}  // namespace

BOOST_AUTO_TEST_CASE(a_table_is_in_the_units_of_the_data) {
  const Axis x(120, -3, 7), y(80, 1e4, 1e4 + 0.5);
  const Grid grids[] = {
      Grid(120, 80),
      Grid(120, 80, Axes::xy),
      Grid(x, y),
      Grid(x, y.reversed()),
      Grid(x.periodic(), y),
      Grid(x.periodic(), y.periodic().reversed()),
      Grid(x.reversed().closed(), y.closed()),
  };
  for (const Grid& grid : grids) {
    for (const std::size_t count : {3u, 40u, 900u}) {
      for (const Metric metric : both_metrics) {
        BOOST_TEST_CONTEXT(count << " seeds, axes " << static_cast<int>(grid.periodic()) << ", x "
                                 << grid.x().from() << " to " << grid.x().to() << ", y "
                                 << (grid.y().is_reversed() ? "up, " : "down, ") << name_of(metric)) {
          check_table(grid, points_on(grid, count), metric);
        }
      }
    }
  }
}

// By hand: two seeds on a ring, whose cells reach across its end.
BOOST_AUTO_TEST_CASE(a_cell_across_the_end_of_a_period) {
  const Grid grid(Axis(10, 0, 1).periodic(), Axis(4, 0, 8).reversed());
  Diagram diagram(test_device(), grid);
  exact_diagram(Seeds(test_device(), grid, {{0.05, 7}, {0.55, 7}}, to_centres), diagram);
  const std::vector<CellRow> table = cell_table(diagram);
  BOOST_TEST_REQUIRE(table.size() == 2u);
  // Columns 8, 9, 0, 1 and 2, and the 5 others.
  BOOST_TEST(table[0].pixels == 20u);
  BOOST_TEST(table[0].area == 4, boost::test_tools::tolerance(1e-12));
  BOOST_TEST(table[0].centroid.x == 0.05, boost::test_tools::tolerance(1e-12));
  BOOST_TEST(table[1].centroid.x == 0.55, boost::test_tools::tolerance(1e-12));
  BOOST_TEST(table[0].centroid.y == 4, boost::test_tools::tolerance(1e-12));
  BOOST_TEST(table[0].touches_border);  // of y
  BOOST_TEST(table[0].neighbours == 1u);
}

// A window that is a part of the grid: what it shows, in the same units; seeds outside it own pixels of it.
BOOST_AUTO_TEST_CASE(a_table_of_a_window_counts_what_it_shows) {
  const Grid grid(Axis(100, 0, 10).periodic(), Axis(100, 0, 10));
  const Seeds seeds(test_device(), grid, {{9.85, 0.45}, {0.25, 0.45}, {5, 5}}, to_centres);
  Diagram diagram(test_device(), Window(grid, 95, 0, 10, 10));  // crosses the end of x
  exact_diagram(seeds, diagram);
  const std::vector<CellRow> table = cell_table(diagram);
  BOOST_TEST_REQUIRE(table.size() == 3u);
  // Columns 95 to 99 are those of the seed in column 98, and 0 to 4 those of the seed in column 2, which
  // comes first in the grid: so it has the tie in column 0.
  BOOST_TEST(table[0].pixels == 50u);
  BOOST_TEST(table[1].pixels == 50u);
  BOOST_TEST(table[2].pixels == 0u);
  BOOST_TEST(std::isnan(table[2].centroid.x));
  BOOST_TEST(table[0].seed.x == 9.85);
  BOOST_TEST(table[0].touches_border);
  BOOST_TEST(table[0].neighbours == 1u);
  // Where the window shows them, or a period away from there.
  BOOST_TEST(std::abs(std::remainder(table[0].centroid.x - 9.75, 10)) < 1e-9);
  BOOST_TEST(std::abs(std::remainder(table[1].centroid.x - 0.25, 10)) < 1e-9);
  BOOST_TEST(table[0].centroid.y == 0.5, boost::test_tools::tolerance(1e-12));
}

BOOST_AUTO_TEST_CASE(a_table_of_a_volume) {
  const Grid grid(Axis(20, -1, 3), Axis(15, 0, 30).reversed(), Axis(9, 5, 6).periodic());
  std::mt19937 rng(7);
  std::vector<Point> points;
  for (int i = 0; i < 25; ++i) {
    const auto along = [&](const Axis& axis) {
      return axis.coordinate(static_cast<double>(rng() % 1000) / 1000 * static_cast<double>(axis.pixels()));
    };
    const double x = along(grid.x()), y = along(grid.y());
    points.push_back({x, y, along(grid.z())});
  }
  Diagram diagram(test_device(), grid);
  exact_diagram(Seeds(test_device(), grid, points), diagram);
  const std::vector<std::uint32_t> labels = diagram.read();
  std::vector<std::uint32_t> voxels(points.size());
  std::vector<double> sums_of_x(points.size());
  std::vector<std::set<std::uint32_t>> neighbours(points.size());
  std::vector<bool> touches(points.size());
  const auto label_of = [&](int x, int y, int z) {
    return labels[static_cast<std::size_t>(((z + 9) % 9 * 15 + y) * 20 + x)];
  };
  for (int z = 0; z < 9; ++z) {
    for (int y = 0; y < 15; ++y) {
      for (int x = 0; x < 20; ++x) {
        const std::uint32_t own = label_of(x, y, z);
        ++voxels[own];
        sums_of_x[own] += x + 0.5;
        if (x == 0 || x == 19 || y == 0 || y == 14) touches[own] = true;
        const auto meet = [&](std::uint32_t other) {
          if (other == own) return;
          neighbours[own].insert(other);
          neighbours[other].insert(own);
        };
        if (x > 0) meet(label_of(x - 1, y, z));
        if (y > 0) meet(label_of(x, y - 1, z));
        meet(label_of(x, y, z - 1));
      }
    }
  }
  const std::vector<CellRow> table = cell_table(diagram);
  BOOST_TEST_REQUIRE(table.size() == points.size());
  const auto close = boost::test_tools::tolerance(1e-9);
  for (const CellRow& row : table) {
    BOOST_TEST((row.seed.x == points[row.id].x && row.seed.z == points[row.id].z));
    BOOST_TEST(row.pixels == voxels[row.id]);
    BOOST_TEST(row.area == voxels[row.id] * (0.2 * 2 / 9), close);
    BOOST_TEST(row.touches_border == touches[row.id]);
    BOOST_TEST(row.neighbours == neighbours[row.id].size());
    BOOST_TEST(row.centroid.x == -1 + 0.2 * sums_of_x[row.id] / voxels[row.id], close);
  }
}
