// Where the points of a frame lie, to a fraction of a pixel, seen from the window of a diagram.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "core/outer_seeds.hpp"
#include "runtime/pixel_grid.hpp"
#include "vorocl/device.hpp"
#include "vorocl/grid.hpp"
#include "vorocl/opencl.hpp"

namespace vorocl {

/// Where in its pixel a point lies: whole numbers of 1/4096 pixel along each axis, from 0 to 4095.
struct Fraction {
  std::uint16_t x, y;
};

/// How many there are in a pixel.
constexpr int fractions_of_pixel = 4096;

constexpr Fraction centre_of_pixel = {fractions_of_pixel / 2, fractions_of_pixel / 2};

/// What kernels get of the points of a frame. Nothing of it changes. Positions are in fractions of a pixel
/// from the window's first pixel. In a tilted grid those of snapped seeds are points too, at the centres of
/// their pixels, for images do not lie in the middle of pixels.
struct PointPlacement {
  PixelGrid grid;    // the window's pixels; its axes are periodic where the kernels themselves go round
  cl::Buffer seeds;  // int2 by id, and one more that is absent: where a seed lies itself or, in long periods,
                     // its image if only that is near; absent too is what owns no pixel here and lies far
  cl::Buffer order;  // int2 by id: what orders seeds as they lie in the grid themselves
  cl::Buffer places;  // int2: those seeds and images that may own a pixel
  cl::Buffer ids;     // of their seeds; null: they are the seeds
  cl_uint count = 0;  // of places
  cl_int4 region{};   // the pixels that get labels: left, top, right, bottom
  cl_int4 periods{};  // in pixels, 0 along an axis that is not periodic; and the tilt, in fractions
};

/// Places points. Throws Error if one that may own a pixel is too far away for 32 bits.
std::shared_ptr<const PointPlacement> place_points(const Device& device, const Window& window,
                                                   const PixelGrid& shown,
                                                   const std::vector<PlanePosition>& pixels,
                                                   const std::vector<Fraction>& fractions);

}  // namespace vorocl
