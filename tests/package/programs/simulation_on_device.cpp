// A simulation on the device: points drift in a periodic box, and a kernel reads the areas of their cells.
// Until the end nothing comes to the host.
#include <iostream>
#include <numeric>
#include <random>
#include <vorocl/vorocl.hpp>

constexpr const char* kernels = R"(
kernel void drift(global double2* points, double2 way) { points[get_global_id(0)] += way; }
kernel void add_areas(global const uint* areas, global uint* sums) { sums[get_global_id(0)] += areas[get_global_id(0)]; }
)";

int main() {
  const vorocl::Device device = vorocl::Device::select();
  const cl::CommandQueue& queue = device.queue();
  constexpr std::size_t count = 100;
  std::mt19937 rng;
  std::uniform_real_distribution<double> anywhere(0, 10);
  std::vector<double> values(2 * count);
  for (double& value : values) value = anywhere(rng);
  const std::vector<cl_uint> zeros(count);
  const cl::Buffer points(queue, values.begin(), values.end(), false),
      all(queue, zeros.begin(), zeros.end(), false);
  cl::Program program(device.context(), kernels);
  program.build("-cl-std=CL1.2");
  cl::Kernel drift(program, "drift"), add(program, "add_areas");
  drift.setArg(0, points);
  drift.setArg(1, cl_double2{{0.37, -0.21}});
  add.setArg(1, all);

  const vorocl::Axis axis = vorocl::Axis(64, 0, 10).periodic();
  const vorocl::Grid box(axis, axis);
  const vorocl::PointBuffer buffer(points, count, vorocl::PointFormat::doubles_xy);
  vorocl::Seeds seeds(device, box, buffer);
  vorocl::Diagram diagram(device, box);
  vorocl::CellSumsResult cells;
  for (int frame = 0; frame < 50; ++frame) {
    queue.enqueueNDRangeKernel(drift, cl::NullRange, count);
    seeds.move_to(buffer);
    vorocl::exact_diagram(seeds, diagram);
    vorocl::cell_sums(diagram, cells);
    add.setArg(0, cells.area());
    queue.enqueueNDRangeKernel(add, cl::NullRange, count);
  }
  std::vector<cl_uint> sums(count);
  queue.enqueueReadBuffer(all, CL_TRUE, 0, count * sizeof(cl_uint), sums.data());
  std::cout << "areas of 50 frames: " << std::accumulate(sums.begin(), sums.end(), 0u) << " pixels\n";
}
