// Lloyd's algorithm: two seeds share a rectangle.
#include <iostream>
#include <vorocl/vorocl.hpp>

int main() {
  const vorocl::Device device = vorocl::Device::select();
  const vorocl::Grid grid(vorocl::Axis(102, 0, 2), vorocl::Axis(51, 0, 1));
  vorocl::Seeds seeds(device, grid, {{0.2, 0.3}, {1.8, 0.7}});
  vorocl::Diagram diagram(device, grid);
  const vorocl::Relaxation done = vorocl::relax(seeds, diagram, vorocl::engine(vorocl::method("exact")), 100);

  std::cout << (done.converged ? "converged" : "still moving") << ":";
  for (const std::optional<vorocl::Point>& point : seeds.read())
    std::cout << ' ' << point->x << ',' << point->y;
  std::cout << '\n';
}
