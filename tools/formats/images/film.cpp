#include "formats/images/film.hpp"

#include <fmt/format.h>
#include <malloc.h>

#include <algorithm>
#include <opencv2/core.hpp>

#include "vorocl/error.hpp"

namespace vorocl::command {

namespace {

/// What x264 takes.
constexpr int longest_side = 16384;

cv::Mat padded(const cv::Mat& picture) {
  const cv::Size size = film_size(picture.size());
  if (size == picture.size()) return picture;
  cv::Mat result;
  cv::copyMakeBorder(picture, result, 0, size.height - picture.rows, 0, size.width - picture.cols,
                     cv::BORDER_REPLICATE);
  return result;
}

OutputFile to_be_film(const std::string& path) {
  OutputFile file(path);
  file.require_file("a film");
  return file;
}

/// On CPUs with AVX-512, x264's film of pictures whose width is no multiple of 64 depends on memory that was
/// never set (seen with version 164). That it holds the same in every run makes the same film again.
void make_unset_memory_the_same() {
#ifdef M_PERTURB
  mallopt(M_PERTURB, 0x55);
#endif
}

}  // namespace

cv::Size film_size(const cv::Size& picture) {
  return {picture.width + picture.width % 2, picture.height + picture.height % 2};
}

Film::Film(const std::string& path, double frames_per_second)
    : file_(to_be_film(path)), frames_per_second_(frames_per_second) {}

void Film::add(const cv::Mat& picture) {
  const cv::Size size = film_size(picture.size());
  if (std::max(size.width, size.height) > longest_side) {
    throw Error(fmt::format(
        "{}: a film of {} x {} cannot be made, because the sides of H.264 have at most {} pixels; "
        "write numbered pictures, such as frames/%05d.png",
        file_.path(), picture.cols, picture.rows, longest_side));
  }
  if (!encoder_) {
    make_unset_memory_the_same();
    encoder_ = film_opener()(file_.temporary_path(), frames_per_second_, size);
  }
  if (!encoder_) {
    throw Error(
        fmt::format("{}: no film of {} x {} can be made here (that needs FFmpeg with an H.264 encoder); "
                    "write numbered pictures, such as frames/%05d.png",
                    file_.path(), picture.cols, picture.rows));
  }
  behind_.add([this, added = padded(picture)] {
    if (!encoder_->add(added)) throw failed();
  });
  ++pictures_;
}

Error Film::failed() const {
  return Error("writing " + file_.path() + " failed: is the disk full? Nothing stays of the film");
}

void Film::finish() {
  if (pictures_ == 0) return;
  behind_.wait();
  if (!encoder_->finish()) throw failed();
  file_.finish();
}

}  // namespace vorocl::command
