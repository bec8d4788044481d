// How points of the data become seeds in pixels.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "app/sources/view.hpp"
#include "vorocl/seeds.hpp"

namespace vorocl::command {

/// The sides of a rectangle of data. True: there is nothing beyond.
struct Ends {
  bool x0 = false, y0 = false, x1 = false, y1 = false;
};

/// How points of the data become seeds.
struct Mapping {
  Bounds bounds;
  bool closed = true;  ///< a point at x1 or y1 falls in the last pixel: for bounds that the points made
  bool y_up = false;
  std::optional<Crs> crs;            ///< of the data
  Outside outside = Outside::count;  ///< the bounds; Outside::absent is not asked for
  Axes periodic = Axes::none;
  std::optional<Bounds> domain;  ///< the rectangle that repeats along the periodic axes; else the bounds
  Ends ends;                     ///< of the domain, along the other axes
  double tilt = 0;               ///< of the domain, if both axes are periodic: see Grid::tilted()
  Snap snap = Snap::to_pixels;   ///< whether points become the centres of their pixels
  bool in_pixels = false;        ///< what is measured stays in pixels
  bool has_one_scale = true;     ///< of both axes in all frames; without it, lengths stay in pixels
};

/// Points in pixels of the grid that the diagram is a window of: along an axis all of it where the picture
/// shows that.
struct MappedPoints {
  View view;
  std::vector<Point> places;
  std::size_t outside = 0;  ///< points in no pixel of the picture

  /// Whether seeds lie outside the picture, or what it shows is not all of the grid.
  bool is_window() const { return outside > 0 || !view.window.is_whole(); }
};

/// Maps points to places in a picture, in pixels: x is (x - x0) * W / (x1 - x0), rounded to 1/4096 or to the
/// centre of its pixel; y likewise, or counted from the bottom if `y_up`. Along a periodic axis points wrap;
/// a period is a whole number of pixels, to which positions are scaled. Beyond the domain's ends the diagram
/// has no pixels. `ids` are the names of particles in errors; without them points are counted from 0. Throws
/// Error that names the first point that is not finite, is 2^31 pixels away or is outside where that is
/// refused; for a period of less than a pixel or more than Axis::max_pixels, a domain outside the bounds, and
/// bounds that check_bounds() refuses.
MappedPoints map_points(const std::vector<Point>& points, const Mapping& mapping, const Size& picture,
                        const std::vector<std::uint32_t>& ids = {});

}  // namespace vorocl::command
