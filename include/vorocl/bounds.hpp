// The map from the data's plane to pixels.
#pragma once

#include <cstdint>
#include <optional>

#include "vorocl/export.h"
#include "vorocl/grid.hpp"

namespace vorocl {

/// The rectangle of the data's plane that a grid shows, or a plane of pixels.
struct Bounds {
  double x0 = 0;
  double y0 = 0;
  double x1 = 0;
  double y1 = 0;
};

/// Throws Error unless the bounds are finite, with x0 <= x1 and y0 <= y1, have an extent along the plane's
/// periodic axes, and are neither so far apart nor so near that double has no scale for them.
VOROCL_API void check_bounds(const Bounds& bounds, const Plane& plane);

/// The map from data to pixels: the column of a point is floor((x - x0) * W / (x1 - x0)), in this order of
/// operations, so that rounding is the same everywhere; rows likewise, or counted from the bottom if `y_up`.
/// Along an axis without an extent a point of the bounds falls in the middle pixel. Pixels may lie outside
/// the plane.
class VOROCL_API PixelMap {
 public:
  /// If `closed`, a point at x1 or y1 falls in the last pixel. Throws as check_bounds().
  PixelMap(const Bounds& bounds, const Plane& plane, bool y_up, bool closed);

  /// Makes axes periodic: points wrap. A period is rounded to whole pixels, and positions along it are scaled
  /// to them about its middle. It may begin anywhere: where it covers as many pixels as the bounds and does
  /// not hold them, or holds nothing of them, it begins with them. Throws Error if it is shorter than a
  /// pixel.
  void repeat(Periodic axes, const Bounds& period);

  /// Whether a point is outside the bounds; along a periodic axis none is.
  bool is_outside(const Point& point) const { return x_.is_outside(point.x) || y_.is_outside(point.y); }

  /// The centre of a finite point's pixel.
  Point pixel(const Point& point) const;

  /// What repeats, in whole pixels; none without a periodic axis.
  std::optional<Domain> domain() const;

 private:
  class Axis {
   public:
    Axis(double low, double high, std::int64_t count, bool closed)
        : low_(low), high_(high), pixels_(count), count_(static_cast<double>(count)), closed_(closed) {}
    void repeat(double period_low, double period_high, const char* name);
    bool is_outside(double at) const { return period_ == 0 && (at < low_ || at > high_); }
    double pixel(double at) const;
    std::int64_t begin() const { return begin_; }
    std::int64_t length() const { return period_ == 0 ? pixels_ : length_; }

   private:
    double low_, high_;
    std::int64_t pixels_;
    double count_;  // the same
    bool closed_;
    double period_ = 0;                    // 0: none
    double period_low_ = 0;                // where it begins ...
    std::int64_t begin_ = 0, length_ = 0;  // ... and these in whole pixels
    double shift_ = 0;                     // the middle of the period, less that of these pixels
  };

  Axis x_, y_;
  std::int64_t height_;
  bool y_up_;
  Periodic periodic_ = Periodic::none;
};

}  // namespace vorocl
