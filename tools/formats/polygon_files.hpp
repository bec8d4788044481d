// Files of cells as polygons, by the extension of their name: GeoJSON (.geojson, .json), WKT in a table
// (.csv), and .vtp, which ParaView opens; and of cells as polyhedra, .vtu. They are only written.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "formats/csv.hpp"
#include "formats/output_file.hpp"
#include "formats/raster.hpp"
#include "vorocl/exact_cells.hpp"
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
  CsvFields kept = {};  ///< of columns of the input
};

/// All, with that of polyhedra.
constexpr const char* polyhedra_extension = ".vtu";
inline const std::vector<std::string> polygon_extensions = {".geojson", ".json", ".csv", ".vtp",
                                                            polyhedra_extension};

/// What a file of polygons says besides these.
struct PolygonFileOptions {
  CsvFields kept = {};                    ///< names of the columns of the input
  std::optional<Crs> crs = std::nullopt;  ///< none: longitudes and latitudes, for GeoJSON
  bool has_date_line = false;             ///< x are longitudes, which repeat from -180 to 180
};

/// GeoJSON has the system as GDAL reads it, and none for longitudes and latitudes (EPSG:4326), as RFC 7946
/// has it. A polygon across the date line is two there. `kept` names the columns of the input that all cells
/// have; of these a .vtp file has those of numbers alone. Numbers in text are the shortest that are read back
/// the same. Throws Error if the name ends in no such extension, or the file cannot be written.
void write_polygons(const OutputFile& file, const std::vector<PolygonCell>& cells,
                    const PolygonFileOptions& options = {});

/// Cells of a volume, each with its number in the polyhedra, as .vtu with their volumes and the columns of
/// the input that hold numbers alone. Throws Error if the file cannot be written.
void write_polyhedra(const OutputFile& file, const std::vector<PolygonCell>& cells,
                     const std::vector<std::uint32_t>& numbers, const ExactPolyhedra& polyhedra,
                     const CsvFields& kept);

}  // namespace vorocl::command
