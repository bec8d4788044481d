// A mask that a kernel of the program's has made: each pixel of it that is set is a seed.
#include <iostream>
#include <vorocl/vorocl.hpp>

int main() {
  const vorocl::Device device = vorocl::Device::select();
  const cl::Program program(device.context(),
                            "kernel void every_16th(global uchar* mask) {"
                            "  mask[get_global_id(1) * 64 + get_global_id(0)] ="
                            "      get_global_id(0) % 16 == 7 && get_global_id(1) % 16 == 7; }");
  program.build();
  cl::Kernel kernel(program, "every_16th");
  const cl::Buffer mask(device.context(), CL_MEM_READ_WRITE, 64 * 64);
  kernel.setArg(0, mask);
  device.queue().enqueueNDRangeKernel(kernel, cl::NullRange, cl::NDRange(64, 64));

  const vorocl::Grid grid(64, 64);
  const vorocl::Seeds seeds = vorocl::Seeds::from_mask(device, grid, mask);
  vorocl::Diagram diagram(device, grid);
  vorocl::jump_flooding(seeds, diagram);
  std::cout << seeds.size() << " seeds; the last pixel is nearest to seed " << diagram.read().back() << '\n';
}
