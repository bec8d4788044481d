// Values: numbers in text, columns of them, metrics by name, and a hash of numbers; the same in every locale
// and on every machine.
#pragma once

#include <cctype>
#include <charconv>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <type_traits>
#include <utility>
#include <vector>

#include "vorocl/grid.hpp"

namespace vorocl::command {

inline bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\r'; }

inline std::string_view trimmed(std::string_view text) {
  while (!text.empty() && is_blank(text.front())) text.remove_prefix(1);
  while (!text.empty() && is_blank(text.back())) text.remove_suffix(1);
  return text;
}

inline std::string lower(std::string_view text) {
  std::string result(text);
  for (char& c : result) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return result;
}

/// The number that the text is, without the blanks around it; "nan" and "inf" are numbers too. None if it is
/// not one, if anything follows it, or if it is a whole number that does not fit the type; a floating-point
/// number that does not is infinite or 0.
template <typename T>
std::optional<T> parse_number(std::string_view text) {
  text = trimmed(text);
  if (text.size() > 1 && text[0] == '+' && text[1] != '-') text.remove_prefix(1);
  T value{};
  const auto result = std::from_chars(text.data(), text.data() + text.size(), value);
  if (result.ptr != text.data() + text.size()) return std::nullopt;
  if (std::is_floating_point_v<T> && result.ec == std::errc::result_out_of_range)
    return static_cast<T>(std::strtod(std::string(text).c_str(), nullptr));
  return result.ec == std::errc() ? std::optional(value) : std::nullopt;
}

/// The parts of a text between separators, one more than there are of these.
inline std::vector<std::string_view> parts_of(std::string_view text, char separator) {
  for (std::vector<std::string_view> parts;;) {
    const std::size_t end = text.find(separator);
    parts.push_back(text.substr(0, end));
    if (end == text.npos) return parts;
    text.remove_prefix(end + 1);
  }
}

/// What a column has row by row: numbers (NaN: absent), or those by which its texts stand in `texts`.
struct ColumnValues {
  std::vector<double> numbers;
  std::vector<std::string> texts;
};

/// Reads a column, which is one of texts if its first value is no number. Texts are in the order of their
/// letters, and those that are new in a later frame behind the earlier ones.
class ColumnReader {
 public:
  /// False for a text, not "", among numbers.
  bool add(const std::string& text, const std::optional<double>& number) {
    if (!has_texts_ && !text.empty()) has_texts_ = !number;
    if (!has_texts_.value_or(false)) {
      numbers_.push_back(number.value_or(std::numeric_limits<double>::quiet_NaN()));
      return number || text.empty();
    }
    while (places_.size() < numbers_.size()) places_.push_back(nullptr);
    numbers_.push_back(std::numeric_limits<double>::quiet_NaN());
    places_.push_back(text.empty() ? nullptr : &*place_of_text_.try_emplace(text, texts_.size()).first);
    return true;
  }

  /// All since the last call.
  ColumnValues take() {
    const std::size_t known = texts_.size();
    for (auto& [text, place] : place_of_text_) {
      if (place < known) continue;
      place = texts_.size();
      texts_.push_back(text);
    }
    for (std::size_t i = 0; i < places_.size(); ++i) {
      if (places_[i] != nullptr) numbers_[i] = static_cast<double>(places_[i]->second);
    }
    places_.clear();
    return {std::exchange(numbers_, {}), texts_};
  }

 private:
  std::optional<bool> has_texts_;
  std::vector<double> numbers_;
  std::vector<std::string> texts_;
  std::map<std::string, std::size_t> place_of_text_;
  std::vector<const std::pair<const std::string, std::size_t>*> places_;  // by row
};

/// The name that options, tables and JSON give it.
inline std::string to_string(Metric metric) {
  switch (metric) {
    case Metric::euclidean:
      return "euclidean";
    case Metric::manhattan:
      return "manhattan";
    case Metric::great_circle:
      break;
  }
  return "great-circle";
}

/// 64-bit FNV-1a (Fowler, Noll, Vo) of whole numbers, byte by byte from the lowest one, and of text.
class Hash {
 public:
  template <typename T>
  void add(T number) {
    static_assert(static_cast<T>(-1) > 0, "unsigned numbers");
    for (std::size_t i = 0; i < sizeof number; ++i) {
      add_byte((number >> (8 * i)) & 0xff);
    }
  }
  void add_text(std::string_view bytes) {
    for (const char byte : bytes) add_byte(static_cast<unsigned char>(byte));
  }

  std::uint64_t value() const { return value_; }

 private:
  void add_byte(std::uint64_t byte) { value_ = (value_ ^ byte) * 0x100000001b3u; }

  std::uint64_t value_ = 0xcbf29ce484222325u;
};

}  // namespace vorocl::command
