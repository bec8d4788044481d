// Cells of a diagram whose pixels weigh differently.
#pragma once

#include <cstdint>
#include <vector>

#include "measures/measurement.hpp"

namespace vorocl {

/// What the centroid of a cell follows from, as CellSums: but each pixel counts as often as it weighs.
struct CellWeight {
  std::uint64_t weight = 0;
  std::int64_t sum_x = 0, sum_y = 0, sum_z = 0;
};

/// The weights of the pixels of a diagram, and the sums of its cells, on the device.
class Density {
 public:
  /// Of a density of at least 0 for each pixel of the window. Throws Error that names the pixel if one is
  /// negative or no number, and if there are more or fewer, or all are 0.
  Density(const Device& device, const Window& window, const std::vector<float>& density);

  /// Sums the cells. The energy: the sum of density times squared distance over all pixels that have a label.
  /// Waits.
  double weigh(const Diagram& diagram);

  // Of the cells that were weighed last: uint64, and int64 in pixels from the window's first one.
  const cl::Buffer& weight() const { return weight_; }
  const cl::Buffer& sum_x() const { return sum_x_; }
  const cl::Buffer& sum_y() const { return sum_y_; }
  const cl::Buffer& sum_z() const { return sum_z_; }  // of a plane 0

  /// The same on the host, by id.
  std::vector<CellWeight> read(std::size_t cells) const;

 private:
  Device device_;
  KernelSet kernels_;
  double unit_ = 0;                            // the density that a weight of 1 stands for
  cl::Buffer pixels_;                          // the weights: uint16
  cl::Buffer at_home_, elsewhere_, energies_;  // see density.cl
  cl::Buffer weight_, sum_x_, sum_y_, sum_z_;
};

}  // namespace vorocl
