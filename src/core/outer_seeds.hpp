// Seeds outside a window's pixels: those of a frame that own pixels although they lie elsewhere in the grid
// or beside it, and the images of all seeds across the ends of periods.
#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include "runtime/kernel.hpp"
#include "runtime/pixel_grid.hpp"
#include "vorocl/device.hpp"
#include "vorocl/grid.hpp"
#include "vorocl/opencl.hpp"

namespace vorocl {

/// A position in pixels from the first one of a grid, or of a window of it. Less than 2^31 pixels from all of
/// the grid's.
using PlanePosition = cl_int2;

/// The position of a seed that is absent has this x: ABSENT of kernels/core/plane.cl.
constexpr cl_int absent_coordinate = INT32_MIN;

inline bool is_absent(const PlanePosition& position) { return position.s[0] == absent_coordinate; }

/// Whether a position is one of these pixels.
inline bool is_inside(const PixelGrid& grid, const PlanePosition& at) {
  return at.s[0] >= 0 && at.s[0] < grid.width() && at.s[1] >= 0 && at.s[1] < grid.height();
}

/// What a frame knows of them, on the device. Nothing of it changes. kernels/exact/outer.cl says what the
/// buffers hold.
struct OuterSeeds {
  std::size_t outside = 0;        // seeds outside the pixels
  Extent extent = Extent::near;   // of all seeds and images
  cl_int4 region{};               // the pixels that get labels: left, top, right, bottom
  cl_int4 home{};                 // those of them whose seeds are in positions, not images
  cl_int4 periods{};              // 0 along an axis that is not periodic
  cl::Buffer seeds;               // positions by id, and one more that is absent
  cl::Buffer places, ids, nodes;  // the tree: of seeds outside and images that may own a pixel
  cl_uint count = 0;              // of these
  cl_int top = 0;                 // the tree's highest level ...
  cl_uint top_start = 0;          // ... and where it begins in the list of nodes

  /// Whether the region is the whole grid.
  bool labels_all(const PixelGrid& grid) const {
    return region.s[0] == 0 && region.s[1] == 0 && region.s[2] == grid.width() - 1 &&
           region.s[3] == grid.height() - 1;
  }
};

/// Gathers the outer seeds of a frame whose positions, by id, are counted from the window's first pixel. Null
/// if there are none: all seeds lie in the pixels, and the grid is not periodic. Cost: the host sorts those
/// seeds and images that no other one rules out for the whole window.
std::shared_ptr<const OuterSeeds> gather_outer_seeds(const Device& device, const Window& window,
                                                     const PixelGrid& pixels,
                                                     std::vector<PlanePosition> positions);

}  // namespace vorocl
