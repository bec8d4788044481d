#include "app/commands/commands.hpp"

#include <string>

#include "app/terminal/console.hpp"
#include "vorocl/version.hpp"

namespace vorocl::command {

namespace {

/// Says where the subcommands are that have left.
void refuse_moved(const std::string& subcommand) {
  if (subcommand != "evaluate" && subcommand != "ablation") return;
  throw UsageError("vorocl " + subcommand + " is now tools/studies/study.py " + subcommand +
                   ", in the source of VoroCL");
}

}  // namespace

void run_command(int argc, char** argv) {
  if (argc > 1) refuse_moved(argv[1]);
  CommandLine line("Raster Voronoi diagrams on any OpenCL device.", "vorocl", "vorocl " VOROCL_VERSION);
  add_devices(line);
  add_prepare(line);
  add_render(line);
  add_simulate(line);
  add_cells(line);
  add_relax(line);
  add_tiles(line);
  add_compare(line);
  add_bench(line);
  line.run(argc, argv);
}

}  // namespace vorocl::command
