// The tables of the studies: CSV rows, each of which starts with its origin; and the one that an evaluation
// grows.
#pragma once

#include <set>
#include <string>
#include <utility>
#include <vector>

#include "formats/csv.hpp"
#include "studies/evaluation.hpp"
#include "vorocl/device.hpp"

namespace vorocl::command {

/// What all rows of a file share, by column: version, device, settings.
using Origin = std::vector<std::pair<std::string, std::string>>;

Origin origin_of(const Device& device, const EvaluationSettings& settings);

/// "2026-01-31T12:00:00Z"
std::string utc_now();

/// The number in as few digits as tell it from all others.
std::string text(double value);

/// A column, and what it holds of what a row is made from.
template <typename Row>
struct Column {
  const char* name;
  std::string (*value)(const Row& row);
};

template <typename Row, std::size_t count>
std::string header_of(const Origin& origin, const Column<Row> (&columns)[count]) {
  CsvFields names;
  for (const auto& shared : origin) names.push_back(shared.first);
  for (const Column<Row>& column : columns) names.emplace_back(column.name);
  return to_csv(names);
}

template <typename Row, std::size_t count>
std::string line_of(const Origin& origin, const Column<Row> (&columns)[count], const Row& row) {
  CsvFields fields;
  for (const auto& shared : origin) fields.push_back(shared.second);
  for (const Column<Row>& column : columns) fields.push_back(column.value(row));
  return to_csv(fields);
}

/// The table of an evaluation, with one row for each configuration, method and metric.
///
/// Not renamed at its end, as other files are: rows are added when a configuration is complete, so that an
/// evaluation which ends early can be continued.
class EvaluationFile {
 public:
  /// Throws Error if the name is not that of a .csv file, if no file can be made there, or if there is one
  /// and it is not to be continued (`resume`).
  EvaluationFile(const std::string& path, bool resume);

  /// Takes over the configurations that are complete in the file, if there is one, and drops the rest: a last
  /// line that was cut off, a configuration with rows missing. Returns a sentence for each thing that it
  /// drops. Throws Error if the file is none of an evaluation or has another origin.
  std::vector<std::string> begin(const Origin& origin);

  bool has(const Configuration& configuration) const { return complete_.count(configuration) > 0; }

  /// Adds the rows of a configuration. Throws Error if they cannot be written; then none of them is there.
  void add(const Configuration& configuration, const ConfigurationResult& result);

  const std::string& path() const { return path_; }

 private:
  std::string path_;
  Origin origin_;
  std::set<Configuration> complete_;
};

}  // namespace vorocl::command
