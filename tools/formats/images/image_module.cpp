// The module of image files: vorocl_images.so.
#include <opencv2/imgcodecs.hpp>

#include "formats/images/modules.hpp"
#include "formats/images/quiet_standard_error.hpp"

namespace vorocl::command {

namespace {

class Module : public ImageModule {
 public:
  cv::Mat read(const std::string& path) const override {
    const QuietStandardError quiet;
    try {
      // Not as grey values: rounding makes a faint blue 0.
      return cv::imread(path, cv::IMREAD_COLOR | cv::IMREAD_ANYDEPTH | cv::IMREAD_IGNORE_ORIENTATION);
    } catch (
        const cv::Exception&) {  // a damaged or too large image; the text names OpenCV's own source lines
      return {};
    }
  }

  bool write(const std::string& path, const cv::Mat& picture) const override {
    const QuietStandardError quiet;
    try {
      return cv::imwrite(path, picture);
    } catch (const cv::Exception&) {  // its text names OpenCV's own source lines
      return false;
    }
  }
};

}  // namespace

}  // namespace vorocl::command

/// What modules.cpp asks for, by this name.
extern "C" __attribute__((visibility("default"))) const void* vorocl_module() {
  static const vorocl::command::Module module;
  return static_cast<const vorocl::command::ImageModule*>(&module);
}
