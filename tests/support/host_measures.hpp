// Tables of cells and of pairs, checked against straight host code on the labels that were written.
#pragma once

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "formats/raster.hpp"
#include "formats/values.hpp"
#include "measured_cases.hpp"
#include "temporary_folder.hpp"

namespace vorocl {

using SeedsById = std::map<std::uint32_t, Pixel>;

inline SeedsById numbered(const std::vector<Pixel>& pixels) {
  SeedsById seeds;
  for (std::uint32_t id = 0; id < pixels.size(); ++id) seeds[id] = pixels[id];
  return seeds;
}

/// An image of labels with its periodic axes, which its file does not know.
struct LabelledGrid {
  Grid grid;
  Labels labels;
};

inline LabelledGrid on_grid(const command::LabelImage& image, Axes axes = Axes::none) {
  return {image.size.grid(axes), image.labels};
}

using TableRow = std::vector<std::optional<double>>;  // none: an empty field

struct Table {
  std::string header;
  std::vector<TableRow> rows;
};

inline Table read_table(const std::string& path) {
  std::istringstream text(content_of(path));
  Table table;
  std::getline(text, table.header);
  for (std::string line; std::getline(text, line);) {
    TableRow row;
    std::istringstream fields(line + ",");
    for (std::string field; std::getline(fields, field, ',');) {
      row.push_back(command::parse_number<double>(field));
      BOOST_TEST((row.back() || field.empty()), path << ": " << line);
    }
    table.rows.push_back(row);
  }
  return table;
}

/// The rows that a table of cells must have, sorted by id.
inline std::vector<TableRow> cells_on_host(const LabelledGrid& image, const SeedsById& seeds, Metric metric) {
  struct Cell {
    double area = 0, sum_x = 0, sum_y = 0, farthest = 0, perimeter = 0;
    std::int64_t left = 1 << 20, top = 1 << 20, right = -(1 << 20), bottom = -(1 << 20);
    std::set<std::uint32_t> neighbours;
  };
  const Grid& grid = image.grid;
  std::map<std::uint32_t, Cell> cells;
  each_pixel(grid, image.labels, [&](std::uint32_t label, int x, int y) {
    Cell& cell = cells[label];
    const Pixel pixel = nearest_image(grid, {x, y}, seeds.at(label));
    ++cell.area;
    cell.sum_x += static_cast<double>(pixel.x);
    cell.sum_y += static_cast<double>(pixel.y);
    cell.left = std::min(cell.left, pixel.x);
    cell.top = std::min(cell.top, pixel.y);
    cell.right = std::max(cell.right, pixel.x);
    cell.bottom = std::max(cell.bottom, pixel.y);
    const auto far = static_cast<double>(distance(image.grid, {x, y}, seeds.at(label), metric));
    cell.farthest = std::max(cell.farthest, metric == Metric::euclidean ? std::sqrt(far) : far);
    for (const auto& [dx, dy] : {std::pair{1, 0}, std::pair{-1, 0}, std::pair{0, 1}, std::pair{0, -1}}) {
      const auto next = in_grid(grid, {x + dx, y + dy});
      if (!next) continue;
      const std::uint32_t other = label_at(grid, image.labels, next->x, next->y);
      if (other == label || other == no_label) continue;
      ++cell.perimeter;
      cell.neighbours.insert(other);
    }
  });
  std::vector<TableRow> rows;
  for (const auto& [id, pixel] : seeds) {
    TableRow row = {static_cast<double>(id), centre(pixel).x, centre(pixel).y, 0};
    const auto found = cells.find(id);
    if (found == cells.end()) {
      row.resize(10);
      row.insert(row.end(), {0, 0, std::nullopt, 0});
    } else {
      const Cell& cell = found->second;
      row[3] = cell.area;
      const bool touches = (!grid.x().is_periodic() && (cell.left == 0 || cell.right == grid.width() - 1)) ||
                           (!grid.y().is_periodic() && (cell.top == 0 || cell.bottom == grid.height() - 1));
      row.insert(row.end(),
                 {cell.sum_x / cell.area + 0.5, cell.sum_y / cell.area + 0.5, cell.left, cell.top, cell.right,
                  cell.bottom, cell.perimeter, cell.neighbours.size(), cell.farthest, touches ? 1 : 0});
    }
    rows.push_back(row);
  }
  return rows;
}

inline std::vector<TableRow> pairs_on_host(const LabelledGrid& image) {
  const Grid& grid = image.grid;
  std::map<std::pair<std::uint32_t, std::uint32_t>, double> lengths;
  each_pixel(grid, image.labels, [&](std::uint32_t label, int x, int y) {
    for (const auto& [dx, dy] : {std::pair{1, 0}, std::pair{0, 1}}) {
      const auto next = in_grid(grid, {x + dx, y + dy});
      if (!next) continue;
      const std::uint32_t other = label_at(grid, image.labels, next->x, next->y);
      if (other != label && other != no_label) ++lengths[std::minmax(label, other)];
    }
  });
  std::vector<TableRow> rows;
  rows.reserve(lengths.size());
  for (const auto& [ids, length] : lengths) rows.push_back({ids.first, ids.second, length});
  return rows;
}

inline void check_rows(const std::string& path, const std::vector<TableRow>& expected) {
  const Table table = read_table(path);
  BOOST_TEST_REQUIRE(table.rows.size() == expected.size(), path);
  std::size_t wrong = 0, first = expected.size();
  for (std::size_t i = expected.size(); i-- > 0;) {
    if (table.rows[i] == expected[i]) continue;
    ++wrong;
    first = i;
  }
  BOOST_TEST(wrong == 0u, path << ": " << wrong << " rows are wrong, the first in line " << first + 2);
}

inline void check_cells_table(const std::string& path, const LabelledGrid& image, const SeedsById& seeds,
                              Metric metric) {
  const Table table = read_table(path);
  BOOST_TEST(table.header ==
             "id,x,y,area,centroid_x,centroid_y,left,top,right,bottom,perimeter,neighbours,largest_distance,"
             "touches_border");
  check_rows(path, cells_on_host(image, seeds, metric));
  double area = 0;
  for (const TableRow& row : table.rows) area += row.at(3).value();
  BOOST_TEST(area == static_cast<double>(seeds.empty() ? 0 : image.grid.pixels()), path);
}

inline void check_adjacency_table(const std::string& path, const LabelledGrid& image) {
  BOOST_TEST(read_table(path).header == "a,b,length");
  check_rows(path, pairs_on_host(image));
}

/// The number of pixels whose distance is not that to the seed of their label.
inline std::size_t wrong_distances(const LabelledGrid& image, const std::vector<float>& distances,
                                   const SeedsById& seeds, Metric metric) {
  BOOST_TEST_REQUIRE(distances.size() == image.grid.pixels());
  std::size_t wrong = 0, i = 0;
  each_pixel(image.grid, image.labels, [&](std::uint32_t label, int x, int y) {
    const auto d = static_cast<double>(distance(image.grid, {x, y}, seeds.at(label), metric));
    const double expected = metric == Metric::euclidean ? std::sqrt(d) : d;
    wrong += std::abs(distances[i++] - expected) > 1e-6 * expected ? 1 : 0;
  });
  return wrong;
}

}  // namespace vorocl
