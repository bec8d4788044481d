#include "formats/images/film.hpp"

#include <fmt/format.h>

#include <opencv2/core.hpp>

#include "vorocl/error.hpp"

namespace vorocl::command {

namespace {

cv::Mat padded(const cv::Mat& picture) {
  const cv::Size size = film_size(picture.size());
  if (size == picture.size()) return picture;
  cv::Mat result;
  cv::copyMakeBorder(picture, result, 0, size.height - picture.rows, 0, size.width - picture.cols,
                     cv::BORDER_REPLICATE);
  return result;
}

}  // namespace

cv::Size film_size(const cv::Size& picture) {
  return {picture.width + picture.width % 2, picture.height + picture.height % 2};
}

Film::Film(const std::string& path, double frames_per_second)
    : file_(path), frames_per_second_(frames_per_second) {}

Film::~Film() {
  encoder_.reset();
  file_.discard();
}

void Film::add(const cv::Mat& picture) {
  if (!encoder_) {
    encoder_ = film_module().open(file_.temporary_path(), frames_per_second_, film_size(picture.size()));
  }
  if (!encoder_) {
    throw Error(
        fmt::format("{}: no film of {} x {} can be made here (OpenCV needs FFmpeg with an H.264 encoder); "
                    "write numbered pictures, such as frames/%05d.png",
                    file_.path(), picture.cols, picture.rows));
  }
  encoder_->add(padded(picture));
  ++pictures_;
}

void Film::finish() {
  if (pictures_ == 0) return;
  encoder_.reset();
  // The encoder does not say what went wrong.
  if (film_module().count_pictures(file_.temporary_path()) != pictures_) {
    throw Error("writing " + file_.path() + " failed: is the disk full?");
  }
  file_.commit();
}

}  // namespace vorocl::command
