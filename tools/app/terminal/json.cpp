#include "app/terminal/json.hpp"

#include <fmt/core.h>

#include <nlohmann/json.hpp>

#include "app/terminal/console.hpp"

namespace vorocl::command {

Json::Json(double value) : text_(nlohmann::json(value).dump()) {}

Json::Json(const std::string& value) : text_(nlohmann::json(value).dump()) {}

Json::Json(const Members& members) : text_("{") {
  for (const auto& [name, value] : members) {
    if (text_.size() > 1) text_ += ',';
    text_ += Json(name).text() + ':' + value.text();
  }
  text_ += '}';
}

Json::Json(const std::vector<Json>& values) : text_("[") {
  for (const Json& value : values) {
    if (text_.size() > 1) text_ += ',';
    text_ += value.text();
  }
  text_ += ']';
}

void print_json(const Json::Members& members) { print("{}\n", Json(members).text()); }

}  // namespace vorocl::command
