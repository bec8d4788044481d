#include "app/options/common_options.hpp"

#include "formats/values.hpp"

namespace vorocl::command {

Option add_metric_option(Command& command, Metric& metric) {
  const Choices<Metric> metrics = {{"euclidean", Metric::euclidean}, {"manhattan", Metric::manhattan}};
  return command.add_choice("--metric", metric, metrics, "Distance").default_text(to_string(metric));
}

Option add_device_option(Command& command, std::string& request) {
  return command.add(
      "--device", request,
      "Part of a platform's or device's name, or platform:device indices (vorocl devices lists "
      "them); else what the environment variable VOROCL_DEVICE says, else the best there is");
}

Option add_json_option(Command& command, bool& json) {
  return command.add("--json", json, "Print one JSON object of results and nothing else on standard output");
}

}  // namespace vorocl::command
