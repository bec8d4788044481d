// Films: H.264 in an .mp4, which browsers play.
#pragma once

#include <memory>
#include <opencv2/core/mat.hpp>
#include <string>

#include "formats/modules.hpp"
#include "formats/output_file.hpp"
#include "formats/workers.hpp"
#include "vorocl/error.hpp"

namespace vorocl::command {

constexpr const char* film_extension = ".mp4";

/// The size of a film of pictures of this size: its sides are even.
cv::Size film_size(const cv::Size& picture);

/// Grows under a temporary name until finish(); without it, nothing stays. A thread of its own encodes each
/// picture while the caller makes the next one.
class Film {
 public:
  /// Throws Error if no file can be made there, and for a pipe.
  Film(const std::string& path, double frames_per_second);

  const std::string& path() const { return file_.path(); }

  /// Appends a picture, which must not change afterwards; all have one size. Its last row or column is
  /// repeated where film_size() is larger. Waits for the picture before. Throws Error if this machine cannot
  /// make the film, or a picture before could not be written.
  void add(const cv::Mat& picture);

  /// How many pictures were added.
  int pictures() const { return pictures_; }

  /// Gives the file its name; there is none if no picture was added. Throws Error if it was not written
  /// whole.
  void finish();

 private:
  Error failed() const;

  GrowingFile file_;
  double frames_per_second_;
  std::unique_ptr<FilmEncoder> encoder_;
  int pictures_ = 0;
  Workers behind_{1};  // the last member: its thread ends before the encoder does
};

}  // namespace vorocl::command
