#include "formats/label_files.hpp"

#include "formats/files.hpp"
#include "formats/npy.hpp"
#include "formats/tiff.hpp"
#include "formats/vtk.hpp"

namespace vorocl::command {

const std::vector<std::string>& label_extensions() {
  static const std::vector<std::string> all = {".npy", ".tif", ".tiff", ".vti"};
  return all;
}

LabelImage read_labels(const std::string& path) {
  check_extension(path, {".npy", ".tif", ".tiff"});
  return extension_of(path) == ".npy" ? read_npy_labels(path) : read_tiff_labels(path);
}

void write_labels(const std::string& path, const LabelImage& image) {
  check_extension(path, label_extensions());
  const std::string extension = extension_of(path);
  if (extension == ".npy") {
    write_npy(path, image.grid, image.labels);
  } else if (extension == ".vti") {
    write_vti(path, "label", image.grid, image.labels);
  } else {
    write_tiff(path, image.grid, image.labels);
  }
}

}  // namespace vorocl::command
