#include "picture/lettering.hpp"

#include <algorithm>
#include <opencv2/imgproc.hpp>

#include "picture/palette.hpp"

namespace vorocl {

namespace {

constexpr int font = cv::FONT_HERSHEY_SIMPLEX;
constexpr int least_text_height = 8;

}  // namespace

int text_height(int rows) { return std::max(least_text_height, rows / 50); }

Lettering::Lettering(int height)
    : height_(height),
      thickness_(std::max(1, height / 10)),
      scale_(cv::getFontScaleFromHeight(font, height, thickness_)) {}

int Lettering::width(const std::string& text) const {
  return cv::getTextSize(text, font, scale_, thickness_, nullptr).width;
}

void Lettering::draw(cv::Mat& picture, const std::string& text, const cv::Point& bottom_left) const {
  cv::putText(picture, text, bottom_left, font, scale_, dark, thickness_, cv::LINE_AA);
}

void draw_text(cv::Mat& picture, const std::string& text) {
  check_picture(picture);
  const Lettering letters(text_height(picture.rows));
  const int margin = letters.height() / 2;
  const cv::Size ground(letters.width(text) + 2 * margin, letters.height() + 2 * margin);
  const std::size_t comma = text.find(", ");
  if (ground.width > picture.cols && ground.height < picture.rows && comma != std::string::npos) {
    draw_text(picture, text.substr(comma + 2));
    cv::Mat above = picture.rowRange(0, picture.rows - ground.height);
    return draw_text(above, text.substr(0, comma));
  }
  const cv::Rect whole({0, 0}, picture.size());
  picture(cv::Rect({0, picture.rows - ground.height}, ground) & whole).setTo(light);
  letters.draw(picture, text, {margin, picture.rows - margin});
}

}  // namespace vorocl
