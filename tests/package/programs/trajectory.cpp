// Particles that go around: each frame's diagram is made from the one before.
#include <cmath>
#include <iostream>
#include <vorocl/vorocl.hpp>

std::vector<vorocl::Point> particles(int frame) {
  std::vector<vorocl::Point> points;
  for (int i = 0; i < 2000; ++i) {
    const double radius = 0.45 * std::sqrt((i + 0.5) / 2000), turn = 2.4 * i + 0.002 * frame;
    points.push_back({radius * std::cos(turn), radius * std::sin(turn)});
  }
  return points;
}

int main() {
  const vorocl::Device device = vorocl::Device::select();
  const vorocl::Grid grid(vorocl::Axis(500, -0.5, 0.5), vorocl::Axis(500, -0.5, 0.5));
  // Methods that flood snap the points: the exact diagram is to be that of the same places.
  vorocl::Seeds seeds(device, grid, particles(0), {vorocl::Outside::count, vorocl::Snap::to_pixels});
  vorocl::Diagram diagram(device, grid), exact(device, grid);
  for (int frame = 0; frame <= 50; ++frame) {
    if (frame > 0) seeds.move_to(particles(frame));
    vorocl::dynamic_jump_flooding(seeds, diagram);
  }
  vorocl::exact_diagram(seeds, exact);
  vorocl::SimilarityResult result;
  vorocl::similarity(diagram, exact, result);
  std::cout << "after 50 frames " << std::floor(result.read()) << " % or more are right\n";
}
