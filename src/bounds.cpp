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

/// A scale in pixels per unit and in units per grid; an axis without extent needs none.
bool has_scale(double extent) {
  return extent == 0 || (std::isfinite(extent * Grid::max_side) && std::isfinite(Grid::max_side / extent));
}

}  // namespace

void check_bounds(const Bounds& bounds, const Grid& grid) {
  const double width = bounds.x1 - bounds.x0, height = bounds.y1 - bounds.y0;
  // Written so that a NaN fails.
  if (!(width >= 0 && height >= 0)) refuse(bounds, "must be numbers x0 <= x1 and y0 <= y1");
  if (!has_scale(width) || !has_scale(height))
    refuse(bounds, "are too far apart, or too near, to compute with");
  if (grid.periodic_x() && width == 0) refuse(bounds, "have no extent in x, which is to be periodic");
  if (grid.periodic_y() && height == 0) refuse(bounds, "have no extent in y, which is to be periodic");
}

AxisMap::AxisMap(double low, double high, int count, bool closed)
    : low_(low), high_(high), count_(count), closed_(closed) {}

double AxisMap::scale() const { return count_ / (high_ - low_); }

void AxisMap::repeat(double period_low, double period_high, const char* name) {
  const double period = period_high - period_low;
  if (!(period * scale() >= 0.5)) {
    std::ostringstream text;
    text << "the period in " << name << " is " << period << ", less than half a pixel";
    throw Error(text.str());
  }
  // In whole pixels, which the period is rounded to: the bounds may differ from it by a rounding error.
  const bool covers = std::llround(period * scale()) >= count_,
             apart = period_high <= low_ || high_ <= period_low;
  const bool holds = period_low <= low_ && high_ <= period_high;
  period_low_ = (covers && !holds) || apart ? low_ : period_low;
  period_ = period;
}

bool AxisMap::is_outside(double at) const { return !period_ && (at < low_ || at > high_); }

double AxisMap::pixel(double at) const {
  if (high_ == low_) return at == low_ ? count_ / 2 : at < low_ ? -1 : count_;
  if (!period_) {
    const double position = std::floor((at - low_) * count_ / (high_ - low_));
    return closed_ && at <= high_ ? std::min(position, count_ - 1.0) : position;
  }
  double offset = std::fmod(at - period_low_, *period_);
  if (offset < 0) offset += *period_;
  const double position = std::floor((offset + (period_low_ - low_)) * count_ / (high_ - low_));
  const auto begin = static_cast<double>(period_begin()), length = static_cast<double>(period_length());
  return position < begin ? position + length : std::min(position, begin + length - 1);
}

std::int64_t AxisMap::period_begin() const {
  return period_ ? std::llround((period_low_ - low_) * scale()) : 0;
}

std::int64_t AxisMap::period_length() const { return period_ ? std::llround(*period_ * scale()) : count_; }

std::optional<Point> to_pixel(const Point& point, const Bounds& bounds, const Grid& grid, bool y_up) {
  AxisMap x(bounds.x0, bounds.x1, grid.width(), true), y(bounds.y0, bounds.y1, grid.height(), true);
  if (grid.periodic_x()) x.repeat(bounds.x0, bounds.x1, "x");
  if (grid.periodic_y()) y.repeat(bounds.y0, bounds.y1, "y");
  if (x.is_outside(point.x) || y.is_outside(point.y)) return std::nullopt;
  const double row = y.pixel(point.y);
  return Point{x.pixel(point.x) + 0.5, (y_up ? grid.height() - 1 - row : row) + 0.5};
}

}  // namespace vorocl
