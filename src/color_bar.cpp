#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <string>
#include <vector>

#include "palette.hpp"
#include "vorocl/error.hpp"
#include "vorocl/picture.hpp"

namespace vorocl {

namespace {

constexpr int least_height = 96;
constexpr int least_text_height = 8;
constexpr int most_steps = 8;
constexpr std::size_t longest_title = 30;

/// Letters of one size.
class Text {
 public:
  explicit Text(int height)
      : height_(height),
        thickness_(std::max(1, height / 10)),
        scale_(cv::getFontScaleFromHeight(font, height, thickness_)) {}

  int height() const { return height_; }
  int thickness() const { return thickness_; }
  int width(const std::string& text) const {
    return cv::getTextSize(text, font, scale_, thickness_, nullptr).width;
  }
  void draw(cv::Mat& picture, const std::string& text, const cv::Point& bottom_left) const {
    cv::putText(picture, text, bottom_left, font, scale_, dark, thickness_, cv::LINE_AA);
  }

 private:
  static constexpr int font = cv::FONT_HERSHEY_SIMPLEX;
  int height_;
  int thickness_;
  double scale_;
};

struct Tick {
  double value;
  std::string text;
};

int magnitude(double number) { return static_cast<int>(std::floor(std::log10(number) + 1e-9)); }

/// The number as it stands among others that are a step apart (0: alone), the same in every locale.
std::string number_text(double value, double step) {
  auto format = std::chars_format::general;
  int precision = 6;
  if (step > 0) {
    const double size = std::max(std::abs(value), step);
    const bool is_plain = size < 1e6 && step >= 1e-4;
    if (is_plain) format = std::chars_format::fixed;
    precision = is_plain ? std::max(0, -magnitude(step)) : magnitude(size) - magnitude(step) + 1;
  }
  std::array<char, 400> text{};
  const auto end = std::to_chars(text.data(), text.data() + text.size(), value, format, precision).ptr;
  return {text.data(), end};
}

std::vector<Tick> ticks_of(const ColorBar& bar, int most) {
  double step = round_step(bar.scale, most);
  if (step == 0) return {{bar.scale.low, number_text(bar.scale.low, 0)}};
  if (bar.whole_values) step = std::max(step, 1.0);
  std::vector<Tick> ticks;
  const double first = std::ceil(bar.scale.low / step - 1e-9);
  const double last = std::floor(bar.scale.high / step + 1e-9);
  const int more = static_cast<int>(std::min(last - first, static_cast<double>(most)));
  for (int i = 0; i <= more; ++i) {
    const double value = (first + i) * step + 0.0;  // not -0
    ticks.push_back({value, number_text(value, step)});
  }
  return ticks;
}

/// The bar alone, its greatest value at the top.
class Bar {
 public:
  Bar(const ColorBar& bar, const cv::Rect& place)
      : colors_(bar.scale, bar.palette),
        // A class is a block around its number.
        margin_(is_categorical(bar.palette) ? 0.5 : 0),
        low_(bar.scale.low - margin_),
        extent_(bar.scale.high + margin_ - low_),
        place_(place),
        point_(bar.open_ended ? place.width / 2 : 0) {}

  /// The row of a value.
  int row(double value) const {
    const double height = place_.height - 2 * point_;
    const double part = extent_ > 0 ? (value - low_) / extent_ : 0.5;
    return place_.br().y - 1 - point_ - static_cast<int>(std::lround(part * (height - 1)));
  }

  void draw(cv::Mat& picture) const {
    const int top = place_.y + point_, bottom = place_.br().y - point_;
    for (int y = top; y < bottom; ++y) {
      const double part = (bottom - y - 0.5) / (bottom - top);
      picture(cv::Rect(place_.x, y, place_.width, 1)).setTo(colors_(low_ + part * extent_));
    }
    const int left = place_.x, right = place_.br().x - 1, middle = place_.x + place_.width / 2;
    const cv::Point upper_tip(middle, place_.y), lower_tip(middle, place_.br().y - 1);
    if (point_ > 0) {
      fill(picture, {{left, top}, {right, top}, upper_tip}, colors_(low_ + extent_));
      fill(picture, {{left, bottom - 1}, {right, bottom - 1}, lower_tip}, colors_(low_));
    }
    // Around it, so that the ends of all palettes stand out from the white.
    std::vector<cv::Point> outline = {
        {right + 1, top - 1}, {right + 1, bottom}, {left - 1, bottom}, {left - 1, top - 1}};
    if (point_ > 0) {
      outline.insert(outline.begin() + 2, lower_tip + cv::Point(0, 1));
      outline.push_back(upper_tip - cv::Point(0, 1));
    }
    cv::polylines(picture, outline, true, dark);
  }

 private:
  static void fill(cv::Mat& picture, const std::vector<cv::Point>& corners, const cv::Vec3b& color) {
    cv::fillConvexPoly(picture, corners, color);
  }

  Colors colors_;
  double margin_;
  double low_;
  double extent_;
  cv::Rect place_;
  int point_;  // the height of a pointed end
};

std::string shortened(const std::string& title) {
  return title.size() <= longest_title ? title : title.substr(0, longest_title - 3) + "...";
}

}  // namespace

cv::Mat with_color_bar(const cv::Mat& picture, const ColorBar& bar) {
  check_picture(picture);
  check_scale(bar.scale);
  const int height = std::max(picture.rows, least_height);
  const Text text(std::max(least_text_height, height / 50));
  const int unit = text.height();
  const std::string title = shortened(bar.title);
  const cv::Rect place(picture.cols + unit, 7 * unit / 2, std::max(10, 2 * unit), height - 5 * unit);
  const std::vector<Tick> ticks = ticks_of(bar, std::clamp(5 * place.height / (8 * unit), 2, most_steps));

  const int numbers = place.br().x + unit;  // where they begin
  int right = place.x + text.width(title);
  for (const Tick& tick : ticks) right = std::max(right, numbers + text.width(tick.text));
  right += unit;
  cv::Mat result(height, right + right % 2, CV_8UC3, cv::Scalar::all(255));
  picture.copyTo(result(cv::Rect({0, 0}, picture.size())));

  text.draw(result, title, {place.x, 2 * unit});
  const Bar drawn(bar, place);
  drawn.draw(result);
  for (const Tick& tick : ticks) {
    const int y = drawn.row(tick.value);
    const cv::Rect mark(place.br().x, y - (text.thickness() - 1) / 2, unit / 2, text.thickness());
    cv::rectangle(result, mark, dark, cv::FILLED);
    text.draw(result, tick.text, {numbers, y + unit / 2});
  }
  return result;
}

}  // namespace vorocl
