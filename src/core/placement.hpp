// Where the seeds of a frame lie, seen from the window of a diagram.
#pragma once

#include <memory>
#include <vector>

#include "core/outer_seeds.hpp"
#include "core/place.hpp"
#include "runtime/pixel_grid.hpp"
#include "vorocl/opencl.hpp"

namespace vorocl {

/// What kernels get of a frame. Nothing of it changes.
struct Placement {
  /// The window's pixels. Its axes are periodic where the kernels themselves go round: then no seed lies
  /// outside.
  PixelGrid grid;

  /// One uint32 per seed: y << 16 | x of its pixel, or absent_position if it is absent or outside the window;
  /// in a volume as VoxelBits has it, or absent_voxel. And one more such value at the end.
  std::shared_ptr<const cl::Buffer> positions;

  /// The places, where a kernel has made them with the positions: see place_on_grid(). Else null.
  std::shared_ptr<const cl::Buffer> places;

  /// The seeds outside, and images across the ends of periods; null if there are none.
  std::shared_ptr<const OuterSeeds> outer;

  /// Of a volume: see are_crowded().
  bool is_crowded = false;
};

/// The position in a volume of a seed that is absent: EMPTY of kernels/volumes/position.cl.
constexpr std::uint32_t absent_voxel = 0x80000000u;

/// The position of a seed that is absent, or outside the window: EMPTY of position.cl.
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

/// Whether kernels go round the periodic axes of these pixels themselves, where no seed lies outside.
bool kernels_go_round(const Window& window, const PixelGrid& shown);

}  // namespace vorocl
