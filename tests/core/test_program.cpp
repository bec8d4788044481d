// Programs: kernels from a folder, build options and dumps, as the environment says.
#define BOOST_TEST_MODULE program
#include <dlfcn.h>

#include <cstdlib>
#include <utility>

#include "brute_force.hpp"
#include "fixture.hpp"
#include "runtime/kernel_sources.hpp"
#include "runtime/program.hpp"
#include "temporary_folder.hpp"
#include "variable.hpp"

using namespace vorocl;

namespace {
bool other_driver = false;
bool build_fails_once = false;
}  // namespace

/// Stands before the OpenCL loader's function: another device has another driver's version, of the same
/// length.
extern "C" __attribute__((visibility("default"))) cl_int CL_API_CALL
clGetDeviceInfo(cl_device_id device, cl_device_info name, std::size_t size, void* value, std::size_t* used) {
  static const auto next = reinterpret_cast<decltype(&clGetDeviceInfo)>(dlsym(RTLD_NEXT, "clGetDeviceInfo"));
  const cl_int code = next(device, name, size, value, used);
  if (other_driver && name == CL_DRIVER_VERSION && value != nullptr) *static_cast<char*>(value) = '?';
  return code;
}

/// Fails as PoCL does where another process builds the same program.
extern "C" __attribute__((visibility("default"))) cl_int CL_API_CALL
clBuildProgram(cl_program program, cl_uint count, const cl_device_id* devices, const char* options,
               void(CL_CALLBACK* notify)(cl_program, void*), void* data) {
  static const auto next = reinterpret_cast<decltype(&clBuildProgram)>(dlsym(RTLD_NEXT, "clBuildProgram"));
  if (std::exchange(build_fails_once, false)) return CL_BUILD_PROGRAM_FAILURE;
  return next(program, count, devices, options, notify, data);
}

namespace {

const Grid grid(24, 16);
const std::vector<Pixel> pixels = random_pixels(grid, 5, 1);

/// The program of exact diagrams, and its first kernel.
bool is_in_groups() { return test_device().tuning().shape == Shape::group; }
std::string file_of_program() { return is_in_groups() ? "exact/group/diagram.cl" : "exact/diagram.cl"; }

/// The exact labels by a new device, whose programs are built anew.
std::vector<std::uint32_t> labels() {
  const Device device = Device::select();
  Diagram diagram(device, grid);
  exact_diagram(Seeds(device, grid, centres(pixels), to_centres), diagram);
  return diagram.read();
}

std::vector<std::uint32_t> true_labels() { return brute_force(grid, pixels, Metric::euclidean); }

/// Writes the embedded kernels into a folder.
void write_kernels(const TemporaryFolder& folder) {
  for (const auto& [file, source] : kernel_sources()) {
    std::filesystem::create_directories(std::filesystem::path(folder / file).parent_path());
    folder.file(file, source);
  }
}

}  // namespace

BOOST_AUTO_TEST_CASE(kernels_of_a_folder_replace_the_embedded_ones) {
  const TemporaryFolder folder;
  write_kernels(folder);
  const Variable variable("VOROCL_KERNEL_DIR", folder / "");
  BOOST_TEST((labels() == true_labels()));
  folder.file("core/position.cl", "#error position.cl of the folder\n");
  check_error([] { labels(); }, {"position.cl of the folder", file_of_program()});
}

BOOST_AUTO_TEST_CASE(a_kernel_that_is_not_in_the_folder_is_an_error) {
  const TemporaryFolder folder;
  write_kernels(folder);
  std::filesystem::remove(folder / "core/position.cl");
  const Variable variable("VOROCL_KERNEL_DIR", folder / "");
  check_error([] { labels(); }, {"core/position.cl", "VOROCL_KERNEL_DIR", "No such file"});
  std::filesystem::create_directory(folder / "core/position.cl");
  check_error([] { labels(); }, {"core/position.cl", "VOROCL_KERNEL_DIR", "Is a directory"});
  const Variable missing("VOROCL_KERNEL_DIR", "/no/such/folder");
  check_error([] { labels(); }, {"/no/such/folder/", "VOROCL_KERNEL_DIR", "No such file"});
}

BOOST_AUTO_TEST_CASE(an_empty_kernel_file_is_read_like_any_other) {
  const TemporaryFolder folder;
  write_kernels(folder);
  folder.file(file_of_program(), "");
  const Variable variable("VOROCL_KERNEL_DIR", folder / "");
  check_error([] { labels(); },
              {std::string("making the kernel ") + (is_in_groups() ? "find_repeats" : "count_chunks"),
               "no such kernel"});
}

BOOST_AUTO_TEST_CASE(build_options_of_the_environment) {
  const TemporaryFolder folder;
  write_kernels(folder);
  folder.file("core/position.cl",
              "#ifdef BROKEN\n#error BROKEN is defined\n#endif\n" + kernel_sources().at("core/position.cl"));
  const Variable kernels("VOROCL_KERNEL_DIR", folder / "");
  BOOST_TEST((labels() == true_labels()));
  const Variable options("VOROCL_BUILD_OPTIONS", "-DBROKEN");
  check_error([] { labels(); }, {"BROKEN is defined", "-DBROKEN"});
}

BOOST_AUTO_TEST_CASE(a_program_that_another_process_builds_too_is_built_again) {
  if (test_device().platform_name() != "Portable Computing Language") return;
  const Variable no_binaries("VOROCL_BINARY_CACHE", "0");
  build_fails_once = true;
  BOOST_TEST((labels() == true_labels()));
  BOOST_TEST(!build_fails_once);
}

BOOST_AUTO_TEST_CASE(programs_are_dumped) {
  const TemporaryFolder folder;
  {
    const Variable variable("VOROCL_DUMP_DIR", folder / "");
    BOOST_TEST((labels() == true_labels()));
  }
  std::string source;
  std::size_t sources = 0, binaries = 0;
  for (const std::string& name : folder.names()) {
    BOOST_TEST(!content_of(folder / name).empty());
    sources += name.find(".cl") != std::string::npos ? 1 : 0;
    binaries += name.find(".bin") != std::string::npos ? 1 : 0;
    if (name.rfind(is_in_groups() ? "exact-group-diagram-" : "exact-diagram-", 0) == 0 &&
        name.find(".cl") != std::string::npos)
      source = name;
  }
  BOOST_TEST(sources == binaries);
  BOOST_TEST_REQUIRE(source != "");

  // What was dumped can be edited and built: it has no #include left.
  BOOST_TEST(content_of(folder / source).find("#include") == std::string::npos);
  const TemporaryFolder kernels;
  write_kernels(kernels);
  kernels.file(file_of_program(), content_of(folder / source));
  const Variable variable("VOROCL_KERNEL_DIR", kernels / "");
  BOOST_TEST((labels() == true_labels()));
}

BOOST_AUTO_TEST_CASE(dumps_of_two_devices_have_two_names) {
  const TemporaryFolder folder;
  const Variable variable("VOROCL_DUMP_DIR", folder / "");
  labels();
  const std::size_t of_one = folder.names().size();
  other_driver = true;
  labels();
  other_driver = false;
  BOOST_TEST(folder.names().size() == 2 * of_one);
}

BOOST_AUTO_TEST_CASE(a_dump_that_cannot_be_written_is_an_error) {
  const Variable variable("VOROCL_DUMP_DIR", "/no/such/folder");
  check_error([] { labels(); }, {"/no/such/folder", "VOROCL_DUMP_DIR", "No such file"});
}
