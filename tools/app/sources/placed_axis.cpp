#include "app/sources/placed_axis.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "vorocl/error.hpp"

namespace vorocl::command {

namespace {

Axis directed(const Axis& axis, bool reversed) { return reversed ? axis.reversed() : axis; }

}  // namespace

PlacedAxis::PlacedAxis(double low, double high, int pixels, bool closed, bool reversed)
    : low_(low),
      high_(high),
      pixels_(pixels),
      reversed_(reversed),
      axis_(directed(closed ? Axis(pixels, low, high).closed() : Axis(pixels, low, high), reversed)) {}

void PlacedAxis::repeat(double low, double high, const char* name) {
  const double period = high - low;
  const double scale = static_cast<double>(pixels_) / (high_ - low_);
  constexpr double rounding = 1e-9;
  if (!(period * scale >= 1 - rounding)) {
    throw Error(fmt::format("the period in {} is {:g}, less than a pixel: take more pixels", name, period));
  }
  const std::int64_t length = std::llround(period * scale);
  // In whole pixels, which the period is rounded to: the bounds may differ from it by a rounding error.
  const bool covers = length >= pixels_, holds = low <= low_ && high_ <= high;
  const bool apart = high <= low_ || high_ <= low;
  const bool moves = (covers && !holds) || apart;
  const double first = ((moves ? low_ : low) - low_) * scale;
  const std::int64_t begin = std::llround(first);
  // The middle of the period, less that of these pixels.
  const double shift =
      first - static_cast<double>(begin) + (period * scale - static_cast<double>(length)) / 2;
  const bool is_shifted = std::abs(shift) >= rounding;
  const double from = (moves ? low_ : low) - (is_shifted ? shift * period / static_cast<double>(length) : 0);
  const double to = moves || is_shifted ? from + period : high;
  axis_ = directed(Axis(length, from, to).periodic(), reversed_);
  begin_ = reversed_ ? pixels_ - begin - length : begin;
}

void PlacedAxis::end_at(const std::optional<double>& low, const std::optional<double>& high) {
  if (low_ == high_) return;
  const double scale = static_cast<double>(pixels_) / (high_ - low_);
  if (low) first_end_ = std::round((*low - low_) * scale);
  if (high) last_end_ = std::max(std::round((*high - low_) * scale), first_end_ + 1);
  if (!reversed_) return;
  const double first = first_end_;
  first_end_ = static_cast<double>(pixels_) - last_end_;
  last_end_ = static_cast<double>(pixels_) - first;
}

double PlacedAxis::held(double place, Snap snap) const {
  const double first = snap == Snap::to_pixels ? 0.5 : 0, last = snap == Snap::to_pixels ? 0.5 : 0x1p-12;
  return std::clamp(place, first_end_ + first, last_end_ - last);  // rounding must not move it beyond
}

Stretch PlacedAxis::shown() const {
  const double begin = std::max(first_end_, 0.0), end = std::min(last_end_, static_cast<double>(pixels_));
  if (begin >= end) return {};
  return {static_cast<std::int64_t>(begin), static_cast<std::int64_t>(end - begin)};
}

Stretch PlacedAxis::grid() const { return axis_.is_periodic() ? Stretch{begin_, axis_.pixels()} : shown(); }

}  // namespace vorocl::command
