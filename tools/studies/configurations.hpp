// The configurations of an evaluation, from the sizes and numbers of seeds that a command line names.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "studies/evaluation.hpp"

namespace vorocl::command {

/// A number of seeds: "100", or "1%" of the pixels.
struct SeedCount {
  std::string text;
  std::size_t count = 0;
  std::optional<double> percent;  ///< instead of the count
};

/// Throws Error if the text is no side of a grid (of side x side pixels).
int parse_side(const std::string& text);

/// Throws Error if the text is no number of seeds. More seeds than pixels are possible.
SeedCount parse_seed_count(const std::string& text);

/// Every side with every number of seeds, the small ones first, each once. Throws Error where a
/// percentage makes less than one seed or more than there can be.
std::vector<Configuration> configurations(const std::vector<int>& sides,
                                          const std::vector<SeedCount>& counts);

}  // namespace vorocl::command
