#include "vorocl/bounds.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "vorocl/error.hpp"

namespace vorocl {

namespace {

[[noreturn]] void refuse(const Bounds& bounds, const std::string& why) {
  std::ostringstream text;
  text << "the bounds " << bounds.x0 << "," << bounds.y0 << "," << bounds.x1 << "," << bounds.y1 << " "
       << why;
  throw Error(text.str());
}

/// A scale in pixels per unit and in units per plane; an axis without extent needs none.
bool has_scale(double extent) {
  constexpr auto most = static_cast<double>(Plane::max_side);
  return extent == 0 || (std::isfinite(extent * most) && std::isfinite(most / extent));
}

}  // namespace

void check_bounds(const Bounds& bounds, const Plane& plane) {
  const double width = bounds.x1 - bounds.x0, height = bounds.y1 - bounds.y0;
  // Written so that a NaN fails.
  if (!(width >= 0 && height >= 0)) refuse(bounds, "must be numbers x0 <= x1 and y0 <= y1");
  if (!has_scale(width) || !has_scale(height))
    refuse(bounds, "are too far apart, or too near, to compute with");
  if (has_x(plane.periodic()) && width == 0) refuse(bounds, "have no extent in x, which is to be periodic");
  if (has_y(plane.periodic()) && height == 0) refuse(bounds, "have no extent in y, which is to be periodic");
}

PixelMap::PixelMap(const Bounds& bounds, const Plane& plane, bool y_up, bool closed)
    : x_(bounds.x0, bounds.x1, plane.width(), closed),
      y_(bounds.y0, bounds.y1, plane.height(), closed),
      height_(plane.height()),
      y_up_(y_up) {
  check_bounds(bounds, plane);
}

void PixelMap::repeat(Periodic axes, const Bounds& period) {
  if (has_x(axes)) x_.repeat(period.x0, period.x1, "x");
  if (has_y(axes)) y_.repeat(period.y0, period.y1, "y");
  periodic_ = axes;
}

Point PixelMap::pixel(const Point& point) const {
  const double row = y_.pixel(point.y);
  return {x_.pixel(point.x) + 0.5, (y_up_ ? static_cast<double>(height_ - 1) - row : row) + 0.5};
}

std::optional<Domain> PixelMap::domain() const {
  if (periodic_ == Periodic::none) return std::nullopt;
  const std::int64_t top = y_up_ ? height_ - y_.begin() - y_.length() : y_.begin();
  return Domain{x_.begin(), top, x_.length(), y_.length(), periodic_};
}

void PixelMap::Axis::repeat(double period_low, double period_high, const char* name) {
  period_ = period_high - period_low;
  const double scale = count_ / (high_ - low_);
  constexpr double rounding = 1e-9;
  if (!(period_ * scale >= 1 - rounding)) {
    std::ostringstream text;
    text << "the period in " << name << " is " << period_ << ", less than a pixel: take more pixels";
    throw Error(text.str());
  }
  length_ = std::llround(period_ * scale);
  // In whole pixels, which the period is rounded to: the bounds may differ from it by a rounding error.
  const bool covers = length_ >= pixels_, holds = period_low <= low_ && high_ <= period_high;
  const bool apart = period_high <= low_ || high_ <= period_low;
  period_low_ = (covers && !holds) || apart ? low_ : period_low;
  const double first = (period_low_ - low_) * scale;
  begin_ = std::llround(first);
  shift_ = first - static_cast<double>(begin_) + (period_ * scale - static_cast<double>(length_)) / 2;
  if (std::abs(shift_) < rounding) shift_ = 0;
}

double PixelMap::Axis::pixel(double at) const {
  if (high_ == low_) return at == low_ ? std::floor(count_ / 2) : at < low_ ? -1 : count_;
  if (period_ == 0) {
    const double position = std::floor((at - low_) * count_ / (high_ - low_));
    return closed_ && at <= high_ ? std::min(position, count_ - 1) : position;
  }
  double offset = std::fmod(at - period_low_, period_);
  if (offset < 0) offset += period_;
  const auto begin = static_cast<double>(begin_), length = static_cast<double>(length_);
  // A value just below the period can be rounded up to its end.
  const double scaled = std::min(offset * length / period_, std::nextafter(length, 0.0));
  double position = std::floor(scaled + shift_);
  if (position < 0) position += length;
  if (position >= length) position -= length;
  return begin + position;
}

}  // namespace vorocl
