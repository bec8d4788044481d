// Devices: selection, adoption, tuning, and programs from several threads.
#define BOOST_TEST_MODULE device
#include <dlfcn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <optional>
#include <string>
#include <thread>

#include "brute_force.hpp"
#include "fixture.hpp"
#include "runtime/buffer.hpp"
#include "runtime/program.hpp"
#include "variable.hpp"

using namespace vorocl;

namespace {
std::size_t group_limit = 0;  // of each dimension; 0: the device's own
}

/// Stands before the OpenCL loader's function, and lowers the limits of a work-group's dimensions.
extern "C" __attribute__((visibility("default"))) cl_int CL_API_CALL
clGetDeviceInfo(cl_device_id device, cl_device_info name, std::size_t size, void* value, std::size_t* used) {
  static const auto next = reinterpret_cast<decltype(&clGetDeviceInfo)>(dlsym(RTLD_NEXT, "clGetDeviceInfo"));
  const cl_int code = next(device, name, size, value, used);
  if (name == CL_DEVICE_MAX_WORK_ITEM_SIZES && value != nullptr && group_limit > 0) {
    std::fill_n(static_cast<std::size_t*>(value), size / sizeof(std::size_t), group_limit);
  }
  return code;
}

BOOST_AUTO_TEST_CASE(selection_follows_the_request) {
  const std::vector<DeviceDescription> devices = Device::list();
  BOOST_REQUIRE(!devices.empty());
  int selected = 0;
  for (const DeviceDescription& device : devices) {
    selected += device.selected ? 1 : 0;
    BOOST_TEST(device.selected == !device.reason.empty());
    if (!device.why_not.empty()) continue;
    const std::string indices =
        std::to_string(device.platform_index) + ":" + std::to_string(device.device_index);
    BOOST_TEST(Device::select(indices).name() == device.name);
    BOOST_TEST(Device::select(indices).platform_name() == device.platform);
  }
  BOOST_TEST(selected == 1);
  check_error([] { Device::select("no such device"); }, {"no such device", devices.front().name, "0:0"});
}

BOOST_AUTO_TEST_CASE(the_environment_is_asked_before_the_librarys_own_order) {
  const char* const before = std::getenv("VOROCL_DEVICE");
  const std::string kept = before == nullptr ? "" : before;
  setenv("VOROCL_DEVICE", "something else", 1);
  check_error([] { Device::select(); }, {"something else"});
  const DeviceDescription first = Device::list("0:0").front();
  BOOST_TEST(Device::select("0:0").name() == first.name);  // and a request before the environment
  BOOST_TEST(first.asked_for);
  setenv("VOROCL_DEVICE", "0:0", 1);
  BOOST_TEST(Device::list().front().asked_for);
  setenv("VOROCL_DEVICE", "", 1);  // says nothing
  for (const DeviceDescription& device : Device::list()) BOOST_TEST(!device.asked_for);
  if (before == nullptr) {
    unsetenv("VOROCL_DEVICE");
  } else {
    setenv("VOROCL_DEVICE", kept.c_str(), 1);
  }
}

BOOST_AUTO_TEST_CASE(the_callers_context_and_queue_are_adopted) {
  const cl::Device cl_device = test_device().cl_device();
  const cl::Context context(cl_device);
  const cl::CommandQueue queue(context, cl_device);  // no profiling
  const Device device(context, queue);
  BOOST_TEST(device.queue()() == queue());
  const Grid grid(20, 10);
  Diagram diagram(device, grid);
  const Report report = jump_flooding(Seeds(device, grid, {{3, 4}}, to_centres), diagram);
  BOOST_TEST(diagram.read() == std::vector<std::uint32_t>(200, 0));
  BOOST_TEST(report.milliseconds() == 0.0);
}

BOOST_AUTO_TEST_CASE(what_cannot_be_adopted_is_refused) {
  const cl::Device cl_device = test_device().cl_device();
  const cl::Context context(cl_device), other(cl_device);
  check_error([&] { Device(cl::Context(), cl::CommandQueue(context, cl_device)); }, {"null"});
  check_error([&] { Device(context, cl::CommandQueue()); }, {"null"});
  check_error([&] { Device(other, cl::CommandQueue(context, cl_device)); }, {"another context"});
  const cl::CommandQueue out_of_order(context, cl_device, CL_QUEUE_OUT_OF_ORDER_EXEC_MODE_ENABLE);
  check_error([&] { Device(context, out_of_order); }, {"out of order"});
}

BOOST_AUTO_TEST_CASE(unfit_tunings_are_refused) {
  check_error([] { test_device().with_tuning({3, 8, 8}); }, {"vector width of 3"});
  check_error([] { test_device().with_tuning({32, 8, 8}); }, {"vector width of 32"});
  check_error([] { test_device().with_tuning({1, 0, 8}); }, {"0 x 8"});
  check_error([] { test_device().with_tuning({1, 1 << 20, 8}); }, {"1048576 x 8"});
  check_error([] { test_device().with_tuning({1, 8, 8, Shape::group, 48}); }, {"48", "32, 64, 128 or 256"});
  const std::size_t half_of_all = std::size_t{1} << 63;  // twice as many, and two more, are two
  check_error([&] { test_device().with_tuning({1, half_of_all + 1, 2}); }, {"9223372036854775809 x 2"});
}

BOOST_AUTO_TEST_CASE(work_groups_are_no_higher_than_the_device_allows) {
  group_limit = 4;
  const Device small = Device::select();
  group_limit = 0;
  check_error([&] { small.with_tuning({1, 1, 8}); }, {"1 x 8", "4 rows"});
  check_error([&] { small.with_tuning({1, 4, 2}); }, {"4 x 2", "4 work-items"});
  BOOST_TEST(small.with_tuning({1, 2, 2}).tuning().group_height == 2u);
  BOOST_TEST(small.tuning().group_width * small.tuning().group_height <= 4u);
}

BOOST_AUTO_TEST_CASE(seeds_and_diagrams_must_fit_together) {
  const Seeds seeds(test_device(), Grid(10, 20), {{1, 1}}, to_centres);
  Diagram other_grid(test_device(), Grid(20, 10));
  check_error([&] { jump_flooding(seeds, other_grid); }, {"10 x 20", "20 x 10"});
  Diagram other_units(test_device(), Grid(Axis(10, 0, 1), Axis(20)));
  check_error([&] { jump_flooding(seeds, other_units); }, {"10 x 20 pixels", "other stretches of the data"});
  Diagram other_device(Device::select(), Grid(10, 20));
  check_error([&] { jump_flooding(seeds, other_device); }, {"different devices"});
}

BOOST_AUTO_TEST_CASE(a_diagram_larger_than_the_device_is_refused) {
  const std::size_t largest = test_device().cl_device().getInfo<CL_DEVICE_MAX_MEM_ALLOC_SIZE>();
  const Grid grid(32768, 32768);
  if (grid.pixels() * 4 <= largest) return;  // nothing is too large for this device
  check_error([&] { Diagram(test_device(), grid); },
              {"too little device memory", "4096.0 MiB", "MiB in one buffer"});
}

BOOST_AUTO_TEST_CASE(working_memory_counts_what_is_held) {
  constexpr std::size_t mebibyte = 1 << 20;
  const std::size_t all = test_device().cl_device().getInfo<CL_DEVICE_GLOBAL_MEM_SIZE>();
  WorkingMemory memory(test_device(), "a test", all - 3 * mebibyte);
  cl::Buffer one, other;
  memory.reserve(one, mebibyte);
  memory.reserve(one, 2 * mebibyte);  // in place of the first
  const cl_mem kept = one();
  memory.reserve(one, mebibyte);
  BOOST_TEST((one() == kept));
  memory.reserve(other, mebibyte);
  check_error([&] { memory.reserve(one, 3 * mebibyte); },
              {"too little device memory for a test: it needs 3.0 MiB besides the ", " MiB in use"});
}

BOOST_AUTO_TEST_CASE(a_build_failure_shows_device_options_and_log) {
  // A vector width that does not exist makes the kernel's types unknown. NVIDIA's log has no names of files.
  const bool names_files = test_device().platform_name() != "NVIDIA CUDA";
  check_error(
      [] {
        program_for(test_device(), "flooding/jump_flooding.cl",
                    "-DVOROCL_WIDTH=5 -DVOROCL_GUARD=16 -DVOROCL_EUCLIDEAN");
      },
      {"flooding/jump_flooding.cl", test_device().name(), "-DVOROCL_WIDTH=5",
       names_files ? "vector.cl:" : "<kernel>:", "uint5"});
}

BOOST_AUTO_TEST_CASE(threads_may_share_a_device_or_own_one) {
  const Grid grid(130, 70);
  const auto pixels = random_pixels(grid, 40, 5);
  const auto ground_truth = brute_force(grid, pixels, Metric::manhattan);
  const Device shared = Device::select();  // nothing built yet
  std::vector<std::vector<std::uint32_t>> labels(8);
  std::vector<std::thread> threads;
  for (std::size_t i = 0; i < labels.size(); ++i) {
    threads.emplace_back([&, i] {
      const Device device = i % 2 == 0 ? shared : Device::select();
      Diagram diagram(device, grid);
      standard_flooding(Seeds(device, grid, centres(pixels), to_centres), diagram, {Metric::manhattan});
      labels[i] = diagram.read();
    });
  }
  for (std::thread& thread : threads) thread.join();
  for (const auto& image : labels) BOOST_TEST((image == ground_truth));
}

// It has none of the driver's threads, and would wait without end for them and for what they held.
BOOST_AUTO_TEST_CASE(a_forked_child_is_refused_at_once) {
  const Device device = Device::select();
  const Grid grid(40, 30);
  Seeds seeds(device, grid, {{1, 2}, {30, 20}}, to_centres);
  Diagram diagram(device, grid);
  // The driver compiles while the process forks: no other process has had this option.
  std::optional<Variable> options(std::in_place, "VOROCL_BUILD_OPTIONS",
                                  "-DVOROCL_OF_PROCESS=" + std::to_string(getpid()));
  const Report report = exact_diagram(seeds, diagram);
  options.reset();
  seeds.move_to({{3, 4}, {20, 20}});
  const pid_t child = fork();
  if (child == 0) {
    alarm(20);
    int refused = 0;
    const auto refuses = [&refused](const auto& call) {
      try {
        call();
      } catch (const Error& error) {
        const bool says = std::string(error.what()).find("spawn or forkserver") != std::string::npos;
        refused += says && error.kind() == ErrorKind::device ? 1 : 0;
      }
    };
    refuses([] { Device::select(); });
    refuses([&] { exact_diagram(seeds, diagram); });
    refuses([&] { Seeds::random(device, grid, 9, 1); });
    refuses([&] { static_cast<void>(diagram.read()); });
    refuses([&] { device.finish(); });
    refuses([&] { seeds.move_to({{5, 6}, {20, 20}}); });
    refuses([&] { static_cast<void>(report.milliseconds()); });
    _exit(refused);
  }
  int status = 0;
  waitpid(child, &status, 0);
  BOOST_TEST(WIFEXITED(status));
  BOOST_TEST(WEXITSTATUS(status) == 7);
}
