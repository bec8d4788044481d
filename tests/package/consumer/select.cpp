// The least that a program needs: a device of VoroCL's choice.
#include <vorocl/vorocl.hpp>

#include "nearest.hpp"

int main() try {
  const vorocl::Device device = vorocl::Device::select();
  const vorocl::Grid grid(70, 50);
  const std::vector<int> x = {3, 60, 33}, y = {4, 10, 44};
  std::vector<vorocl::Point> points;
  for (std::size_t i = 0; i < x.size(); ++i) points.push_back({x[i] + 0.5, y[i] + 0.5});

  vorocl::Diagram diagram(device, grid);
  vorocl::jump_flooding(vorocl::Seeds(device, grid, points), diagram);
  return all_nearest(diagram.read(), 70, 50, x, y) ? 0 : 1;
} catch (const vorocl::Error& error) {
  std::cerr << error.what() << '\n';
  return 1;
}
