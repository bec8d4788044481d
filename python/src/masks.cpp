// Masks and images of labels: what the nearest marked pixel of each pixel is, from array to array.
#include <nanobind/stl/optional.h>
#include <nanobind/stl/tuple.h>

#include <tuple>

#include "module.hpp"

namespace vorocl::python {

namespace {

/// By NumPy's name, without the order of bytes: "b1", "i4", "f8".
PixelType type_of(const std::string& name) {
  const bool is_float = name[0] == 'f';
  switch (name[1]) {
    case '1':
      return PixelType::uint8;
    case '2':
      return PixelType::uint16;
    case '4':
      return is_float ? PixelType::float32 : PixelType::uint32;
    default:
      return is_float ? PixelType::float64 : PixelType::uint64;
  }
}

template <typename T>
ImageTarget target(const std::optional<Array<T>>& image, PixelType type) {
  return image ? ImageTarget(image->data(), type) : ImageTarget();
}

/// The image and its values are the bytes of numbers. The arrays have the grid's shape, the indices one axis
/// more: Python has seen to it.
bool transform(const Device& device, const Grid& grid, const std::tuple<double, double, double>& size,
               const Array<const std::uint8_t>& image, const std::string& type, bool zeros, double farthest,
               const std::optional<Array<double>>& distances,
               const std::optional<Array<std::int32_t>>& indices,
               const std::optional<Array<std::uint32_t>>& ranks,
               const std::optional<Array<std::uint8_t>>& values) {
  const auto [x, y, z] = size;
  DistanceTransform transform(device, grid, {x, y, z});
  TransformTargets targets;
  targets.distances = target(distances, PixelType::float64);
  targets.indices = target(indices, PixelType::uint32);
  targets.ranks = target(ranks, PixelType::uint32);
  targets.values = target(values, type_of(type));
  TransformOptions options;
  options.marked = zeros ? Marked::zeros : Marked::non_zeros;
  options.farthest = farthest;
  transform.run(ImageSource(image.data(), type_of(type)), targets, options);
  return transform.found();
}

}  // namespace

void bind_masks(nb::module_& module) {
  module.def("transform", transform, nb::arg("device"), nb::arg("grid"), nb::arg("size"), nb::arg("image"),
             nb::arg("type"), nb::arg("zeros"), nb::arg("farthest"), nb::arg("distances").none(),
             nb::arg("indices").none(), nb::arg("ranks").none(), nb::arg("values").none(), without_gil());
}

}  // namespace vorocl::python
