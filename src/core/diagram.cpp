#include "vorocl/diagram.hpp"

#include <string>
#include <utility>

#include "core/diagram_state.hpp"
#include "core/seeds_state.hpp"
#include "runtime/buffer.hpp"
#include "runtime/opencl_info.hpp"

namespace vorocl {

namespace {

std::size_t bytes_of(const Grid& grid) { return grid.pixels() * sizeof(std::uint32_t); }

std::string size_text(const Grid& grid) {
  const char* const periodic[] = {"", ", periodic in x", ", periodic in y", ", periodic in x and y"};
  return std::to_string(grid.width()) + " x " + std::to_string(grid.height()) +
         periodic[static_cast<int>(grid.periodic())];
}

}  // namespace

// --- what a diagram holds ---

DiagramState::DiagramState(const Device& device_of_diagram, const Grid& grid_of_diagram,
                           const cl::Buffer& label_image)
    : device(device_of_diagram),
      grid(grid_of_diagram),
      labels(label_image),
      held_(bytes_of(grid_of_diagram)) {}

void DiagramState::reserve(cl::Buffer& buffer, std::size_t bytes) {
  const std::size_t present = buffer() == nullptr ? 0 : size_of(buffer);
  if (present > 0 && present >= bytes) return;
  held_ -= present;
  buffer = cl::Buffer();
  buffer = allocate(device, bytes, "a diagram's working memory", held_);
  held_ += size_of(buffer);
}

void DiagramState::check_fits(const Seeds& seeds) const {
  if (!seeds.device().same_as(device)) throw Error("the seeds and the diagram belong to different devices");
  if (seeds.grid() != grid) {
    throw Error("the seeds' grid is " + size_text(seeds.grid()) + ", the diagram's " + size_text(grid));
  }
}

template <typename Then>
void DiagramState::wait_and(Then then) {
  try {
    device.finish();
    if (contents && contents->last() != nullptr &&
        info<cl_int>(clGetEventInfo, contents->last(), CL_EVENT_COMMAND_EXECUTION_STATUS) < 0) {
      throw Error(device.name() + " failed to fill a diagram; its driver may have said more",
                  ErrorKind::device);
    }
    if (contents && contents->seeds) contents->seeds->check();
    then();
  } catch (const BadPoint&) {
    throw;  // the device has not failed
  } catch (...) {
    contents.reset();
    throw;
  }
}

void DiagramState::wait() {
  wait_and([] {});
}

void DiagramState::read(std::uint32_t* to) {
  wait_and([&] { download(device, labels, grid.pixels(), to); });
}

Filling::Filling(const Seeds& seeds, Diagram& diagram)
    : diagram_(Internal::state(diagram)), previous_(std::exchange(diagram_.contents, std::nullopt)) {
  diagram_.check_fits(seeds);
  seeds_ = Internal::state(seeds).frame();
}

Report Filling::commit(int waves, const cl::Event& first, const cl::Event& last, int age, bool far_counted,
                       const FloodStart& start) {
  check(clFlush(diagram_.device.queue()()), "starting the diagram");
  diagram_.contents = DiagramContents{seeds_, age, last, far_counted};
  return {waves, first, last, stopwatch_.milliseconds(), start};
}

// --- Diagram ---

Diagram::Diagram(const Device& device, const Grid& grid)
    : state_(
          std::make_unique<DiagramState>(device, grid, allocate(device, bytes_of(grid), "the label image"))) {
  fill(device, labels(), no_label, grid.pixels());
}

Diagram::Diagram(const Device& device, const Grid& grid, const cl::Buffer& labels) {
  check_foreign_buffer(device, labels, bytes_of(grid), "the buffer of labels", Access::read_and_write);
  state_ = std::make_unique<DiagramState>(device, grid, labels);
}

Diagram::~Diagram() = default;
Diagram::Diagram(Diagram&& other) noexcept = default;
Diagram& Diagram::operator=(Diagram&& other) noexcept = default;

DiagramState& Diagram::state() const {
  if (!state_) throw Error("this diagram was moved from, and has no labels; use the one it was moved to");
  return *state_;
}

const Device& Diagram::device() const { return state().device; }
const Grid& Diagram::grid() const { return state().grid; }
const cl::Buffer& Diagram::labels() const { return state().labels; }

void Diagram::write(const std::vector<std::uint32_t>& labels) {
  if (labels.size() != grid().pixels()) {
    throw Error("there are " + std::to_string(labels.size()) + " labels to write, and the diagram has " +
                std::to_string(grid().pixels()) + " pixels");
  }
  state().contents.reset();
  upload(device(), this->labels(), labels);
  state().contents.emplace();
}

void Diagram::write(const cl::Buffer& labels) {
  check_foreign_buffer(device(), labels, bytes_of(grid()), "the buffer of labels to write", Access::read);
  if (labels() == this->labels()())
    throw Error("the buffer of labels to write is the diagram's own, which holds them already");
  if (overlap(labels, this->labels(), bytes_of(grid()))) {
    throw Error("the buffer of labels to write overlaps with the diagram's own; write them from another one");
  }
  state().contents.reset();
  const cl::Event copied = copy(device(), labels, this->labels(), bytes_of(grid()));
  state().contents = DiagramContents{nullptr, 0, copied};
}

std::vector<std::uint32_t> Diagram::read() const {
  std::vector<std::uint32_t> labels(grid().pixels());
  read(labels.data());
  return labels;
}

void Diagram::read(std::uint32_t* labels) const { state().read(labels); }

void Diagram::wait() const { state().wait(); }

}  // namespace vorocl
