// Where the pixels of a plane lie in the world, and what a GeoTIFF says of it. Its keys are libgeotiff's
// work, which loads the registry of coordinate reference systems and what that needs: so it stands behind a
// module that is loaded for --crs alone, and that is built where libgeotiff is.
#pragma once

#include <optional>
#include <string>

#include "formats/raster.hpp"

struct tiff;  // TIFF

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

/// What geotiff_module.cpp does. No function throws or prints.
class GeotiffModule {
 public:
  /// The projected or geographic system of this code; none: there is none.
  virtual std::optional<Crs> find(int code) const = 0;

  /// Sets the tags that say the system. False if that fails.
  virtual bool write_keys(tiff* file, const Crs& crs) const = 0;

 protected:
  ~GeotiffModule() = default;
};

/// Sets a file's tags for an image of this size. False if that fails.
bool write_georeference(tiff* file, const Georeference& georeference, double width, double height);

}  // namespace vorocl::command
