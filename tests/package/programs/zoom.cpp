// A zoom into a torus of 10^12 pixels: the window crosses the end of the period along both axes.
#include <iostream>
#include <vorocl/vorocl.hpp>

int main() {
  const vorocl::Device device = vorocl::Device::select();
  const vorocl::Grid torus(1000000, 1000000, vorocl::Axes::xy);
  const vorocl::Seeds seeds(device, torus,
                            {{999899.5, 999899.5}, {100.5, 999899.5}, {999899.5, 100.5}, {100.5, 100.5}});
  vorocl::Diagram zoom(device, vorocl::Window(torus, -500, -500, 1000, 1000));
  vorocl::exact_diagram(seeds, zoom);

  const std::vector<std::uint32_t> labels = zoom.read();
  std::cout << "corners " << labels[0] << ' ' << labels[999] << ' ' << labels[999000] << ' ' << labels[999999]
            << ", pixels";
  for (const vorocl::CellRow& cell : vorocl::cell_table(zoom)) std::cout << ' ' << cell.pixels;
  std::cout << '\n';
}
