#include <algorithm>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "formats/trajectory/readers.hpp"
#include "formats/trajectory/simulation_box.hpp"
#include "formats/values.hpp"

namespace vorocl::command {

namespace {

/// An extended comment: keys in lower case, values without their quotes.
using Pairs = std::map<std::string, std::string>;

/// The value at the start of the text, taken off it: up to a blank, or what quotes, brackets or braces
/// enclose.
std::string take_value(std::string_view& text) {
  const auto kind = text.empty() ? std::string_view::npos : std::string_view("\"'[{").find(text[0]);
  if (kind == std::string_view::npos) return std::string(take_field(text));
  const char opening = text[0];
  const char closing = "\"']}"[kind];
  int depth = 1;
  std::size_t end = 1;
  for (; end < text.size(); ++end) {
    if (text[end] == '\\') {
      ++end;
    } else if (text[end] == closing) {
      if (--depth == 0) break;
    } else if (text[end] == opening) {
      ++depth;
    }
  }
  end = std::min(end, text.size());
  std::string value(text.substr(1, end - 1));
  text.remove_prefix(std::min(end + 1, text.size()));
  return value;
}

/// The pairs of a comment; words of free text are passed over.
Pairs parse_comment(std::string_view text) {
  Pairs pairs;
  for (text = trimmed(text); !text.empty(); text = trimmed(text)) {
    const std::size_t end = std::min(text.find_first_of(" \t\r="), text.size());
    const std::string key = lower(text.substr(0, end));
    text = trimmed(text.substr(end));
    if (text.empty() || text[0] != '=') continue;
    text = trimmed(text.substr(1));
    pairs[key] = take_value(text);
  }
  return pairs;
}

std::vector<std::string_view> split(std::string_view text, const char* separators) {
  std::vector<std::string_view> parts;
  for (std::size_t begin = 0; (begin = text.find_first_not_of(separators, begin)) < text.size();) {
    const std::size_t end = std::min(text.find_first_of(separators, begin), text.size());
    parts.push_back(text.substr(begin, end - begin));
    begin = end;
  }
  return parts;
}

/// The parts of a vector or a matrix, in either of the notations in use: "1 2 3" and [1, 2, 3]. Throws Error
/// unless there are as many as that.
std::vector<std::string_view> elements(const LineReader& lines, const std::string& key, std::string_view text,
                                       std::size_t count) {
  std::vector<std::string_view> parts = split(text, " \t\r,[]");
  if (parts.size() == count) return parts;
  throw lines.error(key + " has " + std::to_string(parts.size()) + " values instead of " +
                    std::to_string(count));
}

std::vector<double> numbers(const LineReader& lines, const std::string& key, std::string_view text,
                            std::size_t count) {
  std::vector<double> values;
  for (std::string_view part : elements(lines, key, text, count)) {
    values.push_back(number_in<double>(lines, take_field(part), "a finite number (" + key + ")"));
  }
  return values;
}

Sides parse_periodic(const LineReader& lines, std::string_view text) {
  const std::string word = lower(text);
  if (word == "t" || word == "true" || word == "1") return {Side::periodic, Side::periodic};
  if (word == "f" || word == "false" || word == "0") return {Side::open, Side::open};
  throw lines.error(shown(text) + " (pbc) is neither T nor F");
}

std::optional<SimulationBox> parse_box(const LineReader& lines, const Pairs& pairs) {
  const auto lattice = pairs.find("lattice");
  if (lattice == pairs.end()) return std::nullopt;
  const std::vector<double> v = numbers(lines, "Lattice", lattice->second, 9);
  Point origin;
  if (const auto found = pairs.find("origin"); found != pairs.end()) {
    const std::vector<double> corner = numbers(lines, "Origin", found->second, 3);
    origin = {corner[0], corner[1], corner[2]};
  }
  Sides x{Side::periodic, Side::periodic};
  Sides y = x, z = x;
  if (const auto found = pairs.find("pbc"); found != pairs.end()) {
    const std::vector<std::string_view> axes = elements(lines, "pbc", found->second, 3);
    x = parse_periodic(lines, axes[0]);
    y = parse_periodic(lines, axes[1]);
    z = parse_periodic(lines, axes[2]);
  }
  // Some programs write a lattice of zeros where there is none.
  if (x.first != Side::periodic && y.first != Side::periodic && v[0] == 0 && v[1] == 0 && v[3] == 0 &&
      v[4] == 0)
    return std::nullopt;
  const Edges edges = {{v[0], v[1], v[2]}, {v[3], v[4], v[5]}, {v[6], v[7], v[8]}};
  return box_from_edges(lines, edges, origin, x, y, z);
}

/// The columns from "name:type:number of columns" for each property, with colons between them too.
RowLayout parse_properties(const LineReader& lines, std::string_view text, const std::string& value_column) {
  const std::vector<std::string_view> parts = split(text, ":");
  if (parts.size() % 3 != 0) throw lines.error(shown(text) + " (Properties) is not made of name:type:count");
  RowLayout layout;
  bool has_position = false;
  std::vector<Property> properties;
  for (std::size_t i = 0; i < parts.size(); i += 3) {
    const auto count = parse_number<std::uint16_t>(parts[i + 2]);
    if (!count) throw lines.error(shown(parts[i + 2]) + " (Properties) is no number of columns");
    if (parts[i] == "pos" && *count >= 2) {
      has_position = true;
      layout.x = layout.fields;
      layout.y = layout.fields + 1;
      if (*count > 2) layout.z = layout.fields + 2;
    }
    if (parts[i] == "id" && *count == 1) layout.id = layout.fields;
    layout.fields += *count;
    properties.push_back({parts[i], *count});
  }
  if (!has_position) throw lines.error("Properties name no position; there must be pos:R:3");
  layout.value = find_value_column(lines, properties, value_column);
  return layout;
}

RowLayout parse_layout(const LineReader& lines, const Pairs& pairs, const std::string& value_column) {
  if (const auto found = pairs.find("properties"); found != pairs.end()) {
    return parse_properties(lines, found->second, value_column);
  }
  RowLayout layout;
  layout.fields = 4;
  layout.may_have_more = true;
  layout.x = 1;
  layout.y = 2;
  layout.z = 3;
  layout.value = find_value_column(lines, {{"species"}, {"x"}, {"y"}, {"z"}}, value_column);
  return layout;
}

}  // namespace

bool Xyz::next(Frame& frame) {
  if (!lines_.next_filled()) return false;
  const ParticleCount count = parse_count(lines_);
  if (!lines_.next()) throw cut_off(lines_, count.line);
  const Pairs pairs = parse_comment(lines_.line());
  const RowLayout layout = parse_layout(lines_, pairs, value_column_);
  std::optional<SimulationBox> box = parse_box(lines_, pairs);
  const auto timestep = pairs.find("timestep");
  frame.timestep = timestep == pairs.end() ? std::nullopt : parse_number<std::int64_t>(timestep->second);
  rows_.read(lines_, layout, count, box, frame);
  return true;
}

}  // namespace vorocl::command
