#include <algorithm>
#include <array>
#include <string>
#include <utility>
#include <vector>

#include "formats/trajectory/readers.hpp"
#include "formats/trajectory/simulation_box.hpp"
#include "formats/values.hpp"

namespace vorocl::command {

namespace {

/// What follows a section's title in its line; none if the line has another title.
std::optional<std::string_view> after(std::string_view line, std::string_view title) {
  if (line.substr(0, title.size()) != title) return std::nullopt;
  line.remove_prefix(title.size());
  if (!line.empty() && line[0] != ' ' && line[0] != '\t') return std::nullopt;
  return trimmed(line);
}

RowLayout parse_columns(const LineReader& lines, std::string_view text, const std::string& value_column) {
  std::vector<std::string_view> columns;
  split_fields(text, columns);
  std::vector<Property> properties;
  properties.reserve(columns.size());
  for (const std::string_view column : columns) properties.push_back({column});
  const auto value = find_value_column(lines, properties, value_column);
  const auto find = [&](std::string_view name) -> std::optional<std::size_t> {
    const auto found = std::find(columns.begin(), columns.end(), name);
    if (found == columns.end()) return std::nullopt;
    return static_cast<std::size_t>(found - columns.begin());
  };
  // All of these lead to the same positions; where there are several, the plain ones lost the least.
  for (const auto& [ending, scaled] :
       {std::pair("", false), std::pair("s", true), std::pair("u", false), std::pair("su", true)}) {
    const auto x = find(std::string("x") + ending), y = find(std::string("y") + ending);
    if (x && y)
      return {columns.size(), false, *x, *y, find(std::string("z") + ending), find("id"), scaled, value};
  }
  throw lines.error("the columns name no position; write the dump with x y, xs ys, xu yu or xsu ysu");
}

/// The two letters of an axis, one per side.
Sides parse_sides(const LineReader& lines, std::string_view flags) {
  const auto parse = [](char letter) -> std::optional<Side> {
    if (letter == 'p') return Side::periodic;
    if (letter == 'f') return Side::wall;
    if (letter == 's' || letter == 'm') return Side::open;
    return std::nullopt;
  };
  const auto low = flags.size() == 2 ? parse(flags[0]) : std::nullopt;
  const auto high = flags.size() == 2 ? parse(flags[1]) : std::nullopt;
  if (!low || !high || (low == Side::periodic) != (high == Side::periodic)) {
    throw lines.error(shown(flags) + " is no boundary; an axis has pp, or two of f, s and m");
  }
  return {*low, *high};
}

/// The sides of all three axes.
std::array<Sides, 3> parse_boundary(const LineReader& lines, const std::vector<std::string_view>& flags) {
  std::array<Sides, 3> sides;
  // Old files have no flags: nothing says that a side is periodic, and nothing that it is a wall.
  sides.fill({Side::open, Side::open});
  if (flags.empty()) return sides;
  if (flags.size() != sides.size()) {
    throw lines.error("the box has " + std::to_string(flags.size()) +
                      " boundary flags; there must be one an axis, such as pp ff pp");
  }
  for (std::size_t i = 0; i < sides.size(); ++i) sides[i] = parse_sides(lines, flags[i]);
  return sides;
}

}  // namespace

bool LammpsDump::next(Frame& frame) {
  if (!lines_.next_filled()) return false;
  Header header;
  const RowLayout layout = parse_columns(lines_, read_header(header), value_column_);
  frame.timestep = header.timestep;
  rows_.read(lines_, layout, *header.count, header.box, frame);
  return true;
}

std::string_view LammpsDump::read_header(Header& header) {
  const std::size_t frame_line = lines_.number();
  for (;;) {
    const std::string_view line = trimmed(lines_.line());
    if (const auto columns = after(line, "ITEM: ATOMS")) {
      const char* const missing = !header.timestep ? "TIMESTEP"
                                  : !header.count  ? "NUMBER OF ATOMS"
                                  : !header.box    ? "BOX BOUNDS"
                                                   : nullptr;
      if (missing)
        throw lines_.error(std::string("the frame has no \"ITEM: ") + missing + "\" before this line");
      return *columns;
    }
    if (after(line, "ITEM: TIMESTEP")) {
      if (header.timestep) {
        throw lines_.error("a new frame, but the one that starts in line " + std::to_string(frame_line) +
                           " has no \"ITEM: ATOMS\" yet; remove it if a run broke off there");
      }
      next_value(frame_line);
      std::string_view value = lines_.line();
      header.timestep = number_in<std::int64_t>(lines_, take_field(value), "a time step");
      check_end(lines_, value);
    } else if (after(line, "ITEM: NUMBER OF ATOMS")) {
      next_value(frame_line);
      header.count = parse_count(lines_);
    } else if (const auto flags = after(line, "ITEM: BOX BOUNDS")) {
      header.box = read_box(*flags, frame_line);
    } else if (after(line, "ITEM: UNITS") || after(line, "ITEM: TIME")) {
      next_value(frame_line);
    } else if (line.substr(0, 5) == "ITEM:") {
      throw lines_.error(shown(line) +
                         " is not part of a dump of atoms; write it with the style atom or custom");
    } else {
      throw lines_.error(shown(line) +
                         " stands where \"ITEM: ...\" is due; does the frame before hold more atoms "
                         "than it announces?");
    }
    if (!lines_.next_filled()) throw cut_off(lines_, frame_line);
  }
}

void LammpsDump::next_value(std::size_t frame_line) {
  if (!lines_.next()) throw cut_off(lines_, frame_line);
}

SimulationBox LammpsDump::read_box(std::string_view title, std::size_t frame_line) {
  std::vector<std::string_view> words;
  split_fields(title, words);
  const auto take = [&words](const std::vector<std::string_view>& names) {
    if (words.size() < names.size() || !std::equal(names.begin(), names.end(), words.begin())) return false;
    words.erase(words.begin(), words.begin() + static_cast<std::ptrdiff_t>(names.size()));
    return true;
  };
  const bool has_tilt = take({"xy", "xz", "yz"});
  const bool has_edges = take({"abc", "origin"});
  const std::array<Sides, 3> sides = parse_boundary(lines_, words);

  double values[3][4] = {};
  for (auto& row : values) {
    next_value(frame_line);
    std::string_view rest = lines_.line();
    const int count = has_edges ? 4 : has_tilt ? 3 : 2;
    for (int i = 0; i < count; ++i)
      row[i] = number_in<double>(lines_, take_field(rest), "a finite number of the box");
    check_end(lines_, rest);
  }
  const auto& [x, y, z] = values;
  if (has_edges) {
    const Edges edges = {{x[0], x[1], x[2]}, {y[0], y[1], y[2]}, {z[0], z[1], z[2]}};
    return box_from_edges(lines_, edges, {x[3], y[3], z[3]}, sides[0], sides[1], sides[2]);
  }
  const double xy = x[2], xz = y[2], yz = z[2];
  // The bounds are those of the whole parallelepiped.
  const BoxAxis x_axis{x[0] - std::min({0.0, xy, xz, xy + xz}), x[1] - std::max({0.0, xy, xz, xy + xz}),
                       sides[0]};
  const BoxAxis y_axis{y[0] - std::min(0.0, yz), y[1] - std::max(0.0, yz), sides[1]};
  return SimulationBox(lines_, x_axis, y_axis, {z[0], z[1], sides[2]}, xy, xz, yz);
}

}  // namespace vorocl::command
