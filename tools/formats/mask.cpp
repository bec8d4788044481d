#include "formats/mask.hpp"

#include <algorithm>
#include <opencv2/imgcodecs.hpp>

#include "formats/files.hpp"
#include "formats/images/quiet_standard_error.hpp"
#include "vorocl/error.hpp"

namespace vorocl::command {

namespace {

cv::Mat read_image(const std::string& path) {
  open_to_read(path);  // for its reasons where the file cannot be read at all
  const QuietStandardError quiet;
  try {
    // Not as grey values: rounding makes a faint blue 0.
    cv::Mat image = cv::imread(path, cv::IMREAD_COLOR | cv::IMREAD_ANYDEPTH | cv::IMREAD_IGNORE_ORIENTATION);
    if (!image.empty()) return image;
  } catch (const cv::Exception&) {  // a damaged or too large image; the text names OpenCV's own source lines
  }
  throw Error(path + " is no image that can be read");
}

}  // namespace

Mask read_mask(const std::string& path) {
  const cv::Mat image = read_image(path);
  Mask mask{Grid(image.cols, image.rows), {}};
  cv::Mat channels = image.reshape(1, image.rows * image.cols);
  cv::Mat set;
  cv::reduce(channels != 0, set, 1, cv::REDUCE_MAX);
  set.copyTo(mask.pixels);
  if (std::count(mask.pixels.begin(), mask.pixels.end(), 0) ==
      static_cast<std::ptrdiff_t>(mask.pixels.size())) {
    throw Error(path + " has no pixel that is not zero: there is no seed");
  }
  return mask;
}

}  // namespace vorocl::command
