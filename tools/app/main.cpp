// The vorocl command: parses, runs a subcommand, and turns what went wrong into one line and an exit code.
#include <exception>
#include <new>

#include "app/commands/commands.hpp"
#include "app/terminal/console.hpp"
#include "app/terminal/usage_error.hpp"
#include "vorocl/version.hpp"

namespace {

constexpr int success = 0, failure = 1, usage = 2;

int run(int argc, char** argv) {
  CLI::App app("Raster Voronoi diagrams on any OpenCL device.", "vorocl");
  app.set_version_flag("--version", "vorocl " VOROCL_VERSION);
  app.require_subcommand(-1);  // at most one: with none, what else was given is the better thing to name
  vorocl::command::add_devices(app);
  vorocl::command::add_render(app);
  vorocl::command::add_simulate(app);
  vorocl::command::add_cells(app);
  vorocl::command::add_relax(app);
  vorocl::command::add_compare(app);
  vorocl::command::add_bench(app);
  vorocl::command::add_evaluate(app);
  vorocl::command::add_ablation(app);
  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& help_or_version) {
    return app.exit(help_or_version);
  } catch (const CLI::ParseError& error) {
    throw vorocl::command::UsageError(error.what());
  }
  if (app.get_subcommands().empty())
    throw vorocl::command::UsageError("no subcommand was given; see vorocl --help");
  return success;
}

}  // namespace

int main(int argc, char** argv) {
  using vorocl::command::print_error;
  try {
    return run(argc, argv);
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
