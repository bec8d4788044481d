// Options that several subcommands share, and the ways in which an option's text becomes a value.
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <utility>
#include <vector>

#include "vorocl/error.hpp"
#include "vorocl/grid.hpp"

namespace vorocl::command {

/// An option whose text `parse` turns into the value; an Error of it is a usage error that names the option.
template <typename T, typename Parse>
CLI::Option* add_parsed(CLI::App& app, const std::string& name, T& value, Parse parse,
                        const std::string& description) {
  const auto set = [&value, parse, name](const std::string& text) {
    try {
      value = parse(text);
    } catch (const Error& error) {
      throw CLI::ValidationError(name, error.what());
    }
  };
  return app.add_option_function<std::string>(name, set, description);
}

/// An option with a list of texts, each of which `parse` turns into a value.
template <typename T, typename Parse>
CLI::Option* add_list(CLI::App& app, const std::string& name, std::vector<T>& values, Parse parse,
                      const std::string& description) {
  const auto set = [&values, parse, name](const std::vector<std::string>& texts) {
    try {
      for (const std::string& text : texts) values.push_back(parse(text));
    } catch (const Error& error) {
      throw CLI::ValidationError(name, error.what());
    }
  };
  return app.add_option_function<std::vector<std::string>>(name, set, description)->delimiter(',');
}

/// The names that a word on the command line may have, with what they stand for.
template <typename T>
using Choices = std::vector<std::pair<std::string, T>>;

template <typename T>
std::string names_of(const Choices<T>& choices) {
  std::string names;
  for (const auto& choice : choices) names += (names.empty() ? "" : ", ") + choice.first;
  return names;
}

/// What the text stands for. Throws Error, which lists the names, if it is none of them.
template <typename T>
T choose(const Choices<T>& choices, const std::string& text) {
  for (const auto& choice : choices) {
    if (choice.first == text) return choice.second;
  }
  throw Error("\"" + text + "\" is unknown; there are " + names_of(choices));
}

template <typename T>
CLI::Option* add_choice(CLI::App& app, const std::string& name, T& value, const Choices<T>& choices,
                        const std::string& description) {
  const auto parse = [choices](const std::string& text) { return choose(choices, text); };
  return add_parsed(app, name, value, parse, description + ": " + names_of(choices))->type_name("NAME");
}

inline std::string to_string(Metric metric) {
  return metric == Metric::euclidean ? "euclidean" : "manhattan";
}

inline CLI::Option* add_metric_option(CLI::App& app, Metric& metric) {
  const Choices<Metric> metrics = {{"euclidean", Metric::euclidean}, {"manhattan", Metric::manhattan}};
  return add_choice(app, "--metric", metric, metrics, "Distance")->default_str(to_string(metric));
}

inline CLI::Option* add_device_option(CLI::App& app, std::string& request) {
  return app.add_option(
      "--device", request,
      "Part of a platform's or device's name, or platform:device indices (vorocl devices lists "
      "them); else what the environment variable VOROCL_DEVICE says, else the best there is");
}

inline CLI::Option* add_json_option(CLI::App& app, bool& json) {
  return app.add_flag("--json", json, "Print one JSON object of results and nothing else on standard output");
}

}  // namespace vorocl::command
