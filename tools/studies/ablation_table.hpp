// The table of an ablation: a CSV file with one row for each variant of a configuration.
#pragma once

#include <string>
#include <vector>

#include "studies/ablation.hpp"
#include "studies/table.hpp"

namespace vorocl::command {

/// The first line.
std::string ablation_header(const Origin& origin);

/// The lines of a configuration, from the results of its variants.
std::string ablation_rows(const Origin& origin, const Configuration& configuration,
                          const std::vector<Variant>& variants, const std::vector<VariantResult>& results);

}  // namespace vorocl::command
