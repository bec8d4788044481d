// vorocl compare: the similarity of two label files, or of one and the exact diagram of seeds.
#include <fmt/format.h>

#include <functional>
#include <memory>
#include <nlohmann/json.hpp>
#include <numeric>
#include <optional>
#include <unordered_map>

#include "app/commands/commands.hpp"
#include "app/options/option_groups.hpp"
#include "app/outputs/measures.hpp"
#include "app/terminal/console.hpp"
#include "app/terminal/end_of_run.hpp"
#include "formats/files.hpp"
#include "formats/raster_files.hpp"
#include "vorocl/distance_errors.hpp"
#include "vorocl/exact_diagram.hpp"
#include "vorocl/method.hpp"
#include "vorocl/similarity.hpp"

namespace vorocl::command {

namespace {

/// Judged by snapped points, as the paper has it, unless --no-snap says otherwise.
struct CompareOptions {
  CompareOptions() { seeds.usual_snap = Snap::to_pixels; }

  std::string a;
  std::string b;
  SeedOptions seeds;  // instead of b: what a is the diagram of
  Metric metric = Metric::euclidean;
  std::string device;
  std::string of_seeds;  // the first option that was given, of those that label files do not need
  bool json = false;

  bool has_seeds() const {
    return seeds.random > 0 || !seeds.points.empty() || !seeds.mask.empty() || !seeds.trajectory.empty();
  }
};

void check_sizes(const std::string& a, const Grid& of_a, const std::string& b, const Grid& of_b) {
  if (of_a == of_b) return;
  throw Error(fmt::format("{} is {} {} and {} is {}; only images of one size can be compared", a,
                          sides_of(of_a), of_a.is_volume() ? "voxels" : "pixels", b, sides_of(of_b)));
}

struct Comparison {
  double similarity;
  std::size_t pixels;
  std::size_t different_pixels;
  bool is_volume;
  const char* unit_of_distances = "";
  std::optional<DistanceErrors> errors = {};  // against the exact diagram
};

Comparison compare(const std::vector<std::uint32_t>& a, const std::vector<std::uint32_t>& b, bool is_volume) {
  const auto equal =
      std::inner_product(a.begin(), a.end(), b.begin(), std::size_t{0}, std::plus<>(), std::equal_to<>());
  return {similarity(a, b), a.size(), a.size() - equal, is_volume};
}

Comparison compare_files(const CompareOptions& options) {
  const LabelImage a = read_labels(options.a), b = read_labels(options.b);
  check_sizes(options.a, a.grid(), options.b, b.grid());
  return compare(a.labels, b.labels, a.depth > 1);
}

/// The labels as indices of seeds, where a file's labels carry the ids of its particles; no_label for one
/// that is no particle's.
std::vector<std::uint32_t> without_ids(std::vector<std::uint32_t> labels,
                                       const std::vector<std::uint32_t>& ids) {
  if (ids.empty()) return labels;
  std::unordered_map<std::uint32_t, std::uint32_t> index_of = {{no_label, no_label}};  // of absent particles
  for (std::size_t i = 0; i < ids.size(); ++i) index_of.emplace(ids[i], static_cast<std::uint32_t>(i));
  for (std::uint32_t& label : labels) {
    const auto found = index_of.find(label);
    label = found == index_of.end() ? no_label : found->second;
  }
  return labels;
}

/// Says how many labels of the file name none of the seeds.
void note_strangers(const std::string& path, const std::vector<std::uint32_t>& of_file,
                    const std::vector<std::uint32_t>& labels, std::size_t seeds) {
  std::size_t strangers = 0;
  for (std::size_t i = 0; i < labels.size(); ++i) {
    if (of_file[i] != no_label && labels[i] >= seeds) ++strangers;
  }
  if (strangers == 0) return;
  print_note(fmt::format("{} of {} labels in {} name none of the seeds: it may be of others", strangers,
                         labels.size(), path));
}

Comparison compare_with_exact(const CompareOptions& options) {
  const LabelImage image = read_labels(options.a);
  SeedOptions seed_options = options.seeds;
  if (!seed_options.size && seed_options.width == 0) seed_options.size = image.grid();
  const bool is_volume = seed_options.is_volume();
  if (image.depth > 1 && seed_options.width != 0) refuse_in_volumes("--width");
  if (is_volume) check_volume_method(method("exact"), options.metric);
  const Input input = read_input(seed_options);
  const View& view = input.view;
  check_sizes(options.a, image.grid(), "the diagram of the seeds",
              {view.picture.size.width(), view.picture.size.height(), view.picture.depth});

  const Device device = select_device(options.device);
  const FinishAtEnd finish(device);
  const Seeds seeds = input.place(device);
  Diagram exact(device, view.window);
  Diagram diagram(device, view.window);
  exact_diagram(seeds, exact, {options.metric});
  const std::vector<std::uint32_t> labels = without_ids(image.labels, input.ids);
  note_strangers(options.a, image.labels, labels, seeds.size());
  diagram.write(view.in_diagram(labels), seeds, options.metric);
  const std::vector<std::uint32_t> truth = exact.read();
  std::vector<std::uint32_t> room;
  Comparison comparison = compare(labels, view.in_picture(truth, no_label, room), is_volume);
  DistanceErrorsResult errors;
  distance_errors(diagram, exact, errors);
  comparison.errors = errors.read();
  comparison.unit_of_distances = unit_of_distances(seeds.grid());
  return comparison;
}

void print_result(const CompareOptions& options, const Comparison& comparison) {
  const auto& errors = comparison.errors;
  if (options.json) {
    Json result = {{"similarity", comparison.similarity},
                   {"pixels", comparison.pixels},
                   {"different_pixels", comparison.different_pixels}};
    if (errors) {
      result["errors"] = Json{{"wrong_pixels", errors->wrong_pixels},
                              {"unlabelled_pixels", errors->unlabelled_pixels},
                              {"largest_excess", errors->largest_excess},
                              {"mean_excess", errors->mean_excess}};
    }
    print_json(result);
    return;
  }
  const char* const pixels = comparison.is_volume ? "voxels" : "pixels";
  print("similarity {:.6f} %: {} of {} {} differ\n", comparison.similarity, comparison.different_pixels,
        comparison.pixels, pixels);
  if (errors) {
    print(
        "{} {} are wrong ({:.6f} %), {} of them without a seed; excess distance: mean {:.3g} {}, "
        "largest {:.3f}\n",
        errors->wrong_pixels, pixels, errors->wrong_percent(), errors->unlabelled_pixels, errors->mean_excess,
        comparison.unit_of_distances, errors->largest_excess);
  }
}

void run(const CompareOptions& options) {
  if (options.has_seeds() && !options.b.empty()) {
    throw UsageError("compare takes another label file or seeds, not both; leave out " + options.b +
                     " or the seeds");
  }
  if (!options.has_seeds() && options.b.empty()) {
    throw UsageError(
        "compare needs another label file or, to compare with their exact diagram, the seeds (such as "
        "--random)");
  }
  if (!options.has_seeds() && !options.of_seeds.empty()) {
    throw UsageError(options.of_seeds + " is for seeds; two label files are compared as they are");
  }
  for (const std::string& path : {options.a, options.b}) {
    if (!path.empty()) as_usage([&] { check_extension(path, readable_label_extensions); });
  }
  const Comparison comparison = options.has_seeds() ? compare_with_exact(options) : compare_files(options);
  print_result(options, comparison);
  const bool has_points = !options.seeds.points.empty() || !options.seeds.trajectory.empty();
  if (has_points && !options.seeds.snap && comparison.errors->wrong_pixels > 0) {
    print_note(
        "the centres of the points' pixels are the truth here, as methods that flood take them; --no-snap "
        "judges by the points themselves");
  }
}

}  // namespace

void add_compare(CommandLine& line) {
  const auto options = std::make_shared<CompareOptions>();
  Command command =
      line.add("compare", "Similarity of two label files, or of one and the exact diagram of seeds");
  command.add("a", options->a, "Labels, .npy or .tif; of a volume .npy").required();
  command.add("b", options->b, "Labels of the same size");
  add_seed_options(command, options->seeds, 0, false, Makes::volumes_too);
  add_frame_option(command, options->seeds);
  add_snap_option(command, options->seeds, "Judge labels");
  command.begin_section("Method");
  add_metric_option(command, options->metric);
  add_device_option(command, options->device);
  add_json_option(command, options->json);
  command.set_work([command, options] {
    const std::string given = command.given({"a", "b", "--json"});
    options->of_seeds = given.substr(0, given.find(' '));
    run(*options);
  });
}

}  // namespace vorocl::command
