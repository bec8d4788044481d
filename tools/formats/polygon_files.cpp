#include "formats/polygon_files.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <nlohmann/json.hpp>
#include <string_view>

#include "formats/files.hpp"
#include "formats/raster_files.hpp"
#include "formats/values.hpp"

namespace vorocl::command {

namespace {

/// The vertices with the first once more at the end, each between brackets or not.
void add_ring(fmt::memory_buffer& text, const std::vector<Point>& polygon, std::string_view point_format,
              std::string_view between) {
  for (std::size_t i = 0; i <= polygon.size(); ++i) {
    const Point& vertex = polygon[i % polygon.size()];
    if (i > 0) text.append(between);
    fmt::format_to(std::back_inserter(text), fmt::runtime(point_format), vertex.x, vertex.y);
  }
}

void add(GrowingFile& file, const fmt::memory_buffer& text) {
  file << std::string_view(text.data(), text.size());
}

const std::vector<std::string> own_columns = {"id", "x", "y", "area", "neighbours"};

std::string json_text(const std::string& text) {
  return nlohmann::json(text).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

/// A field as JSON: null where it is empty, a number that has JSON's form, or a text.
std::string json_of(const std::string& field) {
  if (field.empty()) return "null";
  return nlohmann::json::parse(field, nullptr, false).is_number() ? field : json_text(field);
}

/// The part of a convex polygon on one side of a line along y.
std::vector<Point> part_of(const std::vector<Point>& polygon, double line, bool beyond) {
  const auto is_in = [&](const Point& point) { return beyond ? point.x >= line : point.x <= line; };
  std::vector<Point> part;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Point &from = polygon[i], &to = polygon[(i + 1) % polygon.size()];
    if (is_in(from)) part.push_back(from);
    if (is_in(from) != is_in(to) && from.x != line && to.x != line)
      part.push_back({line, from.y + (to.y - from.y) * ((line - from.x) / (to.x - from.x))});
  }
  return part;
}

/// The parts of a convex polygon in each period from -180 to 180, all in that one.
std::vector<std::vector<Point>> cut_at_date_line(const std::vector<Point>& polygon) {
  std::vector<std::vector<Point>> parts;
  for (const double turn : {0.0, 360.0, -360.0}) {
    std::vector<Point> part = part_of(part_of(polygon, turn - 180, true), turn + 180, false);
    for (Point& point : part) point.x -= turn;
    const bool has_width =
        std::any_of(part.begin(), part.end(), [&](const Point& p) { return p.x != part[0].x; });
    if (has_width) parts.push_back(std::move(part));
  }
  return parts;
}

void write_geojson(GrowingFile& file, const std::vector<PolygonCell>& cells,
                   const PolygonFileOptions& options) {
  constexpr int degrees = 4326;
  const auto& [kept, crs, has_date_line] = options;
  file << "{\"type\":\"FeatureCollection\",";
  if (crs && crs->code != degrees) {
    file << fmt::format(R"("crs":{{"type":"name","properties":{{"name":"urn:ogc:def:crs:EPSG::{}"}}}},)",
                        crs->code);
  }
  file << "\"features\":[";
  std::vector<std::string> names;
  for (const std::string& name : other_names(kept, own_columns)) names.push_back(json_text(name));
  fmt::memory_buffer text;
  for (const PolygonCell& cell : cells) {
    text.clear();
    fmt::format_to(
        std::back_inserter(text),
        R"({}{{"type":"Feature","id":{},"properties":{{"id":{},"x":{},"y":{},"area":{},"neighbours":{})",
        &cell == cells.data() ? "\n" : ",\n", cell.id, cell.id, cell.seed.x, cell.seed.y, cell.area,
        cell.neighbours);
    for (std::size_t i = 0; i < names.size(); ++i)
      fmt::format_to(std::back_inserter(text), ",{}:{}", names[i], json_of(cell.kept[i]));
    text.append(std::string_view(R"(},"geometry":)"));
    if (cell.polygon.empty()) {
      text.append(std::string_view("null}"));
    } else {
      const bool is_cut = has_date_line && (!crs || crs->code == degrees);
      const std::vector<std::vector<Point>> rings =
          is_cut ? cut_at_date_line(cell.polygon) : std::vector<std::vector<Point>>{cell.polygon};
      const bool is_one = rings.size() == 1;
      text.append(std::string_view(is_one ? R"({"type":"Polygon","coordinates":)"
                                          : R"({"type":"MultiPolygon","coordinates":[)"));
      for (const std::vector<Point>& ring : rings) {
        text.append(std::string_view(&ring == rings.data() ? "[[" : ",[["));
        add_ring(text, ring, "[{},{}]", ",");
        text.append(std::string_view("]]"));
      }
      text.append(std::string_view(is_one ? "}}" : "]}}"));
    }
    add(file, text);
  }
  file << "\n]}\n";
}

void write_wkt(GrowingFile& file, const std::vector<PolygonCell>& cells, const CsvFields& kept) {
  CsvFields names = own_columns;
  names.emplace_back("wkt");
  const CsvFields others = other_names(kept, names);
  names.insert(names.end(), others.begin(), others.end());
  file << to_csv(names) + "\n";
  fmt::memory_buffer text;
  for (const PolygonCell& cell : cells) {
    text.clear();
    fmt::format_to(std::back_inserter(text), "{},{},{},{},{},", cell.id, cell.seed.x, cell.seed.y, cell.area,
                   cell.neighbours);
    if (cell.polygon.empty()) {
      text.append(std::string_view("POLYGON EMPTY"));
    } else {
      text.append(std::string_view("\"POLYGON (("));
      add_ring(text, cell.polygon, "{} {}", ", ");
      text.append(std::string_view("))\""));
    }
    if (!kept.empty()) text.append(',' + to_csv(cell.kept));
    text.push_back('\n');
    add(file, text);
  }
}

/// The arrays of a .vtp or .vtu file, raw at its end, each behind its size in bytes.
class VtkArrays {
 public:
  /// The text of an element that names an array.
  template <typename T>
  std::string add(const char* type, const char* name, const std::vector<T>& values, int components = 1) {
    const std::uint64_t bytes = values.size() * sizeof(T);
    std::string element = fmt::format(
        R"(<DataArray type="{}" Name="{}" NumberOfComponents="{}" format="appended" offset="{}"/>)", type,
        name, components, bytes_.size());
    append(&bytes, sizeof bytes);
    append(values.data(), bytes);
    return element;
  }

  /// What VTK has of all cells: their ids, areas or volumes, neighbours, and columns of numbers. Those that
  /// `is_there` says, for it has no empty ones.
  template <typename IsThere>
  std::string add_cells(const std::vector<PolygonCell>& cells, const char* measure, const CsvFields& kept,
                        IsThere is_there) {
    std::vector<double> areas;
    std::vector<std::uint32_t> ids, neighbours;
    for (const PolygonCell& cell : cells) {
      if (!is_there(cell)) continue;
      ids.push_back(cell.id);
      areas.push_back(cell.area);
      neighbours.push_back(cell.neighbours);
    }
    std::string elements =
        add("UInt32", "id", ids) + add("Float64", measure, areas) + add("UInt32", "neighbours", neighbours);
    const CsvFields names = other_names(kept, own_columns);
    for (std::size_t i = 0; i < names.size(); ++i) {
      std::vector<double> numbers;
      for (const PolygonCell& cell : cells) {
        if (!is_there(cell)) continue;
        const std::string& field = cell.kept[i];
        const std::optional<double> number = field.empty() ? NAN : parse_number<double>(field);
        if (!number) break;
        numbers.push_back(*number);
      }
      if (numbers.size() == ids.size()) elements += add("Float64", escaped(names[i]).c_str(), numbers);
    }
    return elements;
  }

  /// The file, of such a kind, with a piece of such sizes and elements.
  void write(GrowingFile& file, const char* kind, const std::string& sizes,
             const std::string& elements) const {
    begin_vtk(file, kind, "", sizes, elements);
    file.write(bytes_.data(), bytes_.size());
    file << end_of_vtk;
  }

 private:
  void append(const void* first, std::size_t count) {
    const auto* const begin = static_cast<const char*>(first);
    bytes_.insert(bytes_.end(), begin, begin + count);
  }

  std::vector<char> bytes_;
};

void write_vtp(GrowingFile& file, const std::vector<PolygonCell>& cells, const CsvFields& kept) {
  std::vector<double> points;
  std::vector<std::int64_t> corners, ends;
  for (const PolygonCell& cell : cells) {
    if (cell.polygon.empty()) continue;
    for (const Point& vertex : cell.polygon) {
      corners.push_back(static_cast<std::int64_t>(corners.size()));
      points.insert(points.end(), {vertex.x, vertex.y, 0});
    }
    ends.push_back(static_cast<std::int64_t>(corners.size()));
  }
  VtkArrays arrays;
  const std::string cell_data =
      arrays.add_cells(cells, "area", kept, [](const PolygonCell& cell) { return !cell.polygon.empty(); });
  const std::string point_data = arrays.add("Float64", "points", points, 3);
  const std::string polygons =
      arrays.add("Int64", "connectivity", corners) + arrays.add("Int64", "offsets", ends);
  arrays.write(
      file, "PolyData",
      fmt::format(
          R"(NumberOfPoints="{}" NumberOfVerts="0" NumberOfLines="0" NumberOfStrips="0" NumberOfPolys="{}")",
          corners.size(), ends.size()),
      fmt::format(R"(<CellData Scalars="area">{}</CellData>
      <Points>{}</Points>
      <Polys>{}</Polys>)",
                  cell_data, point_data, polygons));
}

}  // namespace

void write_polygons(const OutputFile& file, const std::vector<PolygonCell>& cells,
                    const PolygonFileOptions& options) {
  check_extension(file.path(), polygon_extensions);
  const std::string extension = extension_of(file.path());
  GrowingFile growing(file);
  if (extension == ".csv") {
    write_wkt(growing, cells, options.kept);
  } else if (extension == ".vtp") {
    write_vtp(growing, cells, options.kept);
  } else {
    write_geojson(growing, cells, options);
  }
  growing.finish();
}

void write_polyhedra(const OutputFile& file, const std::vector<PolygonCell>& cells,
                     const std::vector<std::uint32_t>& numbers, const ExactPolyhedra& polyhedra,
                     const CsvFields& kept) {
  constexpr std::uint8_t type_of_polyhedra = 42;
  std::vector<double> points;
  std::vector<std::int64_t> corners, ends, faces, face_ends;
  for (const std::size_t number : numbers) {
    const auto& [offsets, neighbours, areas, corner_offsets, all_corners, vertex_offsets, vertices] =
        polyhedra;
    if (offsets[number] == offsets[number + 1]) continue;
    const std::size_t first = corners.size(), begin = vertex_offsets[number];
    for (std::size_t i = begin; i < vertex_offsets[number + 1]; ++i) {
      corners.push_back(static_cast<std::int64_t>(corners.size()));
      points.insert(points.end(), {vertices[i].x, vertices[i].y, vertices[i].z});
    }
    ends.push_back(static_cast<std::int64_t>(corners.size()));
    faces.push_back(offsets[number + 1] - offsets[number]);
    for (std::size_t face = offsets[number]; face < offsets[number + 1]; ++face) {
      faces.push_back(static_cast<std::int64_t>(corner_offsets[face + 1] - corner_offsets[face]));
      for (std::size_t i = corner_offsets[face]; i < corner_offsets[face + 1]; ++i)
        faces.push_back(static_cast<std::int64_t>(all_corners[i] - begin + first));
    }
    face_ends.push_back(static_cast<std::int64_t>(faces.size()));
  }
  VtkArrays arrays;
  const std::string cell_data =
      arrays.add_cells(cells, "volume", kept, [](const PolygonCell& cell) { return cell.area > 0; });
  const std::string point_data = arrays.add("Float64", "points", points, 3);
  const std::string topology =
      arrays.add("Int64", "connectivity", corners) + arrays.add("Int64", "offsets", ends) +
      arrays.add("UInt8", "types", std::vector<std::uint8_t>(ends.size(), type_of_polyhedra)) +
      arrays.add("Int64", "faces", faces) + arrays.add("Int64", "faceoffsets", face_ends);
  GrowingFile growing(file);
  arrays.write(growing, "UnstructuredGrid",
               fmt::format(R"(NumberOfPoints="{}" NumberOfCells="{}")", corners.size(), ends.size()),
               fmt::format(R"(<CellData Scalars="volume">{}</CellData>
      <Points>{}</Points>
      <Cells>{}</Cells>)",
                           cell_data, point_data, topology));
  growing.finish();
}

}  // namespace vorocl::command
