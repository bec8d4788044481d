#include <fmt/format.h>

#include <cstddef>
#include <type_traits>

#include "formats/raster_files.hpp"

namespace vorocl::command {

namespace {

/// Of numbers without a sign, and of floats: "UInt32".
template <typename T>
std::string vtk_type() {
  return (std::is_floating_point_v<T> ? "Float" : "UInt") + std::to_string(8 * sizeof(T));
}

/// The host's, as files of VTK name it.
const char* byte_order() {
  const std::uint16_t one = 1;
  return *reinterpret_cast<const unsigned char*>(&one) == 1 ? "LittleEndian" : "BigEndian";
}

}  // namespace

void begin_vtk(GrowingFile& file, const std::string& kind, const std::string& attributes,
               const std::string& piece, const std::string& elements) {
  file << fmt::format(
      R"(<?xml version="1.0"?>
<VTKFile type="{0}" version="1.0" byte_order="{1}" header_type="UInt64">
  <{0}{2}>
    <Piece {3}>
      {4}
    </Piece>
  </{0}>
  <AppendedData encoding="raw">
    _)",
      kind, byte_order(), attributes, piece, elements);
}

std::string escaped(const std::string& text) {
  std::string result;
  for (const char c : text) {
    switch (c) {
      case '&':
        result += "&amp;";
        break;
      case '<':
        result += "&lt;";
        break;
      case '"':
        result += "&quot;";
        break;
      default:
        result += c;
    }
  }
  return result;
}

template <typename T>
void write_vti(const OutputFile& file, const std::string& name, const Raster& raster,
               const std::vector<T>& values) {
  const Size& size = raster.size;
  const double width = size.width(), height = size.height(), depth = static_cast<double>(raster.depth);
  const Georeference pixels = {{0, 0, width, height, 0, depth}, false, {}};
  const bool has_bounds = raster.georeference && !raster.georeference->tags;
  const auto& [bounds, y_up, crs, tags] = has_bounds ? *raster.georeference : pixels;
  const std::uint64_t bytes = values.size() * sizeof(T);
  GrowingFile image(file);
  const std::string extent = fmt::format("0 {} 0 {} 0 {}", width, height, raster.is_volume() ? depth : 0);
  begin_vtk(
      image, "ImageData",
      fmt::format(R"( WholeExtent="{}" Origin="{} {} {}" Spacing="{} {} {}")", extent, bounds.x0, bounds.y0,
                  raster.is_volume() ? bounds.z0 : 0, (bounds.x1 - bounds.x0) / width,
                  (bounds.y1 - bounds.y0) / height, raster.is_volume() ? (bounds.z1 - bounds.z0) / depth : 1),
      fmt::format(R"(Extent="{}")", extent),
      fmt::format(R"(<CellData Scalars="{0}">
        <DataArray type="{1}" Name="{0}" format="appended" offset="0"/>
      </CellData>)",
                  name, vtk_type<T>()));
  image.write(&bytes, sizeof bytes);
  const std::size_t rows = y_up ? static_cast<std::size_t>(size.height()) : 1, count = values.size() / rows;
  for (std::size_t row = rows; row-- > 0;) image.write(values.data() + row * count, count * sizeof(T));
  image << end_of_vtk;
  image.finish();
}

template void write_vti(const OutputFile&, const std::string&, const Raster&,
                        const std::vector<std::uint8_t>&);
template void write_vti(const OutputFile&, const std::string&, const Raster&,
                        const std::vector<std::uint32_t>&);
template void write_vti(const OutputFile&, const std::string&, const Raster&, const std::vector<float>&);

void write_pvd(const OutputFile& file, const std::vector<TimedFile>& files) {
  GrowingFile collection(file);
  collection
      << fmt::format(
             "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"1.0\" byte_order=\"{}\">\n",
             byte_order())
      << "  <Collection>\n";
  for (const TimedFile& entry : files) {
    collection << fmt::format("    <DataSet timestep=\"{}\" part=\"0\" file=\"{}\"/>\n", entry.time,
                              escaped(entry.name));
  }
  collection << "  </Collection>\n</VTKFile>\n";
  collection.finish();
}

}  // namespace vorocl::command
