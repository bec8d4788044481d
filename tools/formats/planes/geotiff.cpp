#include "formats/planes/geotiff.hpp"

#include <tiffio.h>

#include <algorithm>
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

/// The values of a tag as the library reads it that does not know it; none: it is not there, or has others.
template <typename T>
std::vector<T> read(TIFF* file, Tag tag, TIFFDataType type) {
  std::uint32_t count = 0;
  const T* values = nullptr;
  const TIFFField* const field = TIFFFindField(file, tag, TIFF_ANY);
  if (field == nullptr || TIFFFieldDataType(field) != type || TIFFGetField(file, tag, &count, &values) != 1)
    return {};
  return {values, values + count};
}

std::string read_text(TIFF* file, Tag tag) {
  const std::vector<char> bytes = read<char>(file, tag, TIFF_ASCII);
  return {bytes.begin(), std::find(bytes.begin(), bytes.end(), '\0')};
}

/// False if that fails; no values are none.
template <typename T>
bool set(TIFF* file, Tag tag, const std::vector<T>& values) {
  return values.empty() || TIFFSetField(file, tag, static_cast<int>(values.size()), values.data()) == 1;
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

std::optional<GeoTags> read_geotags(TIFF* file) {
  GeoTags tags;
  tags.scale = read<double>(file, pixel_scale, TIFF_DOUBLE);
  tags.tie_points = read<double>(file, tie_point, TIFF_DOUBLE);
  tags.transformation = read<double>(file, transformation, TIFF_DOUBLE);
  tags.keys = read<std::uint16_t>(file, key_directory, TIFF_SHORT);
  tags.key_doubles = read<double>(file, key_doubles, TIFF_DOUBLE);
  tags.key_texts = read_text(file, key_texts);
  if (tags.tie_points.empty() && tags.transformation.empty() && tags.keys.empty()) return std::nullopt;
  return tags;
}

std::optional<double> read_no_data(TIFF* file) {
  return parse_number<double>(read_text(file, tag_of_no_data));
}

bool write_georeference(TIFF* file, const Georeference& georeference, double width, double height,
                        const char* no_data) {
  add_tags(file);
  const Bounds& bounds = georeference.bounds;
  const double x = (bounds.x1 - bounds.x0) / width, y = (bounds.y1 - bounds.y0) / height;
  GeoTags tags;
  if (georeference.tags) {
    tags = *georeference.tags;
  } else if (georeference.y_up) {
    tags.scale = {x, y, 0};
    tags.tie_points = {0, 0, 0, bounds.x0, bounds.y1, 0};
  } else {  // which a scale cannot say
    tags.transformation = {x, 0, 0, bounds.x0, 0, y, 0, bounds.y0, 0, 0, 0, 0, 0, 0, 0, 1};
  }
  return set(file, pixel_scale, tags.scale) && set(file, tie_point, tags.tie_points) &&
         set(file, transformation, tags.transformation) && set(file, key_directory, tags.keys) &&
         set(file, key_doubles, tags.key_doubles) &&
         (tags.key_texts.empty() || TIFFSetField(file, key_texts, tags.key_texts.c_str()) == 1) &&
         TIFFSetField(file, tag_of_no_data, no_data) == 1 &&
         (!georeference.crs || geotiff_module().write_keys(file, *georeference.crs));
}

}  // namespace vorocl::command
