#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "studies/ablation.hpp"
#include "vorocl/error.hpp"
#include "vorocl/jump_flooding.hpp"
#include "vorocl/plan.hpp"

namespace vorocl {

/// Written at build time, from in_place_scatter.cl.
const std::map<std::string, std::string>& evaluation_kernel_sources();

namespace command {

namespace {

void check(cl_int code, const std::string& what) {
  if (code != CL_SUCCESS) throw Error(what + " failed (OpenCL error " + std::to_string(code) + ")");
}

cl::Program build(const Device& device) {
  const char* text = evaluation_kernel_sources().at("in_place_scatter.cl").c_str();
  const cl_device_id id = device.cl_device()();
  cl_int code = CL_SUCCESS;
  cl::Program program(clCreateProgramWithSource(device.context()(), 1, &text, nullptr, &code));
  check(code, "making the program in_place_scatter.cl");
  check(clBuildProgram(program(), 1, &id, "-cl-std=CL1.2", nullptr, nullptr),
        "building in_place_scatter.cl for " + device.name());
  return program;
}

cl_int set_argument(const cl::Kernel& kernel, cl_uint index, const cl::Buffer& buffer) {
  return clSetKernelArg(kernel(), index, sizeof(cl_mem), &buffer());
}

template <typename T>
cl_int set_argument(const cl::Kernel& kernel, cl_uint index, const T& value) {
  return clSetKernelArg(kernel(), index, sizeof value, &value);
}

/// A kernel of the program, with its arguments.
template <typename... Arguments>
cl::Kernel kernel_of(const cl::Program& program, const char* name, const Arguments&... arguments) {
  cl_int code = CL_SUCCESS;
  cl::Kernel kernel(clCreateKernel(program(), name, &code));
  check(code, std::string("making the kernel ") + name);
  cl_uint index = 0;
  (check(set_argument(kernel, index++, arguments), "setting an argument"), ...);
  return kernel;
}

cl::Event enqueue(const Device& device, const cl::Kernel& kernel, cl_uint dimensions,
                  const std::size_t* items) {
  cl::Event event;
  check(clEnqueueNDRangeKernel(device.queue()(), kernel(), dimensions, nullptr, items, nullptr, 0, nullptr,
                               &event()),
        "launching a kernel of in_place_scatter.cl");
  return event;
}

cl::Buffer allocate(const Device& device, std::size_t words) {
  cl_int code = CL_SUCCESS;
  cl::Buffer buffer(
      clCreateBuffer(device.context()(), CL_MEM_READ_WRITE, words * sizeof(cl_uint), nullptr, &code));
  check(code, "allocating " + std::to_string(words) + " words");
  return buffer;
}

/// What the kernels know of seeds: row << 16 | column of each, and behind them a seed that is not there.
std::vector<cl_uint> packed_positions(const Seeds& seeds) {
  constexpr cl_uint empty_bit = 0x80000000u;
  std::vector<cl_uint> positions;
  for (const std::optional<Point>& pixel : seeds.read_pixels()) {
    positions.push_back(pixel ? static_cast<cl_uint>(pixel->y) << 16 | static_cast<cl_uint>(pixel->x)
                              : empty_bit);
  }
  positions.push_back(empty_bit);
  return positions;
}

/// The labels that go through the waves from frame to frame, each scattered in place: apart from the diagram,
/// which is told of them when they are made.
class Scatter {
 public:
  Scatter(const Device& device, Stamping stamping, std::shared_ptr<ScatterRecord> record)
      : program_(build(device)), stamping_(stamping), record_(std::move(record)) {}

  void begin(const Seeds& seeds, const Diagram& diagram) {
    const std::size_t pixels = diagram.window().pixels();
    labels_ = allocate(seeds.device(), pixels);
    positions_ = allocate(seeds.device(), seeds.size() + 1);
    check(clEnqueueCopyBuffer(seeds.device().queue()(), diagram.labels()(), labels_(), 0, 0,
                              pixels * sizeof(cl_uint), 0, nullptr, nullptr),
          "copying labels");
  }

  void run(const Seeds& seeds, Diagram& diagram, const Plan& plan) const {
    const Device& device = seeds.device();
    const std::vector<cl_uint> positions = packed_positions(seeds);
    check(clEnqueueWriteBuffer(device.queue()(), positions_(), CL_TRUE, 0, positions.size() * sizeof(cl_uint),
                               positions.data(), 0, nullptr, nullptr),
          "copying the seeds' pixels");
    const auto count = static_cast<cl_uint>(seeds.size());
    const auto width = static_cast<cl_int>(diagram.window().width()),
               height = static_cast<cl_int>(diagram.window().height());
    cl::Event first, last;
    if (stamping_ == Stamping::seeds) {
      const std::size_t items[] = {seeds.size()};
      first =
          enqueue(device, kernel_of(program_, "stamp_labels", labels_, positions_, count, width), 1, items);
    }
    for (const Wave& wave : plan) {
      const std::size_t items[] = {static_cast<std::size_t>(width), static_cast<std::size_t>(height)};
      const cl_int step = wave.step, stride = wave.neighbourhood == Neighbourhood::moore ? 1 : 2;
      last = enqueue(
          device,
          kernel_of(program_, "scatter_in_place", labels_, positions_, count, width, height, step, stride), 2,
          items);
      if (first() == nullptr) first = last;
    }
    record_->add(static_cast<int>(plan.size()), first, last);
    diagram.write(labels_, seeds, Metric::euclidean);
  }

 private:
  cl::Program program_;
  Stamping stamping_;
  std::shared_ptr<ScatterRecord> record_;
  cl::Buffer labels_, positions_;
};

cl_ulong time_of(const cl::Event& event, cl_profiling_info what) {
  cl_ulong nanoseconds = 0;
  check(clGetEventProfilingInfo(event(), what, sizeof nanoseconds, &nanoseconds, nullptr),
        "asking for the time of a wave");
  return nanoseconds;
}

}  // namespace

void ScatterRecord::add(int waves, const cl::Event& first, const cl::Event& last) {
  waves_ = waves;
  if (last() != nullptr) frames_.emplace_back(first, last);
}

double ScatterRecord::take_milliseconds() {
  double all = 0;
  for (const auto& [first, last] : frames_) {
    check(clWaitForEvents(1, &last()), "waiting for a frame");
    all += static_cast<double>(time_of(last, CL_PROFILING_COMMAND_END) -
                               time_of(first, CL_PROFILING_COMMAND_START)) *
           1e-6;
  }
  frames_.clear();
  return all;
}

Simulation::Engine in_place_scatter(const Device& device, Stamping stamping,
                                    const std::shared_ptr<ScatterRecord>& record) {
  // A copy of the engine counts its own frames and, from the first one on, has its own labels.
  return
      [scatter = Scatter(device, stamping, record), frame = 0](const Seeds& seeds, Diagram& diagram) mutable {
        if (frame++ == 0) {
          Report report = jump_flooding(seeds, diagram);
          scatter.begin(seeds, diagram);
          return report;
        }
        scatter.run(seeds, diagram,
                    dynamic_jump_flooding_plan(diagram.window(), seeds.alive(), seeds.displacement()));
        return Report();
      };
}

}  // namespace command
}  // namespace vorocl
