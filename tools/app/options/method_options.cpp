#include <unistd.h>

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
    about += "; great-circle: on the globe, of degrees, in kilometres";
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
           "Part of a platform's or device's name, or platform:device indices: see vorocl devices")
      .in_section(run_section);
}

Device select_device(const std::string& request) {
  Device device = Device::select(request);
  if (isatty(STDERR_FILENO) != 0) {
    device.on_compiling([] {
      print_note(
          "the driver compiles kernels, which takes some seconds, once; \"vorocl prepare\" has most compiled "
          "beforehand");
    });
  }
  return device;
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
      .add("--von-neumann-waves", options.von_neumann_waves,
           "djfa: how many waves, from the first, look at von Neumann neighbours")
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
      .add_choice("--reach", options.reach, reaches,
                  "djfa: the waves follow from the last labels, or as in the paper or its authors' program")
      .default_text("measured");
}

void check_volume_method(const Method& method, Metric metric) {
  if (metric == Metric::great_circle)
    throw UsageError("--metric great-circle is for maps: give --size WxH, without a depth");
  if (method.exact && metric != Metric::euclidean) {
    throw UsageError(
        "exact diagrams of volumes and of spaced planes are Euclidean; of methods that make these jump "
        "flooding takes --metric manhattan");
  }
  if (method.volumes) return;
  std::string names;
  for (const Method& other : methods()) {
    if (other.volumes) names += (names.empty() ? "" : ", ") + other.name;
  }
  throw UsageError("the method " + method.name + " is for planes; volumes have " + names);
}

void check_method_options(const Command& command, const std::vector<Method>& methods,
                          const MethodOptions& options) {
  const auto is_djfa = [](const Method& method) { return method.continues; };
  if (std::any_of(methods.begin(), methods.end(), is_djfa)) return;
  for (const Method& method : methods) as_usage([&] { check_options(method, options); });
  for (const char* name : {"--von-neumann-waves", "--extra-waves", "--refresh-interval", "--reach"}) {
    if (command.has(name)) throw UsageError(std::string(name) + " is for the method djfa");
  }
  const auto is_exact = [](const Method& method) { return method.exact; };
  if (command.has("--neighbourhood") && std::all_of(methods.begin(), methods.end(), is_exact)) {
    throw UsageError("--neighbourhood is for methods that flood; the method exact has no waves");
  }
}

}  // namespace vorocl::command
