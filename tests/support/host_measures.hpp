// Tables of cells and of pairs, checked against straight host code on the labels that were written.
#pragma once

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
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

/// Labels as indices of the seeds in order of their ids.
inline Labels indices_of(const Labels& labels, const SeedsById& seeds) {
  std::map<std::uint32_t, std::uint32_t> index;
  for (const auto& seed : seeds) index.emplace(seed.first, static_cast<std::uint32_t>(index.size()));
  return transformed(labels,
                     [&](std::uint32_t label) { return label == no_label ? label : index.at(label); });
}

/// The rows that a table of cells must have, sorted by id.
inline std::vector<TableRow> cells_on_host(const LabelledGrid& image, const SeedsById& seeds, Metric metric) {
  const auto pixels = transformed(seeds, [](const auto& seed) { return seed.second; });
  const CellsOnHost found = cells_on_host(image.grid, pixels, indices_of(image.labels, seeds), metric);
  std::vector<TableRow> rows;
  for (const auto& [id, pixel] : seeds) {
    const CellOnHost& cell = found.cells[rows.size()];
    TableRow row = {static_cast<double>(id), centre(pixel).x, centre(pixel).y, cell.area};
    if (cell.area == 0) {
      row.resize(10);
      row.insert(row.end(), {0, 0, std::nullopt, 0});
    } else {
      const auto number = [](std::int64_t value) { return static_cast<double>(value); };
      row.insert(row.end(), {number(cell.sum.x) / cell.area + 0.5, number(cell.sum.y) / cell.area + 0.5,
                             number(cell.least.x), number(cell.least.y), number(cell.greatest.x),
                             number(cell.greatest.y), cell.perimeter, cell.neighbours,
                             length_of(cell.farthest, metric), cell.touches_border ? 1 : 0});
    }
    rows.push_back(row);
  }
  return rows;
}

inline std::vector<TableRow> pairs_on_host(const LabelledGrid& image) {
  SeedsById seeds;
  each_pixel(image.grid, image.labels,
             [&](std::uint32_t label, const Pixel& pixel) { seeds[label] = pixel; });
  const auto pixels = transformed(seeds, [](const auto& seed) { return seed.second; });
  const auto ids = transformed(seeds, [](const auto& seed) { return seed.first; });
  const Labels indices = indices_of(image.labels, seeds);
  const CellsOnHost found = cells_on_host(image.grid, pixels, indices, Metric::euclidean);
  return transformed(found.pairs, [&](const CellPair& pair) {
    return TableRow{ids[pair.a], ids[pair.b], pair.length};
  });
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
  std::size_t wrong = 0;
  each_pixel(image.grid, image.labels, [&](std::uint32_t label, const Pixel& pixel) {
    const double expected = length_of(distance(image.grid, pixel, seeds.at(label), metric), metric);
    wrong += std::abs(distances[index_of(image.grid, pixel)] - expected) > 1e-6 * expected ? 1 : 0;
  });
  return wrong;
}

}  // namespace vorocl
