#include "formats/images/film.hpp"

#include <fmt/format.h>
#include <malloc.h>

#include <cmath>
#include <cstdlib>

#include "app/terminal/console.hpp"
#include "vorocl/error.hpp"

namespace vorocl::command {

namespace {

cv::Size even(const cv::Size& size) { return {size.width + size.width % 2, size.height + size.height % 2}; }

/// On CPUs with AVX-512, x264's film of pictures whose width is no multiple of 64 depends on memory that was
/// never set (seen with version 164). That it holds the same in every run makes the same film again.
void make_unset_memory_the_same() {
#ifdef M_PERTURB
  mallopt(M_PERTURB, 0x55);
#endif
}

cv::Mat padded(const cv::Mat& picture) {
  const cv::Size size = even(picture.size());
  if (size == picture.size()) return picture;
  cv::Mat result;
  cv::copyMakeBorder(picture, result, 0, size.height - picture.rows, 0, size.width - picture.cols,
                     cv::BORDER_REPLICATE);
  return result;
}

}  // namespace

Film::Film(const std::string& path, double frames_per_second)
    : file_(path), frames_per_second_(frames_per_second) {}

Film::~Film() {
  writer_.release();
  file_.discard();
}

void Film::open(const cv::Size& size) {
  setenv("OPENCV_FFMPEG_LOGLEVEL", "-8", 0);  // quiet: what goes wrong is said in our words
  make_unset_memory_the_same();
  const int h264 = cv::VideoWriter::fourcc('a', 'v', 'c', '1');
  if (!writer_.open(file_.temporary_path(), cv::CAP_FFMPEG, h264, frames_per_second_, even(size))) {
    throw Error(
        fmt::format("{}: no film of {} x {} can be made here (OpenCV needs FFmpeg with an H.264 encoder); "
                    "write numbered pictures, such as frames/%05d.png",
                    file_.path(), size.width, size.height));
  }
  if (even(size) != size) {
    print_note(
        fmt::format("{}: a film's sides are even, so {} x {} has become {} x {} by repeating the last {}",
                    file_.path(), size.width, size.height, even(size).width, even(size).height,
                    size.width % 2 == 0    ? "row"
                    : size.height % 2 == 0 ? "column"
                                           : "row and column"));
  }
}

void Film::add(const cv::Mat& picture) {
  if (pictures_ == 0) open(picture.size());
  writer_.write(padded(picture));
  ++pictures_;
}

void Film::finish() {
  if (pictures_ == 0) return;
  writer_.release();
  // The writer does not say what went wrong.
  const cv::VideoCapture film(file_.temporary_path(), cv::CAP_FFMPEG);
  if (!film.isOpened() || std::lround(film.get(cv::CAP_PROP_FRAME_COUNT)) != pictures_) {
    throw Error("writing " + file_.path() + " failed: is the disk full?");
  }
  file_.commit();
}

}  // namespace vorocl::command
