// vorocl compare: the similarity of two label files, or of one and the truth.
#include <fmt/format.h>

#include <cmath>
#include <functional>
#include <memory>
#include <nlohmann/json.hpp>
#include <numeric>
#include <optional>
#include <unordered_map>

#include "app/commands/commands.hpp"
#include "app/commands/finish_at_end.hpp"
#include "app/options/options.hpp"
#include "app/sources/seed_input.hpp"
#include "app/terminal/usage_error.hpp"
#include "formats/label_files.hpp"
#include "vorocl/distance_errors.hpp"
#include "vorocl/exact_diagram.hpp"
#include "vorocl/similarity.hpp"

namespace vorocl::command {

namespace {

struct CompareOptions {
  std::string a;
  std::string b;
  SeedOptions seeds;  // instead of b: what a is the diagram of
  Metric metric = Metric::euclidean;
  std::string device;
  bool json = false;

  bool with_truth() const {
    return seeds.random > 0 || !seeds.points.empty() || !seeds.mask.empty() || !seeds.trajectory.empty();
  }
};

void check_grids(const std::string& a, const Grid& of_a, const std::string& b, const Grid& of_b) {
  if (of_a == of_b) return;
  throw Error(fmt::format("{} is {} x {} pixels and {} is {} x {}; only images of one size can be compared",
                          a, of_a.width(), of_a.height(), b, of_b.width(), of_b.height()));
}

struct Comparison {
  double similarity;
  std::size_t pixels;
  std::size_t different_pixels;
  std::optional<DistanceErrors> errors;  // against the truth
};

Comparison compare(const LabelImage& a, const LabelImage& b) {
  const auto equal = std::inner_product(a.labels.begin(), a.labels.end(), b.labels.begin(), std::size_t{0},
                                        std::plus<>(), std::equal_to<>());
  return {similarity(a.labels, b.labels), a.labels.size(), a.labels.size() - equal, {}};
}

Comparison compare_files(const CompareOptions& options) {
  const LabelImage a = read_labels(options.a), b = read_labels(options.b);
  check_grids(options.a, a.grid, options.b, b.grid);
  return compare(a, b);
}

/// The labels as indices of seeds, where a file's labels carry the ids of its particles; no_label for one
/// that is no particle's.
std::vector<std::uint32_t> without_ids(std::vector<std::uint32_t> labels,
                                       const std::vector<std::uint32_t>& ids,
                                       const std::vector<std::optional<Point>>& seeds) {
  if (ids.empty()) return labels;
  std::unordered_map<std::uint32_t, std::uint32_t> index_of;
  for (std::size_t i = 0; i < seeds.size(); ++i) {
    if (seeds[i]) index_of.emplace(ids.at(i), static_cast<std::uint32_t>(i));
  }
  for (std::uint32_t& label : labels) {
    const auto found = index_of.find(label);
    label = found == index_of.end() ? no_label : found->second;
  }
  return labels;
}

Comparison compare_with_truth(const CompareOptions& options) {
  const LabelImage image = read_labels(options.a);
  SeedOptions seed_options = options.seeds;
  if (!seed_options.size && seed_options.width == 0) seed_options.size = image.grid;
  const Input input = read_input(seed_options);
  check_grids(options.a, image.grid, "the diagram of the seeds", input.grid);

  const Device device = Device::select(options.device);
  const FinishAtEnd finish(device);
  const Seeds seeds = input.place(device);
  Diagram exact(device, input.grid);
  Diagram diagram(device, input.grid);
  exact_diagram(seeds, exact, {options.metric});
  const std::vector<std::uint32_t> labels = without_ids(image.labels, input.ids, seeds.read());
  diagram.write(labels);
  Comparison comparison = compare({input.grid, labels}, {input.grid, exact.read()});
  comparison.errors = distance_errors(seeds, diagram, exact, options.metric);
  return comparison;
}

void print_json(const Comparison& comparison) {
  nlohmann::ordered_json result = {{"similarity", comparison.similarity},
                                   {"pixels", comparison.pixels},
                                   {"different_pixels", comparison.different_pixels}};
  if (comparison.errors) {
    result["errors"] = {{"wrong_pixels", comparison.errors->wrong_pixels},
                        {"unlabelled_pixels", comparison.errors->unlabelled_pixels},
                        {"largest_excess", comparison.errors->largest_excess},
                        {"mean_excess", comparison.errors->mean_excess}};
  }
  fmt::print("{}\n", result.dump());
}

void print_text(const Comparison& comparison) {
  fmt::print("similarity {:.6f} %: {} of {} pixels differ\n", comparison.similarity,
             comparison.different_pixels, comparison.pixels);
  if (const auto& errors = comparison.errors) {
    fmt::print(
        "{} pixels are wrong ({:.6f} %), {} of them without a seed; excess distance: mean {:.3g} pixels, "
        "largest {:.3f}\n",
        errors->wrong_pixels, errors->wrong_percent(), errors->unlabelled_pixels, errors->mean_excess,
        errors->largest_excess);
  }
}

void run(const CompareOptions& options) {
  if (options.with_truth() != options.b.empty()) {
    throw UsageError(
        "compare needs another label file or, to judge by the truth, the seeds (such as --random)");
  }
  const Comparison comparison = options.with_truth() ? compare_with_truth(options) : compare_files(options);
  options.json ? print_json(comparison) : print_text(comparison);
}

}  // namespace

void add_compare(CLI::App& app) {
  const auto options = std::make_shared<CompareOptions>();
  CLI::App* const command = app.add_subcommand("compare",
                                               "Similarity of two label files: the share of pixels with "
                                               "equal labels; or of one and the exact diagram of seeds");
  command->add_option("a", options->a, "Labels, .npy or .tif")->required();
  command->add_option("b", options->b, "Labels of the same size");
  add_seed_options(*command, options->seeds);
  command->get_option_group("Seeds")->require_option(0, 1);
  add_frame_option(*command, options->seeds);
  add_metric_option(*command, options->metric);
  add_device_option(*command, options->device);
  add_json_option(*command, options->json);
  command->callback([options] { run(*options); });
}

}  // namespace vorocl::command
