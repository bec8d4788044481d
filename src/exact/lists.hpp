// How long the lists of candidates inside the exact engine are. Labels do not depend on it.
#pragma once

#include "vorocl/exact_diagram.hpp"

namespace vorocl {

enum class ListLength {
  full,         ///< exact/diagram.cl
  two_entries,  ///< exact/short_lists.cl: nearly every list overflows, which tests want to see
};

/// exact_diagram() with lists of this length.
Report exact_diagram_with_lists(const Seeds& seeds, Diagram& diagram, const ExactOptions& options,
                                ListLength length);

}  // namespace vorocl
