// Cities in degrees, on a map whose columns go around the world and whose rows begin in the north: the
// nearest on the globe.
#include <iostream>
#include <vorocl/vorocl.hpp>

int main() {
  const char* const names[] = {"Honolulu", "Tokyo", "Auckland", "Los Angeles"};
  const std::vector<vorocl::Point> cities = {
      {-157.86, 21.31}, {139.69, 35.68}, {174.76, -36.85}, {-118.24, 34.05}};

  const vorocl::Grid map(vorocl::Axis(1440, -180, 180).periodic(),
                         vorocl::Axis(720, -90, 90).reversed().closed());
  const vorocl::Device device = vorocl::Device::select();
  vorocl::Diagram diagram(device, map);
  vorocl::exact_diagram(vorocl::Seeds(device, map, cities), diagram, {vorocl::Metric::great_circle});

  const std::vector<std::uint32_t> labels = diagram.read();
  for (const vorocl::Point& at : std::vector<vorocl::Point>{{179, 21}, {-179, -35}, {-95, 90}}) {
    const auto pixel = static_cast<std::size_t>(map.y().pixel(at.y) * 1440 + map.x().pixel(at.x));
    std::cout << names[labels[pixel]] << '\n';
  }
}
