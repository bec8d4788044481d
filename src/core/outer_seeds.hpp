// Seeds outside the grid's pixels: those of a frame that own pixels although they lie elsewhere in the plane,
// and the images of all seeds where the plane is periodic.
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <vector>

#include "runtime/kernel.hpp"
#include "vorocl/device.hpp"
#include "vorocl/grid.hpp"
#include "vorocl/opencl.hpp"

namespace vorocl {

/// A position in the plane, in pixels from the grid's first one. Less than 2^31 pixels from all of the
/// grid's.
using PlanePosition = cl_int2;

/// The position of a seed that is absent has this x: ABSENT of kernels/core/plane.cl.
constexpr cl_int absent_coordinate = INT32_MIN;

inline bool is_absent(const PlanePosition& position) { return position.s[0] == absent_coordinate; }

/// Whether a position is one of the grid's pixels.
inline bool is_inside(const Grid& grid, const PlanePosition& at) {
  return at.s[0] >= 0 && at.s[0] < grid.width() && at.s[1] >= 0 && at.s[1] < grid.height();
}

/// What a frame knows of them, on the device. Nothing of it changes. kernels/exact/outer.cl says what the
/// buffers hold.
struct OuterSeeds {
  std::size_t outside = 0;             // seeds outside the pixels
  Periodic periodic = Periodic::none;  // the domain's axes
  Extent extent = Extent::near;        // of all seeds and images
  cl_int4 region{};                    // the pixels that get labels: left, top, right, bottom
  cl_uint2 periods{};                  // 0 along an axis that is not periodic
  cl::Buffer seeds;                    // positions by id, and one more that is absent
  cl::Buffer places, ids, nodes;       // the tree: of seeds outside and images that may own a pixel
  cl_uint count = 0;                   // of these
  cl_int top = 0;                      // the tree's highest level ...
  cl_uint top_start = 0;               // ... and where it begins in the list of nodes

  /// Whether the region is the whole grid.
  bool labels_all(const Grid& grid) const {
    return region.s[0] == 0 && region.s[1] == 0 && region.s[2] == grid.width() - 1 &&
           region.s[3] == grid.height() - 1;
  }
};

/// Gathers the outer seeds of a frame whose positions, by id, were brought into the domain. Null if there are
/// none: all seeds lie in the pixels, and the plane is not periodic. Cost: the host sorts those seeds and
/// images that no other one rules out for the whole grid.
std::shared_ptr<const OuterSeeds> gather_outer_seeds(const Device& device, const Grid& grid,
                                                     const std::optional<Domain>& domain,
                                                     std::vector<PlanePosition> positions);

/// Throws Error if the grid is periodic itself, or the domain's sides or place are not possible.
void check_domain(const Grid& grid, const Domain& domain);

}  // namespace vorocl
