// The table that an evaluation grows: a CSV file with one row for each configuration, method and metric.
#pragma once

#include <set>
#include <string>
#include <vector>

#include "studies/evaluation.hpp"
#include "studies/table.hpp"

namespace vorocl::command {

/// Not renamed at its end, as other files are: rows are added when a configuration is complete, so that an
/// evaluation which ends early can be continued.
class EvaluationFile {
 public:
  /// Throws Error if the name is not that of a .csv file, if no file can be made there, or if there is one
  /// and it is not to be continued
  /// (`resume`).
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
