#include "formats/raster_files.hpp"

#include <cstdint>

#include "formats/files.hpp"
#include "formats/npy.hpp"

namespace vorocl::command {

const std::vector<std::string>& readable_label_extensions() {
  static const std::vector<std::string> all = {".npy", ".tif", ".tiff"};
  return all;
}

const std::vector<std::string>& label_extensions() {
  static const std::vector<std::string> all = {".npy", ".tif", ".tiff", ".vti"};
  return all;
}

const std::vector<std::string>& volume_extensions() {
  static const std::vector<std::string> all = {".npy", ".vti"};
  return all;
}

template <typename T>
void write_voxels(const OutputFile& file, const std::string& name, const VolumeRaster& raster,
                  const std::vector<T>& values) {
  check_extension(file.path(), volume_extensions());
  extension_of(file.path()) == ".npy" ? write_npy_volume(file, raster.size, values)
                                      : write_vti_volume(file, name, raster, values);
}

template void write_voxels(const OutputFile&, const std::string&, const VolumeRaster&,
                           const std::vector<std::uint32_t>&);
template void write_voxels(const OutputFile&, const std::string&, const VolumeRaster&,
                           const std::vector<float>&);

LabelImage read_labels(const std::string& path) {
  check_extension(path, readable_label_extensions());
  return extension_of(path) == ".npy" ? read_npy_labels(path) : read_tiff_labels(path);
}

void write_labels(const OutputFile& file, const Raster& raster, const std::vector<std::uint32_t>& labels) {
  write_pixels(file, "label", raster, labels);
}

template <typename T>
void write_pixels(const OutputFile& file, const std::string& name, const Raster& raster,
                  const std::vector<T>& values) {
  const std::string extension = extension_of(file.path());
  if (extension == ".npy") {
    write_npy(file, raster.size, values);
  } else if (extension == ".vti") {
    write_vti(file, name, raster, values);
  } else if constexpr (sizeof(T) == 4) {
    check_extension(file.path(), {".npy", ".tif", ".tiff", ".vti"});
    write_tiff(file, raster.size, values);
  } else {
    check_extension(file.path(), {".npy", ".vti"});
  }
}

template void write_pixels(const OutputFile&, const std::string&, const Raster&,
                           const std::vector<std::uint8_t>&);
template void write_pixels(const OutputFile&, const std::string&, const Raster&,
                           const std::vector<std::uint32_t>&);
template void write_pixels(const OutputFile&, const std::string&, const Raster&, const std::vector<float>&);

}  // namespace vorocl::command
