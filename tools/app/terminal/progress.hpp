// The progress bar of long work.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "app/terminal/samples.hpp"

namespace vorocl::command {

/// How far work has come.
struct Advance {
  std::uint64_t count = 0;     ///< of frames, or what else the unit is
  std::optional<double> done;  ///< how much of the whole, 0 ... 1, as far as it is known
  double done_before = 0;      ///< by an earlier run
  double work = 0;             ///< that this run has done, where its rate is not that of the count
};

/// The units of what is counted, and of the rate that is shown.
struct ProgressUnits {
  std::string count = "frames";
  std::optional<std::string> work = std::nullopt;  ///< none: that of what is counted
};

/// One line on standard error, where that is a terminal, else nothing; gone at the end of the scope.
class Progress {
 public:
  explicit Progress(const ProgressUnits& units = {});
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// Does nothing if the line has just been drawn.
  void show(const Advance& advance);
  void show(int count, std::optional<double> done) { show({static_cast<std::uint64_t>(count), done}); }

  /// Erases the line until it is next shown, so that something else can be printed.
  void erase();

 private:
  ProgressUnits units_;
  bool on_terminal_;
  Stopwatch stopwatch_;
  std::optional<double> shown_at_;  // in seconds; none: the line is not there
};

/// The line: "[#####-----]  50 %  120 frames  34.5 frames/s  4 s left".
std::string progress_line(const Advance& advance, double seconds, const ProgressUnits& units = {});

}  // namespace vorocl::command
