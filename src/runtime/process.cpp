#include "runtime/process.hpp"

#include <cerrno>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <system_error>

#include "vorocl/error.hpp"

#if VOROCL_IS_UNIX
#include <sys/resource.h>
#include <unistd.h>
#endif

namespace vorocl {

std::string environment(const char* name) {
  const char* const value = std::getenv(name);
  return value == nullptr ? "" : value;
}

std::string processor_features() {
  std::ifstream processors("/proc/cpuinfo");
  for (std::string line; std::getline(processors, line);) {  // x86, and Arm
    if (line.compare(0, 5, "flags") == 0 || line.compare(0, 8, "Features") == 0) return line;
  }
  return "";
}

#if VOROCL_IS_UNIX

std::int64_t process_number() { return getpid(); }

std::optional<std::uint64_t> address_space_limit() {
  struct rlimit limit = {};
  if (getrlimit(RLIMIT_AS, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY) return std::nullopt;
  return limit.rlim_cur;
}

std::string why_not_writable(const std::string& folder) {
  std::error_code code;
  std::filesystem::create_directories(folder, code);
  if (!code && access(folder.c_str(), W_OK | X_OK) != 0) code.assign(errno, std::generic_category());
  return code ? code.message() : "";
}

#else

std::int64_t process_number() { return 0; }
std::optional<std::uint64_t> address_space_limit() { return std::nullopt; }
std::string why_not_writable(const std::string&) { return ""; }

#endif

void refuse_fork_of(std::int64_t process) {
  if (process_number() == process) return;
  throw Error(
      "this process was forked from one that had used OpenCL, and has none of the driver's threads; make the "
      "process by spawn or forkserver (Python: multiprocessing.set_start_method), or fork before the first "
      "call",
      ErrorKind::device);
}

}  // namespace vorocl
