// The diagram: the image of labels, kept on the device.
#pragma once

#include <CL/opencl.hpp>
#include <cstdint>
#include <optional>
#include <vector>

#include "vorocl/device.hpp"
#include "vorocl/export.hpp"
#include "vorocl/grid.hpp"
#include "vorocl/seeds.hpp"

namespace vorocl {

/// A label image of width * height uint32, row-major, and every buffer that an engine needs to fill it:
/// engines allocate theirs at their first use of a diagram, later frames of a moving run allocate nothing.
class VOROCL_API Diagram {
 public:
  /// All labels are no_label. Throws Error if the device cannot hold the label image.
  Diagram(const Device& device, const Grid& grid);

  /// The labels go to the caller's buffer, which may be a sub-buffer, is retained, and keeps what it holds
  /// until an engine runs. Throws Error if it is null, too small, of another context or not both readable and
  /// writable by kernels.
  Diagram(const Device& device, const Grid& grid, const cl::Buffer& labels);

  // Copies would share the images that engines overwrite.
  Diagram(const Diagram&) = delete;
  Diagram& operator=(const Diagram&) = delete;
  Diagram(Diagram&&) = default;
  Diagram& operator=(Diagram&&) = default;

  const Device& device() const { return device_; }
  const Grid& grid() const { return grid_; }

  /// The labels, for use in OpenCL without a copy: row-major uint32, valid once the queue gets there, or once
  /// an engine's Report::event() is complete.
  const cl::Buffer& labels() const { return labels_; }

  /// The labels on the host, size width * height. Waits. Throws Error if the seeds had a bad point.
  std::vector<std::uint32_t> read() const;

  /// Waits for the queue. Throws Error if the seeds had a bad point.
  void wait() const;

  /// For engines: what a scratch buffer is for.
  enum class Scratch {
    packed_front,
    packed_back,
    seeded,
    flags,
    exact_bits,
    exact_word_starts,
    exact_starts,
    exact_list,
    exact_ids,
    exact_pyramid,
    exact_labelled,
    exact_candidates,
    exact_counts,
    exact_places,
    exact_late,
    exact_listed,
    count_
  };

  /// For engines: the scratch buffer of this use, made at its first use or when more bytes are asked for than
  /// it has. Throws Error, saying how much is needed and there is, if the device cannot hold it.
  const cl::Buffer& scratch(Scratch use, std::size_t bytes);

  /// Throws Error unless seeds and diagram have one device and one grid.
  void check_fits(const Seeds& seeds) const;

  /// For engines, at their start: check_fits(), and remembers the seeds, so that a bad point among them is
  /// reported at the next wait.
  void begin(const Seeds& seeds);

  /// For engines that go on from the labels of the last frame: whether there was one, and whether all of its
  /// seeds are still there, so that every label names one. Asked before begin().
  bool filled() const { return seeds_.has_value(); }
  bool holds_labels_of(const Seeds& seeds) const;

  /// For engines: the frames since the labels were last made from nothing.
  int age() const { return age_; }
  void set_age(int age) { age_ = age; }

 private:
  Device device_;
  Grid grid_;
  cl::Buffer labels_;
  std::vector<cl::Buffer> scratch_;
  std::optional<Seeds> seeds_;  // of the last engine that ran, as they were then
  int age_ = 0;
};

}  // namespace vorocl
