// Metrics by the names that options, tables and JSON give them.
#pragma once

#include <string>

#include "vorocl/grid.hpp"

namespace vorocl::command {

inline std::string to_string(Metric metric) {
  return metric == Metric::euclidean ? "euclidean" : "manhattan";
}

}  // namespace vorocl::command
