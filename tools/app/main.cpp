// The vorocl command: parses, runs a subcommand, and turns what went wrong into one line and an exit code.
#include <exception>

#include "app/commands/commands.hpp"
#include "app/terminal/console.hpp"
#include "app/terminal/interruption.hpp"
#include "app/terminal/usage_error.hpp"
#include "vorocl/version.hpp"

namespace {

constexpr int success = 0, failure = 1, usage = 2;

void run(int argc, char** argv) {
  vorocl::command::CommandLine line("Raster Voronoi diagrams on any OpenCL device.", "vorocl",
                                    "vorocl " VOROCL_VERSION);
  vorocl::command::add_devices(line);
  vorocl::command::add_render(line);
  vorocl::command::add_simulate(line);
  vorocl::command::add_cells(line);
  vorocl::command::add_relax(line);
  vorocl::command::add_compare(line);
  vorocl::command::add_bench(line);
  vorocl::command::add_evaluate(line);
  vorocl::command::add_ablation(line);
  line.run(argc, argv);
}

}  // namespace

int main(int argc, char** argv) {
  using namespace vorocl::command;
  open_standard_streams();
  remove_temporary_files_on_signals();
  try {
    run(argc, argv);
    flush_standard_output();
    return success;
  } catch (const UsageError& error) {
    print_error(error);
    return usage;
  } catch (const std::exception& error) {
    print_error(error);
  }
  return failure;
}
