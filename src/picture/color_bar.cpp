#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <string>
#include <vector>

#include "picture/palette.hpp"
#include "vorocl/error.hpp"
#include "vorocl/picture.hpp"

namespace vorocl {

namespace {

constexpr int font = cv::FONT_HERSHEY_SIMPLEX;
constexpr int least_text_height = 8;

/// The height of the letters of a picture with so many rows.
int text_height(int rows) { return std::max(least_text_height, rows / 50); }

/// OpenCV's letters are those of ASCII: one mark for each other letter of UTF-8, and u for micro.
std::string in_ascii(std::string text) {
  for (const char* const micro : {"\xc2\xb5", "\xce\xbc"}) {
    for (std::size_t at; (at = text.find(micro)) != std::string::npos;) text.replace(at, 2, "u");
  }
  std::string letters;
  for (const char byte : text) {
    const int value = static_cast<unsigned char>(byte);
    if (value < 0x80) letters += byte;
    if (value >= 0xc0) letters += '?';
  }
  return letters;
}

/// Letters of one size.
class Lettering {
 public:
  explicit Lettering(int height)
      : height_(height),
        thickness_(std::max(1, height / 10)),
        scale_(cv::getFontScaleFromHeight(font, height, thickness_)) {}

  int height() const { return height_; }
  int thickness() const { return thickness_; }

  int width(const std::string& text) const {
    return cv::getTextSize(in_ascii(text), font, scale_, thickness_, nullptr).width;
  }

  void draw(cv::Mat& picture, const std::string& text, const cv::Point& bottom_left) const {
    cv::putText(picture, in_ascii(text), bottom_left, font, scale_, dark, thickness_, cv::LINE_AA);
  }

 private:
  int height_;
  int thickness_;
  double scale_;
};

constexpr int least_height = 96;
constexpr int most_steps = 8;
constexpr std::size_t longest_title = 30;

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

/// 1, 2 and 5 times powers of ten, or these powers, or every second or so, as many as there is room for. On a
/// short scale there may be one such number, or none.
std::vector<Tick> logarithmic_ticks(const Scale& scale, int most) {
  const int first = magnitude(scale.low), last = magnitude(scale.high);
  std::vector<double> numbers;
  const auto collect = [&](const std::vector<double>& factors, int every) {
    numbers.clear();
    for (int power = first; power <= last; ++power) {
      for (const double factor : factors) {
        const double number = factor * std::pow(10, power);
        const bool is_on_scale = number >= scale.low * (1 - 1e-9) && number <= scale.high * (1 + 1e-9);
        if (is_on_scale && power % every == 0) numbers.push_back(number);
      }
    }
    return numbers.size() <= static_cast<std::size_t>(most);
  };
  if (!collect({1, 2, 5}, 1)) {
    for (int every = 1; !collect({1}, every);) ++every;
  }
  std::vector<Tick> ticks;
  ticks.reserve(numbers.size());
  for (const double number : numbers) ticks.push_back({number, number_text(number, 0)});
  return ticks;
}

std::string shortened(const std::string& title) {
  return title.size() <= longest_title ? title : title.substr(0, longest_title - 3) + "...";
}

std::vector<Tick> ticks_of(const ColorBar& bar, int most) {
  if (bar.scale.logarithmic) {
    std::vector<Tick> ticks = logarithmic_ticks(bar.scale, most);
    if (ticks.size() >= 2) return ticks;
  }
  double step = round_step(bar.scale, most);
  const auto text_of = [&](double value) {
    const bool has_name = value >= 0 && value < static_cast<double>(bar.names.size());
    return has_name ? shortened(bar.names[static_cast<std::size_t>(value)]) : number_text(value, step);
  };
  if (step == 0) return {{bar.scale.low, text_of(bar.scale.low)}};
  if (bar.whole_values) step = std::max(step, 1.0);
  std::vector<Tick> ticks;
  const double first = std::ceil(bar.scale.low / step - 1e-9);
  const double last = std::floor(bar.scale.high / step + 1e-9);
  const int more = static_cast<int>(std::min(last - first, static_cast<double>(most)));
  for (int i = 0; i <= more; ++i) {
    const double value = (first + i) * step + 0.0;  // not -0
    ticks.push_back({value, text_of(value)});
  }
  return ticks;
}

/// The bar alone, its greatest value at the top.
class Bar {
 public:
  Bar(const ColorBar& bar, const cv::Rect& place)
      : colors_(bar.scale, bar.palette),
        ends_(with_blocks(bar)),
        place_(place),
        point_(bar.open_ended && !is_categorical(bar.palette) ? place.width / 2 : 0) {}

  /// The row of a value.
  int row(double value) const {
    const double height = place_.height - 2 * point_;
    return place_.br().y - 1 - point_ - static_cast<int>(std::lround(part_of(value, ends_) * (height - 1)));
  }

  void draw(cv::Mat& picture) const {
    // The outline is around the colours, so that the ends of all palettes stand out from the white.
    const int left = place_.x - 1, right = place_.br().x, middle = place_.x + place_.width / 2;
    const int top = place_.y + point_ - 1, bottom = place_.br().y - point_;
    const cv::Point upper_tip(middle, place_.y - 1), lower_tip(middle, place_.br().y);
    std::vector<cv::Point> outline = {{right, top}, {right, bottom}, {left, bottom}, {left, top}};
    if (point_ > 0) {
      fill(picture, {{left, top}, {right, top}, upper_tip}, colors_(ends_.high));
      fill(picture, {{left, bottom}, {right, bottom}, lower_tip}, colors_(ends_.low));
      outline.insert(outline.begin() + 2, lower_tip);
      outline.push_back(upper_tip);
    }
    for (int y = top + 1; y < bottom; ++y) {
      const double part = (bottom - y - 0.5) / (bottom - top - 1);
      picture(cv::Rect(place_.x, y, place_.width, 1)).setTo(colors_(value_at(part, ends_)));
    }
    cv::polylines(picture, outline, true, dark);
  }

 private:
  /// A class is a block around its number.
  static Scale with_blocks(const ColorBar& bar) {
    const double margin = is_categorical(bar.palette) ? 0.5 : 0;
    return {bar.scale.low - margin, bar.scale.high + margin, bar.scale.logarithmic};
  }
  static void fill(cv::Mat& picture, const std::vector<cv::Point>& corners, const cv::Vec3b& color) {
    cv::fillConvexPoly(picture, corners, color);
  }

  Colors colors_;
  Scale ends_;
  cv::Rect place_;
  int point_;  // the height of a pointed end
};

}  // namespace

cv::Mat with_color_bar(const cv::Mat& picture, const ColorBar& bar) {
  check_picture(picture);
  check_scale(bar.scale);
  const int height = std::max(picture.rows, least_height);
  const Lettering text(text_height(height));
  const int unit = text.height();
  const std::string title = shortened(bar.title);
  const cv::Rect place(picture.cols + unit, 7 * unit / 2, std::max(10, 2 * unit), height - 5 * unit);
  const std::vector<Tick> ticks = ticks_of(
      bar,
      std::clamp(5 * place.height / (8 * unit), 2, std::max(most_steps, static_cast<int>(bar.names.size()))));

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
