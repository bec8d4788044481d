#include "formats/mask.hpp"

#include <algorithm>
#include <opencv2/core.hpp>

#include "formats/images/pictures.hpp"
#include "vorocl/error.hpp"

namespace vorocl::command {

Mask read_mask(const std::string& path) {
  const cv::Mat image = read_picture(path);
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
