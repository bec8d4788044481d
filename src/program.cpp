#include "program.hpp"

#include <set>
#include <sstream>

#include "device_state.hpp"
#include "kernel_sources.hpp"
#include "opencl_error.hpp"

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
  cl_int code = CL_SUCCESS;
  cl::Program program(device.context(), source, false, &code);
  check(code, "making the program " + file);
  code = program.build({device.cl_device()}, options.c_str());
  if (code != CL_SUCCESS) {
    std::string log;
    program.getBuildInfo(device.cl_device(), CL_PROGRAM_BUILD_LOG, &log);
    throw Error("building " + file + " for " + device.name() + " with \"" + options + "\" failed:\n" + log);
  }
  return program;
}

}  // namespace

cl::Program program_for(const Device& device, const std::string& file, const std::string& options) {
  Device::State& state = device.state();
  const std::lock_guard<std::mutex> lock(state.programs_mutex);
  const std::string key = file + ' ' + options;
  const auto found = state.programs.find(key);
  if (found != state.programs.end()) return found->second;
  return state.programs.emplace(key, build(device, file, options)).first->second;
}

}  // namespace vorocl
