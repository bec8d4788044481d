// vorocl cells --exact: cells as polygons or polyhedra, without a diagram.
#pragma once

#include <string>
#include <vector>

#include "app/outputs/diagram_files.hpp"

namespace vorocl::command {

struct ExactCellsOptions {
  SeedOptions seeds;
  std::string device;
  std::vector<FileRequest> files;  // tables of cells and pairs, and polygons
  bool json = false;
};

/// What vorocl cells does with --exact.
void run_exact_cells(const ExactCellsOptions& options);

}  // namespace vorocl::command
