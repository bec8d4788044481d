// vorocl cells of a volume: tables of its cells and of the pairs that touch.
#pragma once

#include <string>

#include "app/sources/seed_input.hpp"
#include "vorocl/method.hpp"

namespace vorocl::command {

struct VolumeCells {
  SeedOptions seeds;
  Method method;
  MethodOptions method_options;
  std::string device;
  std::string cells, adjacency, labels;  // paths; empty: not asked for
  bool json;
};

/// Makes the volume, measures its cells and writes what is asked for. Throws UsageError for what volumes do
/// not have, Error if it cannot be made.
void measure_volume(const VolumeCells& options);

}  // namespace vorocl::command
