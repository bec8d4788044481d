#include "measures/measurement.hpp"

#include <cmath>
#include <cstdint>

#include "runtime/buffer.hpp"
#include "runtime/opencl_info.hpp"

namespace vorocl {

namespace {

bool works_in_vectors(const Device& device) { return device.tuning().vector_width > 1; }

/// A CPU, which works in vectors, gets large blocks: few cells then lie in several. Each is a work-group, for
/// a group runs on one core. A GPU gets small blocks, for it needs thousands of work-items.
Device with_groups_for_blocks(const Device& device) {
  return works_in_vectors(device) ? device.with_tuning({device.tuning().vector_width, 1, 1}) : device;
}

/// The blocks of planes and of volumes.
constexpr cl_int4 plane_blocks_on_a_cpu = {{8, 7, 0, 0}}, plane_blocks_on_a_gpu = {{5, 3, 0, 0}};
constexpr cl_int4 blocks_on_a_cpu = {{6, 5, 5, 0}}, blocks_on_a_gpu = {{5, 2, 1, 0}};

cl_int4 bits_of_blocks(const Device& device, const PixelGrid& grid) {
  if (grid.has_voxels()) return works_in_vectors(device) ? blocks_on_a_cpu : blocks_on_a_gpu;
  return works_in_vectors(device) ? plane_blocks_on_a_cpu : plane_blocks_on_a_gpu;
}

/// Whether the home sums of a plane's block fit (see cells.cl): the pixels in 16 bits, their columns and
/// their rows in 24.
constexpr bool fits_home_sums(const cl_int4& bits) {
  const auto pixels = std::uint64_t{1} << (bits.s[0] + bits.s[1]);
  const auto most_columns = pixels * ((std::uint64_t{1} << bits.s[0]) - 1);
  const auto most_rows = pixels * ((std::uint64_t{1} << bits.s[1]) - 1);
  return pixels < 1u << 16 && most_columns < 1u << 24 && most_rows < 1u << 24;
}
static_assert(fits_home_sums(plane_blocks_on_a_cpu) && fits_home_sums(plane_blocks_on_a_gpu));

std::size_t blocks_along(int pixels, int bits) { return (static_cast<std::size_t>(pixels - 1) >> bits) + 1; }

}  // namespace

void make_room(cl::Buffer& buffer, const Device& device, std::size_t bytes) {
  if (buffer() != nullptr &&
      info<cl_context>(clGetMemObjectInfo, buffer(), CL_MEM_CONTEXT) == device.context()() &&
      size_of(buffer) >= bytes) {
    return;
  }
  buffer = cl::Buffer();
  buffer = allocate(device, bytes, "the measures of a diagram");
}

cl_int4 MeasuredDiagram::shifts_in_pixels() const {
  const Grid& of = window.grid();
  if (!of.is_tilted() || !grid.is_periodic()) return {};
  const auto in_pixels_of = [](std::int64_t shift) {
    return static_cast<cl_int>(std::floor(static_cast<double>(shift) / fractions_of_pixel + 0.5));
  };
  const Grid::Shifts exact = of.shifts();
  return {{in_pixels_of(exact.xy), in_pixels_of(exact.xz), in_pixels_of(exact.yz), 0}};
}

bool MeasuredDiagram::is_shifted() const {
  const cl_int4 all = shifts_in_pixels();
  return all.s[0] != 0 || all.s[1] != 0 || all.s[2] != 0;
}

const cl::Buffer& rows_behind(const MeasuredDiagram& diagram, KernelSet& kernels, const cl::Buffer& labels,
                              cl::Buffer& room) {
  if (!diagram.is_shifted()) return labels;
  const PixelGrid& grid = diagram.grid;
  const int rows = grid.depth() + (grid.periodic_z() ? grid.height() : 0);
  const std::size_t pixels = static_cast<std::size_t>(grid.width()) * static_cast<std::size_t>(rows);
  make_room(room, diagram.device, pixels * word);
  kernels.get(diagram.device, "measures/beyond.cl", "copy_rows_behind", grid)
      .over_items(pixels, labels, diagram.size(), diagram.shifts_in_pixels(), static_cast<cl_uint>(pixels),
                  room);
  return room;
}

MeasuredDiagram labels_of(const Diagram& diagram) {
  const DiagramState& state = Internal::state(diagram);
  MeasuredDiagram measured = {state.device, state.window, state.grid, nullptr, nullptr, Metric::euclidean};
  if (!state.contents) return measured;
  measured.seeds = state.contents->seeds;
  measured.placement = state.contents->placement;
  measured.metric = state.contents->metric;
  measured.points = state.contents->points;
  return measured;
}

MeasuredDiagram cells_of(const Diagram& diagram, OnGlobe on_globe) {
  MeasuredDiagram measured = labels_of(diagram);
  if (measured.seeds && measured.metric == Metric::great_circle && on_globe == OnGlobe::no) {
    throw Error(
        "a diagram of great circles has no such measure; it has cell_table(), cell_statistics(), "
        "adjacency(), vertices(), map_labels(), border_mask() and distance_field() of floats");
  }
  if (measured.seeds) return measured;
  throw Error(
      "the diagram knows no seeds to measure it by; run a method, or write labels with their seeds and "
      "metric");
}

Blocks::Blocks(const Device& device, const PixelGrid& grid)
    : device_(with_groups_for_blocks(device)),
      grid_(grid),
      bits_(bits_of_blocks(device, grid)),
      count_(blocks_along(grid.width(), bits_.s[0]) * blocks_along(grid.height(), bits_.s[1]) *
             blocks_along(grid.depth(), bits_.s[2])) {}

}  // namespace vorocl
