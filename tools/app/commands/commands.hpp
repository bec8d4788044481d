// The subcommands of vorocl. Each function adds one, whose work runs when its options have been parsed; the
// work throws Error (exit code 1) or UsageError (exit code 2).
#pragma once

#include <CLI/CLI.hpp>

namespace vorocl::command {

void add_devices(CLI::App& app);
void add_render(CLI::App& app);
void add_simulate(CLI::App& app);
void add_cells(CLI::App& app);
void add_relax(CLI::App& app);
void add_compare(CLI::App& app);
void add_bench(CLI::App& app);
void add_evaluate(CLI::App& app);
void add_ablation(CLI::App& app);

}  // namespace vorocl::command
