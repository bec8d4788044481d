// Binaries that processes keep for each other: found where they are right, built anew where anything is
// wrong, and the device's time without that of the compiler.
#define BOOST_TEST_MODULE binary_cache
#include <dlfcn.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <map>
#include <thread>

#include "brute_force.hpp"
#include "fixture.hpp"
#include "runtime/binary_cache.hpp"
#include "runtime/opencl_info.hpp"
#include "runtime/program.hpp"
#include "temporary_folder.hpp"

using namespace vorocl;

namespace {

int builds_from_source = 0;
bool compiler_is_slow = false, has_fake_times = false;
cl_ulong commands = 0;
std::map<cl_event, cl_ulong> numbers_of_commands;
std::set<std::string> kernels_behind_the_first;

template <typename Function>
Function loaders(Function, const char* name) {
  return reinterpret_cast<Function>(dlsym(RTLD_NEXT, name));
}

}  // namespace

// These stand before the OpenCL loader's functions.

extern "C" __attribute__((visibility("default"))) cl_program CL_API_CALL clCreateProgramWithSource(
    cl_context context, cl_uint count, const char** texts, const std::size_t* sizes, cl_int* code) {
  ++builds_from_source;
  if (compiler_is_slow) std::this_thread::sleep_for(std::chrono::milliseconds(150));
  return loaders(&clCreateProgramWithSource, "clCreateProgramWithSource")(context, count, texts, sizes, code);
}

extern "C" __attribute__((visibility("default"))) cl_int CL_API_CALL
clEnqueueNDRangeKernel(cl_command_queue queue, cl_kernel kernel, cl_uint dimensions,
                       const std::size_t* offset, const std::size_t* global, const std::size_t* local,
                       cl_uint count, const cl_event* waits, cl_event* event) {
  const cl_int code = loaders(&clEnqueueNDRangeKernel, "clEnqueueNDRangeKernel")(
      queue, kernel, dimensions, offset, global, local, count, waits, event);
  if (++commands > 1)
    kernels_behind_the_first.insert(info<std::string>(clGetKernelInfo, kernel, CL_KERNEL_FUNCTION_NAME));
  numbers_of_commands[*event] = commands;
  return code;
}

extern "C" __attribute__((visibility("default"))) cl_int CL_API_CALL clEnqueueFillBuffer(
    cl_command_queue queue, cl_mem buffer, const void* pattern, std::size_t pattern_size, std::size_t offset,
    std::size_t size, cl_uint count, const cl_event* waits, cl_event* event) {
  const cl_int code = loaders(&clEnqueueFillBuffer, "clEnqueueFillBuffer")(
      queue, buffer, pattern, pattern_size, offset, size, count, waits, event);
  numbers_of_commands[*event] = ++commands;
  return code;
}

/// Each command takes a millisecond, and a second passes from the start of one to that of the next.
extern "C" __attribute__((visibility("default"))) cl_int CL_API_CALL clGetEventProfilingInfo(
    cl_event event, cl_profiling_info name, std::size_t room, void* value, std::size_t* size) {
  if (!has_fake_times)
    return loaders(&clGetEventProfilingInfo, "clGetEventProfilingInfo")(event, name, room, value, size);
  constexpr cl_ulong millisecond = 1000000;
  const cl_ulong start = 1000 * millisecond * numbers_of_commands[event];
  *static_cast<cl_ulong*>(value) = name == CL_PROFILING_COMMAND_END ? start + millisecond : start;
  return CL_SUCCESS;
}

namespace {

/// A cache of this test's own.
class Cache {
 public:
  Cache() {
    Device::list();  // PoCL has its own cache where the variable said at its start
    setenv("XDG_CACHE_HOME", (caches_ / "").c_str(), 1);
  }
  ~Cache() { unsetenv("XDG_CACHE_HOME"); }
  Cache(const Cache&) = delete;
  Cache& operator=(const Cache&) = delete;

  std::string folder() const { return caches_ / "vorocl/binaries"; }
  std::set<std::string> names() const {
    std::set<std::string> found;
    if (!std::filesystem::exists(folder())) return found;
    for (const auto& entry : std::filesystem::directory_iterator(folder()))
      found.insert(entry.path().filename());
    return found;
  }
  std::string only_file() const {
    BOOST_REQUIRE(names().size() == 1u);
    return folder() + '/' + *names().begin();
  }

 private:
  TemporaryFolder caches_;
};

void write_file(const std::string& path, const std::string& text) {
  std::ofstream(path, std::ios::binary | std::ios::trunc) << text;
}

const std::string key = "a key\nof two lines\n";
const std::string binary = std::string("bytes\0and more", 14) + std::string(5000, 'x');

const Grid grid(150, 90);
const std::vector<Pixel> pixels = random_pixels(grid, 60, 1);

/// Makes the labels on a device whose programs are its own, and has them kept. Returns how many programs were
/// built from their sources.
int build_and_keep(bool keeps = true) {
  const Device device = Device::select();
  Diagram diagram(device, grid);
  builds_from_source = 0;
  jump_flooding(Seeds(device, grid, centres(pixels), to_centres), diagram);
  exact_diagram(Seeds(device, grid, centres(pixels), to_centres), diagram);
  BOOST_TEST((diagram.read() == brute_force(grid, pixels, Metric::euclidean)));
  const int from_source = builds_from_source;
  if (keeps) {
    open_binary_folder();
    BOOST_TEST(keep_programs(device) >= 2u);
  }
  return from_source;
}

bool is_of_pocl() { return keeps_binaries(Device::select()); }

}  // namespace

BOOST_AUTO_TEST_CASE(what_is_kept_is_found_again) {
  const Cache cache;
  BOOST_TEST(!kept_binary(key));
  BOOST_TEST(!std::filesystem::exists(cache.folder()));  // asking makes nothing
  open_binary_folder();
  keep_binary(key, binary);
  BOOST_TEST((kept_binary(key) == binary));
  keep_binary(key, "other");
  BOOST_TEST((kept_binary(key) == "other"));
  BOOST_TEST(!kept_binary(key + ' '));
  BOOST_TEST(!kept_binary(""));
  BOOST_TEST(cache.names().size() == 1u);
  struct stat status = {};
  stat(cache.folder().c_str(), &status);
  BOOST_TEST((status.st_mode & 0777u) == 0700u);
  stat(cache.only_file().c_str(), &status);
  BOOST_TEST((status.st_mode & 0777u) == 0600u);
}

BOOST_AUTO_TEST_CASE(damage_is_found) {
  const Cache cache;
  open_binary_folder();
  keep_binary(key, binary);
  const std::string path = cache.only_file(), whole = content_of(path);
  for (std::size_t i = 0; i < whole.size(); i += i < 100 ? 1 : 97) {
    std::string damaged = whole;
    damaged[i] = static_cast<char>(damaged[i] ^ 1);
    write_file(path, damaged);
    BOOST_TEST(!kept_binary(key), "byte " << i);
    write_file(path, whole.substr(0, i));
    BOOST_TEST(!kept_binary(key), "cut at " << i);
  }
  write_file(path, whole + ' ');
  BOOST_TEST(!kept_binary(key));
  write_file(path, whole);
  BOOST_TEST((kept_binary(key) == binary));
  // The file of one key in the place of another's.
  keep_binary("other key", "other");
  for (const std::string& name : cache.names()) write_file(cache.folder() + '/' + name, whole);
  BOOST_TEST(!kept_binary("other key"));
}

BOOST_AUTO_TEST_CASE(what_others_could_have_written_is_not_read) {
  const Cache cache;
  open_binary_folder();
  keep_binary(key, binary);
  const std::string path = cache.only_file();
  for (const auto& [place, mode, is_read] : {std::tuple(path, 0660, false),
                                             {path, 0602, false},
                                             {path, 0644, true},
                                             {cache.folder(), 0750, false},
                                             {cache.folder(), 0701, false},
                                             {cache.folder(), 0700, true}}) {
    chmod(place.c_str(), static_cast<mode_t>(mode));
    BOOST_TEST(kept_binary(key).has_value() == is_read, place << std::oct << ' ' << mode);
  }
  const std::string moved = cache.folder() + "/moved";
  std::filesystem::rename(path, moved);
  std::filesystem::create_symlink(moved, path);
  BOOST_TEST(!kept_binary(key));
  std::filesystem::remove(path);
  std::filesystem::create_directory(path);
  BOOST_TEST(!kept_binary(key));
  std::filesystem::remove(path);
  BOOST_REQUIRE(mkfifo(path.c_str(), 0600) == 0);
  BOOST_TEST(!kept_binary(key));  // at once
}

BOOST_AUTO_TEST_CASE(a_folder_that_is_not_the_users_alone_is_refused) {
  const Cache cache;
  std::filesystem::create_directories(cache.folder());
  chmod(cache.folder().c_str(), 0755);
  check_error([] { open_binary_folder(); }, {"cannot keep binaries", "/vorocl/binaries: ", "chmod 700"});
  std::filesystem::remove(cache.folder());
  write_file(cache.folder(), "");
  check_error([] { open_binary_folder(); }, {"cannot keep binaries"});
  std::filesystem::remove_all(std::filesystem::path(cache.folder()).parent_path());
  write_file(std::filesystem::path(cache.folder()).parent_path(), "");
  check_error([] { open_binary_folder(); }, {"cannot keep binaries", "Not a directory"});
}

BOOST_AUTO_TEST_CASE(a_variable_turns_it_off) {
  const Cache cache;
  open_binary_folder();
  keep_binary(key, binary);
  setenv("VOROCL_BINARY_CACHE", "0", 1);
  BOOST_TEST(!kept_binary(key));
  BOOST_TEST(binaries_folder().empty());
  BOOST_TEST(!keeps_binaries(test_device()));
  BOOST_TEST(build_and_keep(false) > 0);
  unsetenv("VOROCL_BINARY_CACHE");
  BOOST_TEST((kept_binary(key) == binary));
}

BOOST_AUTO_TEST_CASE(what_cannot_be_written_changes_nothing) {
  const Cache cache;
  open_binary_folder();
  keep_binary(key, "before");
  std::signal(SIGXFSZ, SIG_IGN);
  struct rlimit before = {};
  getrlimit(RLIMIT_FSIZE, &before);
  const struct rlimit limit = {1000, before.rlim_max};
  setrlimit(RLIMIT_FSIZE, &limit);
  check_error([] { keep_binary(key, binary); }, {"cannot keep binaries", "File too large"});
  setrlimit(RLIMIT_FSIZE, &before);
  BOOST_TEST((kept_binary(key) == "before"));
  BOOST_TEST(cache.names().size() == 1u);
}

BOOST_AUTO_TEST_CASE(old_files_go) {
  const Cache cache;
  open_binary_folder();
  const auto has_age = [&](const std::string& name, int days) {
    write_file(cache.folder() + '/' + name, "");
    std::filesystem::last_write_time(
        cache.folder() + '/' + name,
        std::filesystem::file_time_type::clock::now() - std::chrono::hours(24 * days));
  };
  has_age("new-of-a-killed-process", 1);
  has_age("new-of-a-living-one", 0);
  has_age("old", 200);
  has_age("young", 100);
  open_binary_folder();
  BOOST_TEST((cache.names() == std::set<std::string>{"new-of-a-living-one", "young"}));
  // What is used is young again.
  keep_binary(key, binary);
  has_age("young", 200);
  for (const std::string& name : cache.names()) {
    if (name.size() == 16)
      std::filesystem::last_write_time(
          cache.folder() + '/' + name,
          std::filesystem::file_time_type::clock::now() - std::chrono::hours(24 * 200));
  }
  use_binary(key);
  open_binary_folder();
  BOOST_TEST((kept_binary(key) == binary));
  BOOST_TEST(cache.names().count("young") == 0u);
}

BOOST_AUTO_TEST_CASE(processes_that_keep_at_once_never_mix_their_files) {
  const Cache cache;
  open_binary_folder();
  std::vector<pid_t> children;
  for (char letter = 'a'; letter < 'e'; ++letter) {
    children.push_back(fork());
    if (children.back() != 0) continue;
    for (int i = 0; i < 200; ++i) keep_binary(key, std::string(20000, letter));
    _exit(0);
  }
  std::size_t found = 0;
  for (bool some = true; some;) {
    some = false;
    for (const pid_t child : children) some = waitpid(child, nullptr, WNOHANG) == 0 || some;
    const auto kept = kept_binary(key);
    if (!kept) continue;
    ++found;
    BOOST_TEST_REQUIRE(*kept == std::string(20000, kept->front()));
  }
  BOOST_TEST(found > 0u);
  BOOST_TEST(cache.names().size() == 1u);
}

BOOST_AUTO_TEST_CASE(a_later_device_builds_nothing) {
  if (!is_of_pocl()) return;  // nothing is kept
  const Cache cache;
  BOOST_TEST(build_and_keep() > 0);
  const auto names = cache.names();
  BOOST_TEST(build_and_keep() == 0);
  BOOST_TEST((cache.names() == names));
}

// The checksums are right here, so that the driver gets to see them.
BOOST_AUTO_TEST_CASE(a_binary_that_the_driver_refuses_is_built_from_its_source) {
  if (!is_of_pocl()) return;  // nothing is kept
  const Cache cache;
  const int all = build_and_keep();
  for (const std::string& name : cache.names()) {
    const std::string whole = content_of(cache.folder() + '/' + name);
    const std::size_t line = whole.find('\n') + 1, text = whole.find('\n', line) + 1;
    const std::string its_key = whole.substr(text, std::stoul(whole.substr(line)));
    BOOST_TEST_REQUIRE(kept_binary(its_key).has_value());
    keep_binary(its_key, "no program");
  }
  BOOST_TEST(build_and_keep(false) == all);
}

BOOST_AUTO_TEST_CASE(other_options_and_sources_have_other_keys) {
  if (!is_of_pocl()) return;  // nothing is kept
  const Cache cache;
  const Device device = Device::select();
  BOOST_TEST(binary_key(device, "source", "-DA") == binary_key(device, "source", "-DA"));
  BOOST_TEST(binary_key(device, "source", "-DA") != binary_key(device, "source", "-DB"));
  BOOST_TEST(binary_key(device, "source", "-DA") != binary_key(device, "sourcf", "-DA"));
  BOOST_TEST(binary_key(device, "source", "-DA").find(device.name()) != std::string::npos);
}

BOOST_AUTO_TEST_CASE(parts_that_do_not_exist_are_refused) {
  check_error([] { prepare_programs(test_device(), {2, 2}); }, {"part 2", "2 parts"});
  check_error([] { prepare_programs(test_device(), {0, 0}); }, {"0 parts"});
}

BOOST_AUTO_TEST_CASE(a_slow_compiler_is_told_once) {
  const Device device = Device::select();
  Diagram diagram(device, grid);
  int told = 0;
  device.on_compiling([&] { ++told; });
  const Seeds seeds(device, grid, centres(pixels), to_centres);
  setenv("VOROCL_BINARY_CACHE", "0", 1);
  compiler_is_slow = true;
  jump_flooding(seeds, diagram);
  exact_diagram(seeds, diagram);
  compiler_is_slow = false;
  unsetenv("VOROCL_BINARY_CACHE");
  diagram.wait();
  BOOST_TEST(told == 1);
}

// By made-up times: what passes before the first launch of a kernel is the compiler's time.
BOOST_AUTO_TEST_CASE(the_compilers_time_is_not_the_devices) {
  const Device device = Device::select();
  const Seeds seeds(device, grid, centres(pixels), to_centres);
  seeds.read();
  const auto milliseconds = [&](Diagram& diagram) {
    commands = 0;
    const Report report = jump_flooding(seeds, diagram);
    report.event().wait();
    has_fake_times = true;
    const double time = report.milliseconds();
    has_fake_times = false;
    return time;
  };
  Diagram diagram(device, grid), other(device, grid);
  kernels_behind_the_first.clear();
  const double first = milliseconds(diagram);
  const double all = 1000 * (static_cast<double>(commands) - 1) + 1;
  BOOST_TEST(kernels_behind_the_first.size() >= 3u);
  BOOST_TEST(first == all - 999 * static_cast<double>(kernels_behind_the_first.size()));
  BOOST_TEST(milliseconds(diagram) == all);
  BOOST_TEST(milliseconds(other) == all);  // the driver has these kernels
}
