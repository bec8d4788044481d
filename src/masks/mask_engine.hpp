// The mask engine: of each pixel the nearest marked one (kernels/masks/transform.cl).
#pragma once

#include <cstdint>
#include <limits>

#include "masks/marks.hpp"
#include "masks/pixel_sizes.hpp"
#include "runtime/buffer.hpp"
#include "runtime/kernel.hpp"

namespace vorocl {

/// What is written; buffers that are null are not.
struct NearestTargets {
  cl::Buffer distances;
  PixelType type_of_distances = PixelType::float32;  // or float64; uint32: squares
  cl::Buffer indices, places, ranks;
  cl::Buffer values, image;  // may be one buffer
  PixelType type_of_values = PixelType::uint32;
  cl::Buffer labels;  // alone: has those of the marks, and gets those of all pixels
  double farthest = std::numeric_limits<double>::infinity();
};

/// The first and the last one of what was enqueued.
struct Commands {
  cl::Event first, last;
};

/// What engines, one after the other, work in.
struct MaskWorkspace {
  cl::Buffer keys, ints, flags, columns, slices, between;
};

class MaskEngine {
 public:
  MaskEngine(const Device& device, const ImageShape& shape, const PixelSize& size, const WholeSizes& whole,
             Metric metric = Metric::euclidean);

  const ImageShape& shape() const { return shape_; }
  Metric metric() const { return metric_; }

  /// Enqueues the passes. Throws Error if the device has too little memory.
  Commands run(KernelSet& kernels, const Marks& marks, const NearestTargets& targets, MaskWorkspace& room,
               WorkingMemory& memory);

 private:
  struct Pass {
    cl::Buffer costs, far_costs;
    std::int64_t limit = 0, far_limit = 0;  // of distances in keys
    int bits = 1;
    bool saturates = false;   // keys of 32 bits
    bool starts_far = false;  // these would seldom do
  };
  Pass make_pass(int size, std::int64_t square, std::int64_t most, std::int64_t greatest_square) const;
  /// How many strips of a row are taken together along z.
  int strips_at_once() const;

  /// What passes carry for these targets (kernels/masks/sizes.cl).
  int carried_for(const NearestTargets& targets) const;

  /// Runs a kernel by keys of 32 bits, and of 64 where these do not hold all.
  template <typename Run>
  Commands run_pass(KernelSet& kernels, const Pass& pass, const char* name, const cl::Buffer& flags,
                    std::size_t strips, Run run);

  /// The buffer, or any in its place.
  const cl::Buffer& given(const cl::Buffer& buffer) const { return buffer() == nullptr ? nothing_ : buffer; }

  /// Enqueues the last pass, of so many items, with arguments before those that all shapes have.
  template <typename... Arguments>
  cl::Event run_last(Kernel& kernel, std::size_t count, const NearestTargets& targets, const Marks& marks,
                     const Arguments&... arguments) const;

  /// The passes in the group shape (kernels/masks/group/transform.cl).
  Commands run_in_groups(KernelSet& kernels, const Marks& marks, const NearestTargets& targets,
                         MaskWorkspace& room, WorkingMemory& memory);

  cl::Buffer images_of(const NearestTargets& targets, int carried, bool is_far) const;

  Device device_;  // without vectors
  ImageShape shape_;
  PixelSize size_;
  WholeSizes whole_;
  Metric metric_;
  Pass along_y_, along_z_;
  std::int64_t most_in_slice_, most_;  // of squared distances
  cl::Buffer nothing_;
};

}  // namespace vorocl
