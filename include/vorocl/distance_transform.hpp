// Images instead of seeds: the nearest marked pixel of every pixel, whatever the image.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>

#include "vorocl/device.hpp"
#include "vorocl/export.h"
#include "vorocl/grid.hpp"
#include "vorocl/opencl.hpp"
#include "vorocl/own_state.hpp"
#include "vorocl/report.hpp"

namespace vorocl {

struct DistanceTransformState;

/// What a pixel of an image is in memory. Integers with a sign have the type of the same size without one
/// as marks and as values: they are compared with zero and copied.
enum class PixelType { uint8, uint16, uint32, uint64, float32, float64 };

/// An image that is read: row-major, slice after slice, without gaps, in the host's memory or in a buffer of
/// the device's context. It keeps no memory: what is on the host must stay there during the call.
class VOROCL_API ImageSource {
 public:
  ImageSource(const void* pixels, PixelType type) : host_(pixels), type_(type) {}
  ImageSource(const cl::Buffer& pixels, PixelType type) : buffer_(pixels), type_(type) {}

  const void* host() const { return host_; }  ///< null where it is a buffer
  const cl::Buffer& buffer() const { return buffer_; }
  PixelType type() const { return type_; }

 private:
  const void* host_ = nullptr;
  cl::Buffer buffer_;
  PixelType type_;
};

/// Where an image is written, likewise, in a buffer that kernels can read and write; none if made without
/// arguments.
class VOROCL_API ImageTarget {
 public:
  ImageTarget() = default;
  ImageTarget(void* pixels, PixelType type) : host_(pixels), type_(type) {}
  ImageTarget(const cl::Buffer& pixels, PixelType type) : buffer_(pixels), type_(type) {}

  bool is_wanted() const { return host_ != nullptr || buffer_() != nullptr; }
  void* host() const { return host_; }
  const cl::Buffer& buffer() const { return buffer_; }
  PixelType type() const { return type_; }

 private:
  void* host_ = nullptr;
  cl::Buffer buffer_;
  PixelType type_ = PixelType::uint32;
};

/// Which pixels are marked: those that others look for.
enum class Marked {
  zeros,      ///< as SciPy's distance_transform_edt() and edt have it
  non_zeros,  ///< as a mask of seeds and an image of labels have it; NaN is no data, and not marked
};

/// The lengths of a pixel along the axes of a grid.
///
/// Distances are compared as whole numbers. Where the lengths are to each other as whole numbers up to 1,000
/// (0.065, 0.065 and 0.2 are as 13, 13 and 40; to a rounding of double), these are taken, and nothing is
/// rounded; in images with a side of more than 8,192 pixels the numbers may have to be less. Else the squares
/// of the lengths are rounded for comparisons: a pixel may take a marked one whose distance is greater by a
/// part of about n (D / s)^2 / 2^62. D is the image's diagonal and s the least length; n is the number of
/// pixels of the longest side, rounded up to a power of two of at least 64. It is 2e-10 where D is 1,000 s
/// and n 1,024. An image where it is more than 1 % is refused.
struct PixelSize {
  double x = 1;
  double y = 1;
  double z = 1;
};

/// What a transform writes. All images have the size of the transform's.
struct TransformTargets {
  /// The distance to the nearest marked pixel, between centres, in the units of PixelSize. float32 or
  /// float64: for pixels of the size 1 the root of a whole number, rounded once to float64; else within 2
  /// units in the last place of the type. uint32: the square, which has the unit of 1; needs sizes that are
  /// whole numbers, and distances whose squares fit. Where nothing is marked or the nearest is beyond
  /// `farthest`: infinity; no_label of squares.
  ImageTarget distances;

  /// The index of the nearest marked pixel along each axis, as SciPy's return_indices: uint32, an image of
  /// indices along z (volumes: see Grid::is_volume()), then one along y, then one along x: 2 or 3 images in a
  /// row. no_label (-1 as int32) where there is none.
  ImageTarget indices;

  /// The nearest marked pixel as a place in the image, x + width * (y + height * z): uint32. no_label where
  /// there is none.
  ImageTarget places;

  /// Its number among the marked ones in row-major order: uint32, the ids of Seeds::from_mask(). no_label
  /// where there is none.
  ImageTarget ranks;

  /// The value that the nearest marked pixel has in the image, of the type of the image: labels that grow. 0
  /// where there is none.
  ImageTarget values;
};

struct TransformOptions {
  Marked marked = Marked::zeros;

  /// Marked pixels that are farther away than so much are none: infinity, no_label and 0 are written instead.
  /// In the units of PixelSize; a root as double has it: std::sqrt(13) takes in what is 2 and 3 pixels away,
  /// and 7 * 0.65 what is 7 pixels of 0.65 away: where lengths are not 1, what is farther by a rounding is no
  /// farther.
  double farthest = std::numeric_limits<double>::infinity();
};

/// The exact Euclidean distance transform of images of one size: for every pixel the nearest marked pixel; of
/// several at the least distance the one that comes first in row-major order, slice by slice. It keeps its
/// kernels and working memory from image to image.
///
/// Exact: distances are compared as whole numbers, and the results are the same on every device. Separable
/// (rows by their bits, then columns, then lines along z, where nearest rows and slices are found by divide
/// and conquer, as they are monotone): the cost is in proportion to the pixels, whatever the image shows
/// (docs/masks.md has the proofs and the figures).
///
/// Memory beside the images: 2 bytes per pixel of a plane; in a volume those of a few slices, and 4
/// bytes per voxel if there is no target of 4 bytes or more per voxel. With Shape::group 6 bytes per pixel.
///
/// Threads: one thread at a time.
class VOROCL_API DistanceTransform {
 public:
  /// For images of a grid's size and periods (other axes than the grid's are as Grid(width, height, depth)
  /// makes them; a pixel of an axis that is spaced() is so many sizes long). Throws Error, if the grid is
  /// larger than a diagram can be (Window::max_side; of a volume Window::max_side_of_volume pixels and 2^31 -
  /// 1 voxels), is tilted, or a size is not from 1e-140 to 1e140 or more than 1,000 times another one. Of a
  /// plane z is not looked at.
  explicit DistanceTransform(const Device& device, const Grid& grid, const PixelSize& size = {});

  /// Transforms an image. Where all images are buffers it enqueues and returns. Else it waits: on a device
  /// that shares the host's memory kernels read and write there, without copies. Targets must not overlap
  /// each other or the image. Throws Error if no target is wanted, a target has a type that is not named
  /// above, a buffer cannot be used, the distances of squares do not fit, `farthest` is negative or NaN, or
  /// the device has too little memory or (float64 targets) no doubles.
  Report run(const ImageSource& image, const TransformTargets& targets, const TransformOptions& options = {});

  /// Whether the last image had a marked pixel. Waits.
  bool found() const;

  const Device& device() const;
  const Grid& grid() const;

 private:
  DistanceTransformState& state() const;
  OwnState<DistanceTransformState> state_;
};

}  // namespace vorocl
