// Labels on the host, as files hold them.
#pragma once

#include <cstdint>
#include <vector>

#include "vorocl/grid.hpp"

namespace vorocl::command {

struct LabelImage {
  Grid grid;
  std::vector<std::uint32_t> labels;  // row-major
};

/// The image with ids[label] for each label; without ids as it is. no_label stays.
inline LabelImage with_ids(LabelImage image, const std::vector<std::uint32_t>& ids) {
  if (ids.empty()) return image;
  for (std::uint32_t& label : image.labels) {
    if (label != no_label) label = ids.at(label);
  }
  return image;
}

}  // namespace vorocl::command
