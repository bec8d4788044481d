// A table with a row per cell, in the units of the data.
#include <iostream>
#include <vorocl/vorocl.hpp>

int main() {
  const vorocl::Device device = vorocl::Device::select();
  const vorocl::Grid grid(vorocl::Axis(300, 0, 3), vorocl::Axis(100, 0, 1));
  vorocl::Diagram diagram(device, grid);
  vorocl::exact_diagram(vorocl::Seeds(device, grid, {{0.495, 0.505}, {1.505, 0.505}, {2.495, 0.505}}),
                        diagram);

  std::cout << "id,x,y,area,centroid_x,centroid_y,neighbours\n";
  for (const vorocl::CellRow& cell : vorocl::cell_table(diagram)) {
    std::cout << cell.id << ',' << cell.seed.x << ',' << cell.seed.y << ',' << cell.area << ','
              << cell.centroid.x << ',' << cell.centroid.y << ',' << cell.neighbours << '\n';
  }
}
