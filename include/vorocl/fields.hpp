// Images that follow from a diagram: distances to the nearest seed, borders of the cells.
#pragma once

#include <cstdint>
#include <vector>

#include "vorocl/diagram.hpp"
#include "vorocl/export.h"
#include "vorocl/opencl.hpp"
#include "vorocl/own_state.hpp"
#include "vorocl/report.hpp"
#include "vorocl/seeds.hpp"

namespace vorocl {

template <typename T>
struct FieldState;

/// What distance_field() says of a pixel without a label; infinity in the field of floats.
constexpr std::int32_t no_distance = 0x7fffffff;

/// One value per pixel, row-major, on the device: int32, uint32, float or uint8. Filling it again allocates
/// nothing. Empty before the first time, and after it was moved from or filling it threw.
///
/// Threads: one thread at a time.
///
/// Lifetime: a field keeps its device, and remembers the frame of seeds that it was made from; seeds and
/// diagram may change at once after the call. Its buffer is valid until the next call that fills the field.
///
/// Ordering: all work goes to the device's in-order queue, in the order of the calls.
template <typename T>
class VOROCL_API Field {
 public:
  const cl::Buffer& values() const;  ///< null while the field is empty

  /// Waits. Throws BadPoint if the frame of the seeds had one, and Error if a value does not fit.
  std::vector<T> read() const;

  /// As above, to where all pixels of the window fit, if the field is not empty.
  void read(T* values) const;

 private:
  friend struct Internal;
  OwnState<FieldState<T>> state_;
};

extern template class Field<std::int32_t>;
extern template class Field<float>;
extern template class Field<std::uint8_t>;
extern template class Field<std::uint32_t>;

/// Each pixel's distance to the seed of its label, between pixel centres, in the diagram's metric: squared if
/// Euclidean. Exact integers: in pixels, or in units of the spacing in a grid with an axis that is spaced
/// (Axis::spaced()). Enqueues and returns; where a seed lies so far outside the window that a distance takes
/// more than 31 bits, reading the field throws Error. Throws Error if the diagram knows no seeds (see
/// Diagram::write()), its labels are of points within their pixels (Snap::none), or the device has too little
/// memory.
VOROCL_API Report distance_field(const Diagram& diagram, Field<std::int32_t>& field);

/// As above and in the same unit, of any labels: the root of the squared Euclidean distance, within 3 units
/// in the last place. Of any length. By great circles kilometres, to a millionth or 1 cm.
VOROCL_API Report distance_field(const Diagram& diagram, Field<float>& field);

/// 1 for each pixel that shares an edge, in a volume a face, with a pixel of another label, else 0. Enqueues
/// and returns.
VOROCL_API Report border_mask(const Diagram& diagram, Field<std::uint8_t>& mask);

/// Each pixel's label, looked up in a table of uint32 on the device with one entry per seed: ids of the
/// caller's own, classes, colours. no_label where a pixel has no label, or that of an absent seed. Enqueues
/// and returns. Throws Error if the diagram knows no seeds, or the buffer has too few entries or cannot be
/// read by kernels.
VOROCL_API Report map_labels(const Diagram& diagram, const cl::Buffer& table, Field<std::uint32_t>& field);

/// As above, from a table on the host, which is copied to a new buffer.
VOROCL_API Report map_labels(const Diagram& diagram, const std::vector<std::uint32_t>& table,
                             Field<std::uint32_t>& field);

/// The label of each pixel that is at most so far away from its seed, in the units of distance_field() and by
/// the diagram's metric (a root as double has it: std::sqrt(13) takes in what is 2 and 3 pixels away), and
/// no_label farther away: cells that grow to a width and no farther. Enqueues and returns. Throws Error if
/// the diagram knows no seeds, or the distance is negative or NaN.
VOROCL_API Report expand_labels(const Diagram& diagram, double distance, Field<std::uint32_t>& field);

}  // namespace vorocl
