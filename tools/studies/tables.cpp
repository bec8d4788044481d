#include "studies/tables.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <ctime>
#include <filesystem>
#include <map>

#include "formats/csv.hpp"
#include "formats/files.hpp"
#include "formats/output_file.hpp"
#include "formats/values.hpp"
#include "vorocl/error.hpp"
#include "vorocl/version.hpp"

namespace vorocl::command {

Origin origin_of(const Device& device, const EvaluationSettings& settings) {
  return {{"version", VOROCL_VERSION},
          {"platform", device.platform_name()},
          {"device", device.name()},
          {"driver", device.driver_version()},
          {"rng_seed", std::to_string(settings.rng_seed)},
          {"step_length", std::to_string(settings.step_length)},
          {"frames", std::to_string(settings.frames)},
          {"timed_frames", std::to_string(settings.timed_frames)},
          {"repeats", std::to_string(settings.repeats)}};
}

std::string utc_now() {
  const std::time_t now = std::time(nullptr);
  char text[sizeof "2026-01-31T12:00:00Z"];
  std::strftime(text, sizeof text, "%Y-%m-%dT%H:%M:%SZ", std::gmtime(&now));
  return text;
}

std::string text(double value) { return fmt::format("{}", value); }

namespace {

/// What a row is made from, besides the origin.
struct Row {
  const std::string& date;
  const Configuration& configuration;
  const ConfigurationResult& result;
  const MethodResult& method;

  /// How many times faster than another method this one is.
  std::string speedup_over(const std::string& other, Metric metric) const {
    return text(result.of(other, metric).milliseconds.median() / method.milliseconds.median());
  }
};

const Column<Row> columns[] = {
    {"date", [](const Row& row) { return row.date; }},
    {"n", [](const Row& row) { return std::to_string(row.configuration.side); }},
    {"seeds", [](const Row& row) { return std::to_string(row.configuration.seeds); }},
    {"pixels_per_seed",
     [](const Row& row) {
       return text(static_cast<double>(row.configuration.pixels()) /
                   static_cast<double>(row.configuration.seeds));
     }},
    {"coincident_seeds", [](const Row& row) { return std::to_string(row.result.coincident_seeds); }},
    {"method", [](const Row& row) { return row.method.method; }},
    {"metric", [](const Row& row) { return to_string(row.method.metric); }},
    {"waves", [](const Row& row) { return std::to_string(row.method.waves); }},
    {"milliseconds_median", [](const Row& row) { return text(row.method.milliseconds.median()); }},
    {"milliseconds_least", [](const Row& row) { return text(row.method.milliseconds.least()); }},
    {"milliseconds_greatest", [](const Row& row) { return text(row.method.milliseconds.greatest()); }},
    {"host_milliseconds_median", [](const Row& row) { return text(row.method.host_milliseconds.median()); }},
    {"speedup_over_jfa", [](const Row& row) { return row.speedup_over("jfa", Metric::euclidean); }},
    {"speedup_over_djfae", [](const Row& row) { return row.speedup_over("djfa", Metric::euclidean); }},
    {"similarity_to_euclidean_jfa_mean",
     [](const Row& row) { return text(row.method.similarity_to_euclidean_jfa.mean()); }},
    {"similarity_to_euclidean_jfa_least",
     [](const Row& row) { return text(row.method.similarity_to_euclidean_jfa.least()); }},
    {"similarity_to_jfa_mean", [](const Row& row) { return text(row.method.similarity_to_jfa.mean()); }},
    {"similarity_to_jfa_least", [](const Row& row) { return text(row.method.similarity_to_jfa.least()); }},
    {"similarity_to_exact_mean", [](const Row& row) { return text(row.method.similarity_to_exact.mean()); }},
    {"similarity_to_exact_least",
     [](const Row& row) { return text(row.method.similarity_to_exact.least()); }},
    {"wrong_percent_mean", [](const Row& row) { return text(row.method.errors.wrong_percent.mean()); }},
    {"wrong_percent_greatest",
     [](const Row& row) { return text(row.method.errors.wrong_percent.greatest()); }},
    {"largest_excess", [](const Row& row) { return text(row.method.errors.largest_excess.greatest()); }},
    {"mean_excess", [](const Row& row) { return text(row.method.errors.mean_excess.mean()); }},
};

using Values = std::map<std::string, std::string>;

/// A row as values by column. Throws Error if it is none of an evaluation.
Values values_of(const std::string& place, const std::string& header, const std::string& row) {
  const auto names = csv_fields(header), fields = csv_fields(row);
  if (!names || !fields || names->size() != fields->size()) {
    throw Error(place + ": this is no row of an evaluation; give another file");
  }
  Values values;
  for (std::size_t i = 0; i < names->size(); ++i) values[(*names)[i]] = (*fields)[i];
  return values;
}

/// Throws Error that names what differs; of another version nothing else is looked at.
void check_origin(const std::string& path, Values& values, const Origin& origin) {
  std::string differences;
  for (const auto& [name, value] : origin) {
    if (values[name] == value) continue;
    differences += fmt::format("{}{} is {} there and {} here", differences.empty() ? "" : ", ", name,
                               values[name], value);
    if (name == origin.front().first) break;
  }
  if (!differences.empty()) {
    throw Error(fmt::format("{} is of another evaluation ({}); give another file", path, differences));
  }
}

Configuration configuration_of(const std::string& place, Values& values) {
  const auto side = parse_number<int>(values["n"]);
  const auto seeds = parse_number<std::size_t>(values["seeds"]);
  if (!side || !seeds) throw Error(place + ": this row has no n and seeds; give another file");
  return {*side, *seeds};
}

/// The rows of each configuration, in the file's order.
using Rows = std::vector<std::pair<Configuration, std::vector<std::string>>>;

Rows rows_of(const std::string& path, const Lines& lines, const Origin& origin) {
  const std::string header = header_of(origin, columns);
  const bool is_evaluation = lines.whole.empty()
                                 ? header.rfind(lines.cut_off, 0) == 0
                                 : lines.whole.front().rfind(origin.front().first + ",", 0) == 0;
  if (!is_evaluation) throw Error(path + " is no evaluation; give another file");
  Rows rows;
  for (std::size_t i = 1; i < lines.whole.size(); ++i) {
    const std::string place = fmt::format("{}:{}", path, i + 1);
    Values values = values_of(place, lines.whole.front(), lines.whole[i]);
    check_origin(path, values, origin);
    const Configuration configuration = configuration_of(place, values);
    auto found = std::find_if(rows.begin(), rows.end(),
                              [&](const auto& entry) { return entry.first == configuration; });
    if (found == rows.end()) found = rows.insert(rows.end(), {configuration, {}});
    found->second.push_back(lines.whole[i]);
  }
  if (!lines.whole.empty() && lines.whole.front() != header) {
    throw Error(path + " has other columns than evaluations of this version; give another file");
  }
  return rows;
}

}  // namespace

EvaluationFile::EvaluationFile(const std::string& path, bool resume) : path_(path) {
  check_extension(path, {".csv"});
  OutputFile(path).require_file("an evaluation");
  std::error_code ignored;
  if (!resume && std::filesystem::exists(path, ignored)) {
    throw Error(path + " exists; --resume goes on with it, or give another file");
  }
}

std::vector<std::string> EvaluationFile::begin(const Origin& origin) {
  origin_ = origin;
  std::vector<std::string> dropped;
  std::string kept = header_of(origin, columns) + "\n";
  std::error_code ignored;
  if (std::filesystem::exists(path_, ignored)) {
    const Lines lines = read_lines(path_, "evaluation");
    const Rows all_rows = rows_of(path_, lines, origin);
    if (!lines.cut_off.empty()) dropped.push_back(path_ + ": the last line was cut off and is dropped");
    for (const auto& [configuration, rows] : all_rows) {
      if (rows.size() == 2 * evaluated_methods().size()) {
        complete_.insert(configuration);
        for (const std::string& row : rows) kept += row + "\n";
      } else {
        dropped.push_back(
            fmt::format("{}: {} x {} pixels with {} seeds have {} rows of {}, which are dropped", path_,
                        configuration.side, configuration.side, configuration.seeds, rows.size(),
                        2 * evaluated_methods().size()));
      }
    }
  }
  GrowingFile table{OutputFile(path_)};
  table << kept;
  table.finish();
  return dropped;
}

void EvaluationFile::add(const Configuration& configuration, const ConfigurationResult& result) {
  const std::string date = utc_now();
  std::string lines;
  for (const MethodResult& method : result.methods) {
    lines += line_of(origin_, columns, Row{date, configuration, result, method}) + "\n";
  }
  append_to_file(path_, lines);
  complete_.insert(configuration);
}

}  // namespace vorocl::command
