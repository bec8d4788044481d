// Two processes share the seeds of a plane and make its tiles; each pixel must have a label.
#include <mpi.h>

#include <algorithm>
#include <cstdint>
#include <vector>
#include <vorocl/mpi.hpp>

int main(int argc, char** argv) {
  MPI_Init(&argc, &argv);
  std::uint64_t labelled = 0;
  {
    int rank = 0;
    MPI_Comm_rank(MPI_COMM_WORLD, &rank);
    const vorocl::Grid grid(1000, 600);
    vorocl::SharedSeeds seeds(MPI_COMM_WORLD, grid);
    const std::vector<vorocl::Point> points = {{100.0 + 500 * rank, 300}, {200, 100.0 + 400 * rank}};
    seeds.add(points, 2 * static_cast<std::uint64_t>(rank));
    seeds.share();
    const vorocl::Tiling tiling(grid, 256);
    vorocl::TileCounter counter(MPI_COMM_WORLD, seeds, tiling);
    const auto count = [&](const vorocl::TileLabels& tile) {
      const std::uint32_t* const end = tile.labels + tile.tile.pixels();
      labelled += static_cast<std::uint64_t>(
          std::count_if(tile.labels, end, [](std::uint32_t label) { return label < 4; }));
    };
    vorocl::exact_tiles(
        vorocl::Device::select(), seeds, tiling, [&] { return counter.next(); }, count);
    MPI_Allreduce(MPI_IN_PLACE, &labelled, 1, MPI_UINT64_T, MPI_SUM, MPI_COMM_WORLD);
  }
  MPI_Finalize();
  return labelled == 1000 * 600 ? 0 : 1;
}
