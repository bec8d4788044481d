// Ctrl-C while a simulation runs.
#pragma once

#include <csignal>

namespace vorocl::command {

/// In its scope, the first SIGINT or SIGTERM is only noted, so that what is written so far can be completed;
/// a second one ends the process at once. One at a time.
class Interruption {
 public:
  Interruption();
  ~Interruption();
  Interruption(const Interruption&) = delete;
  Interruption& operator=(const Interruption&) = delete;

  bool came() const;

 private:
  struct sigaction before_int_ = {};
  struct sigaction before_term_ = {};
};

}  // namespace vorocl::command
