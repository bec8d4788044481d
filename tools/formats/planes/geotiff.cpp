#include "formats/planes/geotiff.hpp"

#include <tiffio.h>

#include <array>
#include <cstdint>

#include "formats/modules.hpp"
#include "formats/values.hpp"
#include "vorocl/error.hpp"
#include "vorocl/grid.hpp"

namespace vorocl::command {

namespace {

enum Tag : std::uint32_t {
  pixel_scale = 33550,
  tie_point = 33922,
  transformation = 34264,
  key_directory = 34735,
  key_doubles = 34736,
  key_texts = 34737,
  tag_of_no_data = 42113  // GDAL's
};

/// The tags of GeoTIFF, which libtiff does not know by itself. (It wants names that it could write to.)
void add_tags(TIFF* file) {
  static char names[][20] = {"ModelPixelScale", "ModelTiepoint",  "ModelTransformation", "GeoKeyDirectory",
                             "GeoDoubleParams", "GeoAsciiParams", "GDALNoData"};
  static const std::array<TIFFFieldInfo, 7> tags = {
      {{pixel_scale, -1, -1, TIFF_DOUBLE, FIELD_CUSTOM, 1, 1, names[0]},
       {tie_point, -1, -1, TIFF_DOUBLE, FIELD_CUSTOM, 1, 1, names[1]},
       {transformation, -1, -1, TIFF_DOUBLE, FIELD_CUSTOM, 1, 1, names[2]},
       {key_directory, -1, -1, TIFF_SHORT, FIELD_CUSTOM, 1, 1, names[3]},
       {key_doubles, -1, -1, TIFF_DOUBLE, FIELD_CUSTOM, 1, 1, names[4]},
       {key_texts, -1, -1, TIFF_ASCII, FIELD_CUSTOM, 1, 0, names[5]},
       {tag_of_no_data, -1, -1, TIFF_ASCII, FIELD_CUSTOM, 1, 0, names[6]}}};
  TIFFMergeFieldInfo(file, tags.data(), static_cast<std::uint32_t>(tags.size()));
}

template <std::size_t count>
bool set(TIFF* file, Tag tag, const std::array<double, count>& values) {
  return TIFFSetField(file, tag, static_cast<int>(count), values.data()) == 1;
}

const GeotiffModule& geotiff_module() {
  static const auto& module = *static_cast<const GeotiffModule*>(load_module(
      "vorocl_geotiff.so",
      "coordinate reference systems need libgeotiff, where vorocl is built: install libgeotiff-dev and build "
      "it again, or write the file without --crs"));
  return module;
}

}  // namespace

Crs parse_crs(const std::string& text) {
  const std::string start = "EPSG:";
  const auto code = text.rfind(start, 0) == 0 ? parse_number<int>(text.substr(start.size())) : std::nullopt;
  if (!code) throw Error("\"" + text + "\" must be EPSG:n, such as EPSG:32632");
  const std::optional<Crs> crs = geotiff_module().find(*code);
  if (!crs) {
    throw Error("the EPSG's registry has no projected or geographic coordinate reference system " + text +
                " (Debian's package proj-data has the registry)");
  }
  return *crs;
}

bool write_georeference(TIFF* file, const Georeference& georeference, double width, double height,
                        const char* no_data) {
  add_tags(file);
  const Bounds& bounds = georeference.bounds;
  const double x = (bounds.x1 - bounds.x0) / width, y = (bounds.y1 - bounds.y0) / height;
  bool done = false;
  if (georeference.y_up) {
    done =
        set<3>(file, pixel_scale, {x, y, 0}) && set<6>(file, tie_point, {0, 0, 0, bounds.x0, bounds.y1, 0});
  } else {  // which a scale cannot say
    done = set<16>(file, transformation, {x, 0, 0, bounds.x0, 0, y, 0, bounds.y0, 0, 0, 0, 0, 0, 0, 0, 1});
  }
  done = done && TIFFSetField(file, tag_of_no_data, no_data) == 1;
  return done && (!georeference.crs || geotiff_module().write_keys(file, *georeference.crs));
}

}  // namespace vorocl::command
