// The progress bar of long work.
#pragma once

#include <chrono>
#include <optional>
#include <string>

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
  using Clock = std::chrono::steady_clock;

  std::string unit_;
  bool on_terminal_;
  Clock::time_point start_;
  Clock::time_point shown_;
};

/// The line: "[#####-----]  50 %  120 frames  34.5 frames/s  4 s left".
std::string progress_line(int count, std::optional<double> done, double seconds,
                          const std::string& unit = "frames");

}  // namespace vorocl::command
