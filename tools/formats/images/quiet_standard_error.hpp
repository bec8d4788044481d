// Keeps other libraries from printing where the command prints its own errors.
#pragma once

#include <fcntl.h>
#include <unistd.h>

namespace vorocl::command {

/// Sends standard error nowhere for a scope: OpenCV and the image libraries under it print to it by
/// themselves.
class QuietStandardError {
 public:
  QuietStandardError() : standard_error_(dup(STDERR_FILENO)) {
    const int nowhere = open("/dev/null", O_WRONLY);
    if (nowhere >= 0) dup2(nowhere, STDERR_FILENO);
    if (nowhere >= 0) close(nowhere);
  }
  ~QuietStandardError() {
    if (standard_error_ < 0) return;
    dup2(standard_error_, STDERR_FILENO);
    close(standard_error_);
  }
  QuietStandardError(const QuietStandardError&) = delete;
  QuietStandardError& operator=(const QuietStandardError&) = delete;

 private:
  int standard_error_;
};

}  // namespace vorocl::command
