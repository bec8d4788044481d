// vorocl-mpi tiles: a plane made by several processes.
#pragma once

#include <functional>

#include "app/options/command_line.hpp"

namespace vorocl::command {

/// Adds the subcommand, which has the options of vorocl tiles. MPI must be initialised when it runs. It calls
/// `before` when its options have been parsed and checked.
void add_shared_tiles(CommandLine& line, const std::function<void()>& before);

}  // namespace vorocl::command
