// Letters in pictures.
#pragma once

#include <opencv2/core.hpp>
#include <string>

namespace vorocl {

/// The height of the letters of a picture with so many rows.
int text_height(int rows);

/// Letters of one size.
class Lettering {
 public:
  explicit Lettering(int height);

  int height() const { return height_; }
  int thickness() const { return thickness_; }
  int width(const std::string& text) const;
  void draw(cv::Mat& picture, const std::string& text, const cv::Point& bottom_left) const;

 private:
  int height_;
  int thickness_;
  double scale_;
};

}  // namespace vorocl
