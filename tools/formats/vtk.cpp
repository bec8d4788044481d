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

}  // namespace

const char* byte_order() {
  const std::uint16_t one = 1;
  return *reinterpret_cast<const unsigned char*>(&one) == 1 ? "LittleEndian" : "BigEndian";
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
  image << fmt::format(
      R"(<?xml version="1.0"?>
<VTKFile type="ImageData" version="1.0" byte_order="{0}" header_type="UInt64">
  <ImageData WholeExtent="{1}" Origin="{4} {5} {6}" Spacing="{7} {8} {9}">
    <Piece Extent="{1}">
      <CellData Scalars="{2}">
        <DataArray type="{3}" Name="{2}" format="appended" offset="0"/>
      </CellData>
    </Piece>
  </ImageData>
  <AppendedData encoding="raw">
    _)",
      byte_order(), fmt::format("0 {} 0 {} 0 {}", width, height, raster.is_volume() ? depth : 0), name,
      vtk_type<T>(), bounds.x0, bounds.y0, raster.is_volume() ? bounds.z0 : 0,
      (bounds.x1 - bounds.x0) / width, (bounds.y1 - bounds.y0) / height,
      raster.is_volume() ? (bounds.z1 - bounds.z0) / depth : 1);
  image.write(&bytes, sizeof bytes);
  const std::size_t rows = y_up ? static_cast<std::size_t>(size.height()) : 1, count = values.size() / rows;
  for (std::size_t row = rows; row-- > 0;) image.write(values.data() + row * count, count * sizeof(T));
  image << "\n  </AppendedData>\n</VTKFile>\n";
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
