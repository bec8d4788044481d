// CSV files: their lines, and points from them.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "vorocl/grid.hpp"

namespace vorocl::command {

using CsvFields = std::vector<std::string>;

/// The fields of a line, without the blanks around them; fields may be quoted ("a ""b"", c"). None if a quote
/// is not closed.
std::optional<CsvFields> csv_fields(const std::string& line);

/// The line, without its end, of these fields; those that need it are quoted.
std::string to_csv(const CsvFields& fields);

/// The two columns that hold the points: names from the header, or indices from 0.
struct Columns {
  std::string x;
  std::string y;
};

/// "x,y" to columns. Throws Error unless these are two names.
Columns parse_columns(const std::string& text);

/// The points of a CSV file with commas, in its order. A first line without any number is a header. Without
/// `columns` the header must name an x and a y (in any case); where there is no header the first two columns
/// count. Blank lines are skipped. Throws Error that names file, line
/// and text for a line that cannot be read, and if there is no point at all.
std::vector<Point> read_csv(const std::string& path, const std::optional<Columns>& columns);

}  // namespace vorocl::command
