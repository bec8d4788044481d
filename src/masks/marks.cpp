#include "masks/marks.hpp"

#include <algorithm>
#include <string>

#include "core/placement.hpp"
#include "masks/items.hpp"
#include "runtime/buffer.hpp"
// Last: it defines macros.
#include "masks/sizes.cl"

namespace vorocl {

std::size_t bytes_of(PixelType type) {
  switch (type) {
    case PixelType::uint8:
      return 1;
    case PixelType::uint16:
      return 2;
    case PixelType::uint32:
    case PixelType::float32:
      return 4;
    case PixelType::uint64:
    case PixelType::float64:
      return 8;
  }
  throw Error("there is no type of pixels of number " + std::to_string(static_cast<int>(type)));
}

namespace {

void check_shape(const Grid& grid) {
  if (grid.is_tilted()) throw Error("the grid is tilted, which distance transforms of images do not know");
  const bool is_deep = grid.depth() > 1;
  const std::int64_t most = is_deep ? Window::max_side_of_volume : Window::max_side;
  const std::uint64_t most_pixels = is_deep ? 0x7fffffffu : Window::max_pixels;
  if (std::max({grid.width(), grid.height(), grid.depth()}) <= most && grid.pixels() <= most_pixels) return;
  throw Error("an image of " + size_text(grid) + " is too large: it can have " + std::to_string(most) +
              " pixels along a side and " + std::to_string(most_pixels) +
              " in all; cut it into parts that overlap");
}

}  // namespace

ImageShape::ImageShape(const PixelGrid& grid)
    : width(grid.width()),
      height(grid.height()),
      depth(grid.depth()),
      is_volume(grid.has_voxels()),
      periodic_x(grid.periodic_x()),
      periodic_y(grid.periodic_y()),
      periodic_z(grid.periodic_z()) {}

ImageShape::ImageShape(const Grid& grid)
    : width((check_shape(grid), static_cast<int>(grid.width()))),
      height(static_cast<int>(grid.height())),
      depth(static_cast<int>(grid.depth())),
      is_volume(grid.is_volume()),
      periodic_x(grid.x().is_periodic()),
      periodic_y(grid.y().is_periodic()),
      periodic_z(grid.z().is_periodic()) {}

Kernel& mask_kernel(KernelSet& kernels, const Device& device, const char* name,
                    const KernelOptions& options) {
  const bool in_groups = device.tuning().shape == Shape::group;
  return kernels.get(device, in_groups ? "masks/group/transform.cl" : "masks/transform.cl", name,
                     PixelGrid(1, 1), options);
}

std::size_t Marks::shorts_of_row() const { return static_cast<std::size_t>(SHORTS_OF_ROW(shape.width)); }

void Marks::make_room() {
  if (counts() != nullptr) return;
  bits = allocate(device, shape.rows() * shorts_of_row() * sizeof(cl_ushort), "the marks of an image");
  counts = allocate(device, (2 * shape.rows() + 1) * word, "the marks of an image");
}

cl::Event Marks::mark(KernelSet& kernels, const cl::Buffer& pixels, PixelType type, Marked marked) {
  make_room();
  const bool has_sign = type == PixelType::float32 || type == PixelType::float64;
  const auto mark_by = [&](Kernel& kernel, std::size_t items) {
    return kernel.over_items(items, pixels, static_cast<cl_int>(bytes_of(type)), cl_int{has_sign},
                             cl_uint{marked == Marked::zeros ? 0u : 0xffffu}, shape.width,
                             static_cast<cl_int>(shape.rows()), bits, counts);
  };
  cl::Event first;
  if (device.tuning().shape == Shape::group) {
    first = fill(device, counts, cl_uint{0}, shape.rows());
    mark_by(mask_kernel(kernels, device, "mark_words"), shape.rows() * shorts_of_row());
  } else {
    first = mark_by(mask_kernel(kernels, device, "mark_pixels").in_groups_of(1),
                    std::min(items_of(device), shape.rows()));
  }
  is_summed_ = false;
  return first;
}

void Marks::sum(KernelSet& kernels) {
  if (is_summed_) return;
  const std::size_t items = device.tuning().shape == Shape::group ? device.tuning().patch_items : 1;
  mask_kernel(kernels, device, "sum_counts")
      .in_groups_of(items)
      .over_items(items, counts, static_cast<cl_int>(shape.rows()));
  is_summed_ = true;
}

void Marks::rank(KernelSet& kernels) {
  sum(kernels);
  const std::size_t words_of_row = shorts_of_row() * sizeof(cl_ushort) / sizeof(cl_ulong);
  if (starts() == nullptr)
    starts = allocate(device, shape.rows() * words_of_row * word, "the marks of an image");
  mask_kernel(kernels, device, "start_words")
      .over_items(shape.rows(), bits, counts, static_cast<cl_int>(shape.rows()),
                  static_cast<cl_int>(words_of_row), starts);
}

std::size_t Marks::count(KernelSet& kernels) {
  sum(kernels);
  cl_uint found = 0;
  check(clEnqueueReadBuffer(device.queue()(), counts(), CL_TRUE, shape.rows() * word, word, &found, 0,
                            nullptr, nullptr),
        "reading a buffer");
  return found;
}

namespace {

/// How the parts of a position lie in it.
struct PositionBits {
  explicit PositionBits(const PixelGrid& grid) {
    if (!grid.has_voxels()) return;
    const VoxelBits of_volume(grid);
    x = of_volume.x;
    y = of_volume.y;
  }
  int x = 16, y = 16;
};

}  // namespace

cl::Event Marks::paint(KernelSet& kernels, const PixelGrid& grid, const cl::Buffer& positions,
                       std::size_t seeds, const cl::Buffer& labels) {
  make_room();
  is_summed_ = false;
  const PositionBits bits_of_position(grid);
  if (device.tuning().shape == Shape::group) {
    cl::Event first = fill(device, bits, cl_ushort{0}, shape.rows() * shorts_of_row());
    fill(device, counts, cl_uint{0}, shape.rows());
    fill(device, labels, ~cl_uint{0}, shape.pixels());
    mask_kernel(kernels, device, "paint_pixels")
        .over_items(seeds, positions, static_cast<cl_uint>(seeds), shape.width, shape.height,
                    bits_of_position.x, bits_of_position.y, bits, counts, labels);
    return first;
  }
  return mask_kernel(kernels, device, "paint_seeds")
      .in_groups_of(1)
      .over_items(std::min(units_of(device), shape.rows()), positions, static_cast<cl_uint>(seeds),
                  shape.width, shape.height, static_cast<cl_int>(shape.rows()), bits_of_position.x,
                  bits_of_position.y, bits, counts, labels);
}

void Marks::list(KernelSet& kernels, const PixelGrid& grid, const cl::Buffer& positions) const {
  const PositionBits bits_of_position(grid);
  mask_kernel(kernels, device, "list_marks")
      .over_items(shape.rows() + 1, bits, counts, static_cast<cl_int>(shape.rows()),
                  static_cast<cl_int>(shorts_of_row()), shape.height, bits_of_position.x, bits_of_position.y,
                  cl_uint{grid.has_voxels() ? absent_voxel : absent_position}, positions);
}

}  // namespace vorocl
