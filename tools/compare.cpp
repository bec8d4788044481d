// vorocl compare: the similarity of two label files.
#include <fmt/format.h>

#include <functional>
#include <memory>
#include <nlohmann/json.hpp>
#include <numeric>

#include "commands.hpp"
#include "label_file.hpp"
#include "options.hpp"
#include "vorocl/similarity.hpp"

namespace vorocl::command {

namespace {

struct CompareOptions {
  std::string a;
  std::string b;
  bool json = false;
};

void run(const CompareOptions& options) {
  const LabelImage a = read_labels(options.a), b = read_labels(options.b);
  if (a.grid != b.grid) {
    throw Error(fmt::format("{} is {} x {} pixels and {} is {} x {}; only images of one size can be compared",
                            options.a, a.grid.width(), a.grid.height(), options.b, b.grid.width(),
                            b.grid.height()));
  }
  const double percent = similarity(a.labels, b.labels);
  const auto equal = std::inner_product(a.labels.begin(), a.labels.end(), b.labels.begin(), std::size_t{0},
                                        std::plus<>(), std::equal_to<>());
  const std::size_t different = a.labels.size() - equal;
  if (options.json) {
    const nlohmann::ordered_json result = {
        {"similarity", percent}, {"pixels", a.labels.size()}, {"different_pixels", different}};
    fmt::print("{}\n", result.dump());
  } else {
    fmt::print("similarity {:.6f} %: {} of {} pixels differ\n", percent, different, a.labels.size());
  }
}

}  // namespace

void add_compare(CLI::App& app) {
  const auto options = std::make_shared<CompareOptions>();
  CLI::App* const command =
      app.add_subcommand("compare", "Similarity of two label files: the share of pixels with equal labels");
  command->add_option("a", options->a, "Labels, .npy or .tif")->required();
  command->add_option("b", options->b, "Labels of the same size")->required();
  add_json_option(*command, options->json);
  command->callback([options] { run(*options); });
}

}  // namespace vorocl::command
