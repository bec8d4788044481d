#include "app/terminal/progress.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace vorocl::command {

namespace {

constexpr int bar_width = 24;
constexpr auto redraw_interval = std::chrono::milliseconds(100);
const char* const erase_line = "\r\x1b[K";

std::string duration(double seconds) {
  const auto whole = static_cast<long long>(std::ceil(seconds));
  if (whole < 60) return fmt::format("{} s", whole);
  if (whole < 3600) return fmt::format("{} min {} s", whole / 60, whole % 60);
  return fmt::format("{} h {} min", whole / 3600, whole / 60 % 60);
}

}  // namespace

std::string progress_line(int count, std::optional<double> done, double seconds, const std::string& unit) {
  std::string line;
  if (done) {
    const auto filled = static_cast<std::size_t>(std::clamp(*done, 0.0, 1.0) * bar_width);
    line = fmt::format("[{}{}] {:3.0f} %  ", std::string(filled, '#'), std::string(bar_width - filled, '-'),
                       100 * *done);
  }
  line += fmt::format("{0} {2}  {1:.1f} {2}/s", count, seconds > 0 ? count / seconds : 0, unit);
  if (done && *done > 0) line += fmt::format("  {} left", duration(seconds * (1 - *done) / *done));
  return line;
}

Progress::Progress(const std::string& unit)
    : unit_(unit), on_terminal_(isatty(STDERR_FILENO) != 0), start_(Clock::now()) {}

Progress::~Progress() { erase(); }

void Progress::erase() {
  if (!on_terminal_) return;
  std::fputs(erase_line, stderr);
  std::fflush(stderr);
  shown_ = {};
}

void Progress::show(int count, std::optional<double> done) {
  const Clock::time_point now = Clock::now();
  if (!on_terminal_ || now - shown_ < redraw_interval) return;
  shown_ = now;
  const double seconds = std::chrono::duration<double>(now - start_).count();
  fmt::print(stderr, "{}{}", erase_line, progress_line(count, done, seconds, unit_));
  std::fflush(stderr);
}

}  // namespace vorocl::command
