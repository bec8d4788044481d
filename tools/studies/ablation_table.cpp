#include "studies/ablation_table.hpp"

namespace vorocl::command {

namespace {

/// What a row is made from, besides the origin.
struct Row {
  const std::string& date;
  const Configuration& configuration;
  const Variant& variant;
  const VariantResult& result;
};

const Column<Row> columns[] = {
    {"date", [](const Row& row) { return row.date; }},
    {"n", [](const Row& row) { return std::to_string(row.configuration.side); }},
    {"seeds", [](const Row& row) { return std::to_string(row.configuration.seeds); }},
    {"study", [](const Row& row) { return row.variant.study; }},
    {"setting", [](const Row& row) { return row.variant.setting; }},
    {"d_max", [](const Row& row) { return std::to_string(row.variant.max_displacement); }},
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

}  // namespace

std::string ablation_header(const Origin& origin) { return header_of(origin, columns) + "\n"; }

std::string ablation_rows(const Origin& origin, const Configuration& configuration,
                          const std::vector<Variant>& variants, const std::vector<VariantResult>& results) {
  const std::string date = utc_now();
  std::string lines;
  for (std::size_t i = 0; i < variants.size(); ++i) {
    lines += line_of(origin, columns, Row{date, configuration, variants[i], results[i]}) + "\n";
  }
  return lines;
}

}  // namespace vorocl::command
