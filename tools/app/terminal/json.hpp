// JSON, as --json prints it.
#pragma once

#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace vorocl::command {

/// A value that is made once: numbers, texts, and lists and objects of values.
class Json {
 public:
  /// Members in the order in which they are printed.
  using Members = std::vector<std::pair<std::string, Json>>;

  Json() : text_("null") {}
  Json(bool value) : text_(value ? "true" : "false") {}
  template <typename T, std::enable_if_t<std::is_integral_v<T> && !std::is_same_v<T, bool>, int> = 0>
  Json(T value) : text_(std::to_string(value)) {}
  Json(double value);
  Json(const std::string& value);
  Json(const char* value) : Json(std::string(value)) {}
  Json(const Members& members);
  Json(const std::vector<Json>& values);

  const std::string& text() const { return text_; }

 private:
  std::string text_;
};

/// Prints an object, as a line on standard output.
void print_json(const Json::Members& members);

}  // namespace vorocl::command
