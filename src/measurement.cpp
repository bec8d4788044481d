#include "measurement.hpp"

#include "buffer.hpp"
#include "opencl_info.hpp"
#include "seeds_state.hpp"

namespace vorocl {

namespace {

bool works_in_vectors(const Device& device) { return device.tuning().vector_width > 1; }

/// A CPU, which works in vectors, gets large blocks: few cells then lie in several. Each is a work-group, for
/// a group runs on one core. A GPU gets small blocks, for it needs thousands of work-items.
Device with_groups_for_blocks(const Device& device) {
  return works_in_vectors(device) ? device.with_tuning({device.tuning().vector_width, 1, 1}) : device;
}
int bits_of_width(const Device& device) { return works_in_vectors(device) ? 8 : 5; }
int bits_of_height(const Device& device) { return works_in_vectors(device) ? 7 : 3; }

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

void MeasuredFrames::check() const {
  if (seeds) seeds->check();
  if (labels) labels->check();
}

MeasuredFrames frames_of(const Diagram& diagram) {
  const std::optional<DiagramContents>& contents = Internal::state(diagram).contents;
  return {nullptr, contents ? contents->seeds : nullptr};
}

MeasuredFrames frames_of(const Seeds& seeds, const Diagram& diagram) {
  Internal::state(diagram).check_fits(seeds);
  MeasuredFrames frames = frames_of(diagram);
  frames.seeds = Internal::state(seeds).frame();
  return frames;
}

Blocks::Blocks(const Device& device, const Grid& grid)
    : device_(with_groups_for_blocks(device)),
      grid_(grid),
      wide_(bits_of_width(device)),
      high_(bits_of_height(device)),
      count_(blocks_along(grid.width(), wide_) * blocks_along(grid.height(), high_)) {}

Report report_of(const Stopwatch& stopwatch, const Device& device, const cl::Event& first,
                 const cl::Event& last) {
  check(clFlush(device.queue()()), "starting a measurement");
  return {0, first, last, stopwatch.milliseconds()};
}

}  // namespace vorocl
