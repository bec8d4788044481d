// Files of cells as polygons, by the extension of their name: GeoJSON (.geojson, .json), WKT in a table
// (.csv), and .vtp, which ParaView opens. They are only written.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "formats/output_file.hpp"
#include "vorocl/grid.hpp"

namespace vorocl::command {

/// A cell with what files say of it. Its polygon is empty or goes round it counter-clockwise, without the
/// first vertex once more at the end.
struct PolygonCell {
  std::uint32_t id = 0;
  Point seed;
  double area = 0;
  std::uint32_t neighbours = 0;
  std::vector<Point> polygon;
};

const std::vector<std::string>& polygon_extensions();

/// Numbers in text are the shortest that are read back the same. Throws Error if the name ends in no such
/// extension, or the file cannot be written.
void write_polygons(const OutputFile& file, const std::vector<PolygonCell>& cells);

}  // namespace vorocl::command
