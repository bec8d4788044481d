// All of a torus: cells reach across its ends, and so do their centroids.
#include <iostream>
#include <vorocl/vorocl.hpp>

int main() {
  const vorocl::Device device = vorocl::Device::select();
  const vorocl::Grid torus(90, 90, vorocl::Axes::xy);
  vorocl::Diagram diagram(device, torus);
  vorocl::exact_diagram(vorocl::Seeds(device, torus, {{2.5, 2.5}, {47.5, 2.5}, {2.5, 47.5}, {47.5, 47.5}}),
                        diagram);

  vorocl::CellSumsResult sums;
  vorocl::cell_sums(diagram, sums);
  for (const vorocl::CellSums& cell : sums.read()) {
    std::cout << cell.area << " around " << cell.centroid().x << ' ' << cell.centroid().y << '\n';
  }
}
