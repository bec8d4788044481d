// A plane of 10^10 pixels, of which a few tiles are looked at.
#include <iostream>
#include <map>
#include <vorocl/vorocl.hpp>

int main() {
  const vorocl::Grid plane(100000, 100000);
  vorocl::PlaneSeeds seeds(plane);
  for (int y = 62; y < 100000; y += 125) {
    std::vector<vorocl::Point> row;
    for (int x = 62; x < 100000; x += 125) row.push_back({x + 0.5, y + 0.5});
    seeds.add(row);
  }

  std::map<std::uint32_t, int> areas;
  const vorocl::Tiling tiling(vorocl::Window(plane, 50000, 75000, 1000, 1000), 512);
  vorocl::exact_tiles(vorocl::Device::select(), seeds, tiling, [&](const vorocl::TileLabels& tile) {
    for (std::uint64_t i = 0; i < tile.tile.pixels(); ++i) ++areas[tile.labels[i]];
  });
  std::cout << tiling.count() << " tiles of " << plane.pixels() << " pixels: " << areas.size() << " of "
            << seeds.alive() << " cells, the first is " << areas.begin()->first << " with "
            << areas.begin()->second << " pixels\n";
}
