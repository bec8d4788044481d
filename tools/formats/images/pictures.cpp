#include "formats/images/pictures.hpp"

#include "formats/files.hpp"
#include "formats/images/modules.hpp"
#include "vorocl/error.hpp"

namespace vorocl::command {

const std::vector<std::string>& picture_extensions() {
  static const std::vector<std::string> all = {".png", ".jpg", ".jpeg", ".bmp", ".tif", ".tiff"};
  return all;
}

cv::Mat read_picture(const std::string& path) {
  open_to_read(path);  // for its reasons where the file cannot be read at all
  cv::Mat picture = image_module().read(path);
  if (picture.empty()) throw Error(path + " is no image that can be read");
  return picture;
}

void write_picture(const std::string& path, const cv::Mat& picture) {
  if (!image_module().write(path, picture)) throw Error("writing " + path + " failed");
}

}  // namespace vorocl::command
