// The distance transform of an image, and its objects grown by five pixels.
#include <algorithm>
#include <iostream>
#include <vorocl/vorocl.hpp>

int main() {
  const vorocl::Device device = vorocl::Device::select();
  const vorocl::Grid grid(64, 48);
  std::vector<std::uint8_t> image(64 * 48);
  image[20 * 64 + 15] = image[20 * 64 + 45] = 255;
  vorocl::Diagram diagram(device, grid);
  vorocl::exact_diagram(vorocl::Seeds::from_mask(device, grid, image), diagram);

  vorocl::Field<float> distances;
  vorocl::distance_field(diagram, distances);
  vorocl::Field<std::uint32_t> grown;
  vorocl::expand_labels(diagram, 5, grown);

  const std::vector<float> distance = distances.read();
  const std::vector<std::uint32_t> labels = grown.read();
  std::cout << "at most " << *std::max_element(distance.begin(), distance.end()) << " pixels; grown to "
            << std::count(labels.begin(), labels.end(), 0u) << " and "
            << std::count(labels.begin(), labels.end(), 1u) << '\n';
}
