// A program that owns its context, queues and buffers: its points and VoroCL's labels never leave the device.
// Built with several settings of the bindings, with their exceptions and without.
#include <cstdlib>
#include <vorocl/vorocl.hpp>

#include "nearest.hpp"

namespace {

constexpr int width = 120, height = 90;

/// The program's own use of the labels: how far each pixel is from its seed, squared.
const char* const own_source = R"(
kernel void distances(global const uint* labels, global const float2* points, global int* squares, int width) {
  const int x = get_global_id(0), y = get_global_id(1);
  const int2 d = convert_int2(points[labels[y * width + x]]) - (int2)(x, y);
  squares[y * width + x] = d.x * d.x + d.y * d.y;
}
)";

void require(bool right, const char* what) {
  if (right) return;
  std::cerr << "wrong: " << what << '\n';
  std::exit(1);
}

template <typename Function>
void require_error(Function function, const std::string& part) {
  try {
    function();
  } catch (const vorocl::Error& error) {
    require(std::string(error.what()).find(part) != std::string::npos, error.what());
    return;
  }
  require(false, "no vorocl::Error was thrown");
}

void draw(const cl::Context& context, const cl::Device& cl_device) {
  const cl::CommandQueue mine(context, cl_device), for_vorocl(context, cl_device);
  const std::vector<int> x = {5, 90, 40, 119, 60}, y = {7, 3, 80, 89, 45};
  std::vector<cl_float2> centres;
  for (std::size_t i = 0; i < x.size(); ++i) {
    centres.push_back({{static_cast<float>(x[i]) + 0.5f, static_cast<float>(y[i]) + 0.5f}});
  }
  const std::size_t pixels = width * height;
  const cl::Buffer points(context, CL_MEM_READ_ONLY, centres.size() * sizeof(cl_float2));
  const cl::Buffer labels(context, CL_MEM_READ_WRITE, pixels * sizeof(cl_uint));
  const cl::Buffer squares(context, CL_MEM_READ_WRITE, pixels * sizeof(cl_int));

  // An event to wait for ...
  cl::Event uploaded;
  mine.enqueueWriteBuffer(points, CL_FALSE, 0, centres.size() * sizeof(cl_float2), centres.data(), nullptr,
                          &uploaded);
  mine.flush();

  const vorocl::Device device(context, for_vorocl);
  const vorocl::Grid grid(width, height);
  device.wait_for({uploaded});
  const vorocl::Seeds seeds(device, grid, vorocl::PointBuffer(points, centres.size()),
                            {vorocl::Outside::refuse, vorocl::Snap::to_pixels});
  vorocl::Diagram diagram(device, grid, labels);
  const vorocl::Report report = vorocl::jump_flooding(seeds, diagram);
  require(diagram.labels()() == labels(), "the labels are in the program's buffer");

  // ... and one to return: the program's queue goes on from it.
  const cl::Program program(context, std::string(own_source));
  program.build();  // a constructor that builds would ask for OpenCL C 2.0, which not every device has
  cl::Kernel kernel(program, "distances");
  kernel.setArg(0, labels);
  kernel.setArg(1, points);
  kernel.setArg(2, squares);
  kernel.setArg(3, cl_int{width});
  const std::vector<cl::Event> done = {report.event()};
  mine.enqueueNDRangeKernel(kernel, cl::NullRange, cl::NDRange(width, height), cl::NullRange, &done);
  std::vector<cl_int> read_squares(pixels);
  std::vector<cl_uint> read_labels(pixels);
  mine.enqueueReadBuffer(squares, CL_TRUE, 0, pixels * sizeof(cl_int), read_squares.data());
  mine.enqueueReadBuffer(labels, CL_TRUE, 0, pixels * sizeof(cl_uint), read_labels.data());
  require(all_nearest(read_labels, width, height, x, y), "every label is the nearest seed's");
  require(read_squares[0] == 5 * 5 + 7 * 7, "the program's own kernel read the labels");
  require(read_labels == diagram.read(), "both queues see the same labels");

  // On the device's own queue no event is needed.
  const cl::Buffer squares_again(context, CL_MEM_READ_WRITE, pixels * sizeof(cl_int));
  cl::KernelFunctor<cl::Buffer, cl::Buffer, cl::Buffer, cl_int> distances(program, "distances");
  distances(cl::EnqueueArgs(device.queue(), cl::NDRange(width, height)), labels, points, squares_again,
            width);
  std::vector<cl_int> read_again(pixels);
  cl::copy(device.queue(), squares_again, read_again.begin(), read_again.end());
  require(read_again == read_squares, "the program's own kernel ran on the device's queue");

  require(report.milliseconds() == 0.0, "a queue without profiling has no times, and that is no error");
  const cl::Buffer small(context, CL_MEM_READ_WRITE, 16);
  require_error([&] { vorocl::Diagram(device, grid, small); }, "16 bytes");
  require_error([&] { vorocl::Device::select("no such device"); }, "no such device");
}

/// The bindings do in this program what its settings say, whatever the library does.
void check_own_bindings(const cl::Context& context, const cl::Device& cl_device) {
  const cl::CommandQueue queue(context, cl_device);
  const cl::Buffer buffer(context, CL_MEM_READ_WRITE, 16);
  char byte = 0;
#if defined(CL_HPP_ENABLE_EXCEPTIONS)
  try {
    queue.enqueueReadBuffer(buffer, CL_TRUE, 0, 17, &byte);
    require(false, "the program's own mistake throws a cl::Error");
  } catch (const cl::Error& error) {
    require(error.err() == CL_INVALID_VALUE, "the cl::Error has its code");
  }
#else
  require(queue.enqueueReadBuffer(buffer, CL_TRUE, 0, 17, &byte) == CL_INVALID_VALUE,
          "the program's own mistake gives a code");
#endif
}

}  // namespace

int main() {
  try {
    const cl::Device cl_device = vorocl::Device::select().cl_device();  // as good a way to find one as any
    const cl::Context context(cl_device);
    draw(context, cl_device);
    check_own_bindings(context, cl_device);
  } catch (const std::exception& error) {  // a cl::Error from inside VoroCL would come here too
    std::cerr << error.what() << '\n';
    return 1;
  }
}
