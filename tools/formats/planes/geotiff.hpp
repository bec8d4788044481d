// Where the pixels of a plane lie in the world, and what a GeoTIFF says of it. Its keys are libgeotiff's
// work, which loads the registry of coordinate reference systems and what that needs: so it stands behind a
// module that is loaded for --crs alone, and that is built where libgeotiff is.
#pragma once

#include <optional>
#include <string>

#include "formats/raster.hpp"

struct tiff;  // TIFF

namespace vorocl::command {

/// "EPSG:32632" to the system. Throws Error if it is no such text, if the registry has no projected or
/// geographic system of this code, and where this vorocl was built without libgeotiff.
Crs parse_crs(const std::string& text);

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

/// Those tags of an open file; none: it is no GeoTIFF.
std::optional<GeoTags> read_geotags(tiff* file);

/// The number that pixels without a value have, as GDAL writes it; none: the file does not say it.
std::optional<double> read_no_data(tiff* file);

/// Sets a file's tags for an image of this size, whose pixels without a value have `no_data`. False if that
/// fails.
bool write_georeference(tiff* file, const Georeference& georeference, double width, double height,
                        const char* no_data);

}  // namespace vorocl::command
