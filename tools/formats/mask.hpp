// Mask images: each non-zero pixel is a seed.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "vorocl/grid.hpp"

namespace vorocl::command {

struct Mask {
  Grid grid;
  std::vector<std::uint8_t> pixels;  // row-major, 0 where there is no seed
};

/// From any image that OpenCV reads; a pixel is set if one of its colour channels is not 0 (an alpha channel
/// does not count). Throws Error if the file cannot be read or no pixel is set.
Mask read_mask(const std::string& path);

}  // namespace vorocl::command
