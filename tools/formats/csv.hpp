// CSV files: their lines, points from them, and values that go with those.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "formats/trajectory/line_reader.hpp"
#include "vorocl/grid.hpp"

namespace vorocl::command {

using CsvFields = std::vector<std::string>;

/// The fields of a line, without the blanks around them; fields may be quoted ("a ""b"", c"). None if a quote
/// is not closed.
std::optional<CsvFields> csv_fields(std::string_view line);

/// The line, without its end, of these fields; those that need it are quoted.
std::string to_csv(const CsvFields& fields);

/// The columns that hold the points: names from the header, or indices from 0.
struct Columns {
  std::string x;
  std::string y;
  std::string z = {};  ///< of a volume; else empty
};

/// "x,y" to columns. Throws Error unless these are two names.
Columns parse_columns(const std::string& text);

/// The same where volumes have "x,y,z".
Columns parse_columns_and_z(const std::string& text);

/// The columns of points and values, from 0.
struct CsvIndices {
  std::size_t x = 0, y = 1;
  std::optional<std::size_t> z;
  std::optional<std::size_t> value;
};

/// The points of a CSV file with commas, one after the other. A first line without any number is a header.
/// Without `columns` the header must name an x and a y (in any case); where there is no header there must be
/// two columns, or three with a value column. Blank lines are skipped; fields may be quoted ("a ""b"", c").
/// The value column is a name or an index too; there an empty field is an absent value (NaN).
class CsvReader {
 public:
  /// Throws Error if the file cannot be read.
  explicit CsvReader(const std::string& path, const std::optional<Columns>& columns,
                     const std::string& value_column = "", bool has_z = false);

  /// Goes to the next point; false at the end of the file. Throws Error that names file, line and text for a
  /// line that cannot be read, has more than a mebibyte or more fields than the first one, a coordinate that
  /// is not finite and a column that is not there, and at the end if there was no point at all.
  bool next();

  const Point& point() const { return point_; }
  double z() const { return z_; }          ///< of a volume
  double value() const { return value_; }  ///< of the value column

  /// Whether the header names a z, which is neither asked for nor the value column. Known after next().
  bool leaves_out_z() const { return leaves_out_z_; }

 private:
  std::string path_;
  std::optional<Columns> columns_;
  std::string value_column_;
  LineReader lines_;
  bool has_z_;
  std::optional<CsvIndices> indices_;
  std::size_t columns_there_ = 0;  // fields of the first line
  bool has_points_ = false;
  bool leaves_out_z_ = false;
  Point point_;
  double z_ = 0;
  double value_ = 0;
};

struct CsvPoints {
  std::vector<Point> points;
  std::vector<double> values;  ///< of the value column, one per point; empty without one
  bool leave_out_z = false;    ///< see CsvReader::leaves_out_z()
};

/// All points (x, y, z) of such a file, whose header must name a z too, or whose columns must be three; with
/// `columns` these must be. Throws Error as CsvReader.
std::vector<Point3> read_csv_of_volume(const std::string& path, const std::optional<Columns>& columns);

/// All points of such a file. Throws Error as CsvReader.
CsvPoints read_csv(const std::string& path, const std::optional<Columns>& columns,
                   const std::string& value_column = "");

}  // namespace vorocl::command
