#include "formats/label_files.hpp"

#include "formats/files.hpp"
#include "formats/npy.hpp"
#include "formats/pixel_files.hpp"
#include "formats/tiff.hpp"

namespace vorocl::command {

const std::vector<std::string>& readable_label_extensions() {
  static const std::vector<std::string> all = {".npy", ".tif", ".tiff"};
  return all;
}

const std::vector<std::string>& label_extensions() {
  static const std::vector<std::string> all = {".npy", ".tif", ".tiff", ".vti"};
  return all;
}

LabelImage read_labels(const std::string& path) {
  check_extension(path, readable_label_extensions());
  return extension_of(path) == ".npy" ? read_npy_labels(path) : read_tiff_labels(path);
}

void write_labels(const OutputFile& file, const Raster& raster, const std::vector<std::uint32_t>& labels) {
  write_pixels(file, "label", raster, labels);
}

}  // namespace vorocl::command
