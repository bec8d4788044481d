// Images that follow from a diagram: distances to the nearest seed, borders of the cells.
#pragma once

#include <CL/opencl.hpp>
#include <cstdint>
#include <optional>
#include <vector>

#include "vorocl/diagram.hpp"
#include "vorocl/export.hpp"
#include "vorocl/report.hpp"
#include "vorocl/seeds.hpp"

namespace vorocl {

/// What distance_field() says of a pixel without a label; infinity in the field of floats.
constexpr std::int32_t no_distance = 0x7fffffff;

/// One value a pixel, row-major, on the device. Filling it again allocates nothing.
template <typename T>
class Field {
 public:
  const cl::Buffer& values() const { return values_; }

  /// Waits. Throws Error if the seeds had a bad point.
  VOROCL_API std::vector<T> read() const;

  /// For the functions that fill it: readies it for this grid of the seeds or diagram.
  VOROCL_API void prepare(const Device& device, const Grid& grid, const std::optional<Seeds>& seeds);

 private:
  std::optional<Device> device_;
  std::optional<Seeds> seeds_;
  std::size_t pixels_ = 0;
  cl::Buffer values_;
};

/// Each pixel's distance to the seed of its label, between pixel centres: squared if Euclidean. Exact
/// integers. Enqueues and returns. Throws Error if seeds and diagram do not fit together or the device has
/// too little memory.
VOROCL_API Report distance_field(const Seeds& seeds, const Diagram& diagram, Field<std::int32_t>& field,
                                 Metric metric = Metric::euclidean);

/// As above, in pixels: the root of the squared Euclidean distance, within 3 units in the last place.
VOROCL_API Report distance_field(const Seeds& seeds, const Diagram& diagram, Field<float>& field,
                                 Metric metric = Metric::euclidean);

/// 1 for each pixel that shares an edge with a pixel of another label, else 0. Enqueues and returns.
VOROCL_API Report border_mask(const Diagram& diagram, Field<std::uint8_t>& mask);

}  // namespace vorocl
