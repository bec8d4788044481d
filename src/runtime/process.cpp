#include "runtime/process.hpp"

#include <cerrno>
#include <filesystem>
#include <system_error>

#include "vorocl/error.hpp"

#if defined(__unix__) || defined(__APPLE__)
#include <sys/resource.h>
#include <unistd.h>
#define VOROCL_IS_UNIX 1
#else
#define VOROCL_IS_UNIX 0
#endif

namespace vorocl {

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
