// Which pixels of an image others look for: see kernels/masks/marks.cl.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "runtime/kernel.hpp"
#include "runtime/pixel_grid.hpp"
#include "vorocl/distance_transform.hpp"
#include "vorocl/opencl.hpp"

namespace vorocl {

std::size_t bytes_of(PixelType type);

/// The sides of an image, and along which of them it repeats.
struct ImageShape {
  explicit ImageShape(const PixelGrid& grid);

  /// Throws Error unless an image of the grid can be transformed.
  explicit ImageShape(const Grid& grid);

  std::array<int, 3> sides() const { return {width, height, depth}; }
  std::size_t rows() const { return static_cast<std::size_t>(height) * static_cast<std::size_t>(depth); }
  std::size_t pixels() const { return static_cast<std::size_t>(width) * rows(); }

  friend bool operator==(const ImageShape& a, const ImageShape& b) {
    return a.width == b.width && a.height == b.height && a.depth == b.depth && a.periodic_x == b.periodic_x &&
           a.periodic_y == b.periodic_y && a.periodic_z == b.periodic_z;
  }

  int width, height, depth;
  bool is_volume;  // of one slice, too
  bool periodic_x, periodic_y, periodic_z;
};

/// A bit for each pixel, and once they are ranked the number of each mark in row-major order.
struct Marks {
  Device device;  // without vectors
  ImageShape shape;
  cl::Buffer bits, counts;  // of pixels; of rows (see sum_counts())
  cl::Buffer starts;        // null until they are ranked

  Marks(const Device& device_of_marks, const ImageShape& shape_of_image)
      : device(without_vectors(device_of_marks)), shape(shape_of_image) {}

  std::size_t shorts_of_row() const;

  /// Makes the bits of an image on the device; returns the command.
  cl::Event mark(KernelSet& kernels, const cl::Buffer& pixels, PixelType type, Marked marked);

  /// Marks the pixels that have seeds, and writes their ids there, the lowest of several. Such marks have
  /// neither ranks nor a count. Returns the command.
  cl::Event paint(KernelSet& kernels, const PixelGrid& grid, const cl::Buffer& positions, std::size_t seeds,
                  const cl::Buffer& labels);

  /// Makes it possible to look up the number of a mark.
  void rank(KernelSet& kernels);

  /// How many marks there are. Waits.
  std::size_t count(KernelSet& kernels);

  /// Writes the positions of the marks by their numbers, and `empty` behind them; see Placement::positions.
  void list(KernelSet& kernels, const PixelGrid& grid, const cl::Buffer& positions) const;

 private:
  void make_room();

  /// Counts come to stand before each row. Few ask for them, so it waits for these.
  void sum(KernelSet& kernels);

  bool is_summed_ = false;
};

/// Kernels of the mask engine, which take sizes and periods as arguments: one program serves all images.
Kernel& mask_kernel(KernelSet& kernels, const Device& device, const char* name,
                    const KernelOptions& options = {});

}  // namespace vorocl
