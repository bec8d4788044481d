#include "label_file.hpp"

#include "files.hpp"
#include "npy.hpp"
#include "tiff.hpp"

namespace vorocl::command {

void check_label_path(const std::string& path) { check_extension(path, {".npy", ".tif", ".tiff"}); }

LabelImage read_labels(const std::string& path) {
  check_label_path(path);
  return extension_of(path) == ".npy" ? read_npy_labels(path) : read_tiff_labels(path);
}

void write_labels(const std::string& path, const LabelImage& image) {
  check_label_path(path);
  if (extension_of(path) == ".npy") {
    write_npy_labels(path, image);
  } else {
    write_tiff_labels(path, image);
  }
}

}  // namespace vorocl::command
