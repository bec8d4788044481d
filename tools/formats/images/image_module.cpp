// The module of image files: vorocl_images.so.
#include <fcntl.h>
#include <unistd.h>

#include <new>
#include <opencv2/imgcodecs.hpp>

#include "formats/modules.hpp"

namespace vorocl::command {

namespace {

/// Sends standard error nowhere for a scope: OpenCV and the image libraries under it print to it by
/// themselves.
class QuietStandardError {
 public:
  QuietStandardError() : standard_error_(dup(STDERR_FILENO)) {
    const int nowhere = open("/dev/null", O_WRONLY);
    if (nowhere >= 0) dup2(nowhere, STDERR_FILENO);
    if (nowhere >= 0) close(nowhere);
  }
  ~QuietStandardError() {
    if (standard_error_ < 0) return;
    dup2(standard_error_, STDERR_FILENO);
    close(standard_error_);
  }
  QuietStandardError(const QuietStandardError&) = delete;
  QuietStandardError& operator=(const QuietStandardError&) = delete;

 private:
  int standard_error_;
};

/// What `work` makes; nothing if OpenCV refuses it, whose texts name its own source lines.
template <typename Work>
auto quietly(const Work& work) -> decltype(work()) {
  const QuietStandardError quiet;
  try {
    return work();
  } catch (const cv::Exception& error) {
    if (error.code == cv::Error::StsNoMem) throw std::bad_alloc();
    return {};
  }
}

class Module : public ImageModule {
 public:
  cv::Mat decode(const std::vector<std::uint8_t>& bytes, bool is_plain) const override {
    const int colors = cv::IMREAD_COLOR | cv::IMREAD_ANYDEPTH | cv::IMREAD_IGNORE_ORIENTATION;
    const int flags = is_plain ? static_cast<int>(cv::IMREAD_UNCHANGED) : colors;
    return quietly([&] { return cv::imdecode(bytes, flags); });
  }

  std::vector<std::uint8_t> encode(const std::string& extension, const cv::Mat& picture) const override {
    return quietly([&] {
      std::vector<std::uint8_t> bytes;
      if (!cv::imencode(extension, picture, bytes)) bytes.clear();
      return bytes;
    });
  }
};

}  // namespace

}  // namespace vorocl::command

/// What modules.cpp asks for, by this name.
extern "C" __attribute__((visibility("default"))) const void* vorocl_module() {
  static const vorocl::command::Module module;
  return static_cast<const vorocl::command::ImageModule*>(&module);
}
