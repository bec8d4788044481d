// Points and labels in the program's own context, queue and buffers.
#include <algorithm>
#include <iostream>
#include <vorocl/vorocl.hpp>

int main() {
  const cl::Context context(CL_DEVICE_TYPE_ALL);
  const cl::CommandQueue queue(context);
  const std::vector<cl_float2> values = {{{1.5f, 1.5f}}, {{6.5f, 6.5f}}};
  const cl::Buffer points(queue, values.begin(), values.end(), true), labels(context, CL_MEM_READ_WRITE, 256);

  const vorocl::Device device(context, queue);
  const vorocl::Grid grid(8, 8);
  vorocl::Diagram diagram(device, grid, labels);
  vorocl::exact_diagram(vorocl::Seeds(device, grid, {points, 2}), diagram);

  std::vector<cl_uint> read(64);
  queue.enqueueReadBuffer(labels, CL_TRUE, 0, 256, read.data());
  std::cout << std::count(read.begin(), read.end(), 0u) << " pixels and "
            << std::count(read.begin(), read.end(), 1u) << '\n';
}
