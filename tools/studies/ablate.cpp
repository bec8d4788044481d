// vorocl-study ablation: what each choice of dJFA is worth, as one table.
#include <fmt/format.h>

#include <memory>
#include <nlohmann/json.hpp>

#include "app/options/option_groups.hpp"
#include "app/terminal/console.hpp"
#include "app/terminal/end_of_run.hpp"
#include "app/terminal/progress.hpp"
#include "app/terminal/selected_device.hpp"
#include "formats/files.hpp"
#include "formats/output_file.hpp"
#include "studies/ablation.hpp"
#include "studies/study_line.hpp"
#include "studies/tables.hpp"

namespace vorocl::command {

namespace {

/// What a row is made from, besides the origin.
struct VariantRow {
  const std::string& date;
  const Configuration& configuration;
  const Variant& variant;
  const VariantResult& result;
};

const Column<VariantRow> variant_columns[] = {
    {"date", [](const VariantRow& row) { return row.date; }},
    {"n", [](const VariantRow& row) { return std::to_string(row.configuration.side); }},
    {"seeds", [](const VariantRow& row) { return std::to_string(row.configuration.seeds); }},
    {"study", [](const VariantRow& row) { return row.variant.study; }},
    {"setting", [](const VariantRow& row) { return row.variant.setting; }},
    {"d_max", [](const VariantRow& row) { return std::to_string(row.variant.max_displacement); }},
    {"waves_mean", [](const VariantRow& row) { return text(row.result.waves.mean()); }},
    {"milliseconds_median", [](const VariantRow& row) { return text(row.result.milliseconds.median()); }},
    {"milliseconds_least", [](const VariantRow& row) { return text(row.result.milliseconds.least()); }},
    {"milliseconds_greatest", [](const VariantRow& row) { return text(row.result.milliseconds.greatest()); }},
    {"similarity_to_exact_mean",
     [](const VariantRow& row) { return text(row.result.similarity_to_exact.mean()); }},
    {"similarity_to_exact_least",
     [](const VariantRow& row) { return text(row.result.similarity_to_exact.least()); }},
    {"wrong_percent_mean",
     [](const VariantRow& row) { return text(row.result.errors.wrong_percent.mean()); }},
    {"wrong_percent_greatest",
     [](const VariantRow& row) { return text(row.result.errors.wrong_percent.greatest()); }},
    {"largest_excess",
     [](const VariantRow& row) { return text(row.result.errors.largest_excess.greatest()); }},
    {"mean_excess", [](const VariantRow& row) { return text(row.result.errors.mean_excess.mean()); }},
    {"differing_between_runs_mean",
     [](const VariantRow& row) { return text(row.result.differing_between_runs.mean()); }},
    {"differing_between_runs_greatest",
     [](const VariantRow& row) { return text(row.result.differing_between_runs.greatest()); }},
};

/// The first line of the table.
std::string ablation_header(const Origin& origin) { return header_of(origin, variant_columns) + "\n"; }

/// The lines of a configuration, from the results of its variants.
std::string ablation_rows(const Origin& origin, const Configuration& configuration,
                          const std::vector<Variant>& variants, const std::vector<VariantResult>& results) {
  const std::string date = utc_now();
  std::string lines;
  for (std::size_t i = 0; i < variants.size(); ++i) {
    lines +=
        line_of(origin, variant_columns, VariantRow{date, configuration, variants[i], results[i]}) + "\n";
  }
  return lines;
}

struct AblationOptions {
  StudyOptions study;
  std::string path;
  std::string device;
  bool json = false;
};

void print_table(const Configuration& configuration, const EvaluationSettings& settings,
                 const std::vector<Variant>& variants, const std::vector<VariantResult>& results) {
  print("{} x {} pixels, {} seeds, mean of {} frames\n\n", configuration.side, configuration.side,
        configuration.seeds, settings.frames);
  print("{:<18} {:<32} {:>5} {:>5} {:>9} {:>9} {:>11} {:>16}\n", "study", "setting", "d_max", "waves",
        "ms/frame", "wrong %", "mean excess", "runs differ by %");
  for (std::size_t i = 0; i < variants.size(); ++i) {
    const VariantResult& result = results[i];
    print("{:<18} {:<32} {:>5} {:>5.1f} {:>9.3f} {:>9.4f} {:>11.3g} {:>16.4f}\n", variants[i].study,
          variants[i].setting, variants[i].max_displacement, result.waves.mean(),
          result.milliseconds.median() / settings.timed_frames, result.errors.wrong_percent.mean(),
          result.errors.mean_excess.mean(), result.differing_between_runs.mean());
  }
  print("\n");
}

/// Measures all variants of a configuration, prints them unless JSON is wanted, and returns the table's
/// lines.
std::string ablate(const Device& device, const Configuration& configuration, const AblationOptions& options) {
  const EvaluationSettings& settings = options.study.settings;
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
  return ablation_rows(origin_of(device, settings), configuration, variants, results);
}

void run(const AblationOptions& options) {
  as_usage([&] { check_extension(options.path, {".csv"}); });
  const OutputFile file(options.path);
  const std::vector<Configuration> all =
      as_usage([&] { return configurations(options.study.sides, options.study.seeds); });
  const Device device = select_device(options.device);
  const FinishAtEnd finish(device);
  std::string table = ablation_header(origin_of(device, options.study.settings));
  for (const Configuration& configuration : all) table += ablate(device, configuration, options);
  GrowingFile written(file);
  written << table;
  written.finish();
  if (options.json) {
    print_json({{"device", device.name()}, {"configurations", all.size()}, {"file", options.path}});
  } else {
    print("wrote {}\n", options.path);
  }
}

}  // namespace

void add_ablation(CommandLine& line) {
  const auto options = std::make_shared<AblationOptions>();
  options->study.settings.frames = 50;
  options->study.settings.timed_frames = 20;
  Command command = line.add("ablation",
                             "What dJFA's choices are worth, changed one at a time: its "
                             "waves, its refresh, the seeds' motion and spread, "
                             "and waves that scatter in place");
  command.add("-o", options->path, "Table to write: .csv").value_name("FILE").required();
  add_study_options(command, options->study, "1000", "1%");
  add_device_option(command, options->device);
  add_json_option(command, options->json);
  command.set_work([options] {
    if (options->study.sides.empty()) options->study.sides = {1000};
    if (options->study.seeds.empty()) options->study.seeds = {parse_seed_count("1%")};
    run(*options);
  });
}

}  // namespace vorocl::command
