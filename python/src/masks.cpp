// Masks and images of labels: what the nearest marked pixel of each pixel is, from array to array.
#include <nanobind/stl/function.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/tuple.h>

#include <functional>
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

/// The image, its values and the distances, which are floats or doubles, are the bytes of numbers. The arrays
/// have the grid's shape, the indices one axis more: Python has seen to it.
bool transform(const Device& device, const Grid& grid, const std::tuple<double, double, double>& size,
               const Array<const std::uint8_t>& image, const std::string& type, bool zeros, double farthest,
               const std::optional<Array<std::uint8_t>>& distances,
               const std::optional<Array<std::int32_t>>& indices,
               const std::optional<Array<std::uint32_t>>& ranks,
               const std::optional<Array<std::uint8_t>>& values) {
  const auto [x, y, z] = size;
  DistanceTransform transform(device, grid, {x, y, z});
  TransformTargets targets;
  const bool are_floats = distances && distances->size() == grid.pixels() * sizeof(float);
  targets.distances = target(distances, are_floats ? PixelType::float32 : PixelType::float64);
  targets.indices = target(indices, PixelType::uint32);
  targets.ranks = target(ranks, PixelType::uint32);
  targets.values = target(values, type_of(type));
  TransformOptions options;
  options.marked = zeros ? Marked::zeros : Marked::non_zeros;
  options.farthest = farthest;
  transform.run(ImageSource(image.data(), type_of(type)), targets, options);
  return transform.found();
}

using UseTile = std::function<void(std::int64_t, std::int64_t, nb::object, nb::object)>;

/// The pixels of a tile, until the function that is given them returns: Python's code copies them.
template <typename T>
nb::object pixels_of(const T* pixels, const Window& tile) {
  if (pixels == nullptr) return nb::none();
  const auto side = [](std::int64_t length) { return static_cast<std::size_t>(length); };
  return nb::cast(nb::ndarray<nb::numpy, const T, nb::ndim<2>>(
      pixels, {side(tile.height()), side(tile.width())}, nb::none()));
}

/// Gives a function the row and the column of each tile's first pixel, its labels and its distances.
void mask_tiles(const Device& device, const PlaneMask& mask, int side, const std::string& metric,
                bool distances, const UseTile& use) {
  TileOptions options;
  options.metric = metric_of(metric);
  options.distances = distances;
  const Tiling tiling(mask.grid(), side);
  nb::gil_scoped_release release;
  exact_tiles(
      device, mask, tiling,
      [&](const TileLabels& tile) {
        const nb::gil_scoped_acquire acquire;
        use(tile.tile.y(), tile.tile.x(), pixels_of(tile.labels, tile.tile),
            pixels_of(tile.distances, tile.tile));
      },
      options);
}

}  // namespace

void bind_masks(nb::module_& module) {
  nb::class_<PlaneMask>(module, "PlaneMask")
      .def(
          "__init__",
          [](PlaneMask* mask, std::int64_t width, std::int64_t height, bool periodic_x, bool periodic_y) {
            const auto axis = [](std::int64_t pixels, bool repeats) {
              return repeats ? Axis(pixels).periodic() : Axis(pixels);
            };
            new (mask) PlaneMask(Grid(axis(width, periodic_x), axis(height, periodic_y)));
          },
          nb::arg("width"), nb::arg("height"), nb::arg("periodic_x"), nb::arg("periodic_y"))
      .def(
          "add_rows",
          [](PlaneMask& mask, const Array<const std::uint8_t>& rows) {
            mask.add_rows(rows.data(), static_cast<std::int64_t>(rows.size()) / mask.grid().width());
          },
          nb::arg("rows"), without_gil())
      .def_prop_ro("seeds", &PlaneMask::id_end);
  module.def("mask_tiles", mask_tiles, nb::arg("device"), nb::arg("mask"), nb::arg("side"), nb::arg("metric"),
             nb::arg("distances"), nb::arg("use"));
  module.def("transform", transform, nb::arg("device"), nb::arg("grid"), nb::arg("size"), nb::arg("image"),
             nb::arg("type"), nb::arg("zeros"), nb::arg("farthest"), nb::arg("distances").none(),
             nb::arg("indices").none(), nb::arg("ranks").none(), nb::arg("values").none(), without_gil());
}

}  // namespace vorocl::python
