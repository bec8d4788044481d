// Similarity of two diagrams, the paper's measure: 100 x matching pixels / all pixels.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "vorocl/diagram.hpp"
#include "vorocl/export.h"
#include "vorocl/opencl.hpp"
#include "vorocl/own_state.hpp"
#include "vorocl/report.hpp"

namespace vorocl {

struct SimilarityState;

/// The share of pixels with equal labels in percent, of two label images of one size. Throws Error if the
/// sizes differ or are 0.
VOROCL_API double similarity(const std::vector<std::uint32_t>& a, const std::vector<std::uint32_t>& b);

/// What similarity() counted, on the device.
///
/// Threads: one thread at a time.
///
/// Lifetime: a result keeps its device, and remembers the frames of seeds that the diagrams were made from,
/// which may change at once after the call. Its buffer is valid until the next comparison into it.
///
/// Ordering: all work goes to the device's in-order queue, in the order of the calls.
class VOROCL_API SimilarityResult {
 public:
  /// One uint32: the pixels that differ. Null while the result is empty.
  const cl::Buffer& differences() const;

  /// The pixels that differ; 0 while the result is empty. Waits. Throws BadPoint if seeds had one.
  std::size_t read_differences() const;

  /// The similarity in percent; 100 while the result is empty. As read_differences().
  double read() const;

 private:
  friend struct Internal;
  OwnState<SimilarityState> state_;
};

/// The share of pixels with equal labels. One pass over the two label images. Enqueues and returns. Throws
/// Error if the diagrams have different windows or devices.
VOROCL_API Report similarity(const Diagram& a, const Diagram& b, SimilarityResult& result);

/// The share of pixels whose labels name seeds that are equally far from them in the diagrams' metric, within
/// a tolerance in pixels; labels that name no seed are equal to each other alone. With 1e-4 times the grid's
/// side and Euclidean distances it is the similarity of the program by the paper's authors. One pass over the
/// two label images, with a look-up of the seeds where they differ. Enqueues and returns. Throws Error if the
/// diagrams do not fit together, are not of one frame of seeds and one metric, their seeds have weights, or
/// the tolerance is negative or not finite.
VOROCL_API Report similarity(const Diagram& a, const Diagram& b, double tolerance, SimilarityResult& result);

}  // namespace vorocl
