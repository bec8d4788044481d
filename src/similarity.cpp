#include "vorocl/similarity.hpp"

#include "buffer.hpp"
#include "kernel.hpp"

namespace vorocl {

namespace {
constexpr std::size_t pixels_per_item = 1024;

double percentage(std::size_t differences, std::size_t pixels) {
  return 100.0 * static_cast<double>(pixels - differences) / static_cast<double>(pixels);
}
}  // namespace

double similarity(const std::vector<std::uint32_t>& a, const std::vector<std::uint32_t>& b) {
  if (a.size() != b.size() || a.empty()) {
    throw Error("label images of " + std::to_string(a.size()) + " and " + std::to_string(b.size()) +
                " pixels cannot be compared");
  }
  std::size_t differences = 0;
  for (std::size_t i = 0; i < a.size(); ++i) differences += a[i] != b[i] ? 1 : 0;
  return percentage(differences, a.size());
}

double similarity(const Diagram& a, const Diagram& b) {
  const Device& device = a.device();
  if (!device.same_as(b.device())) throw Error("the diagrams belong to different devices");
  if (a.grid() != b.grid()) throw Error("diagrams of different grids cannot be compared");
  const std::size_t pixels = a.grid().pixels();
  const cl::Buffer differences = allocate(device, sizeof(cl_uint), "the similarity");
  fill(device, differences, cl_uint{0}, 1);
  Kernel(device, "similarity.cl", "count_differences", a.grid())
      .over_items((pixels + pixels_per_item - 1) / pixels_per_item, a.labels(), b.labels(),
                  static_cast<cl_uint>(pixels), static_cast<cl_uint>(pixels_per_item), differences);
  a.wait();
  b.wait();
  return percentage(download<cl_uint>(device, differences, 1).front(), pixels);
}

}  // namespace vorocl
