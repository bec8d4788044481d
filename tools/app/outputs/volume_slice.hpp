// A slice of a volume, which pictures show as a plane.
#pragma once

#include <cstdint>

#include "app/outputs/measures.hpp"

namespace vorocl::command {

/// A slice of a volume, across an axis.
struct VolumeSlice {
  char axis;  // x, y or z
  std::int64_t at;
};

/// How many slices there are along the axis.
std::int64_t slices_along(const Grid& grid, char axis);

/// The pixels of a slice: x and y across z, x and z across y, y and z across x.
Size size_of_slice(const Grid& grid, const VolumeSlice& slice);

/// The labels in a slice, and if asked for the seeds, as those of a plane. Reads those of the volume from the
/// device, if they were not read before, and needs nothing else of it. The buffers must live as long.
Measures in_slice(Measures& volume, const VolumeSlice& slice, bool with_seeds, MeasureBuffers& buffers);

}  // namespace vorocl::command
