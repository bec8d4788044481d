// The progress bar of long work.
#pragma once

#include <optional>
#include <string>

#include "studies/stopwatch.hpp"

namespace vorocl::command {

/// One line on standard error that counts frames or what else the unit is, where that is a terminal, else
/// nothing; gone at the end of the scope.
class Progress {
 public:
  explicit Progress(const std::string& unit = "frames");
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// Shows how many are made and, as far as it is known, how much of the whole is done (0 ... 1). Does
  /// nothing if the line has just been drawn.
  void show(int count, std::optional<double> done);

  /// Erases the line until it is next shown, so that something else can be printed.
  void erase();

 private:
  std::string unit_;
  bool on_terminal_;
  Stopwatch stopwatch_;
  std::optional<double> shown_at_;  // in seconds; none: the line is not there
};

/// The line: "[#####-----]  50 %  120 frames  34.5 frames/s  4 s left".
std::string progress_line(int count, std::optional<double> done, double seconds,
                          const std::string& unit = "frames");

}  // namespace vorocl::command
