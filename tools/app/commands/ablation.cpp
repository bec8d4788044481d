// vorocl ablation: what each choice of dJFA is worth, as one table.
#include "studies/ablation.hpp"

#include <fmt/format.h>

#include <memory>
#include <nlohmann/json.hpp>

#include "app/commands/commands.hpp"
#include "app/commands/finish_at_end.hpp"
#include "app/options/options.hpp"
#include "app/terminal/interruption.hpp"
#include "app/terminal/progress.hpp"
#include "formats/csv.hpp"
#include "formats/files.hpp"
#include "studies/evaluation_file.hpp"
#include "studies/evaluation_plan.hpp"

namespace vorocl::command {

namespace {

struct AblationOptions {
  std::vector<int> sides;  // empty: the usual ones
  std::vector<SeedCount> seeds;
  EvaluationSettings settings;
  std::string path;
  std::string device;
  bool json = false;
};

/// What a row is made from, besides the origin.
struct Row {
  const std::string& date;
  const Configuration& configuration;
  const Variant& variant;
  const VariantResult& result;
};

struct Column {
  const char* name;
  std::string (*value)(const Row& row);
};

std::string text(double value) { return fmt::format("{}", value); }

const Column columns[] = {
    {"date", [](const Row& row) { return row.date; }},
    {"n", [](const Row& row) { return std::to_string(row.configuration.side); }},
    {"seeds", [](const Row& row) { return std::to_string(row.configuration.seeds); }},
    {"study", [](const Row& row) { return row.variant.study; }},
    {"setting", [](const Row& row) { return row.variant.setting; }},
    {"d_max", [](const Row& row) { return std::to_string(row.variant.step_length); }},
    {"waves_mean", [](const Row& row) { return text(row.result.waves.mean()); }},
    {"milliseconds_median", [](const Row& row) { return text(row.result.milliseconds.median()); }},
    {"milliseconds_least", [](const Row& row) { return text(row.result.milliseconds.least()); }},
    {"milliseconds_greatest", [](const Row& row) { return text(row.result.milliseconds.greatest()); }},
    {"similarity_to_exact_mean", [](const Row& row) { return text(row.result.similarity_to_exact.mean()); }},
    {"similarity_to_exact_least",
     [](const Row& row) { return text(row.result.similarity_to_exact.least()); }},
    {"wrong_percent_mean", [](const Row& row) { return text(row.result.errors.wrong_percent.mean()); }},
    {"wrong_percent_greatest",
     [](const Row& row) { return text(row.result.errors.wrong_percent.greatest()); }},
    {"largest_excess", [](const Row& row) { return text(row.result.errors.largest_excess.greatest()); }},
    {"mean_excess", [](const Row& row) { return text(row.result.errors.mean_excess.mean()); }},
    {"differing_between_runs_mean",
     [](const Row& row) { return text(row.result.differing_between_runs.mean()); }},
    {"differing_between_runs_greatest",
     [](const Row& row) { return text(row.result.differing_between_runs.greatest()); }},
};

std::string header_of(const Origin& origin) {
  CsvFields names;
  for (const auto& shared : origin) names.push_back(shared.first);
  for (const Column& column : columns) names.emplace_back(column.name);
  return to_csv(names);
}

std::string line_of(const Origin& origin, const Row& row) {
  CsvFields fields;
  for (const auto& shared : origin) fields.push_back(shared.second);
  for (const Column& column : columns) fields.push_back(column.value(row));
  return to_csv(fields);
}

void print_table(const Configuration& configuration, const EvaluationSettings& settings,
                 const std::vector<Variant>& variants, const std::vector<VariantResult>& results) {
  fmt::print("{} x {} pixels, {} seeds, mean of {} frames\n\n", configuration.side, configuration.side,
             configuration.seeds, settings.frames);
  fmt::print("{:<18} {:<32} {:>5} {:>5} {:>9} {:>9} {:>11} {:>16}\n", "study", "setting", "d_max", "waves",
             "ms/frame", "wrong %", "mean excess", "runs differ by %");
  for (std::size_t i = 0; i < variants.size(); ++i) {
    const VariantResult& result = results[i];
    fmt::print("{:<18} {:<32} {:>5} {:>5.1f} {:>9.3f} {:>9.4f} {:>11.3g} {:>16.4f}\n", variants[i].study,
               variants[i].setting, variants[i].step_length, result.waves.mean(),
               result.milliseconds.median() / settings.timed_frames, result.errors.wrong_percent.mean(),
               result.errors.mean_excess.mean(), result.differing_between_runs.mean());
  }
  fmt::print("\n");
}

/// Measures all variants of a configuration, prints them unless JSON is wanted, and returns the table's
/// lines.
std::string ablate(const Device& device, const Configuration& configuration, const AblationOptions& options) {
  const EvaluationSettings& settings = options.settings;
  const Interruption interruption;
  Progress progress;
  const std::vector<Variant> variants = variants_of(device, configuration, settings);
  const double all = diagrams_of_variant(settings) * static_cast<double>(variants.size());
  int done = 0;
  const auto made = [&](int diagrams) {
    done += diagrams;
    progress.show(done, done / all);
    if (interruption.came()) throw Error("interrupted; nothing is written");
  };
  const std::vector<VariantResult> results = measure(device, configuration, settings, variants, made);
  progress.erase();
  if (!options.json) print_table(configuration, settings, variants, results);
  const Origin origin = origin_of(device, settings);
  const std::string date = utc_now();
  std::string lines;
  for (std::size_t i = 0; i < variants.size(); ++i) {
    lines += line_of(origin, {date, configuration, variants[i], results[i]}) + "\n";
  }
  return lines;
}

void run(const AblationOptions& options) {
  check_extension(options.path, {".csv"});
  const OutputFile file(options.path);
  const std::vector<Configuration> all = configurations(options.sides, options.seeds);
  const Device device = Device::select(options.device);
  const FinishAtEnd finish(device);
  std::string table = header_of(origin_of(device, options.settings)) + "\n";
  for (const Configuration& configuration : all) table += ablate(device, configuration, options);
  file.write([&](const std::string& path) {
    std::ofstream stream = open_to_write(path);
    stream << table;
    check_written(stream, options.path);
  });
  if (options.json) {
    const nlohmann::ordered_json result = {
        {"device", device.name()}, {"configurations", all.size()}, {"file", options.path}};
    fmt::print("{}\n", result.dump());
  } else {
    fmt::print("wrote {}\n", options.path);
  }
}

}  // namespace

void add_ablation(CLI::App& app) {
  const auto options = std::make_shared<AblationOptions>();
  options->settings.frames = 50;
  options->settings.timed_frames = 20;
  CLI::App* const command = app.add_subcommand("ablation",
                                               "What dJFA's choices are worth, changed one at a time: its "
                                               "waves, its refresh, the seeds' motion and spread, "
                                               "and waves that scatter in place");
  command->add_option("-o", options->path, "Table to write: .csv")->type_name("FILE")->required();
  add_list(*command, "--sizes", options->sides, parse_side, "Grids, of n x n pixels")
      ->type_name("n,...")
      ->default_str("1000");
  add_list(*command, "--seeds", options->seeds, parse_seed_count,
           "Numbers of seeds, or percentages of the pixels")
      ->type_name("S|P%,...")
      ->default_str("1%");
  add_settings_options(*command, options->settings);
  add_device_option(*command, options->device);
  add_json_option(*command, options->json);
  command->callback([options] {
    if (options->sides.empty()) options->sides = {1000};
    if (options->seeds.empty()) options->seeds = {parse_seed_count("1%")};
    run(*options);
  });
}

}  // namespace vorocl::command
