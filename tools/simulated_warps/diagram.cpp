// diagram METHOD SIDE SEEDS: one diagram of random seeds, in the shapes that a GPU gets; dJFA's second frame.
// What is counted is all kernels since the line "diagram".
#include <cstdio>
#include <cstdlib>
#include <string>

#include "vorocl/vorocl.hpp"

using namespace vorocl;

int main(int argc, char** argv) {
  if (argc != 4) return std::fprintf(stderr, "usage: diagram METHOD SIDE SEEDS\n"), 2;
  try {
    const Method& made_by = method(argv[1]);
    const Device device = Device::select().with_tuning({1, 32, 8, Shape::group, 64});
    const Grid grid(std::atoi(argv[2]), std::atoi(argv[2]));
    Seeds seeds = Seeds::random(device, grid, std::strtoull(argv[3], nullptr, 10), 1);
    Diagram diagram(device, grid);
    if (made_by.continues) {
      made_by.run(seeds, diagram, {});
      random_step(seeds, 1, Border::reflect, 1, 1);
    }
    device.finish();
    std::puts("diagram");
    made_by.run(seeds, diagram, {});
    diagram.wait();
  } catch (const std::exception& error) {
    std::fprintf(stderr, "diagram: %s\n", error.what());
    return 1;
  }
}
