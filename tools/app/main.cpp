// The vorocl command: parses, runs a subcommand, and turns what went wrong into one line and an exit code.
#include <exception>
#include <new>

#include "app/commands/commands.hpp"
#include "app/terminal/console.hpp"
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
  using vorocl::command::print_error;
  try {
    run(argc, argv);
    return success;
  } catch (const vorocl::command::UsageError& error) {
    print_error(error.what());
    return usage;
  } catch (const std::bad_alloc&) {
    print_error("out of memory; use a smaller grid or fewer seeds");
  } catch (const std::exception& error) {
    print_error(error.what());
  }
  return failure;
}
