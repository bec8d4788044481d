#include "formats/trajectory/trajectory.hpp"

#include <utility>

#include "formats/trajectory/line_reader.hpp"
#include "formats/trajectory/readers.hpp"
#include "formats/values.hpp"

namespace vorocl::command {

namespace {

bool starts_with(std::string_view text, std::string_view start) {
  return text.substr(0, start.size()) == start;
}

}  // namespace

std::unique_ptr<TrajectoryReader> open_trajectory(const std::string& path, const std::string& value_column,
                                                  Wanted wanted) {
  LineReader lines(path);
  if (!lines.next_filled()) {
    throw lines.error("the file is empty; give a LAMMPS text dump or an XYZ file");
  }
  const std::string_view first = trimmed(lines.line());
  lines.unread();
  if (starts_with(first, "ITEM:"))
    return std::make_unique<LammpsDump>(std::move(lines), value_column, wanted);
  // A count that is negative or far too large still tells an XYZ, which then says what is wrong with it.
  if (first.find_first_not_of("+-0123456789") == std::string_view::npos) {
    return std::make_unique<Xyz>(std::move(lines), value_column, wanted);
  }
  throw lines.error(
      "this is neither a LAMMPS text dump (its first line starts with \"ITEM:\") nor an XYZ file "
      "(its first line is the number of atoms)");
}

}  // namespace vorocl::command
