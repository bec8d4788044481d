// The diagram: the image of labels, kept on the device.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "vorocl/device.hpp"
#include "vorocl/export.h"
#include "vorocl/grid.hpp"
#include "vorocl/opencl.hpp"
#include "vorocl/own_state.hpp"
#include "vorocl/seeds.hpp"

namespace vorocl {

struct DiagramState;

/// A label image of width * height uint32, row-major, which engines fill: the labels of a window of a grid.
/// It remembers the seeds, the metric and the method that it was made from, and measures ask it for them.
/// Engines make their working memory and their kernels at their first use of a diagram and keep them there:
/// later frames of a moving run allocate nothing.
///
/// An engine either fills a diagram or throws. After an exception the labels are undefined, and the diagram
/// counts as never filled: a method that goes on from the last labels starts anew.
///
/// Threads: one thread at a time. Two threads may fill two diagrams of one device.
///
/// Lifetime: a diagram keeps its device, and remembers the frame of the seeds that it was made from. A
/// diagram that was moved from throws Error whatever it is asked.
///
/// Ordering: all work goes to the device's in-order queue, in the order of the calls.
class VOROCL_API Diagram {
 public:
  /// All labels are no_label. A grid is the window that shows all of it. Throws Error if a side is more than
  /// Window::max_side, there are more than Window::max_pixels, or the device cannot hold the label image.
  Diagram(const Device& device, const Window& window);

  /// The labels go to the caller's buffer, which may be a sub-buffer, is retained, and keeps what it holds
  /// until an engine runs. Throws Error if it is null, too small, of another context or not both readable and
  /// writable by kernels.
  Diagram(const Device& device, const Window& window, const cl::Buffer& labels);

  /// The labels go to the host's memory: width * height from `labels` on, which must stay there for as long
  /// as the diagram does. Where the device shares the host's memory, kernels write there, and read() of the
  /// same address copies nothing. Elsewhere this is as the first constructor. What is there counts for
  /// nothing, and is defined after read() alone. Waits for the device when it is destroyed.
  Diagram(const Device& device, const Window& window, std::uint32_t* labels);

  const Device& device() const;
  const Window& window() const;

  /// The labels, for use in OpenCL without a copy: row-major uint32, valid for commands that are enqueued
  /// behind the engine's, or once its Report::event() is complete.
  const cl::Buffer& labels() const;

  /// The metric that the labels were made by. Throws Error if the diagram counts as never filled, or its
  /// labels were written without one.
  Metric metric() const;

  /// The name of the method that made the labels (see methods()), "flood" for a plan of the caller's, empty
  /// if the caller wrote them or the diagram counts as never filled.
  const std::string& method() const;

  /// Writes labels of the caller's: width * height, row-major. An engine that goes on from the last labels
  /// goes on from these; a label that is no seed's id counts as none. Measures that need seeds throw Error.
  /// Waits until they are copied. Throws Error if the size is another.
  void write(const std::vector<std::uint32_t>& labels);

  /// As above, labels that name these seeds by this metric: measures know them then.
  void write(const std::vector<std::uint32_t>& labels, const Seeds& seeds, Metric metric);

  /// As above, from a buffer of the same context (which may be a sub-buffer). Enqueue and return. Throw Error
  /// if it is the diagram's own or overlaps with it.
  void write(const cl::Buffer& labels);
  void write(const cl::Buffer& labels, const Seeds& seeds, Metric metric);

  /// The labels on the host, size width * height. Waits. Throws as wait().
  std::vector<std::uint32_t> read() const;

  /// As above, to where width * height labels fit: without a second image on the host. Where the labels are
  /// there already (see the constructor that takes an address), nothing is copied.
  void read(std::uint32_t* labels) const;

  /// From the next filling on, the labels go to the host's memory, as those of the constructor that takes an
  /// address; null: to memory of the diagram's own. It counts as never filled, and keeps its kernels and
  /// working memory. Waits for the device. Throws Error if the device has too little memory.
  void put_labels_at(std::uint32_t* labels);

  /// Waits for the queue. Throws BadPoint if the frame of seeds that the diagram was made from had a bad
  /// point, and Error if the device failed.
  void wait() const;

 private:
  friend struct Internal;
  DiagramState& state() const;
  OwnState<DiagramState> state_;
};

}  // namespace vorocl
