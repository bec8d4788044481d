#include "vorocl/diagram.hpp"

#include <string>
#include <utility>

#include "core/diagram_state.hpp"
#include "core/seeds_state.hpp"
#include "globe/globe.hpp"
#include "runtime/buffer.hpp"
#include "runtime/metric.hpp"
#include "runtime/opencl_info.hpp"

namespace vorocl {

namespace {

std::size_t bytes_of(const PixelGrid& grid) { return grid.pixels() * sizeof(std::uint32_t); }

/// Why seeds of one grid are not of another.
std::string difference(const Grid& seeds, const Grid& diagram) {
  const std::string one = size_text(seeds), other = size_text(diagram);
  if (one != other) return "the seeds' grid is " + one + ", the diagram's " + other;
  return "the seeds' grid and the diagram's have " + one +
         " pixels, but show other stretches of the data; make both of one grid";
}

}  // namespace

// --- what a diagram holds ---

DiagramState::DiagramState(const Device& device_of_diagram, const Window& window_of_diagram,
                           const cl::Buffer& label_image)
    : device(device_of_diagram),
      window(window_of_diagram),
      grid(window_of_diagram),
      labels(label_image),
      memory(device, "a diagram's working memory", bytes_of(grid)),
      own_labels_(label_image) {}

DiagramState::~DiagramState() { leave_host(); }

void DiagramState::leave_host() noexcept {
  if (host_ == nullptr) return;
  try {
    device.finish();
  } catch (const Error&) {  // of commands whose callers hear of it where they wait
  }
  labels = cl::Buffer();
  host_ = nullptr;
}

void DiagramState::put_labels_at(std::uint32_t* memory) {
  contents.reset();
  ++*fills;
  leave_host();
  if (memory != nullptr && shares_memory(device)) {
    labels = buffer_at(device, memory, bytes_of(grid), "the label image");
    host_ = memory;
  } else {
    if (own_labels_() == nullptr) own_labels_ = allocate(device, bytes_of(grid), "the label image");
    labels = own_labels_;
  }
}

std::shared_ptr<const Placement> DiagramState::place(const Seeds& seeds, Metric metric) const {
  if (!seeds.device().same_as(device)) throw Error("the seeds and the diagram belong to different devices");
  if (seeds.grid() != window.grid()) throw Error(difference(seeds.grid(), window.grid()));
  if (metric == Metric::great_circle) check_globe(window.grid());
  return Internal::state(seeds).frame()->place_in(window, grid);
}

std::shared_ptr<const PointPlacement> DiagramState::place_points(const SeedsFrame& frame,
                                                                 Metric metric) const {
  return metric == Metric::great_circle ? place_on_globe(window, grid, frame)
                                        : frame.place_points_in(window, grid);
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
  wait_and([&] {
    to == host_ ? synchronise(device, labels, bytes_of(grid)) : download(device, labels, grid.pixels(), to);
  });
}

Filling::Filling(const Seeds& seeds, Diagram& diagram, Metric metric, const char* method)
    : diagram_(Internal::state(diagram)), previous_(std::exchange(diagram_.contents, std::nullopt)) {
  ++*diagram_.fills;
  if (method != std::string_view("exact")) refuse_great_circles(metric, method);
  next_.metric = checked(metric);
  next_.seeds = Internal::state(seeds).frame();
  if (next_.seeds->lags()) {
    if (method != std::string_view("exact"))
      refuse_weights(*next_.seeds, std::string("the method ") + method);
    if (metric != Metric::euclidean) refuse_weights(*next_.seeds, "a metric that is not Euclidean");
    if (!next_.seeds->is_off_centre)
      throw Error("weights are those of the points themselves, and these seeds are snapped to pixels");
  }
  next_.placement = diagram_.place(seeds, metric);
  next_.method = method;
}

const PointPlacement& Filling::take_places() {
  next_.points = diagram_.place_points(seeds(), next_.metric);
  return *next_.points;
}

Kernel& Filling::kernel(const char* file, const char* name, Neighbourhood neighbourhood) {
  return diagram_.kernels.get(diagram_.device, file, name, placement().grid, {next_.metric, neighbourhood});
}

Kernel& Filling::kernel(const Device& device, const char* file, const char* name) {
  return diagram_.kernels.get(device, file, name, placement().grid, {next_.metric});
}

Report Filling::commit(int waves, const cl::Event& first, const cl::Event& last, int age,
                       const FloodStart& start) {
  check(clFlush(diagram_.device.queue()()), "starting the diagram");
  next_.last = last;
  next_.age = age;
  diagram_.contents = next_;
  const bool snapped = next_.seeds->is_off_centre && !next_.points;
  return Internal::report(waves, first, last, stopwatch_.milliseconds(), first_launches_.take(), start,
                          snapped);
}

// --- Diagram ---

Diagram::Diagram(const Device& device, const Window& window)
    : state_(make_state<DiagramState>(device, window,
                                      allocate(device, bytes_of(PixelGrid(window)), "the label image"))) {
  fill(device, labels(), no_label, state_->grid.pixels());
}

Diagram::Diagram(const Device& device, const Window& window, const cl::Buffer& labels) {
  check_foreign_buffer(device, labels, bytes_of(PixelGrid(window)), "the buffer of labels",
                       Access::read_and_write);
  state_ = make_state<DiagramState>(device, window, labels);
}

Diagram::Diagram(const Device& device, const Window& window, std::uint32_t* labels) {
  if (labels == nullptr) throw Error("the host's memory for labels is null");
  state_ = make_state<DiagramState>(device, window, cl::Buffer());
  state_->put_labels_at(labels);
}

DiagramState& Diagram::state() const {
  if (!state_) throw Error("this diagram was moved from, and has no labels; use the one it was moved to");
  return *state_;
}

const Device& Diagram::device() const { return state().device; }
const Window& Diagram::window() const { return state().window; }
const cl::Buffer& Diagram::labels() const { return state().labels; }

Metric Diagram::metric() const {
  const std::optional<DiagramContents>& contents = state().contents;
  if (!contents || !contents->seeds) {
    throw Error(
        "the diagram has no metric, because no method has filled it; run one, or write labels with "
        "their seeds and metric");
  }
  return contents->metric;
}

const std::string& Diagram::method() const {
  static const std::string none;
  return state().contents ? state().contents->method : none;
}

namespace {

/// What labels of the caller's are, which name no seeds or these.
DiagramContents written() { return {}; }
DiagramContents written(const DiagramState& state, const Seeds& seeds, Metric metric) {
  DiagramContents contents;
  contents.metric = checked(metric);
  contents.placement = state.place(seeds, metric);
  contents.seeds = Internal::state(seeds).frame();
  if (contents.seeds->are_points() || contents.placement->goes_beyond || metric == Metric::great_circle)
    contents.points = state.place_points(*contents.seeds, metric);
  return contents;
}

void write_labels(DiagramState& state, const std::vector<std::uint32_t>& labels, DiagramContents&& contents) {
  if (labels.size() != state.grid.pixels()) {
    throw Error("there are " + std::to_string(labels.size()) + " labels to write, and the diagram has " +
                std::to_string(state.grid.pixels()) + " pixels");
  }
  state.contents.reset();
  ++*state.fills;
  upload(state.device, state.labels, labels);
  state.contents = std::move(contents);
}

void write_labels(DiagramState& state, const cl::Buffer& labels, DiagramContents&& contents) {
  const std::size_t bytes = bytes_of(state.grid);
  check_foreign_buffer(state.device, labels, bytes, "the buffer of labels to write", Access::read);
  if (labels() == state.labels())
    throw Error("the buffer of labels to write is the diagram's own, which holds them already");
  if (overlap(labels, state.labels, bytes)) {
    throw Error("the buffer of labels to write overlaps with the diagram's own; write them from another one");
  }
  state.contents.reset();
  ++*state.fills;
  contents.last = copy(state.device, labels, state.labels, bytes);
  state.contents = std::move(contents);
}

}  // namespace

void Diagram::write(const std::vector<std::uint32_t>& labels) { write_labels(state(), labels, written()); }

void Diagram::write(const std::vector<std::uint32_t>& labels, const Seeds& seeds, Metric metric) {
  write_labels(state(), labels, written(state(), seeds, metric));
}

void Diagram::write(const cl::Buffer& labels) { write_labels(state(), labels, written()); }

void Diagram::write(const cl::Buffer& labels, const Seeds& seeds, Metric metric) {
  write_labels(state(), labels, written(state(), seeds, metric));
}

std::vector<std::uint32_t> Diagram::read() const {
  std::vector<std::uint32_t> labels(state().grid.pixels());
  read(labels.data());
  return labels;
}

void Diagram::read(std::uint32_t* labels) const { state().read(labels); }

void Diagram::put_labels_at(std::uint32_t* labels) { state().put_labels_at(labels); }

void Diagram::wait() const { state().wait(); }

}  // namespace vorocl
