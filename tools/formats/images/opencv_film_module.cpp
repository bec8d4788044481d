// The module of films, vorocl_films.so, where OpenCV encodes them: of a build without VOROCL_FFMPEG.
#include <cmath>
#include <cstdlib>
#include <opencv2/videoio.hpp>

#include "formats/modules.hpp"

namespace vorocl::command {

namespace {

class Encoder : public FilmEncoder {
 public:
  Encoder(const std::string& path, double frames_per_second, const cv::Size& size) {
    const int h264 = cv::VideoWriter::fourcc('a', 'v', 'c', '1');
    writer_.open(path, cv::CAP_FFMPEG, h264, frames_per_second, size);
  }
  bool is_open() const { return writer_.isOpened(); }
  bool add(const cv::Mat& picture) override {
    writer_.write(picture);
    return true;
  }

 private:
  cv::VideoWriter writer_;
};

class Module : public FilmModule {
 public:
  std::unique_ptr<FilmEncoder> open(const std::string& path, double frames_per_second,
                                    const cv::Size& size) const override {
    setenv("OPENCV_FFMPEG_LOGLEVEL", "-8", 0);  // quiet: what goes wrong is said in our words
    auto encoder = std::make_unique<Encoder>(path, frames_per_second, size);
    if (!encoder->is_open()) return nullptr;
    return encoder;
  }

  long count_pictures(const std::string& path) const override {
    const cv::VideoCapture film(path, cv::CAP_FFMPEG);
    return film.isOpened() ? std::lround(film.get(cv::CAP_PROP_FRAME_COUNT)) : 0;
  }
};

}  // namespace

}  // namespace vorocl::command

/// What modules.cpp asks for, by this name.
extern "C" __attribute__((visibility("default"))) const void* vorocl_module() {
  static const vorocl::command::Module module;
  return static_cast<const vorocl::command::FilmModule*>(&module);
}
