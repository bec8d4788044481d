// Where the pixels of a plane lie in the world, for GeoTIFF files.
#pragma once

#include <optional>
#include <string>

#include "vorocl/bounds.hpp"

namespace vorocl::command {

/// A coordinate reference system of the EPSG's registry.
struct Crs {
  int code = 0;  ///< EPSG:code
  bool is_geographic = false;
  std::string name;
};

/// "EPSG:32632" to the system. Throws Error if it is no such text, if the registry has no projected or
/// geographic system of this code, and where this vorocl was built without libgeotiff.
Crs parse_crs(const std::string& text);

/// The rectangle that an image shows, in data units, and whether its y axis points up.
struct Georeference {
  Bounds bounds;
  bool y_up = false;
  std::optional<Crs> crs;
};

}  // namespace vorocl::command
