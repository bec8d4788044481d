// CSV files: their lines, points from them, and values that go with those. (Debian 12 and 13 have libcsv
// alone, without a release since 2013.)
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "formats/trajectory/line_reader.hpp"
#include "formats/values.hpp"
#include "vorocl/grid.hpp"

namespace vorocl::command {

using CsvFields = std::vector<std::string>;

/// The fields of a line, without the blanks around them; those that begin with a quote are quoted
/// ("a ""b"", c"). None if a quote is not closed.
std::optional<CsvFields> csv_fields(std::string_view line, char separator = ',');

/// The line, without its end, of these fields; those that need it are quoted.
std::string to_csv(const CsvFields& fields);

/// The names of columns beside others: one that these have too gets "input_" before it.
CsvFields other_names(CsvFields names, const std::vector<std::string>& others);

/// The columns that hold the points: names from the header, or indices from 0.
struct Columns {
  std::string x;
  std::string y;
  std::string z = {};  ///< of a volume; else empty
};

/// "x,y" to columns, or "x,y,z" where there are volumes. Throws Error unless these are so many names.
Columns parse_columns(const std::string& text, bool of_volumes = false);

/// What is asked for of a file.
struct CsvOptions {
  std::optional<Columns> columns;      ///< else those that the header names, or the only ones
  std::string value_column = {};       ///< by name or index; "": none
  bool decimal_comma = false;          ///< of numbers; then fields have other separators
  std::vector<std::string> keep = {};  ///< columns whose text is kept; {"all"}: every one that has a name
  bool reads_ids = true;               ///< of the column id
  bool on_globe = false;               ///< points are longitudes and latitudes
};

/// The columns, from 0.
struct CsvIndices {
  std::size_t x = 0, y = 1;
  std::optional<std::size_t> z = {}, value = {}, id = {};
  std::vector<std::size_t> kept = {};
};

/// The points of a CSV file, one after the other. Fields are separated by commas, or by what the first line
/// has, semicolons or tabs, or says (sep=;). They may be quoted, with line breaks too. Comments (# ...) and
/// rows of empty fields are skipped. The first row is a header if it names columns that are asked for, has no
/// numbers, or counts from 0 as pandas does. Without `columns` it must name an x and a y, or a longitude and
/// a latitude, in any case; where there is no header there must be two columns, three with a value column.
class CsvReader {
 public:
  /// Throws Error if the file cannot be read.
  explicit CsvReader(const std::string& path, CsvOptions options, bool has_z = false);

  /// Goes to the next point; false at the end of the file. Throws Error that names file, line and text for a
  /// line that cannot be read, has more than a mebibyte or more fields than the first one, an infinite
  /// coordinate, a latitude beyond a pole and a column that is not there, and at the end if there was no
  /// point at all.
  bool next();

  /// Coordinates that are absent (empty, NA, NaN, null) are NaN; z is that of a volume, or 0.
  const Point& point() const { return point_; }

  /// Of the column id, if the header names one: no_label if it is none.
  std::optional<std::uint32_t> id() const { return indices_->id ? std::optional(id_) : std::nullopt; }

  /// Adds that of the value column. Throws Error, as above, for a text among numbers.
  void add_value(ColumnReader& column) const;

  CsvFields kept() const;
  const std::vector<std::string>& kept_names() const { return options_.keep; }

  /// What a user may not expect of the file. Known after next().
  const std::vector<std::string>& notes() const { return notes_; }

 private:
  bool next_record();
  bool begin();  // with the first record: whether it is a header

  std::string path_;
  CsvOptions options_;
  LineReader lines_;
  bool has_z_;
  std::optional<char> separator_;
  CsvFields fields_;  // of the present record
  std::optional<CsvIndices> indices_;
  std::size_t columns_there_ = 0;  // fields of the first one
  bool has_points_ = false;
  std::vector<std::string> notes_;
  Point point_;
  std::uint32_t id_ = no_label;
};

/// By point, those of its row; those of other columns are empty.
struct CsvPoints {
  std::vector<Point> points;
  ColumnValues values;  ///< of the value column
  std::vector<std::uint32_t>
      ids;  ///< ascending, of the column id, or the numbers of rows if some have no point
  std::vector<CsvFields> kept;
  std::vector<std::string> kept_names, notes;
};

/// What is said of a file all or some of whose rows have no point.
constexpr const char* no_coordinates = " holds no points: all rows lack a coordinate";
std::string note_of_absent(const std::string& path, std::uint64_t absent, std::uint64_t rows);

/// All points of such a file, without rows that lack a coordinate. Throws Error as CsvReader.
CsvPoints read_csv(const std::string& path, const CsvOptions& options, bool has_z = false);

}  // namespace vorocl::command
