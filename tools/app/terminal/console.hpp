// What the command says: results on standard output, all else on standard error; and the errors of a wrong
// command line.
#pragma once

#include <fmt/format.h>

#include <cstdint>
#include <exception>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>
#include <utility>

#include "vorocl/error.hpp"

namespace vorocl::command {

/// The name of the program that notes, warnings and errors begin with: "vorocl" before this is called.
void name_program(const std::string& name);

/// At the start of main(). Opens those of the three streams that are closed: else the first file to be
/// written would become one of them, and what is printed would go into it. Where a stream is a pipe that
/// nobody reads, or a file that would grow past its limit, printing and writing fail from here on; they do
/// not end the process.
void open_standard_streams();

/// Prints on standard output. Throws Error if that fails.
void print_text(const std::string& text);

template <typename... Arguments>
void print(fmt::format_string<Arguments...> format, Arguments&&... arguments) {
  print_text(fmt::format(format, std::forward<Arguments>(arguments)...));
}

/// A value as --json prints it: an object has its members in the order in which they were added.
using Json = nlohmann::ordered_json;

/// Prints an object as a line on standard output.
void print_json(const Json& object);

/// Throws Error unless all that was printed on standard output has arrived.
void flush_standard_output();

/// For all but one of several processes that do the same: from here on it prints errors, and nothing else.
void say_errors_alone() noexcept;

/// Goes to the start of a terminal's line, and erases it.
constexpr const char* erase_line = "\r\x1b[K";

/// Print on standard error, if that is possible: nothing depends on it. On a terminal a note takes the place
/// of a progress bar.
void print_note(const std::string& text) noexcept;
void print_warning(const std::string& text) noexcept;
void print_error(const std::exception& error) noexcept;
void print_on_standard_error(std::string_view text) noexcept;

/// The text with what would move a terminal's cursor, or change its colours and title, as \x1b and the like:
/// texts may hold what a file, or its name, holds. Tabs stay; line feeds do where the text may have lines.
std::string printable(const std::string& text, bool has_lines = false);

/// "1 seed", "2 seeds"; other nouns with their plural.
std::string counted(std::uint64_t count, const std::string& noun, const std::string& plural = "");

/// What an exception says, in our words where memory is missing, OpenCV failed, or a signal stopped a
/// compiler.
std::string message_of(const std::exception& error);

/// The error of a wrong command line: exit code 2, where other errors give 1.
class UsageError : public Error {
 public:
  using Error::Error;
};

/// Does what checks or reads something of the command line: its Error is a UsageError.
template <typename Check>
auto as_usage(const Check& check) {
  try {
    return check();
  } catch (const Error& error) {
    throw UsageError(error.what());
  }
}

}  // namespace vorocl::command
