#include "app/commands/commands.hpp"

#include "vorocl/version.hpp"

namespace vorocl::command {

void run_command(int argc, char** argv) {
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
