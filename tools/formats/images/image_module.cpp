// The module of image files: vorocl_images.so.
#include <sys/mman.h>
#include <unistd.h>

#include <new>
#include <opencv2/imgcodecs.hpp>
#include <string>

#include "formats/modules.hpp"

namespace vorocl::command {

namespace {

/// Keeps for a scope what goes to standard error: OpenCV and the image libraries under it print to it by
/// themselves.
class KeptStandardError {
 public:
  KeptStandardError() : standard_error_(dup(STDERR_FILENO)), kept_(memfd_create("stderr", 0)) {
    if (kept_ >= 0) dup2(kept_, STDERR_FILENO);
  }
  ~KeptStandardError() {
    if (kept_ >= 0) close(kept_);
    if (standard_error_ < 0) return;
    dup2(standard_error_, STDERR_FILENO);
    close(standard_error_);
  }
  KeptStandardError(const KeptStandardError&) = delete;
  KeptStandardError& operator=(const KeptStandardError&) = delete;

  /// The first lines of it.
  std::string text() const {
    std::string text(4096, ' ');
    const ssize_t count = pread(kept_, text.data(), text.size(), 0);
    text.resize(count > 0 ? static_cast<std::size_t>(count) : 0);
    return text;
  }

 private:
  int standard_error_, kept_;
};

/// Of a damaged JPEG libjpeg makes up what is missing. It prints the first thing alone that it finds wrong.
bool is_damaged(const std::string& heard) { return heard.find("Corrupt JPEG data") != std::string::npos; }

/// What `work` makes; nothing if OpenCV refuses it, whose texts name its own source lines, or has made it up.
template <typename Work>
auto quietly(const Work& work) -> decltype(work()) {
  const KeptStandardError printed;
  try {
    auto made = work();
    if (is_damaged(printed.text())) return {};
    return made;
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
