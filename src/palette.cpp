#include "palette.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/imgproc.hpp>

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

}  // namespace

bool is_categorical(Palette palette) { return palette == Palette::okabe_ito; }

void check_scale(const Scale& scale) {
  if (scale.logarithmic && scale.low <= 0) {
    throw Error("a logarithmic scale cannot begin at " + std::to_string(scale.low) + "; it begins above 0");
  }
  if (std::isfinite(scale.high - scale.low) && scale.low <= scale.high) return;
  throw Error(
      "a scale cannot go from " + std::to_string(scale.low) + " to " + std::to_string(scale.high) +
      "; it goes from a finite number to one that is not less, and the difference is a finite number too");
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
  if (scale.high <= scale.low) return 0.5;
  if (scale.logarithmic)
    return (std::log(value) - std::log(scale.low)) / (std::log(scale.high) - std::log(scale.low));
  return (value - scale.low) / (scale.high - scale.low);
}

Colors::Colors(const Scale& scale, Palette palette)
    : scale_(scale), categorical_(is_categorical(palette)), table_(table_of(palette)) {
  check_scale(scale);
}

cv::Vec3b Colors::operator()(double value) const {
  if (std::isnan(value) || (scale_.logarithmic && value <= 0)) return absent_grey;
  const double clamped = std::clamp(value, scale_.low, scale_.high);
  if (categorical_) {
    const double remainder = std::fmod(std::round(clamped), table_.cols);
    return table_(0, static_cast<int>(remainder < 0 ? remainder + table_.cols : remainder));
  }
  const double part = scale_.high > scale_.low ? part_of(clamped, scale_) : 0;
  return table_(0, static_cast<int>(std::lround((levels - 1) * part)));
}

cv::Vec3b categorical_color(std::uint32_t number) { return okabe_ito[number % okabe_ito.size()]; }

}  // namespace vorocl
