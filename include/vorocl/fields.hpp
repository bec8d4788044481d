// Images that follow from a diagram: distances to the nearest seed, borders of the cells.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "vorocl/diagram.hpp"
#include "vorocl/export.h"
#include "vorocl/opencl.hpp"
#include "vorocl/report.hpp"
#include "vorocl/seeds.hpp"

namespace vorocl {

template <typename T>
struct FieldState;

/// What distance_field() says of a pixel without a label; infinity in the field of floats.
constexpr std::int32_t no_distance = 0x7fffffff;

/// One value per pixel, row-major, on the device: int32, float or uint8. Filling it again allocates nothing.
/// Empty before the first time, and after it was moved from or filling it threw.
///
/// Threads: one thread at a time.
///
/// Lifetime: a field keeps its device, and remembers the frames of seeds that it was made from; seeds and
/// diagram may change at once after the call. Its buffer is valid until the next call that fills the field.
///
/// Ordering: all work goes to the device's in-order queue, in the order of the calls.
template <typename T>
class VOROCL_API Field {
 public:
  Field();
  ~Field();
  Field(Field&& other) noexcept;
  Field& operator=(Field&& other) noexcept;

  const cl::Buffer& values() const;  ///< null while the field is empty

  /// Waits. Throws BadPoint if the frame of the seeds, or that which the diagram was made from, had one.
  std::vector<T> read() const;

  /// As above, to where all pixels of the grid fit, if the field is not empty.
  void read(T* values) const;

 private:
  friend struct Internal;
  std::unique_ptr<FieldState<T>> state_;
};

extern template class Field<std::int32_t>;
extern template class Field<float>;
extern template class Field<std::uint8_t>;

/// Each pixel's distance to the seed of its label, between pixel centres: squared if Euclidean. Exact
/// integers. Enqueues and returns; where seeds lie outside the grid it waits, and throws Error if a distance
/// takes more than 31 bits. Throws Error if seeds and diagram do not fit together or the device has too
/// little memory.
VOROCL_API Report distance_field(const Seeds& seeds, const Diagram& diagram, Field<std::int32_t>& field,
                                 Metric metric = Metric::euclidean);

/// As above, in pixels: the root of the squared Euclidean distance, within 3 units in the last place. Of any
/// length, and enqueues and returns.
VOROCL_API Report distance_field(const Seeds& seeds, const Diagram& diagram, Field<float>& field,
                                 Metric metric = Metric::euclidean);

/// 1 for each pixel that shares an edge with a pixel of another label, else 0. Enqueues and returns.
VOROCL_API Report border_mask(const Diagram& diagram, Field<std::uint8_t>& mask);

}  // namespace vorocl
