#include "runtime/program.hpp"

#include <cerrno>
#include <cstring>
#include <fstream>
#include <functional>
#include <set>
#include <sstream>
#include <utility>

#include "runtime/binary_cache.hpp"
#include "runtime/device_state.hpp"
#include "runtime/kernel_sources.hpp"
#include "runtime/opencl_info.hpp"
#include "runtime/process.hpp"
#include "runtime/stopwatch.hpp"

namespace vorocl {

namespace {

/// The text of a kernel file: the embedded one, or that in the folder that VOROCL_KERNEL_DIR names.
std::string source_of(const std::string& file) {
  const std::string folder = environment("VOROCL_KERNEL_DIR");
  if (folder.empty()) return kernel_sources().at(file);
  std::ifstream stream(folder + '/' + file, std::ios::binary);
  std::string text;
  if (!std::getline(stream, text, '\0') && !stream.eof()) {  // an empty file ends at once
    throw Error("cannot read the kernel " + folder + '/' + file +
                    " (the folder is VOROCL_KERNEL_DIR): " + std::strerror(errno),
                ErrorKind::file);
  }
  return text;
}

/// Appends a file's text with its #include "..." lines resolved, each file once. #line keeps the compiler's
/// messages true.
void append_source(const std::string& file, const std::string& source, std::set<std::string>& included,
                   std::string& text) {
  const std::string include = "#include \"";
  std::istringstream lines(source);
  std::string line;
  text += "#line 1 \"" + file + "\"\n";
  for (int number = 1; std::getline(lines, line); ++number) {
    if (line.compare(0, include.size(), include) == 0) {
      const std::string name = line.substr(include.size(), line.rfind('"') - include.size());
      if (included.insert(name).second) append_source(name, source_of(name), included, text);
      text += "#line " + std::to_string(number + 1) + " \"" + file + "\"\n";
    } else {
      text += line + '\n';
    }
  }
}

/// Writes a file into the folder that VOROCL_DUMP_DIR names, if it names one: what `content` returns, which
/// is asked only then. (PoCL builds every kernel once more to answer for a binary.)
template <typename Content>
void dump(const std::string& name, Content content) {
  const std::string folder = environment("VOROCL_DUMP_DIR");
  if (folder.empty()) return;
  const std::string text = content();  // first: a driver's compiler sets errno, too
  std::ofstream stream(folder + '/' + name, std::ios::binary);
  if (!(stream << text).flush()) {
    throw Error(
        "cannot write " + folder + '/' + name + " (the folder is VOROCL_DUMP_DIR): " + std::strerror(errno),
        ErrorKind::file);
  }
}

/// "exact-diagram-1a2b...": the same in every process, another for every device and set of options.
std::string dump_name(const Device& device, const std::string& file, const std::string& options) {
  std::ostringstream name;
  for (const char c : file.substr(0, file.rfind('.'))) name << (c == '/' ? '-' : c);
  name << '-' << std::hex
       << std::hash<std::string>()(device.name() + ' ' + device.driver_version() + ' ' + options);
  return name.str();
}

/// The binary of the program's only device.
std::string binary_of(const cl::Program& program) {
  std::string binary(info<std::size_t>(clGetProgramInfo, program(), CL_PROGRAM_BINARY_SIZES), '\0');
  auto* bytes = reinterpret_cast<unsigned char*>(binary.data());
  check(clGetProgramInfo(program(), CL_PROGRAM_BINARIES, sizeof(bytes), &bytes, nullptr),
        "asking for a program's binary");
  return binary;
}

/// The program from a binary that was kept; null unless the driver takes it.
cl::Program from_binary(const Device& device, const std::string& binary, const std::string& options) {
  const auto* bytes = reinterpret_cast<const unsigned char*>(binary.data());
  const std::size_t size = binary.size();
  const cl_device_id id = device.cl_device()();
  cl_int code = CL_SUCCESS, status = CL_SUCCESS;
  cl::Program program(clCreateProgramWithBinary(device.context()(), 1, &id, &size, &bytes, &status, &code));
  const bool is_taken = code == CL_SUCCESS && status == CL_SUCCESS &&
                        clBuildProgram(program(), 1, &id, options.c_str(), nullptr, nullptr) == CL_SUCCESS;
  return is_taken ? program : cl::Program();
}

cl::Program from_source(const Device& device, const std::string& file, const std::string& source,
                        const std::string& options) {
  const Stopwatch stopwatch;
  const char* text = source.c_str();
  const cl_device_id id = device.cl_device()();
  cl_int code = CL_SUCCESS;
  cl::Program program(clCreateProgramWithSource(device.context()(), 1, &text, nullptr, &code));
  check(code, [&] { return "making the program " + file; });
  const std::string what = "building " + file + " for " + device.name() + " with \"" + options + '"';
  const auto build = [&] { return clBuildProgram(program(), 1, &id, options.c_str(), nullptr, nullptr); };
  code = build();
  // Of two processes that build one program at once each removes files of the other in PoCL's cache.
  if (code == CL_BUILD_PROGRAM_FAILURE && is_pocl(device)) code = build();
  if (code == CL_BUILD_PROGRAM_FAILURE) {
    const std::string cache = is_pocl(device) ? trouble_with_cache_of_pocl() : "";
    if (!cache.empty()) throw Error(what + " failed; " + cache, ErrorKind::kernel_build);
    const auto ask = [id](const cl::Program& of, cl_program_build_info wanted, std::size_t size, void* value,
                          std::size_t* used) {
      return clGetProgramBuildInfo(of(), id, wanted, size, value, used);
    };
    throw Error(what + " failed:\n" + info<std::string>(ask, program, CL_PROGRAM_BUILD_LOG),
                ErrorKind::kernel_build);
  }
  check(code, what.c_str());
  constexpr double of_a_compiler = 100;  // a driver that has the program needs 40 ms at most
  std::function<void()>& notice = Internal::state(device).on_compiling;
  if (notice && stopwatch.milliseconds() > of_a_compiler) std::exchange(notice, nullptr)();
  return program;
}

BuiltProgram build(const Device& device, const std::string& file, const std::string& options) {
  const std::string source = with_includes(file, source_of(file));
  const std::string name = dump_name(device, file, options);
  dump(name + ".cl", [&] { return "// " + device.name() + ": " + options + '\n' + source; });
  BuiltProgram built;
  built.binary_key = binary_key(device, source, options);
  if (const std::optional<std::string> binary = kept_binary(built.binary_key))
    built.program = from_binary(device, *binary, options);
  built.is_kept = built.program() != nullptr;
  if (!built.is_kept) built.program = from_source(device, file, source, options);
  dump(name + ".bin", [&] { return binary_of(built.program); });
  return built;
}

}  // namespace

std::string with_includes(const std::string& file, const std::string& text) {
  std::string whole;
  std::set<std::string> included = {file};
  append_source(file, text, included, whole);
  return whole;
}

cl::Program program_for(const Device& device, const std::string& file, const std::string& options) {
  DeviceState& state = Internal::state(device);
  refuse_fork_of(state.process);  // a thread that it does not have may have been building
  const std::lock_guard<std::mutex> lock(state.programs_mutex);
  const std::string all = state.build_options.empty() ? options : options + ' ' + state.build_options;
  const std::string key = file + ' ' + all;
  const auto found = state.programs.find(key);
  if (found != state.programs.end()) return found->second.program;
  const std::string more = environment("VOROCL_BUILD_OPTIONS");
  const BuiltProgram built = build(device, file, more.empty() ? all : all + ' ' + more);
  return state.programs.emplace(key, built).first->second.program;
}

std::size_t keep_programs(const Device& device) {
  DeviceState& state = Internal::state(device);
  const std::lock_guard<std::mutex> lock(state.programs_mutex);
  std::size_t count = 0;
  for (auto& [key, built] : state.programs) {
    if (built.binary_key.empty()) continue;
    built.is_kept ? use_binary(built.binary_key) : keep_binary(built.binary_key, binary_of(built.program));
    built.is_kept = true;
    ++count;
  }
  return count;
}

}  // namespace vorocl
