#include <map>
#include <string>

#include "studies/ablation.hpp"
#include "trials/samples.hpp"
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

/// Lets the diagram's labels go through the waves, each scattered in place.
Report scatter(const cl::Program& program, const Seeds& seeds, Diagram& diagram, const Plan& plan,
               Stamping stamping) {
  const Stopwatch host;
  const Grid& grid = diagram.grid();
  const cl::Buffer &labels = diagram.labels(), &positions = seeds.positions();
  const auto count = static_cast<cl_uint>(seeds.size());
  const cl_int width = grid.width(), height = grid.height();
  cl::Event first, last;
  if (stamping == Stamping::seeds) {
    const std::size_t items[] = {seeds.size()};
    first = enqueue(seeds.device(), kernel_of(program, "stamp_labels", labels, positions, count, width), 1,
                    items);
  }
  for (const Wave& wave : plan) {
    const std::size_t items[] = {static_cast<std::size_t>(width), static_cast<std::size_t>(height)};
    const cl_int step = wave.step, stride = wave.neighbourhood == Neighbourhood::moore ? 1 : 2;
    last =
        enqueue(seeds.device(),
                kernel_of(program, "scatter_in_place", labels, positions, count, width, height, step, stride),
                2, items);
    if (first() == nullptr) first = last;
  }
  return {static_cast<int>(plan.size()), first, last, host.milliseconds()};
}

}  // namespace

Simulation::Engine in_place_scatter(const Device& device, Stamping stamping) {
  // A copy of the engine counts its own frames.
  return [program = build(device), stamping, frame = 0](const Seeds& seeds, Diagram& diagram,
                                                        double max_displacement) mutable {
    if (frame++ == 0) return jump_flooding(seeds, diagram);
    return scatter(program, seeds, diagram,
                   dynamic_jump_flooding_plan(diagram.grid(), seeds.alive(), max_displacement), stamping);
  };
}

}  // namespace command
}  // namespace vorocl
