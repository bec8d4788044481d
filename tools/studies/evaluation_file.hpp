// The table that an evaluation grows: a CSV file with one row for each configuration, method and metric.
#pragma once

#include <fstream>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "studies/evaluation.hpp"

namespace vorocl::command {

/// What all rows of a file share, by column: version, device, settings.
using Origin = std::vector<std::pair<std::string, std::string>>;

/// "2026-01-31T12:00:00Z"
std::string utc_now();

Origin origin_of(const Device& device, const EvaluationSettings& settings);

/// Not renamed at its end, as other files are: rows are added when a configuration is complete, so that an
/// evaluation which ends early can go on.
class EvaluationFile {
 public:
  /// Throws Error if no file can be made there, or if there is one and it is not to be gone on with
  /// (`resume`).
  EvaluationFile(const std::string& path, bool resume);

  /// Takes over the configurations that are complete in the file, if there is one, and says on standard error
  /// what it drops: a last line that was cut off, a configuration with rows missing. Throws Error if the file
  /// is none of an evaluation or has another origin.
  void begin(const Origin& origin);

  bool has(const Configuration& configuration) const { return complete_.count(configuration) > 0; }

  /// Adds the rows of a configuration. Throws Error if they cannot be written.
  void add(const Configuration& configuration, const ConfigurationResult& result);

  const std::string& path() const { return path_; }

 private:
  std::string path_;
  Origin origin_;
  std::set<Configuration> complete_;
  std::ofstream rows_;
};

}  // namespace vorocl::command
