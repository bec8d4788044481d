// What depends on the metric, on the host. In kernels it is ALONG() of core/position.cl. Great circles have
// an engine and measures of their own, so that none of the distances here is asked for theirs.
//
// Each of these is a switch without a default: a metric that is missing in one does not compile.
#pragma once

#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <string>

#include "vorocl/error.hpp"
#include "vorocl/grid.hpp"

namespace vorocl {

/// The metric, if it is one. Throws Error for a number that was made one.
inline Metric checked(Metric metric) {
  switch (metric) {
    case Metric::euclidean:
    case Metric::manhattan:
    case Metric::great_circle:
      return metric;
  }
  throw Error("there is no metric of number " + std::to_string(static_cast<int>(metric)) +
              "; there are euclidean, manhattan and great_circle");
}

/// The option that builds kernels for it.
inline const char* build_option(Metric metric) {
  switch (metric) {
    case Metric::euclidean:
      return " -DVOROCL_EUCLIDEAN";
    case Metric::manhattan:
      return " -DVOROCL_MANHATTAN";
    case Metric::great_circle:  // kernels of its own
      break;
  }
  return "";
}

/// Distances as kernels and engines compare them, of the offsets along both axes. They are squared if
/// Euclidean.
template <typename Length>
Length compared_distance(Metric metric, Length dx, Length dy) {
  switch (metric) {
    case Metric::euclidean:
      return dx * dx + dy * dy;
    case Metric::manhattan:
      return (dx < 0 ? -dx : dx) + (dy < 0 ? -dy : dy);
    case Metric::great_circle:
      break;
  }
  return 0;
}

/// A compared distance in pixels.
inline double in_pixels(Metric metric, double compared) {
  switch (metric) {
    case Metric::euclidean:
      return std::sqrt(compared);
    case Metric::manhattan:
      return compared;
    case Metric::great_circle:
      break;
  }
  return 0;
}

/// A distance in pixels as it is compared.
inline double as_compared(Metric metric, double pixels) {
  switch (metric) {
    case Metric::euclidean:
      return pixels * pixels;
    case Metric::manhattan:
      return pixels;
    case Metric::great_circle:
      break;
  }
  return 0;
}

/// The compared distance that a disc of the metric has whose area is pi times these pixels.
inline double radius_of_area(Metric metric, double pixels) {
  constexpr double half_pi = 1.5707963267948966;
  switch (metric) {
    case Metric::euclidean:
      return pixels;
    case Metric::manhattan:
      return std::sqrt(half_pi * pixels);
    case Metric::great_circle:
      break;
  }
  return 0;
}

/// Of methods that flood: throws Error for great circles, which they do not know.
inline void refuse_great_circles(Metric metric, const std::string& method) {
  if (metric == Metric::great_circle)
    throw Error("the method " + method + " knows no great circles; exact does");
}

}  // namespace vorocl
