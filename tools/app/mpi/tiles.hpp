// vorocl-mpi tiles: a plane made by several processes.
#pragma once

#include "app/options/command_line.hpp"

namespace vorocl::command {

/// Adds the subcommand, which has the options of vorocl tiles. MPI must be initialised when it runs.
void add_shared_tiles(CommandLine& line);

}  // namespace vorocl::command
