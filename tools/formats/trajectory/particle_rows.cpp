#include "formats/trajectory/particle_rows.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "formats/values.hpp"
#include "vorocl/error.hpp"

namespace vorocl::command {

namespace {

/// Refuses a count that the file cannot hold, a row being longer than a byte. Rows that lack a field or a few
/// rows too few are left to the reading, which can name the line.
void check_fits(const LineReader& lines, const ParticleCount& count) {
  const auto left = lines.is_compressed() ? std::nullopt : lines.bytes_left();
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
  clear();
  if (is_volume()) {
    if (!layout.z) throw lines.error("the particles have no z, which a volume needs");
    if (box) box->check_volume(lines);
  } else if (box && wanted_ != Wanted::depth) {
    box->check_plane(lines);
  }
  const std::size_t first_line = lines.number() + 1;
  const bool wants_box = wanted_ == Wanted::box || wanted_ == Wanted::box_of_volume;
  if (wants_box && box && !box->grows(is_volume())) {
    if (!lines.skip(count.value)) throw cut_off(lines, count.line);
  } else {
    while (ids_.size() < count.value) {
      if (!lines.next()) {
        throw lines.error_at(
            lines.number(),
            fmt::format("the file ends after {} of the {} particles that line {} announces; it seems cut "
                        "off: write it anew, or remove its last frame",
                        ids_.size(), count.value, count.line));
      }
      add(lines, layout, count, box);
    }
    sort(lines, first_line);
  }
  frame.z_span = ids_.empty() ? 0 : highest_z_ - lowest_z_;
  give(ids_, frame.ids);
  give(positions_, frame.positions);
  give(z_, frame.z);
  ColumnValues values = values_.take();
  give(values.numbers, frame.values.numbers);
  frame.values.texts = std::move(values.texts);
  frame.box = box ? std::optional<Box>(box->extent()) : std::nullopt;
}

void ParticleRows::clear() {
  ids_.clear();
  positions_.clear();
  z_.clear();
  values_.take();
  order_.clear();
  lowest_z_ = std::numeric_limits<double>::infinity();
  highest_z_ = -lowest_z_;
}

void ParticleRows::add(const LineReader& lines, const RowLayout& layout, const ParticleCount& count,
                       std::optional<SimulationBox>& box) {
  const std::string_view line = lines.line();
  if (line.substr(0, 5) == "ITEM:") {
    throw lines.error(
        fmt::format("{} of the {} particles that line {} announces are here; correct the number or add "
                    "the rows",
                    ids_.size(), count.value, count.line));
  }
  split_fields(line, fields_);
  if (fields_.size() < layout.fields || (fields_.size() > layout.fields && !layout.may_have_more)) {
    throw wrong_fields(lines, layout, count, fields_.size());
  }
  const std::uint32_t id =
      layout.id ? parse_id(lines, fields_[*layout.id]) : static_cast<std::uint32_t>(ids_.size());
  Point position = {number_in<double>(lines, fields_[layout.x], "a finite x"),
                    number_in<double>(lines, fields_[layout.y], "a finite y")};
  if (is_volume()) {
    position.z = number_in<double>(lines, fields_[*layout.z], "a finite z");
  } else if (layout.z) {
    position.z = parse_number<double>(fields_[*layout.z]).value_or(0);
  }
  if (layout.value) {
    const std::string_view field = fields_[*layout.value];
    if (!values_.add(std::string(field), parse_number<double>(field)))
      throw lines.error(fmt::format("{} stands where a number is due, to colour by", shown(field)));
  }
  if (box) position = layout.scaled ? box->from_scaled(position) : box->turned(position);
  if (box) position = box->place(lines, id, position, is_volume());
  if (!std::isfinite(position.x) || !std::isfinite(position.y) || !std::isfinite(position.z)) {
    throw lines.error("the position is too far from the box to be computed");
  }
  ids_.push_back(id);
  lowest_z_ = std::min(lowest_z_, position.z);
  highest_z_ = std::max(highest_z_, position.z);
  if (is_volume()) z_.push_back(position.z);
  position.z = 0;
  positions_.push_back(position);
}

void ParticleRows::sort(const LineReader& lines, std::size_t first_line) {
  const auto is_no_later = [](std::uint32_t a, std::uint32_t b) { return a >= b; };
  if (std::adjacent_find(ids_.begin(), ids_.end(), is_no_later) == ids_.end()) return;
  for (const std::uint32_t id : ids_) order_.push_back(id_and_row(id, order_.size()));
  sort_by_id(order_, spare_);
  const auto is_twin = [](IdAndRow a, IdAndRow b) { return id_of(a) == id_of(b); };
  const auto twin = std::adjacent_find(order_.begin(), order_.end(), is_twin);
  if (twin == order_.end()) return;
  throw lines.error_at(
      first_line + row_of(*(twin + 1)),
      fmt::format("id {} comes twice in this frame, first in line {}; give each particle one of its "
                  "own, or write the dump without ids",
                  id_of(*twin), first_line + row_of(*twin)));
}

template <typename T>
void ParticleRows::give(std::vector<T>& of_rows, std::vector<T>& of_frame) const {
  if (order_.empty()) {
    of_frame.swap(of_rows);
    return;
  }
  of_frame.resize(of_rows.size());
  for (std::size_t i = 0; i < of_rows.size(); ++i) of_frame[i] = of_rows[row_of(order_[i])];
}

}  // namespace vorocl::command
