// Where the points of a frame lie, to a fraction of a pixel, seen from the window of a diagram.
#pragma once

#include <memory>
#include <vector>

#include "core/place.hpp"
#include "runtime/pixel_grid.hpp"
#include "vorocl/device.hpp"
#include "vorocl/grid.hpp"
#include "vorocl/opencl.hpp"

namespace vorocl {

/// What kernels get of points, and of seeds at the centres of pixels where a window does not hold them all or
/// images do not lie in the middle of pixels. Nothing of it changes. Positions are in fractions of a pixel
/// from the window's first pixel.
struct PointPlacement {
  PixelGrid grid;     // the window's pixels; its axes are periodic where the kernels themselves go round
  cl::Buffer seeds;   // int2 by id, and one more that is absent: where a seed lies or, in long periods, its
                      // image if only that is near. A point that is far and owns no pixel here is absent too
  cl::Buffer order;   // int2 by id: what orders seeds as they lie in the grid themselves
  cl::Buffer places;  // int2: those seeds and images that may own a pixel
  cl::Buffer ids;     // of their seeds; null: they are the seeds
  cl_uint count = 0;  // of places
  cl_int4 region{};   // the pixels that get labels: left, top, right, bottom
  cl_int4 periods{};  // in pixels, 0 along an axis that is not periodic; and the tilt, in fractions

  // Where seeds at the centres of pixels are too far away for fractions, all seeds, or places, are in pixels.
  bool seeds_in_pixels = false, places_in_pixels = false;
};

struct Lags;

/// Places points that the host knows, from the grid's first pixel on, or seeds at the centres of pixels;
/// `lags` may be null. Throws Error if a point that may own a pixel is too far away for 32 bits.
std::shared_ptr<const PointPlacement> place_points(const Device& device, const Window& window,
                                                   const PixelGrid& shown, const std::vector<Place>& places,
                                                   bool are_points, const Lags* lags);

/// The same of points that a kernel has placed in all of a grid whose periods kernels go round themselves.
std::shared_ptr<const PointPlacement> placed_points(const Window& window, const PixelGrid& shown,
                                                    const cl::Buffer& places, std::size_t count);

}  // namespace vorocl
