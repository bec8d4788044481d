#include "formats/csv.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <limits>
#include <utility>

#include "formats/values.hpp"
#include "vorocl/error.hpp"

namespace vorocl::command {

namespace {

using Fields = CsvFields;

/// A line of the file, for what is wrong with it.
struct Line {
  const LineReader& reader;
  Fields fields;

  Error error(const std::string& what) const {
    std::string shown(trimmed(reader.line()).substr(0, 80));
    std::replace_if(
        shown.begin(), shown.end(), [](unsigned char c) { return c < ' '; }, '?');
    return reader.error(what + ": " + shown);
  }
};

bool is_header(const Fields& fields) {
  return std::none_of(fields.begin(), fields.end(),
                      [](const std::string& field) { return parse_number<double>(field).has_value(); });
}

std::string lower(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text;
}

std::optional<std::size_t> index_of(const Fields& header, const std::string& name) {
  const auto exact = std::find(header.begin(), header.end(), name);
  if (exact != header.end()) return static_cast<std::size_t>(exact - header.begin());
  const auto found = std::find_if(header.begin(), header.end(),
                                  [&](const std::string& field) { return lower(field) == lower(name); });
  if (found != header.end()) return static_cast<std::size_t>(found - header.begin());
  return std::nullopt;
}

/// The names of the columns, or their indices.
std::string list_of(const Fields& fields, bool has_header) {
  std::string list;
  for (std::size_t i = 0; i < fields.size() && list.size() < 1000; ++i) {
    list += (i == 0 ? "" : ", ") + (has_header ? fields[i] : std::to_string(i));
  }
  return list;
}

/// Where a column is, by its name in the header or by its index.
std::size_t locate(const std::string& column, const Line& first, bool has_header) {
  if (const auto index = has_header ? index_of(first.fields, column) : std::nullopt) return *index;
  if (const auto index = parse_number<std::size_t>(column); index && *index < first.fields.size())
    return *index;
  const bool has_commas =
      first.fields.size() > 1 || first.reader.line().find_first_of(";\t") == std::string::npos;
  throw first.error("there is no column " + column + "; there are " + list_of(first.fields, has_header) +
                    (has_commas ? "" : "; fields are separated by commas here"));
}

CsvIndices locate(const Columns& wanted, const Line& first, bool has_header) {
  const bool has_z = !wanted.z.empty();
  try {
    CsvIndices indices = {locate(wanted.x, first, has_header), locate(wanted.y, first, has_header), {}, {}};
    if (has_z) indices.z = locate(wanted.z, first, has_header);
    return indices;
  } catch (const Error& error) {
    throw Error(error.what() + std::string(" (choose ") + (has_z ? "three" : "two") +
                " with --columns, by name or by index from 0)");
  }
}

const std::string& field(const Line& line, std::size_t index) {
  if (index < line.fields.size()) return line.fields[index];
  throw line.error("there is no column " + std::to_string(index) +
                   ", counted from 0: the line ends before it");
}

constexpr const char* of_decimal_commas = "; decimals have a point, not a comma";

/// Of more columns without names than are needed the first two may be half of two decimal commas.
void refuse_columns_to_choose_from(const Line& first, std::size_t needed, bool has_z) {
  const auto past_empty_ends = std::find_if(first.fields.rbegin(), first.fields.rend(),
                                            [](const std::string& field) { return !field.empty(); });
  const auto columns = static_cast<std::size_t>(first.fields.rend() - past_empty_ends);
  if (columns <= needed) return;
  throw first.error("there are " + std::to_string(columns) + " columns without names: choose " +
                    (has_z ? "three" : "two") + " with --columns, such as " + (has_z ? "0,1,2" : "0,1") +
                    of_decimal_commas);
}

double number(const Line& line, std::size_t index) {
  const auto parsed = parse_number<double>(field(line, index));
  if (parsed) return *parsed;
  const std::string& text = line.fields[index];
  throw line.error("\"" + text + "\" is not a number" +
                   (text.find(',') == std::string::npos ? "" : of_decimal_commas));
}

double coordinate(const Line& line, std::size_t index) {
  const double value = number(line, index);
  if (!std::isfinite(value)) throw line.error("\"" + line.fields[index] + "\" is not finite");
  return value;
}

double value_or_absent(const Line& line, std::size_t index) {
  return field(line, index).empty() ? std::numeric_limits<double>::quiet_NaN() : number(line, index);
}

}  // namespace

std::optional<CsvFields> csv_fields(std::string_view line) {
  CsvFields fields;
  fields.reserve(static_cast<std::size_t>(std::count(line.begin(), line.end(), ',')) + 1);
  fields.emplace_back();
  bool quoted = false;
  for (std::size_t i = 0; i < line.size(); ++i) {
    if (line[i] == '"' && quoted && i + 1 < line.size() && line[i + 1] == '"') {
      fields.back() += line[++i];
    } else if (line[i] == '"') {
      quoted = !quoted;
    } else if (line[i] == ',' && !quoted) {
      fields.emplace_back();
    } else {
      fields.back() += line[i];
    }
  }
  if (quoted) return std::nullopt;
  for (std::string& field : fields) field = std::string(trimmed(field));
  return fields;
}

std::string to_csv(const CsvFields& fields) {
  std::string line;
  for (const std::string& field : fields) {
    if (&field != &fields.front()) line += ',';
    if (field.find_first_of(",\"") == std::string::npos) {
      line += field;
      continue;
    }
    line += '"';
    for (const char c : field) line += c == '"' ? std::string("\"\"") : std::string(1, c);
    line += '"';
  }
  return line;
}

namespace {

Columns columns_of(const std::string& text, std::size_t most, const std::string& what) {
  std::vector<std::string> names;
  for (std::size_t begin = 0; begin <= text.size();) {
    const auto comma = std::min(text.find(',', begin), text.size());
    names.emplace_back(trimmed(text.substr(begin, comma - begin)));
    begin = comma + 1;
  }
  const bool some_empty = std::find(names.begin(), names.end(), "") != names.end();
  if (names.size() < 2 || names.size() > most || some_empty) {
    throw Error("\"" + text + "\" must be two columns, such as x,y or 0,1" + what);
  }
  return {names[0], names[1], names.size() > 2 ? names[2] : ""};
}

}  // namespace

Columns parse_columns(const std::string& text) { return columns_of(text, 2, ""); }

Columns parse_columns_and_z(const std::string& text) { return columns_of(text, 3, ", or three of a volume"); }

CsvReader::CsvReader(const std::string& path, const std::optional<Columns>& columns,
                     const std::string& value_column, bool has_z)
    : path_(path), columns_(columns), value_column_(value_column), lines_(path), has_z_(has_z) {}

bool CsvReader::next() {
  Line line{lines_, {}};
  while (lines_.next_filled()) {
    auto fields = csv_fields(trimmed(lines_.line()));
    if (!fields) throw line.error("a quote is not closed");
    line.fields = std::move(*fields);
    if (!indices_) {
      const bool has_header = is_header(line.fields);
      indices_.emplace();
      if (columns_ || has_header) {
        *indices_ = locate(columns_.value_or(Columns{"x", "y", has_z_ ? "z" : ""}), line, has_header);
      } else {
        refuse_columns_to_choose_from(line, (value_column_.empty() ? 2 : 3) + (has_z_ ? 1 : 0), has_z_);
        if (has_z_) indices_->z = 2;
      }
      if (!value_column_.empty()) indices_->value = locate(value_column_, line, has_header);
      const auto z = has_header && !columns_ && !has_z_ ? index_of(line.fields, "z") : std::nullopt;
      leaves_out_z_ = z && z != indices_->value;
      columns_there_ = line.fields.size();
      if (has_header) continue;
    }
    while (line.fields.size() > columns_there_ && line.fields.back().empty()) line.fields.pop_back();
    if (line.fields.size() > columns_there_) {
      throw line.error("there are " + std::to_string(line.fields.size()) +
                       " fields where the first line has " + std::to_string(columns_there_) +
                       of_decimal_commas);
    }
    point_ = {coordinate(line, indices_->x), coordinate(line, indices_->y)};
    if (indices_->z) z_ = coordinate(line, *indices_->z);
    if (indices_->value) value_ = value_or_absent(line, *indices_->value);
    return has_points_ = true;
  }
  if (!has_points_) throw Error(path_ + " holds no points");
  return false;
}

CsvPoints read_csv(const std::string& path, const std::optional<Columns>& columns,
                   const std::string& value_column) {
  CsvReader reader(path, columns, value_column);
  CsvPoints result;
  while (reader.next()) {
    result.points.push_back(reader.point());
    if (!value_column.empty()) result.values.push_back(reader.value());
  }
  result.leave_out_z = reader.leaves_out_z();
  return result;
}

std::vector<Point3> read_csv_of_volume(const std::string& path, const std::optional<Columns>& columns) {
  CsvReader reader(path, columns, "", true);
  std::vector<Point3> points;
  while (reader.next()) points.push_back({reader.point().x, reader.point().y, reader.z()});
  return points;
}

}  // namespace vorocl::command
