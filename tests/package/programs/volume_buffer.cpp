// A volume of points that lie in a buffer of the device, in the units of the data.
#include <iostream>
#include <vorocl/vorocl.hpp>

int main() {
  const vorocl::Device device = vorocl::Device::select();
  const std::vector<double> values = {1, 0.5, 0.97, 1, 0.5, 3.03};  // x, y, z
  const cl::Buffer points(device.queue(), values.begin(), values.end(), true);

  const vorocl::Grid box(vorocl::Axis(32, 0, 2), vorocl::Axis(16, 0, 1), vorocl::Axis(64, 0, 4));
  const vorocl::Seeds seeds(device, box, {points, 2, vorocl::PointFormat::doubles_xyz});
  vorocl::Diagram diagram(device, box);
  vorocl::exact_diagram(seeds, diagram);
  for (const vorocl::CellRow& cell : vorocl::cell_table(diagram))
    std::cout << "a volume of " << cell.area << " around z = " << cell.centroid.z << '\n';
}
