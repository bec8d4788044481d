// Where the seeds of a frame lie, seen from the window of a diagram: in pixels, or to a fraction of one.
#pragma once

#include <memory>
#include <vector>

#include "core/place.hpp"
#include "runtime/pixel_grid.hpp"
#include "vorocl/device.hpp"
#include "vorocl/grid.hpp"
#include "vorocl/opencl.hpp"

namespace vorocl {

/// The x of a seed that is absent: ABSENT of kernels/core/units.cl.
constexpr cl_int absent_coordinate = INT32_MIN;

/// What kernels get of a frame. Nothing of it changes.
struct Placement {
  /// The window's pixels. Its axes are periodic where the kernels themselves go round: then no seed lies
  /// outside.
  PixelGrid grid;

  /// Null of a frame that goes beyond the window. Else one uint32 per seed: y << 16 | x of its pixel, or
  /// absent_position if it is absent; in a volume as VoxelBits has it, or absent_voxel. And one more such
  /// value at the end.
  std::shared_ptr<const cl::Buffer> positions;

  /// The places, where a kernel has made them with the positions: see place_on_grid(). Else null.
  std::shared_ptr<const cl::Buffer> places;

  /// Of a volume: see are_crowded().
  bool is_crowded = false;

  /// Whether seeds lie outside the window, or images of them that kernels do not find themselves: then labels
  /// are made of PointPlacement alone.
  bool goes_beyond = false;
  std::size_t outside = 0;  // so many seeds
};

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
  cl_int4 first{}, last{};  // of the pixels that get labels: x, y and z
  cl_int8 lattice{};        // what repeats: LATTICE of kernels/core/lattice.cl

  // Where seeds at the centres of pixels are too far away for fractions, all seeds, or places, are in pixels.
  bool seeds_in_pixels = false, places_in_pixels = false;
};

/// The position in a volume of a seed that is absent: EMPTY of kernels/volumes/position.cl.
constexpr std::uint32_t absent_voxel = 0x80000000u;

/// The position of a seed that is absent: EMPTY of position.cl.
constexpr std::uint32_t absent_position = 0x80008000u;

/// Whether many seeds of a volume stand close together, as those of a surface or a solid do, and others of
/// its voxels are far from any: exact diagrams of such seeds are made voxel by voxel
/// (masks/exact_diagram.hpp).
bool are_crowded(const PixelGrid& volume, const std::vector<std::uint32_t>& voxels);

/// The position of a seed in a pixel.
inline std::uint32_t pack(int x, int y) {
  return static_cast<std::uint32_t>(y) << 16 | static_cast<std::uint32_t>(x);
}

/// How kernels pack positions in all of a grid.
struct PackedPositions {
  explicit PackedPositions(const PixelGrid& grid);

  cl_int2 bits;   // of x and y, from the lowest bit on; what is above is z
  cl_uint empty;  // of a seed that is absent
};

/// Places seeds that the host knows, whose places are counted from the grid's first pixel.
std::shared_ptr<const Placement> place_in_window(const Device& device, const Window& window,
                                                 const PixelGrid& shown, const std::vector<Place>& places);

struct Lags;

/// Places points that the host knows, from the grid's first pixel on, or seeds at the centres of pixels;
/// `lags` may be null. Throws Error if a point that may own a pixel is too far away for 32 bits.
std::shared_ptr<const PointPlacement> place_points(const Device& device, const Window& window,
                                                   const PixelGrid& shown, const std::vector<Place>& places,
                                                   bool are_points, const Lags* lags);

/// The same of points that a kernel has placed in all of a grid whose periods kernels go round themselves.
std::shared_ptr<const PointPlacement> placed_points(const Window& window, const PixelGrid& shown,
                                                    const cl::Buffer& places, std::size_t count);

/// Whether the tilts of all images of a grid that kernels walk fit in 32 bits: those of very flat ones do
/// not.
bool tilts_fit(const Grid& grid);

/// Whether kernels go round the periodic axes of these pixels themselves, where no seed lies outside.
bool kernels_go_round(const Window& window, const PixelGrid& shown);

}  // namespace vorocl
