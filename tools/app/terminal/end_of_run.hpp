// What must be done however a run ends: Ctrl-C and its like (SIGINT, SIGTERM, and SIGHUP of a terminal that
// is closed), and the work that is still on a device.
#pragma once

#include <exception>

#include "vorocl/device.hpp"

namespace vorocl::command {

/// At the start of main(): from here on these signals remove the temporary files before they end the process.
/// One that the caller ignores (nohup) stays ignored.
void remove_temporary_files_on_signals();

/// In its scope, the first of these signals is only noted, so that what is written so far can be completed; a
/// second one ends the process at once, as without the scope. One at a time.
class Interruption {
 public:
  Interruption();
  ~Interruption();
  Interruption(const Interruption&) = delete;
  Interruption& operator=(const Interruption&) = delete;

  /// Whether one came since the last scope began.
  static bool came();
};

/// Waits for the device at the end of a scope, also where an error ends it: PoCL crashes a process that exits
/// while its threads still build or run a kernel.
class FinishAtEnd {
 public:
  explicit FinishAtEnd(const Device& device) : device_(device) {}
  ~FinishAtEnd() {
    try {
      device_.finish();
    } catch (const std::exception&) {  // the error that ends the scope is the one to report
    }
  }
  FinishAtEnd(const FinishAtEnd&) = delete;
  FinishAtEnd& operator=(const FinishAtEnd&) = delete;

 private:
  Device device_;
};

}  // namespace vorocl::command
