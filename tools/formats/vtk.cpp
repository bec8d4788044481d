#include <fmt/format.h>

#include <cstddef>

#include "formats/raster_files.hpp"

namespace vorocl::command {

namespace {

template <typename T>
constexpr const char* vtk_type = nullptr;
template <>
constexpr const char* vtk_type<std::uint8_t> = "UInt8";
template <>
constexpr const char* vtk_type<std::uint32_t> = "UInt32";
template <>
constexpr const char* vtk_type<float> = "Float32";

const char* byte_order() {
  const std::uint16_t one = 1;
  return *reinterpret_cast<const unsigned char*>(&one) == 1 ? "LittleEndian" : "BigEndian";
}

}  // namespace

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

namespace {

/// What stands before the bytes of an image of values: where its cells lie.
template <typename T>
std::string start_of_image(const std::string& name, const std::string& extent, const Point& corner,
                           const Point& cell) {
  return fmt::format(
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
      byte_order(), extent, name, vtk_type<T>, corner.x, corner.y, corner.z, cell.x, cell.y, cell.z);
}

constexpr const char* end_of_image = "\n  </AppendedData>\n</VTKFile>\n";

}  // namespace

template <typename T>
void write_vti(const OutputFile& file, const std::string& name, const Raster& raster,
               const std::vector<T>& values) {
  const Size& size = raster.size;
  const Georeference pixels = {
      {0, 0, static_cast<double>(size.width()), static_cast<double>(size.height())}, false, {}};
  const auto& [bounds, y_up, crs] = raster.georeference ? *raster.georeference : pixels;
  const std::uint64_t bytes = values.size() * sizeof(T);
  const std::size_t row_bytes = static_cast<std::size_t>(size.width()) * sizeof(T);
  GrowingFile image(file);
  image << start_of_image<T>(
      name, fmt::format("0 {} 0 {} 0 0", size.width(), size.height()), {bounds.x0, bounds.y0, 0},
      {(bounds.x1 - bounds.x0) / size.width(), (bounds.y1 - bounds.y0) / size.height(), 1});
  image.write(&bytes, sizeof bytes);
  for (int row = 0; row < size.height(); ++row) {
    const std::ptrdiff_t of_picture = y_up ? size.height() - 1 - row : row;
    const T* const first = values.data() + of_picture * size.width();
    image.write(first, row_bytes);
  }
  image << end_of_image;
  image.finish();
}

template <typename T>
void write_vti_volume(const OutputFile& file, const std::string& name, const VolumeRaster& raster,
                      const std::vector<T>& values) {
  const VolumeSize& size = raster.size;
  const std::uint64_t bytes = values.size() * sizeof(T);
  GrowingFile image(file);
  image << start_of_image<T>(name, fmt::format("0 {} 0 {} 0 {}", size.width, size.height, size.depth),
                             raster.corner, raster.voxel);
  image.write(&bytes, sizeof bytes);
  image.write(values.data(), bytes);
  image << end_of_image;
  image.finish();
}

template void write_vti_volume(const OutputFile&, const std::string&, const VolumeRaster&,
                               const std::vector<std::uint32_t>&);
template void write_vti_volume(const OutputFile&, const std::string&, const VolumeRaster&,
                               const std::vector<float>&);
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
