// Numbers in text, read the same in every locale.
#pragma once

#include <charconv>
#include <optional>
#include <string_view>

namespace vorocl::command {

inline std::string_view trimmed(std::string_view text) {
  const char* const blanks = " \t\r";
  const auto first = text.find_first_not_of(blanks);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(blanks) - first + 1);
}

/// The number that the text is, without the blanks around it; "nan" and "inf" are numbers too. None if it is
/// not one, if anything follows it, or if it does not fit the type.
template <typename T>
std::optional<T> parse_number(std::string_view text) {
  text = trimmed(text);
  if (text.size() > 1 && text[0] == '+' && text[1] != '-') text.remove_prefix(1);
  T value{};
  const auto result = std::from_chars(text.data(), text.data() + text.size(), value);
  if (result.ec != std::errc() || result.ptr != text.data() + text.size()) return std::nullopt;
  return value;
}

}  // namespace vorocl::command
