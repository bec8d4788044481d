#include "formats/trajectory/particle_rows.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "formats/values.hpp"
#include "vorocl/error.hpp"

namespace vorocl::command {

namespace {

/// Refuses a count that the file cannot hold, a row being longer than a byte. Rows that lack a field or a few
/// rows too few are left to the reading, which can name the line.
void check_fits(const LineReader& lines, const ParticleCount& count) {
  const auto left = lines.bytes_left();
  if (left && count.value > *left) {
    throw lines.error_at(count.line,
                         fmt::format("{} particles cannot be in the {} bytes that follow: the number is "
                                     "wrong, or the file is cut off",
                                     count.value, *left));
  }
}

Error wrong_fields(const LineReader& lines, const RowLayout& layout, const ParticleCount& count,
                   std::size_t fields) {
  return lines.error(
      fmt::format("{} fields where a particle has {}{}; or line {} is wrong about {} particles", fields,
                  layout.fields, layout.may_have_more ? " or more" : "", count.line, count.value));
}

std::uint32_t parse_id(const LineReader& lines, std::string_view field) {
  const auto id = parse_number<std::uint64_t>(field);
  if (!id || *id >= no_label) {
    throw lines.error(fmt::format("{} is no id; ids go from 0 to {}", shown(field), no_label - 1));
  }
  return static_cast<std::uint32_t>(*id);
}

double parse_value(const LineReader& lines, std::string_view field) {
  const auto value = parse_number<double>(field);
  if (!value) throw lines.error(fmt::format("{} stands where a number is due, to colour by", shown(field)));
  return *value;
}

/// The place of a column among those of a property, if it is one of them.
std::optional<std::size_t> place_in(const Property& property, std::string_view column) {
  if (property.columns == 1) return column == property.name ? std::optional<std::size_t>(0) : std::nullopt;
  const std::string_view name = property.name;
  if (column.size() < name.size() + 3 || column.substr(0, name.size()) != name) return std::nullopt;
  const auto number =
      parse_number<std::size_t>(column.substr(name.size() + 1, column.size() - name.size() - 2));
  if (!number || *number < 1 || *number > property.columns) return std::nullopt;
  return column == fmt::format("{}[{}]", name, *number) ? std::optional<std::size_t>(*number - 1)
                                                        : std::nullopt;
}

/// Appends the names of its columns to a list, until that is long.
void list(const Property& property, std::string& names) {
  constexpr std::size_t longest = 1000;
  for (std::size_t i = 1; i <= property.columns && names.size() < longest; ++i) {
    names += names.empty() ? "" : ", ";
    names += property.columns == 1 ? std::string(property.name) : fmt::format("{}[{}]", property.name, i);
  }
}

}  // namespace

std::optional<std::size_t> find_value_column(const LineReader& lines, const std::vector<Property>& properties,
                                             const std::string& column) {
  if (column.empty()) return std::nullopt;
  std::size_t first = 0;
  std::string names;
  for (const Property& property : properties) {
    if (const auto place = place_in(property, column)) return first + *place;
    first += property.columns;
    list(property, names);
  }
  throw lines.error(fmt::format("there is no column {}; there are {}", shown(column), names));
}

Error cut_off(const LineReader& lines, std::size_t frame_line) {
  return lines.error_at(lines.number(),
                        fmt::format("the file ends within the frame that starts in line {}; it seems cut "
                                    "off: write it anew, or remove that frame",
                                    frame_line));
}

ParticleCount parse_count(const LineReader& lines) {
  const auto value = parse_number<std::uint64_t>(lines.line());
  if (!value || *value > Window::max_pixels) {
    throw lines.error(fmt::format("{} stands where a number of particles, from 0 to {}, is due",
                                  shown(trimmed(lines.line())), Window::max_pixels));
  }
  return {*value, lines.number()};
}

void ParticleRows::read(LineReader& lines, const RowLayout& layout, const ParticleCount& count,
                        std::optional<SimulationBox>& box, Frame& frame) {
  check_fits(lines, count);
  rows_.clear();
  const std::size_t first_line = lines.number() + 1;
  while (rows_.size() < count.value) {
    if (!lines.next()) {
      throw lines.error_at(
          lines.number(),
          fmt::format("the file ends after {} of the {} particles that line {} announces; it seems cut "
                      "off: write it anew, or remove its last frame",
                      rows_.size(), count.value, count.line));
    }
    Row row = parse(lines, layout, count);
    if (layout.scaled) row.position = box->from_scaled(row.position);
    if (box) row.position = box->place(lines, row.id, row.position);
    if (!std::isfinite(row.position.x) || !std::isfinite(row.position.y)) {
      throw lines.error("the position is too far from the box to be computed");
    }
    rows_.push_back(row);
  }
  sort(lines, first_line);
  frame.ids.clear();
  frame.positions.clear();
  frame.values.clear();
  for (const Row& row : rows_) {
    frame.ids.push_back(row.id);
    frame.positions.push_back(row.position);
    if (layout.value) frame.values.push_back(row.value);
  }
  frame.z_span = rows_.empty() ? 0 : z_span(layout.scaled ? box->depth() : 1);
  frame.box = box ? std::optional<Box>(box->extent()) : std::nullopt;
}

ParticleRows::Row ParticleRows::parse(const LineReader& lines, const RowLayout& layout,
                                      const ParticleCount& count) const {
  std::string_view rest = lines.line();
  if (rest.substr(0, 5) == "ITEM:") {
    throw lines.error(
        fmt::format("{} of the {} particles that line {} announces are here; correct the number or add "
                    "the rows",
                    rows_.size(), count.value, count.line));
  }
  std::string_view x;
  std::string_view y;
  std::string_view z;
  std::string_view id;
  std::string_view value;
  std::size_t fields = 0;
  for (std::string_view field = take_field(rest); !field.empty(); field = take_field(rest)) {
    if (fields == layout.x) x = field;
    if (fields == layout.y) y = field;
    if (fields == layout.z) z = field;
    if (fields == layout.id) id = field;
    if (fields == layout.value) value = field;
    ++fields;
  }
  if (fields < layout.fields || (fields > layout.fields && !layout.may_have_more)) {
    throw wrong_fields(lines, layout, count, fields);
  }
  const auto number = static_cast<std::uint32_t>(rows_.size());
  return {layout.id ? parse_id(lines, id) : number,
          number,
          {take_real(lines, x, "a finite x"), take_real(lines, y, "a finite y")},
          parse_number<double>(z).value_or(0),
          layout.value ? parse_value(lines, value) : 0};
}

double ParticleRows::z_span(double unit) const {
  const auto [lowest, highest] =
      std::minmax_element(rows_.begin(), rows_.end(), [](const Row& a, const Row& b) { return a.z < b.z; });
  return (highest->z - lowest->z) * unit;
}

void ParticleRows::sort(const LineReader& lines, std::size_t first_line) {
  std::sort(rows_.begin(), rows_.end(),
            [](const Row& a, const Row& b) { return a.id != b.id ? a.id < b.id : a.number < b.number; });
  const auto twin =
      std::adjacent_find(rows_.begin(), rows_.end(), [](const Row& a, const Row& b) { return a.id == b.id; });
  if (twin == rows_.end()) return;
  throw lines.error_at(
      first_line + (twin + 1)->number,
      fmt::format("id {} comes twice in this frame, first in line {}; give each particle one of its "
                  "own, or write the dump without ids",
                  twin->id, first_line + twin->number));
}

}  // namespace vorocl::command
