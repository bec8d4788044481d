// The subcommands of vorocl. Each function adds one, whose work runs when its options have been parsed; the
// work throws Error (exit code 1) or UsageError (exit code 2).
#pragma once

#include "app/options/command_line.hpp"

namespace vorocl::command {

void add_devices(CommandLine& line);
void add_prepare(CommandLine& line);
void add_render(CommandLine& line);
void add_simulate(CommandLine& line);
void add_cells(CommandLine& line);
void add_relax(CommandLine& line);
void add_tiles(CommandLine& line);
void add_compare(CommandLine& line);
void add_bench(CommandLine& line);

/// Parses a command line and runs the subcommand that it names. Throws UsageError for one that makes no
/// sense, and what the work throws.
void run_command(int argc, char** argv);

}  // namespace vorocl::command
