// An axis of the data on one of a picture.
#pragma once

#include <cstdint>
#include <limits>
#include <optional>

#include "app/sources/view.hpp"
#include "vorocl/grid.hpp"
#include "vorocl/seeds.hpp"

namespace vorocl::command {

/// Pixels of the picture along an axis. They may lie outside it.
struct Stretch {
  std::int64_t begin = 0, length = 0;

  bool is_within(std::int64_t pixels) const { return begin >= 0 && begin + length <= pixels; }
};

/// What the library's Axis says of points, placed in a picture: where a period is, and where there is nothing
/// beyond.
class PlacedAxis {
 public:
  /// [low, high] of the data on all pixels of the picture, which are counted from `high` if `reversed`. If
  /// `closed`, a point at `high` falls in the last pixel. Throws as Axis.
  PlacedAxis(double low, double high, int pixels, bool closed, bool reversed);

  /// Makes it periodic. A period is rounded to whole pixels, and positions along it are scaled to them about
  /// its middle. It may begin anywhere: where it covers as many pixels as the picture has and does not hold
  /// all of them, or holds none of them, it begins with the picture. Throws Error, which says the name of the
  /// axis, if it is shorter than a pixel.
  void repeat(double low, double high, const char* name);

  /// Ends it, where it is not periodic: beyond these there is nothing. There is at least a pixel between
  /// them.
  void end_at(const std::optional<double>& low, const std::optional<double>& high);

  /// Whether a point is outside [low, high]; none is along a periodic axis.
  bool is_outside(double at) const { return !axis_.covers(at); }

  /// Where a point lies, from the picture's first pixel on, as exact diagrams take it: at the centre of its
  /// pixel, or at a whole number of 1/4096 pixel.
  double place(double at, Snap snap) const {
    return static_cast<double>(begin_) +
           (snap == Snap::to_pixels ? axis_.pixel(at) + 0.5 : axis_.rounded_position(at));
  }

  /// How many periods a point lies beyond the one that place() brings it to.
  double periods_beyond(double at) const { return axis_.periods_beyond(at); }

  /// That of a point which must not be beyond an end.
  double held(double place, Snap snap) const;

  /// The picture's pixels that there are; none if the ends lie outside.
  Stretch shown() const;

  /// All pixels that there are: one period, or what is shown of an axis that does not repeat.
  Stretch grid() const;

  /// The picture's pixels in data units: along a period, which is a whole number of pixels, their sides are a
  /// little more or less than elsewhere.
  AxisScale scale() const { return {axis_, static_cast<double>(begin_)}; }

 private:
  double low_, high_;
  std::int64_t pixels_;
  bool reversed_;
  Axis axis_;               // of the pixels from begin_ on: a period, or all of the picture
  std::int64_t begin_ = 0;  // in the picture
  double first_end_ = -std::numeric_limits<double>::infinity(),
         last_end_ = std::numeric_limits<double>::infinity();
};

}  // namespace vorocl::command
