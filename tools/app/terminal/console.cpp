#include "app/terminal/console.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <iostream>
#include <new>
#include <nlohmann/json.hpp>
#include <opencv2/core.hpp>

#include "app/terminal/end_of_run.hpp"
#include "formats/files.hpp"
#include "vorocl/error.hpp"

namespace vorocl::command {

namespace {

bool errors_alone = false;
std::string program = "vorocl";

/// How many bytes from here are one character of UTF-8 that a terminal prints; 0: none.
std::size_t printable_bytes(std::string_view text, bool has_lines) {
  const auto byte = [text](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  if (byte(0) < 0x80)
    return (byte(0) >= ' ' && byte(0) != 0x7f) || (has_lines && byte(0) == '\n') || byte(0) == '\t' ? 1 : 0;
  const std::size_t length = byte(0) >= 0xf0 ? 4 : byte(0) >= 0xe0 ? 3 : 2;
  if (byte(0) < 0xc2 || byte(0) > 0xf4 || text.size() < length) return 0;
  for (std::size_t i = 1; i < length; ++i) {
    if ((byte(i) & 0xc0) != 0x80) return 0;
  }
  return byte(0) == 0xc2 && byte(1) < 0xa0 ? 0 : length;  // U+0080 to U+009F are controls
}

void print_line(const char* kind, const std::string& text, bool has_lines = false) {
  const char* const start = isatty(STDERR_FILENO) != 0 ? erase_line : "";
  print_on_standard_error(fmt::format("{}{}: {}: {}\n", start, program, kind, printable(text, has_lines)));
}

/// Does what prints, if there is memory for it.
template <typename Print>
void if_possible(const Print& print) noexcept {
  try {
    print();
  } catch (const std::exception&) {
    print_on_standard_error(program);
    print_on_standard_error(": error: out of memory\n");
  }
}

}  // namespace

void name_program(const std::string& name) { program = name; }

void open_standard_streams() {
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
    if (fcntl(stream, F_GETFD) >= 0) continue;
    // The lowest number that is free is this one. Output that nobody takes must fail, so it is not writable.
    open("/dev/null", stream == STDERR_FILENO ? O_WRONLY : O_RDONLY);
  }
  std::signal(SIGPIPE, SIG_IGN);
  std::signal(SIGXFSZ, SIG_IGN);
}

void print_text(const std::string& text) {
  if (std::fwrite(text.data(), 1, text.size(), stdout) == text.size()) return;
  throw Error("cannot write standard output: " + reason(errno));
}

void print_json(const Json& object) { print("{}\n", object.dump()); }

void flush_standard_output() {
  std::cout.flush();  // CLI11 prints its help there
  if (std::fflush(stdout) == 0 && std::ferror(stdout) == 0) return;
  throw Error("cannot write standard output: " + reason(errno));
}

void say_errors_alone() noexcept {
  errors_alone = true;
  if (std::freopen("/dev/null", "w", stdout) == nullptr) std::fclose(stdout);
}

void print_note(const std::string& text) noexcept {
  if (!errors_alone) if_possible([&] { print_line("note", text); });
}
void print_warning(const std::string& text) noexcept {
  if (!errors_alone) if_possible([&] { print_line("warning", text); });
}
void print_error(const std::exception& error) noexcept {
  // A compiler's log has lines; a file's name that has some must not look like more than one error.
  const auto* const of_vorocl = dynamic_cast<const Error*>(&error);
  const bool has_log = of_vorocl != nullptr && of_vorocl->kind() == ErrorKind::kernel_build;
  if_possible([&] { print_line("error", message_of(error), has_log); });
}

void print_on_standard_error(std::string_view text) noexcept {
  std::fwrite(text.data(), 1, text.size(), stderr);
  std::fflush(stderr);
}

std::string printable(const std::string& text, bool has_lines) {
  std::string result;
  for (std::size_t place = 0; place < text.size();) {
    const std::size_t length = printable_bytes(std::string_view(text).substr(place), has_lines);
    result += length > 0 ? text.substr(place, length)
                         : fmt::format("\\x{:02x}", static_cast<unsigned char>(text[place]));
    place += length > 0 ? length : 1;
  }
  return result;
}

std::string counted(std::uint64_t count, const std::string& noun, const std::string& plural) {
  return fmt::format("{} {}", count, count == 1 ? noun : plural.empty() ? noun + "s" : plural);
}

std::string message_of(const std::exception& error) {
  const char* const out_of_memory = "out of memory; use a smaller grid or fewer seeds";
  if (dynamic_cast<const std::bad_alloc*>(&error) != nullptr) return out_of_memory;
  if (const auto* const of_opencv = dynamic_cast<const cv::Exception*>(&error)) {
    return of_opencv->code == cv::Error::StsNoMem ? out_of_memory : "OpenCV failed: " + of_opencv->err;
  }
  // The driver's compiler removes its files when a signal comes, and then misses them.
  const auto* const of_vorocl = dynamic_cast<const Error*>(&error);
  if (of_vorocl != nullptr && of_vorocl->kind() == ErrorKind::kernel_build && Interruption::came()) {
    return "interrupted";
  }
  return error.what();
}

}  // namespace vorocl::command
