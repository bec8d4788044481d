// What the command says on standard error.
#pragma once

#include <fmt/format.h>

#include <cstdio>
#include <string>

namespace vorocl::command {

inline void print_note(const std::string& text) { fmt::print(stderr, "vorocl: note: {}\n", text); }
inline void print_warning(const std::string& text) { fmt::print(stderr, "vorocl: warning: {}\n", text); }
inline void print_error(const std::string& text) { fmt::print(stderr, "vorocl: error: {}\n", text); }

}  // namespace vorocl::command
