#include "app/options/method_options.hpp"

#include "app/terminal/usage_error.hpp"

namespace vorocl::command {

Choices<Method> method_choices() {
  Choices<Method> choices;
  for (const Method& method : methods()) choices.emplace_back(method.name, method);
  return choices;
}

void add_method_options(CLI::App& app, MethodOptions& options) {
  add_metric_option(app, options.metric);
  const Choices<std::optional<NeighbourhoodMix>> neighbourhoods = {
      {"moore", NeighbourhoodMix::moore},
      {"von-neumann", NeighbourhoodMix::von_neumann},
      {"mixed", NeighbourhoodMix::mixed}};
  add_choice(app, "--neighbourhood", options.neighbourhood, neighbourhoods, "Neighbours that a wave looks at")
      ->default_str("mixed for djfa, moore for the others");
  app.add_option("--von-neumann-waves", options.von_neumann_waves,
                 "Of djfa, mixed: how many of the first waves are von Neumann")
      ->type_name("0|1|2")
      ->check(CLI::Range(0, 2))
      ->capture_default_str();
  app.add_option("--extra-waves", options.extra_waves, "Of djfa: waves of step 1, or 2 and 1, at the end")
      ->type_name("0|1|2")
      ->check(CLI::Range(0, 2))
      ->capture_default_str();
  app.add_option("--refresh-interval", options.refresh_interval,
                 "Of djfa: a full JFA every R frames; 0: in frame 0 alone")
      ->type_name("R")
      ->check(CLI::Range(0, 1000000000))
      ->capture_default_str();
}

void check_method_options(const CLI::App& app, const MethodOptions& options, bool has_djfa) {
  if (has_djfa) return;
  if (options.neighbourhood == NeighbourhoodMix::mixed) {
    throw UsageError("--neighbourhood mixed is for the method djfa");
  }
  for (const char* name : {"--von-neumann-waves", "--extra-waves", "--refresh-interval"}) {
    if (app.count(name) > 0) throw UsageError(std::string(name) + " is for the method djfa");
  }
}

}  // namespace vorocl::command
