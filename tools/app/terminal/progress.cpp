#include "app/terminal/progress.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>

#include "app/terminal/console.hpp"

namespace vorocl::command {

namespace {

constexpr int bar_width = 24;
constexpr double redraw_interval = 0.1;  // in seconds

std::string duration(double seconds) {
  const auto whole = static_cast<long long>(std::ceil(seconds));
  if (whole < 60) return fmt::format("{} s", whole);
  if (whole < 3600) return fmt::format("{} min {} s", whole / 60, whole % 60);
  return fmt::format("{} h {} min", whole / 3600, whole / 60 % 60);
}

}  // namespace

std::string progress_line(const Advance& advance, double seconds, const ProgressUnits& units) {
  std::string line;
  const std::optional<double>& done = advance.done;
  if (done) {
    const auto filled = static_cast<std::size_t>(std::clamp(*done, 0.0, 1.0) * bar_width);
    line = fmt::format("[{}{}] {:3.0f} %  ", std::string(filled, '#'), std::string(bar_width - filled, '-'),
                       100 * *done);
  }
  const double work = units.work ? advance.work : static_cast<double>(advance.count);
  line += fmt::format("{} {}  {:.1f} {}/s", advance.count, units.count, seconds > 0 ? work / seconds : 0,
                      units.work.value_or(units.count));
  if (done && *done > advance.done_before) {
    line += fmt::format("  {} left", duration(seconds * (1 - *done) / (*done - advance.done_before)));
  }
  return line;
}

Progress::Progress(const ProgressUnits& units) : units_(units), on_terminal_(isatty(STDERR_FILENO) != 0) {}

Progress::~Progress() { erase(); }

void Progress::erase() {
  if (!on_terminal_) return;
  print_on_standard_error(erase_line);
  shown_at_.reset();
}

void Progress::show(const Advance& advance) {
  const double seconds = stopwatch_.seconds();
  if (!on_terminal_ || (shown_at_ && seconds - *shown_at_ < redraw_interval)) return;
  shown_at_ = seconds;
  print_on_standard_error(erase_line + progress_line(advance, seconds, units_));
}

}  // namespace vorocl::command
