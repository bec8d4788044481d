// Films: H.264 in an .mp4, which browsers play.
#pragma once

#include <opencv2/core.hpp>
#include <opencv2/videoio.hpp>
#include <string>

#include "formats/files.hpp"

namespace vorocl::command {

/// Grows under a temporary name until finish(); without it, nothing stays.
class Film {
 public:
  /// Throws Error if no file can be made there.
  Film(const std::string& path, double frames_per_second);
  ~Film();
  Film(const Film&) = delete;
  Film& operator=(const Film&) = delete;

  /// Appends a picture; all have one size. The format wants even sides: a last row or column is repeated
  /// where it must be, which standard error is told. Throws Error if this machine cannot make the film.
  void add(const cv::Mat& picture);

  /// Gives the file its name; there is none if no picture was added. Throws Error if it was not written
  /// whole.
  void finish();

 private:
  void open(const cv::Size& size);

  OutputFile file_;
  double frames_per_second_;
  cv::VideoWriter writer_;
  int pictures_ = 0;
};

}  // namespace vorocl::command
