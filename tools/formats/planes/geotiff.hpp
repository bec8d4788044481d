// What a GeoTIFF says of where it lies. Its keys are libgeotiff's work, which loads the registry of
// coordinate reference systems and what that needs: so it stands behind a module that is loaded for --crs
// alone, and that is built where libgeotiff is.
#pragma once

#include <optional>

#include "formats/planes/georeference.hpp"

struct tiff;  // TIFF

namespace vorocl::command {

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
