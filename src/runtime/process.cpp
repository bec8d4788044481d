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

namespace {

/// As the environment says it. With an empty home it lies in the root.
std::filesystem::path cache_of_pocl() {
  const auto variable = [](const char* name) { return std::filesystem::path(environment(name)); };
  if (auto own = variable("POCL_CACHE_DIR"); !own.empty()) return own;
  if (auto caches = variable("XDG_CACHE_HOME"); !caches.empty()) return caches / "pocl";
  const char* const home = std::getenv("HOME");
  return home == nullptr ? "/tmp/pocl" : std::string(home) + "/.cache/pocl";
}

}  // namespace

std::int64_t process_number() { return getpid(); }

std::optional<std::uint64_t> address_space_limit() {
  struct rlimit limit = {};
  if (getrlimit(RLIMIT_AS, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY) return std::nullopt;
  return limit.rlim_cur;
}

std::string trouble_with_cache_of_pocl() {
  const std::filesystem::path folder = cache_of_pocl();
  std::error_code code;
  std::filesystem::create_directories(folder, code);
  if (!code && access(folder.c_str(), W_OK | X_OK) != 0) code.assign(errno, std::generic_category());
  if (!code) return "";
  return "PoCL cannot write its cache " + folder.string() + " (" + code.message() +
         "): let POCL_CACHE_DIR name a folder that it can write";
}

#else

std::int64_t process_number() { return 0; }
std::optional<std::uint64_t> address_space_limit() { return std::nullopt; }
std::string trouble_with_cache_of_pocl() { return ""; }

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
