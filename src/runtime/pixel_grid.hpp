// The pixels that kernels run over: a diagram's, or a part of them.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <string>

#include "vorocl/grid.hpp"

namespace vorocl {

/// Rows of pixels, and along which axes their ends meet; in a volume slices of rows. Most kernels are built
/// for the periodic axes, all for vectors no longer than a row, and in a volume for its VoxelBits and its
/// spacing.
class PixelGrid {
 public:
  PixelGrid(int width, int height, Axes periodic = Axes::none)
      : width_(width), height_(height), periodic_(periodic) {}

  /// Those of a diagram's window, or a volume. Throws Error if it is larger than a diagram can be.
  explicit PixelGrid(const Window& window);

  /// The same pixels, and no ends that meet.
  PixelGrid without_periods() const { return {width_, height_}; }

  int width() const { return width_; }
  int height() const { return height_; }
  int depth() const { return depth_; }
  bool has_voxels() const { return depth_ > 1 || is_spaced(); }
  bool is_spaced() const { return spacing_ != std::array<int, 3>{1, 1, 1}; }
  const std::array<int, 3>& spacing() const { return spacing_; }  ///< of x, y and z
  Axes periodic() const { return periodic_; }                     ///< z in a volume alone
  bool periodic_x() const { return has_x(periodic_); }
  bool periodic_y() const { return has_y(periodic_); }
  bool periodic_z() const { return has_z(periodic_); }
  bool is_periodic() const { return periodic_ != Axes::none; }
  int longest_side() const { return std::max({width_, height_, depth_}); }
  std::size_t rows() const { return static_cast<std::size_t>(height_) * static_cast<std::size_t>(depth_); }
  std::size_t pixels() const { return static_cast<std::size_t>(width_) * rows(); }

  friend bool operator==(const PixelGrid& a, const PixelGrid& b) {
    return a.width_ == b.width_ && a.height_ == b.height_ && a.depth_ == b.depth_ &&
           a.periodic_ == b.periodic_ && a.spacing_ == b.spacing_;
  }
  friend bool operator!=(const PixelGrid& a, const PixelGrid& b) { return !(a == b); }

 private:
  int width_, height_, depth_ = 1;
  Axes periodic_;
  std::array<int, 3> spacing_ = {1, 1, 1};
};

/// How a voxel's coordinates lie in its position: x in the lowest bits, then y, then z, so that positions are
/// in the order of the tie rule. Along a periodic axis there is room for half a period more at both ends. In
/// kernels VOROCL_BITS_X, VOROCL_BITS_Y and VOROCL_BITS_Z.
struct VoxelBits {
  explicit VoxelBits(const PixelGrid& grid);

  std::uint32_t pack(int at_x, int at_y, int at_z) const {
    return static_cast<std::uint32_t>(at_z) << (x + y) | static_cast<std::uint32_t>(at_y) << x |
           static_cast<std::uint32_t>(at_x);
  }

  /// x, y and z of a voxel.
  std::array<int, 3> unpack(std::uint32_t position) const {
    const auto field = [position](int first, int count) {
      return static_cast<int>(position >> first & ((std::uint32_t{1} << count) - 1));
    };
    return {field(0, x), field(x, y), field(x + y, z)};
  }

  int x, y, z;
};

/// Whether seeds lie in voxels (VoxelBits): in a volume, and in a plane with an axis that is spaced.
bool has_voxels(const Grid& grid);

/// Whether a diagram can show all of a grid.
bool fits_in_a_diagram(const Grid& grid);

/// Throws Error if a grid has voxels, for something ("a window") that knows planes without spacings alone.
void refuse_volume(const Grid& grid, const char* what);

/// Throws Error if a grid is tilted, for something ("flooding") that does not know that.
void refuse_tilted(const Grid& grid, const char* what);

/// ", periodic in x and y", or nothing.
std::string periodic_text(Axes axes);

/// "640 x 480, periodic in x".
std::string size_text(const PixelGrid& pixels);
std::string size_text(const Grid& grid);

}  // namespace vorocl
