#include "reference.hpp"

#include <fstream>
#include <map>
#include <sstream>
#include <utility>

#include "core/seeds_state.hpp"
#include "runtime/buffer.hpp"
#include "runtime/program.hpp"

namespace vorocl {

namespace {

std::string source_of_reference() {
  std::ostringstream text;
  text << std::ifstream(VOROCL_REFERENCE).rdbuf();
  return with_includes("reference.cl", text.str());
}

std::string options_for(const PixelGrid& grid, Metric metric) {
  return std::string("-cl-std=CL1.2 -DVOROCL_WIDTH=1 -DVOROCL_GUARD=0 -DVOROCL_NEIGHBOURS=9") +
         (metric == Metric::euclidean ? " -DVOROCL_EUCLIDEAN" : " -DVOROCL_MANHATTAN") +
         (grid.periodic_x() ? " -DVOROCL_PERIODIC_X" : "") +
         (grid.periodic_y() ? " -DVOROCL_PERIODIC_Y" : "");
}

/// Built once for each context and set of options. Never destroyed: at the end of the process a driver may be
/// gone before.
const cl::Program& program_for_reference(const Device& device, const std::string& options) {
  static auto& programs = *new std::map<std::pair<cl_context, std::string>, cl::Program>;
  const auto [found, is_new] = programs.try_emplace({device.context()(), options});
  if (is_new) {
    found->second = cl::Program(device.context(), source_of_reference());
    check(found->second.build(std::vector<cl::Device>{device.cl_device()}, options.c_str()),
          "building the reference");
  }
  return found->second;
}

}  // namespace

std::vector<std::uint32_t> reference_labels(const Seeds& seeds, Metric metric) {
  const Device& device = seeds.device();
  const PixelGrid grid{Window(seeds.grid())};
  const auto placement = Internal::state(seeds).frame()->place_in(seeds.grid(), grid);
  const cl::Buffer labels = allocate(device, grid.pixels() * sizeof(cl_uint), "the reference's labels");
  cl::Kernel kernel(program_for_reference(device, options_for(grid, metric)), "label_by_all_seeds");
  check(kernel.setArg(0, *placement->positions), "setting the reference's seeds");
  check(kernel.setArg(1, static_cast<cl_uint>(seeds.size())), "setting the reference's count");
  check(kernel.setArg(2, labels), "setting the reference's labels");
  check(kernel.setArg(3, cl_int{grid.width()}), "setting the reference's width");
  check(kernel.setArg(4, cl_int{grid.height()}), "setting the reference's height");
  // Always groups of one size: PoCL compiles a kernel again for each.
  const std::size_t group = device.tuning().group_width * device.tuning().group_height;
  const std::size_t items = (grid.pixels() + group - 1) / group * group;
  check(device.queue().enqueueNDRangeKernel(kernel, cl::NullRange, cl::NDRange(items), cl::NDRange(group)),
        "launching the reference");
  return download<std::uint32_t>(device, labels, grid.pixels());
}

}  // namespace vorocl
