// Ends objects in every order and leaves some behind: for checkers that watch memory, and to see that nothing
// crashes. Prints nothing.
#include <memory>

#include "snapped_seeds.hpp"
#include "vorocl/vorocl.hpp"

using namespace vorocl;

namespace {

const std::vector<Point> points = {{1, 1}, {20, 9}, {7, 30}};
const Grid grid(40, 35);
const Tuning small = {1, 8, 1};  // small kernels: valgrind slows the driver's compiler down too

// These end after main(), in an order that nobody chooses.
std::unique_ptr<Device> last_device;
std::unique_ptr<Diagram> last_diagram;

struct Parts {
  std::unique_ptr<Device> device = std::make_unique<Device>(Device::select().with_tuning(small));
  std::unique_ptr<Seeds> seeds = std::make_unique<Seeds>(*device, grid, points);
  std::unique_ptr<Diagram> diagram = std::make_unique<Diagram>(*device, grid);
  std::unique_ptr<Report> report = std::make_unique<Report>(jump_flooding(*seeds, *diagram));

  void end(int which) {
    if (which == 0) device.reset();
    if (which == 1) seeds.reset();
    if (which == 2) diagram.reset();
    if (which == 3) report.reset();
  }
};

// Never deleted: work is still in flight when the program ends. (Volatile, or compilers drop it.)
Parts* volatile forgotten;

}  // namespace

int main() {
  // Each goes first once and last once, with the work still in flight; the diagram is read if it is there at
  // half time.
  for (int first = 0; first < 4; ++first) {
    Parts parts;
    for (int i = 0; i < 4; ++i) {
      parts.end((first + i) % 4);
      if (i == 1 && parts.diagram) parts.diagram->read();
    }
  }
  // The caller's own handles end before what adopted them, and the buffer before the diagram over it.
  Diagram adopted = [] {
    const cl::Device cl_device = Device::select().cl_device();
    const cl::Context context(cl_device);
    const Device device = Device(context, cl::CommandQueue(context, cl_device)).with_tuning(small);
    return Diagram(device, grid, cl::Buffer(context, CL_MEM_READ_WRITE, grid.pixels() * 4));
  }();
  jump_flooding(Seeds(adopted.device(), grid, points, to_centres), adopted);
  adopted.read();

  last_device = std::make_unique<Device>(Device::select().with_tuning(small));
  last_diagram = std::make_unique<Diagram>(*last_device, grid);
  jump_flooding(Seeds(*last_device, grid, points, to_centres), *last_diagram);

  forgotten = new Parts;
  jump_flooding(*forgotten->seeds, *forgotten->diagram);
}
