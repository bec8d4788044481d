// The module of GeoTIFF's keys: vorocl_geotiff.so.
#include <geo_normalize.h>
#include <geotiff.h>
#include <geovalues.h>
#include <proj.h>
#include <tiffio.h>

#include <memory>

#include "formats/planes/geotiff.hpp"

namespace vorocl::command {

namespace {

constexpr int lowest_code = 1024, highest_code = 32766;  // of the EPSG's systems

struct Free {
  void operator()(char* text) const { GTIFFreeMemory(text); }
  void operator()(GTIF* keys) const { GTIFFree(keys); }
};

class Module : public GeotiffModule {
 public:
  // libgeotiff asks PROJ, which would print to stderr what it does not find.
  Module() { proj_log_level(nullptr, PJ_LOG_NONE); }

  std::optional<Crs> find(int code) const override {
    if (code < lowest_code || code > highest_code) return std::nullopt;
    char* name = nullptr;
    const bool is_projected = GTIFGetPCSInfo(code, &name, nullptr, nullptr, nullptr) == 1;
    const bool is_known = is_projected || GTIFGetGCSInfo(code, &name, nullptr, nullptr, nullptr) == 1;
    const std::unique_ptr<char, Free> held(name);
    if (!is_known) return std::nullopt;
    return Crs{code, !is_projected, name != nullptr ? name : ""};
  }

  bool write_keys(TIFF* file, const Crs& crs) const override {
    const std::unique_ptr<GTIF, Free> keys(GTIFNew(file));
    return keys &&
           GTIFKeySet(keys.get(), GTModelTypeGeoKey, TYPE_SHORT, 1,
                      crs.is_geographic ? ModelTypeGeographic : ModelTypeProjected) == 1 &&
           GTIFKeySet(keys.get(), GTRasterTypeGeoKey, TYPE_SHORT, 1, RasterPixelIsArea) == 1 &&
           GTIFKeySet(keys.get(), GTCitationGeoKey, TYPE_ASCII, 0, crs.name.c_str()) == 1 &&
           GTIFKeySet(keys.get(), crs.is_geographic ? GeographicTypeGeoKey : ProjectedCSTypeGeoKey,
                      TYPE_SHORT, 1, crs.code) == 1 &&
           GTIFWriteKeys(keys.get()) == 1;
  }
};

}  // namespace

}  // namespace vorocl::command

/// What geotiff.cpp asks for, by this name.
extern "C" __attribute__((visibility("default"))) const void* vorocl_module() {
  static const vorocl::command::Module module;
  return static_cast<const vorocl::command::GeotiffModule*>(&module);
}
