// Ctrl-C and its like: SIGINT, SIGTERM, and SIGHUP of a terminal that is closed.
#pragma once

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

}  // namespace vorocl::command
