// How many work-items share a pass of the mask engine: each has working memory of its own.
#pragma once

#include <algorithm>
#include <cstddef>

#include "runtime/opencl_info.hpp"
#include "vorocl/device.hpp"

namespace vorocl {

inline std::size_t items_of(const Device& device) {
  constexpr std::size_t least = 16, each_unit = 2;
  return std::max(least, each_unit * units_of(device));
}

}  // namespace vorocl
