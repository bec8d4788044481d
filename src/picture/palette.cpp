#include "picture/palette.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <sstream>

#include "vorocl/error.hpp"

namespace vorocl {

namespace {

constexpr int levels = 256;

/// BGR: orange, sky blue, bluish green, yellow, blue, vermilion, reddish purple, grey.
const std::array<cv::Vec3b, 8> okabe_ito = {cv::Vec3b{0, 159, 230},   {233, 180, 86}, {115, 158, 0},
                                            cv::Vec3b{66, 228, 240},  {178, 114, 0},  {0, 94, 213},
                                            cv::Vec3b{167, 121, 204}, {153, 153, 153}};

/// The colours of the levels, or of the classes.
cv::Mat_<cv::Vec3b> table_of(Palette palette) {
  cv::Mat_<cv::Vec3b> table;
  if (is_categorical(palette)) {
    table.create(1, static_cast<int>(okabe_ito.size()));
    std::copy(okabe_ito.begin(), okabe_ito.end(), table.begin());
    return table;
  }
  cv::Mat_<std::uint8_t> ramp(1, levels);
  for (int level = 0; level < levels; ++level) ramp(0, level) = static_cast<std::uint8_t>(level);
  const auto is_one_of = [palette](Palette a, Palette b) { return palette == a || palette == b; };
  if (is_one_of(Palette::viridis_r, Palette::turbo_r) || palette == Palette::greys_r) {
    cv::flip(ramp, ramp, 1);
  }
  if (is_one_of(Palette::greys, Palette::greys_r)) {
    cv::cvtColor(ramp, table, cv::COLOR_GRAY2BGR);
  } else {
    const bool is_viridis = is_one_of(Palette::viridis, Palette::viridis_r);
    cv::applyColorMap(ramp, table, is_viridis ? cv::COLORMAP_VIRIDIS : cv::COLORMAP_TURBO);
  }
  return table;
}

/// What is spread evenly over a scale: the value, or its logarithm (ratios of values may overflow).
double spread(double value, const Scale& scale) { return scale.logarithmic ? std::log(value) : value; }

}  // namespace

bool is_categorical(Palette palette) { return palette == Palette::okabe_ito; }

void check_scale(const Scale& scale) {
  std::ostringstream text;
  if (scale.logarithmic && scale.low <= 0) {
    text << "a logarithmic scale cannot begin at " << scale.low << "; it begins above 0";
    throw Error(text.str());
  }
  if (std::isfinite(scale.high - scale.low) && scale.low <= scale.high) return;
  text << "a scale cannot go from " << scale.low << " to " << scale.high
       << "; it goes from a finite number to one that is not less, and the difference is a finite number too";
  throw Error(text.str());
}

void check_picture(const cv::Mat& picture) {
  if (picture.type() != CV_8UC3)
    throw Error("the picture to draw into must have 3 channels of 8 bits (CV_8UC3)");
}

double round_step(const Scale& scale, int most) {
  check_scale(scale);
  const double extent = scale.high - scale.low;
  if (extent == 0) return 0;
  const double least = extent / std::max(most, 1);
  const double power = std::pow(10, std::floor(std::log10(least)));
  for (const double factor : {1, 2, 5}) {
    if (factor * power >= least * (1 - 1e-9)) return factor * power;
  }
  return 10 * power;
}

double part_of(double value, const Scale& scale) {
  const double low = spread(scale.low, scale), high = spread(scale.high, scale);
  if (high <= low) return 0.5;
  return (spread(value, scale) - low) / (high - low);
}

double value_at(double part, const Scale& scale) {
  const double low = spread(scale.low, scale), high = spread(scale.high, scale);
  const double value = low + part * (high - low);
  return scale.logarithmic ? std::exp(value) : value;
}

Colors::Colors(const Scale& scale, Palette palette)
    : scale_(scale), categorical_(is_categorical(palette)), table_(table_of(palette)) {
  check_scale(scale);
  if (categorical_ && scale.logarithmic) {
    throw Error(
        "a logarithmic scale is for quantities, and a categorical palette for classes; "
        "take viridis, turbo or greys");
  }
}

cv::Vec3b Colors::operator()(double value) const {
  if (std::isnan(value) || (scale_.logarithmic && value <= 0)) return absent_grey;
  const double clamped = std::clamp(value, scale_.low, scale_.high);
  if (categorical_) {
    const double number =
        std::isfinite(value) ? value : clamped;  // classes have colours beyond the scale, too
    const double remainder = std::fmod(std::round(number), table_.cols);
    return table_(0, static_cast<int>(remainder < 0 ? remainder + table_.cols : remainder));
  }
  const double part = scale_.high > scale_.low ? part_of(clamped, scale_) : 0;
  return table_(0, static_cast<int>(std::lround((levels - 1) * part)));
}

cv::Vec3b categorical_color(std::uint32_t number) { return okabe_ito[number % okabe_ito.size()]; }

}  // namespace vorocl
