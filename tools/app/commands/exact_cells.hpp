// vorocl cells --exact: cells as polygons or polyhedra, without a diagram.
#pragma once

#include <string>
#include <vector>

#include "app/sources/seed_input.hpp"

namespace vorocl::command {

struct ExactCellsOptions {
  SeedOptions seeds;
  std::string device;
  std::string cells, adjacency, polygons;  // paths; empty: not asked for
  std::vector<std::string> columns;        // of the cells, as they were chosen
  bool json = false;
};

/// What vorocl cells does with --exact.
void run_exact_cells(const ExactCellsOptions& options);

}  // namespace vorocl::command
