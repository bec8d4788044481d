#include "formats/csv.hpp"

#include <algorithm>
#include <cctype>
#include <limits>
#include <utility>

#include "formats/numbers.hpp"
#include "formats/trajectory/line_reader.hpp"
#include "vorocl/error.hpp"

namespace vorocl::command {

namespace {

using Fields = CsvFields;

struct Indices {
  std::size_t x = 0;
  std::size_t y = 1;
  std::optional<std::size_t> value;
};

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
  throw first.error("there is no column " + column + "; there are " + list_of(first.fields, has_header));
}

Indices locate(const std::optional<Columns>& columns, const std::string& value_column, const Line& first,
               bool has_header) {
  Indices indices;
  if (columns || has_header) {
    const Columns wanted = columns.value_or(Columns{"x", "y"});
    try {
      indices.x = locate(wanted.x, first, has_header);
      indices.y = locate(wanted.y, first, has_header);
    } catch (const Error& error) {
      throw Error(error.what() + std::string(" (choose two with --columns, by name or by index from 0)"));
    }
  }
  if (!value_column.empty()) indices.value = locate(value_column, first, has_header);
  return indices;
}

const std::string& field(const Line& line, std::size_t index) {
  if (index >= line.fields.size()) throw line.error("there is no column " + std::to_string(index));
  return line.fields[index];
}

double number(const Line& line, std::size_t index) {
  const auto parsed = parse_number<double>(field(line, index));
  if (!parsed) throw line.error("\"" + line.fields[index] + "\" is not a number");
  return *parsed;
}

double value(const Line& line, std::size_t index) {
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

Columns parse_columns(const std::string& text) {
  const auto comma = text.find(',');
  if (comma == std::string::npos || text.find(',', comma + 1) != std::string::npos) {
    throw Error("\"" + text + "\" must be two columns, such as x,y or 0,1");
  }
  Columns columns{std::string(trimmed(text.substr(0, comma))), std::string(trimmed(text.substr(comma + 1)))};
  if (columns.x.empty() || columns.y.empty()) {
    throw Error("\"" + text + "\" must be two columns, such as x,y or 0,1");
  }
  return columns;
}

CsvPoints read_csv(const std::string& path, const std::optional<Columns>& columns,
                   const std::string& value_column) {
  LineReader reader(path);
  CsvPoints result;
  std::optional<Indices> indices;
  Line line{reader, {}};
  while (reader.next_filled()) {
    auto fields = csv_fields(trimmed(reader.line()));
    if (!fields) throw line.error("a quote is not closed");
    line.fields = std::move(*fields);
    if (!indices) {
      const bool has_header = is_header(line.fields);
      indices = locate(columns, value_column, line, has_header);
      if (has_header) continue;
    }
    result.points.push_back({number(line, indices->x), number(line, indices->y)});
    if (indices->value) result.values.push_back(value(line, *indices->value));
  }
  if (result.points.empty()) throw Error(path + " holds no points");
  return result;
}

}  // namespace vorocl::command
