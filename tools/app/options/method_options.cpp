#include <algorithm>

#include "app/options/option_groups.hpp"
#include "app/terminal/console.hpp"
#include "formats/values.hpp"

namespace vorocl::command {

Option add_metric_option(Command& command, Metric& metric, Globe globe) {
  constexpr const char* of_globe = "great-circle";
  Choices<Metric> metrics = {{"euclidean", Metric::euclidean}, {"manhattan", Metric::manhattan}};
  std::string about = "Distance";
  if (globe == Globe::yes) {
    metrics.emplace_back(of_globe, Metric::great_circle);
    about +=
        "; great-circle: on the globe, of longitudes and latitudes in degrees, north up unless --y-down, in "
        "kilometres";
  }
  const auto parse = [metrics, globe](const std::string& text) {
    if (globe == Globe::no && text == of_globe) {
      throw Error(
          "great-circle, the distance on the globe, is of render and cells, whose labels compare "
          "takes as two files; here there are " +
          names_of(metrics));
    }
    return choose(metrics, text);
  };
  return command.add_parsed("--metric", metric, parse, about + ": " + names_of(metrics))
      .value_name("NAME")
      .default_text(to_string(metric));
}

Option add_device_option(Command& command, std::string& request) {
  return command
      .add("--device", request,
           "Part of a platform's or device's name, or platform:device indices (vorocl devices lists "
           "them); else what the environment variable VOROCL_DEVICE says, else the best there is")
      .in_section(run_section);
}

Option add_json_option(Command& command, bool& json) {
  return command.add("--json", json, "Print one JSON object of results and nothing else on standard output")
      .in_section(run_section);
}

Choices<Method> method_choices() {
  Choices<Method> choices;
  for (const Method& method : methods()) choices.emplace_back(method.name, method);
  return choices;
}

void add_method_option(Command& command, Method& method, const std::string& about) {
  command.begin_section("Method");
  command.add_choice("--method", method, method_choices(), about).default_text(method.name);
}

void add_method_options(Command& command, MethodOptions& options, Globe globe) {
  add_metric_option(command, options.metric, globe);
  command.begin_section("Flooding, for its study");
  const Choices<std::optional<NeighbourhoodMix>> neighbourhoods = {
      {"moore", NeighbourhoodMix::moore},
      {"von-neumann", NeighbourhoodMix::von_neumann},
      {"mixed", NeighbourhoodMix::mixed}};
  command
      .add_choice("--neighbourhood", options.neighbourhood, neighbourhoods, "Neighbours that a wave looks at")
      .default_text("mixed for djfa, moore for the others");
  command
      .add(
          "--von-neumann-waves", options.von_neumann_waves,
          "djfa with the mixed neighbourhood: how many waves, from the first, look at von Neumann neighbours")
      .value_name("0|1|2")
      .in_range(0, 2)
      .default_is_value();
  command
      .add("--extra-waves", options.extra_waves,
           "djfa: waves to add at the end: one of step 1, or two of steps 2 and 1")
      .value_name("0|1|2")
      .in_range(0, 2)
      .default_is_value();
  command
      .add("--refresh-interval", options.refresh_interval,
           "djfa: make a full JFA in every R-th frame; 0: in frame 0 alone")
      .value_name("R")
      .in_range(0, 1000000000)
      .default_is_value();
  const Choices<Reach> reaches = {
      {"measured", Reach::measured}, {"paper", Reach::paper}, {"authors", Reach::authors}};
  command
      .add_choice(
          "--reach", options.reach, reaches,
          "djfa: the waves follow from how far the last labels are from their seeds, or, as in the "
          "paper, from the mean density and the greatest displacement alone; authors: likewise, with a "
          "first step rounded down, as in the program of the paper's authors")
      .default_text("measured");
}

void check_method_options(const Command& command, const std::vector<Method>& methods,
                          const MethodOptions& options) {
  const auto is_djfa = [](const Method& method) { return method.continues; };
  if (std::any_of(methods.begin(), methods.end(), is_djfa)) return;
  for (const Method& method : methods) as_usage([&] { check_options(method, options); });
  for (const char* name : {"--von-neumann-waves", "--extra-waves", "--refresh-interval", "--reach"}) {
    if (command.has(name)) throw UsageError(std::string(name) + " is for the method djfa");
  }
}

}  // namespace vorocl::command
