#include "formats/csv.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <set>
#include <utility>

#include "formats/id_order.hpp"
#include "formats/values.hpp"
#include "vorocl/error.hpp"

namespace vorocl::command {

namespace {

using Fields = CsvFields;

/// A line of the file, for what is wrong with it.
struct Line {
  const LineReader& reader;
  const Fields& fields;

  Error error(const std::string& what) const {
    std::string shown(trimmed(reader.line()).substr(0, 80));
    std::replace_if(
        shown.begin(), shown.end(), [](unsigned char c) { return c < ' '; }, '?');
    return reader.error(what + ": " + shown);
  }
};

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

bool is_number(const std::string& field) { return parse_number<double>(field).has_value(); }

/// Whether none of the fields is a finite number and one is a text: NaN alone may be absent numbers.
bool are_texts(const Fields& fields) {
  const auto is_text = [](const std::string& field) { return !field.empty() && !is_number(field); };
  return std::any_of(fields.begin(), fields.end(), is_text) &&
         std::none_of(fields.begin(), fields.end(), [](const std::string& field) {
           return std::isfinite(parse_number<double>(field).value_or(INFINITY));
         });
}

/// What programs write where there is no number.
bool is_absent(const std::string& field) {
  static const std::set<std::string> texts = {"", "na", "n/a", "null", "nan"};
  return texts.count(lower(field)) > 0 && field != "Na";  // sodium
}

/// The names that pandas gives the columns of an array: 0,1,2.
bool counts_from_zero(const Fields& fields) {
  for (std::size_t i = 0; i < fields.size(); ++i) {
    if (fields[i] != std::to_string(i)) return false;
  }
  return fields.size() > 1;
}

/// The columns of points that the header names, on the globe rather its degrees; none if it names no x and y.
std::optional<Columns> usual_columns(const Fields& header, bool has_z, bool on_globe = false) {
  using Names = std::vector<const char*>;
  const std::pair<Names, Names> degrees = {{"lon", "lng", "long", "longitude"}, {"lat", "latitude"}};
  const std::pair<Names, Names> usual = {{"x"}, {"y"}}, others = {{"x_coord"}, {"y_coord"}};
  const auto of_header = [&](const Names& names) {
    return std::find_if(names.begin(), names.end(),
                        [&](const char* name) { return index_of(header, name).has_value(); });
  };
  for (const auto& [xs, ys] :
       on_globe ? std::array{degrees, usual, others} : std::array{usual, degrees, others}) {
    const auto x = of_header(xs), y = of_header(ys);
    if (x != xs.end() && y != ys.end()) return Columns{*x, *y, has_z ? "z" : ""};
  }
  return std::nullopt;
}

/// What the first row of a file is.
struct FirstRow {
  bool is_header = false;
  bool has_names = false;  ///< of a header, which may have numbers alone
  std::string note;        ///< where it could be a point too
};

/// A header names columns that are asked for, has no numbers, or none where the columns that are asked for by
/// their indices have them.
FirstRow first_row(const Fields& fields, const std::vector<std::string>& asked) {
  if (counts_from_zero(fields)) {
    return {true, false,
            "the first row, " + to_csv(fields) +
                ", are names of columns, as pandas writes them; where it is a point, write names before it"};
  }
  FirstRow row;
  for (const std::string& column : asked) {
    const auto index = parse_number<std::size_t>(column);
    const bool is_index = index && *index < fields.size();
    const bool is_named = !is_index && index_of(fields, column);
    if (is_named && is_number(column)) {
      row.note = "the first row, " + to_csv(fields) + ", are names of columns, one of which is asked for";
    }
    if (is_named || (is_index && !is_number(fields[*index]) && !is_absent(fields[*index])))
      row.is_header = row.has_names = true;
  }
  if (are_texts(fields) || (asked.empty() && usual_columns(fields, false)))
    row.is_header = row.has_names = true;
  return row;
}

CsvIndices locate(const Columns& wanted, const Line& first, bool has_header) {
  const bool has_z = !wanted.z.empty();
  try {
    CsvIndices indices = {locate(wanted.x, first, has_header), locate(wanted.y, first, has_header)};
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

constexpr const char* of_decimal_commas = "; decimals have a point, or with --decimal , a comma";

/// Of more columns without names than are needed the first two may be half of two decimal commas.
void refuse_columns_to_choose_from(const Line& first, std::size_t needed, bool has_z) {
  const auto past_empty_ends = std::find_if(first.fields.rbegin(), first.fields.rend(),
                                            [](const std::string& field) { return !field.empty(); });
  const auto columns = static_cast<std::size_t>(first.fields.rend() - past_empty_ends);
  if (columns <= needed) return;
  throw first.error("there are " + std::to_string(columns) + " columns without names: choose " +
                    (has_z ? "three" : "two") + " with --columns, such as " +
                    (has_z ? "0,1,2" : "0,1 (three with --exact, or of a volume, with --size WxHxD)") +
                    of_decimal_commas);
}

std::optional<double> number(std::string text, bool has_decimal_commas) {
  if (has_decimal_commas) std::replace(text.begin(), text.end(), ',', '.');
  return parse_number<double>(text);
}

Error no_number(const Line& line, const std::string& text, bool has_decimal_commas) {
  const bool may_be_decimal = !has_decimal_commas && text.find(',') != std::string::npos;
  return line.error("\"" + text + "\" is not a number" + (may_be_decimal ? of_decimal_commas : ""));
}

/// NaN where it is absent.
double coordinate(const Line& line, std::size_t index, bool has_decimal_commas) {
  const std::string& text = field(line, index);
  if (is_absent(text)) return std::numeric_limits<double>::quiet_NaN();
  const auto value = number(text, has_decimal_commas);
  if (!value) throw no_number(line, text, has_decimal_commas);
  if (std::isinf(*value)) throw line.error("\"" + text + "\" is not finite");
  return *value;
}

bool is_empty(const Fields& fields) {
  return std::all_of(fields.begin(), fields.end(), [](const std::string& field) { return field.empty(); });
}

/// R's, or NumPy's; "#,x,y" are names of columns.
bool is_comment(std::string_view line) {
  line = trimmed(line);
  return line[0] == '#' && line.substr(0, 2) != "#,";
}

/// The first of the separators in use that a file's first row has.
char separator_of(std::string_view line, bool has_decimal_commas) {
  const std::string_view all = has_decimal_commas ? ";\t" : ",;\t";
  for (const char separator : all) {
    if (line.find(separator) != std::string_view::npos) return separator;
  }
  return all[0];
}

}  // namespace

std::optional<CsvFields> csv_fields(std::string_view line, char separator) {
  CsvFields fields;
  fields.reserve(static_cast<std::size_t>(std::count(line.begin(), line.end(), separator)) + 1);
  fields.emplace_back();
  bool quoted = false, may_quote = true;  // at the start of a field alone; elsewhere a quote is a character
  for (std::size_t i = 0; i < line.size(); ++i) {
    if (quoted && line[i] == '"') {
      quoted = i + 1 < line.size() && line[i + 1] == '"';
      if (quoted) fields.back() += line[++i];
    } else if (!quoted && line[i] == separator) {
      fields.emplace_back();
      may_quote = true;
    } else if (may_quote && line[i] == '"') {
      quoted = true;
      may_quote = false;
      fields.back().clear();
    } else {
      may_quote = may_quote && is_blank(line[i]);
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
    if (field.find_first_of(",\"\n") == std::string::npos) {
      line += field;
      continue;
    }
    line += '"';
    for (const char c : field) line += c == '"' ? std::string("\"\"") : std::string(1, c);
    line += '"';
  }
  return line;
}

CsvFields other_names(CsvFields names, const std::vector<std::string>& others) {
  for (std::string& name : names) {
    if (std::find(others.begin(), others.end(), name) != others.end()) name.insert(0, "input_");
  }
  return names;
}

Columns parse_columns(const std::string& text, bool of_volumes) {
  std::vector<std::string> names;
  for (const std::string_view part : parts_of(text, ',')) names.emplace_back(trimmed(part));
  const bool some_empty = std::find(names.begin(), names.end(), "") != names.end();
  if (names.size() < 2 || names.size() > (of_volumes ? 3 : 2) || some_empty) {
    throw Error("\"" + text + "\" must be two columns, such as x,y or 0,1" +
                (of_volumes ? ", or three of a volume" : ""));
  }
  return {names[0], names[1], names.size() > 2 ? names[2] : ""};
}

CsvReader::CsvReader(const std::string& path, CsvOptions options, bool has_z)
    : path_(path), options_(std::move(options)), lines_(path), has_z_(has_z) {}

bool CsvReader::next_record() {
  constexpr std::size_t most_lines = 1000, most_bytes = 1 << 20;  // of one that has line breaks
  while (lines_.next_filled()) {
    if (is_comment(lines_.line())) continue;
    const std::size_t first_line = lines_.number();
    std::string text(lines_.line());
    if (!separator_) {
      const bool says = text.size() >= 5 && lower(text.substr(0, 4)) == "sep=";  // for Excel
      separator_ = says ? text[4] : separator_of(text, options_.decimal_comma);
      if (says) continue;
    }
    auto fields = csv_fields(text, *separator_);
    for (std::size_t lines = 1; !fields; ++lines) {
      if (lines == most_lines || text.size() > most_bytes || !lines_.next())
        throw lines_.error_at(first_line, "a quote is not closed: " + shown(text));
      text += '\n' + std::string(lines_.line());
      if (lines_.line().find('"') != std::string_view::npos) fields = csv_fields(text, *separator_);
    }
    fields_ = std::move(*fields);
    if (!is_empty(fields_)) return true;
  }
  return false;
}

bool CsvReader::begin() {
  const Line line{lines_, fields_};
  std::vector<std::string> asked;
  if (options_.columns) asked = {options_.columns->x, options_.columns->y};
  if (!options_.value_column.empty()) asked.push_back(options_.value_column);
  const FirstRow first = first_row(fields_, asked);
  if (!first.note.empty()) notes_.push_back(path_ + ": " + first.note);
  indices_.emplace();
  if (options_.columns || first.has_names) {
    const Columns usual =
        usual_columns(fields_, has_z_, options_.on_globe).value_or(Columns{"x", "y", has_z_ ? "z" : ""});
    *indices_ = locate(options_.columns.value_or(usual), line, first.is_header);
  } else {
    refuse_columns_to_choose_from(line, (options_.value_column.empty() ? 2 : 3) + (has_z_ ? 1 : 0), has_z_);
    if (has_z_) indices_->z = 2;
  }
  CsvIndices& at = *indices_;
  if (!options_.value_column.empty()) at.value = locate(options_.value_column, line, first.is_header);
  const auto named = [&](const char* name) -> std::optional<std::size_t> {
    const auto index = first.has_names ? index_of(fields_, name) : std::nullopt;
    return index == at.x || index == at.y || (index && index == at.z) ? std::nullopt : index;
  };
  if (options_.reads_ids) at.id = named("id");
  const auto z = options_.columns || has_z_ ? std::nullopt : named("z");
  if (z && z != at.value)
    notes_.push_back(path_ + ": z is left out; volumes have it, with --size WxHxD, or " +
                     "with --exact --columns X,Y,Z");
  if (options_.keep == CsvFields{"all"}) {
    options_.keep.clear();
    for (std::size_t i = 0; i < fields_.size() && first.is_header; ++i) {
      if (i == at.x || i == at.y || i == at.z || i == at.id || fields_[i].empty()) continue;
      options_.keep.push_back(fields_[i]);
      at.kept.push_back(i);
    }
  } else {
    for (const std::string& column : options_.keep) {
      const std::size_t index = locate(column, line, first.is_header);
      if (std::find(at.kept.begin(), at.kept.end(), index) != at.kept.end())
        throw line.error("column " + column + " is to be kept twice");
      at.kept.push_back(index);
    }
  }
  columns_there_ = fields_.size();
  return first.is_header;
}

bool CsvReader::next() {
  while (next_record()) {
    if (!indices_ && begin()) continue;
    while (fields_.size() > columns_there_ && fields_.back().empty()) fields_.pop_back();
    const Line line{lines_, fields_};
    if (fields_.size() > columns_there_) {
      throw line.error("there are " + std::to_string(fields_.size()) + " fields where the first line has " +
                       std::to_string(columns_there_) + of_decimal_commas);
    }
    const auto at = [&](std::size_t index) { return coordinate(line, index, options_.decimal_comma); };
    point_ = {at(indices_->x), at(indices_->y), indices_->z ? at(*indices_->z) : 0};
    if (options_.on_globe && std::abs(point_.y) > 90)
      throw line.error(field(line, indices_->y) + " is no latitude, from -90 to 90 degrees");
    if (indices_->id) id_ = parse_number<std::uint32_t>(field(line, *indices_->id)).value_or(no_label);
    return has_points_ = true;
  }
  if (!has_points_) throw Error(path_ + " holds no points");
  return false;
}

void CsvReader::add_value(ColumnReader& column) const {
  const Line line{lines_, fields_};
  const std::string& text = field(line, *indices_->value);
  if (!column.add(is_absent(text) ? "" : text, number(text, options_.decimal_comma)))
    throw no_number(line, text, options_.decimal_comma);
}

CsvFields CsvReader::kept() const {
  CsvFields fields;
  for (const std::size_t index : indices_->kept) fields.push_back(field({lines_, fields_}, index));
  return fields;
}

namespace {

/// The values by these rows.
template <typename T>
void arrange(std::vector<T>& values, const std::vector<IdAndRow>& rows) {
  if (values.empty()) return;
  std::vector<T> arranged;
  arranged.reserve(values.size());
  for (const IdAndRow row : rows) arranged.push_back(std::move(values[row_of(row)]));
  values = std::move(arranged);
}

/// Puts the points in the order of the column's ids, if these are ones: then labels and ties are by them.
void take_ids(const std::string& path, CsvPoints& read, const std::vector<std::uint32_t>& ids) {
  std::vector<IdAndRow> rows, spare;
  for (const std::uint32_t id : ids) rows.push_back(id_and_row(id, rows.size()));
  sort_by_id(rows, spare);
  const auto is_twin = [](IdAndRow a, IdAndRow b) { return id_of(a) == id_of(b); };
  if (id_of(rows.back()) == no_label || std::adjacent_find(rows.begin(), rows.end(), is_twin) != rows.end()) {
    read.notes.push_back(path +
                         ": the column id has other than whole numbers, each once and below 2^32 - 1, so "
                         "labels number the rows from 0");
    return;
  }
  read.ids.clear();
  for (const IdAndRow row : rows) read.ids.push_back(id_of(row));
  arrange(read.points, rows);
  arrange(read.values.numbers, rows);
  arrange(read.kept, rows);
}

}  // namespace

std::string note_of_absent(const std::string& path, std::uint64_t absent, std::uint64_t rows) {
  return path + ": " + std::to_string(absent) + " of " + std::to_string(rows) +
         " rows lack a coordinate and are left out";
}

CsvPoints read_csv(const std::string& path, const CsvOptions& options, bool has_z) {
  CsvReader reader(path, options, has_z);
  CsvPoints read;
  std::vector<std::uint32_t> ids;
  std::uint32_t rows = 0;
  ColumnReader column;
  for (; reader.next(); ++rows) {
    const Point& point = reader.point();
    if (std::isnan(point.x) || std::isnan(point.y) || std::isnan(point.z)) continue;
    read.points.push_back(point);
    read.ids.push_back(rows);
    if (!options.value_column.empty()) reader.add_value(column);
    if (!options.keep.empty()) read.kept.push_back(reader.kept());
    if (reader.id()) ids.push_back(*reader.id());
  }
  read.values = column.take();
  read.notes = reader.notes();
  read.kept_names = reader.kept_names();
  if (read.points.empty()) throw Error(path + no_coordinates);
  if (read.points.size() < rows) {
    read.notes.push_back(note_of_absent(path, rows - read.points.size(), rows));
  } else {
    read.ids.clear();  // the seeds' own
  }
  if (!ids.empty()) take_ids(path, read, ids);
  return read;
}

}  // namespace vorocl::command
