#include "program.hpp"

#include <set>
#include <sstream>

#include "device_state.hpp"
#include "kernel_sources.hpp"
#include "opencl_info.hpp"

namespace vorocl {

namespace {

/// Appends a file with its #include "..." lines resolved, each file once. #line keeps the compiler's messages
/// true.
void append_source(const std::string& file, std::set<std::string>& included, std::string& text) {
  if (!included.insert(file).second) return;
  const std::string include = "#include \"";
  std::istringstream lines(kernel_sources().at(file));
  std::string line;
  text += "#line 1 \"" + file + "\"\n";
  for (int number = 1; std::getline(lines, line); ++number) {
    if (line.compare(0, include.size(), include) == 0) {
      append_source(line.substr(include.size(), line.rfind('"') - include.size()), included, text);
      text += "#line " + std::to_string(number + 1) + " \"" + file + "\"\n";
    } else {
      text += line + '\n';
    }
  }
}

cl::Program build(const Device& device, const std::string& file, const std::string& options) {
  std::string source;
  std::set<std::string> included;
  append_source(file, included, source);
  const char* text = source.c_str();
  const cl_device_id id = device.cl_device()();
  cl_int code = CL_SUCCESS;
  cl::Program program(clCreateProgramWithSource(device.context()(), 1, &text, nullptr, &code));
  check(code, [&] { return "making the program " + file; });
  if (clBuildProgram(program(), 1, &id, options.c_str(), nullptr, nullptr) != CL_SUCCESS) {
    const auto ask = [id](const cl::Program& of, cl_program_build_info name, std::size_t size, void* value,
                          std::size_t* used) {
      return clGetProgramBuildInfo(of(), id, name, size, value, used);
    };
    throw Error("building " + file + " for " + device.name() + " with \"" + options + "\" failed:\n" +
                    info<std::string>(ask, program, CL_PROGRAM_BUILD_LOG),
                ErrorKind::kernel_build);
  }
  return program;
}

}  // namespace

cl::Program program_for(const Device& device, const std::string& file, const std::string& options) {
  DeviceState& state = Internal::state(device);
  const std::lock_guard<std::mutex> lock(state.programs_mutex);
  const std::string key = file + ' ' + options;
  const auto found = state.programs.find(key);
  if (found != state.programs.end()) return found->second;
  return state.programs.emplace(key, build(device, file, options)).first->second;
}

}  // namespace vorocl
