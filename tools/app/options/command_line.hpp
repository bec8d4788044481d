// Subcommands and their options. CLI11 stands behind it, in command_line.cpp alone: its header takes five
// seconds to compile, in every source that includes it.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "vorocl/error.hpp"

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace vorocl::command {

/// An option, and what else there is to say of it.
class Option {
 public:
  explicit Option(CLI::Option& option) : option_(&option) {}

  Option& required();
  Option& value_optional();                       ///< it may be given without a value
  Option& value_name(const std::string& name);    ///< for the help
  Option& default_text(const std::string& text);  ///< for the help
  Option& default_is_value();                     ///< the help shows what the variable holds now
  template <typename T>
  Option& in_range(T low, T high);  ///< both included
  Option& in_range(double low, double high);
  Option& needs(const Option& other);
  Option& excludes(const Option& other);
  Option& in_section(const char* title);  ///< of the help, not in that of begin_section()

 private:
  CLI::Option* option_;
};

/// The names that a word on the command line may have, with what they stand for.
template <typename T>
using Choices = std::vector<std::pair<std::string, T>>;

template <typename T>
std::string names_of(const Choices<T>& choices) {
  std::string names;
  for (const auto& choice : choices) names += (names.empty() ? "" : ", ") + choice.first;
  return names;
}

/// "did you mean NAME? ", of the name that takes the fewest letters to insert, remove, replace or swap (the
/// distance of Damerau and Levenshtein, the first of several); nothing if more than a third of the word would
/// change.
std::string did_you_mean(const std::string& word, const std::vector<std::string>& names);

/// What the text stands for. Throws Error, which lists the names, if it is none of them.
template <typename T>
T choose(const Choices<T>& choices, const std::string& text) {
  for (const auto& choice : choices) {
    if (choice.first == text) return choice.second;
  }
  std::vector<std::string> names;
  for (const auto& choice : choices) names.push_back(choice.first);
  throw Error("\"" + text + "\" is unknown; " + did_you_mean(text, names) + "there are " + names_of(choices));
}

/// Titles of sections that the help of most subcommands has.
constexpr const char *files_to_write = "Files to write", *grid_section = "Grid and units",
                     *seed_files = "What the seeds' files say", *pictures_section = "Pictures",
                     *run_section = "Run";

/// A subcommand, or a group of its options. Options are stored in the variables that are given with them,
/// which must stay where they are until the work runs.
class Command {
 public:
  using Setter = std::function<void(const std::string& text)>;
  using ListSetter = std::function<void(const std::vector<std::string>& texts)>;

  explicit Command(CLI::App& app) : app_(&app) {}

  Option add(const std::string& name, bool& flag, const std::string& about);

  /// A text or a number, which may be optional.
  template <typename T>
  Option add(const std::string& name, T& value, const std::string& about);

  /// A flag and its opposite: "--name,!--no-name".
  Option add_pair(const std::string& names, const std::function<void(bool is_on)>& set,
                  const std::string& about);

  /// An option whose text `set` is given; an Error of it is a usage error that names the option.
  Option add_text(const std::string& name, const Setter& set, const std::string& about);

  /// An option with a list of texts, with commas between them.
  Option add_texts(const std::string& name, const ListSetter& set, const std::string& about);

  /// An option whose text `parse` turns into the value.
  template <typename T, typename Parse>
  Option add_parsed(const std::string& name, T& value, const Parse& parse, const std::string& about) {
    const Setter set = [&value, parse](const std::string& text) { value = parse(text); };
    return add_text(name, set, about);
  }

  /// An option with a list of texts, each of which `parse` turns into a value.
  template <typename T, typename Parse>
  Option add_list(const std::string& name, std::vector<T>& values, const Parse& parse,
                  const std::string& about) {
    const ListSetter set = [&values, parse](const std::vector<std::string>& texts) {
      for (const std::string& text : texts) values.push_back(parse(text));
    };
    return add_texts(name, set, about);
  }

  template <typename Value, typename T>
  Option add_choice(const std::string& name, Value& value, const Choices<T>& choices,
                    const std::string& about) {
    const auto parse = [choices](const std::string& text) { return choose(choices, text); };
    return add_parsed(name, value, parse, about + ": " + names_of(choices)).value_name("NAME");
  }

  /// Refuses a word that no option takes with what `advice` says of it, unless there is an unknown option to
  /// name. For commands without positional arguments.
  void refuse_words(const std::function<std::string(const std::string& word)>& advice);

  /// A group of options of which at least and at most so many must be given.
  Command add_group(const std::string& name, const std::string& about, std::size_t least, std::size_t most);

  /// The help lists what is added from here on under this title. After the seeds come what is written and
  /// the grid, and run_section last.
  void begin_section(const char* title);

  /// An option that was added before.
  Option option(const std::string& name) const;

  /// Whether the option was given.
  bool has(const std::string& name) const;

  /// The options that were given, but for `others`: a line "--name value,..." for each, in the order of the
  /// help.
  std::string given(const std::vector<std::string>& others) const;

  /// What a subcommand does when its options have been parsed.
  void set_work(const std::function<void()>& work);

 private:
  CLI::App* app_;
};

class CommandLine {
 public:
  CommandLine(const std::string& about, const std::string& name, const std::string& version);
  ~CommandLine();

  Command add(const std::string& name, const std::string& about);

  /// Parses the command line and runs the subcommand's work, or prints the help or the version. Throws
  /// UsageError, and what the work throws.
  void run(int argc, char** argv);

 private:
  /// Where the help of the subcommand is that was given: "see vorocl render --help".
  std::string see_help() const;

  /// Of what was given, the option or the subcommand that is unknown, and what it may have meant.
  std::string about_unknown() const;

  std::unique_ptr<CLI::App> app_;
};

/// What main() does: has the function run a command line, turns what went wrong into one line on standard
/// error, and returns the exit code: 0 for success, 1 for an error and 2 for a UsageError.
int run_program(void (*run)(int argc, char** argv), int argc, char** argv);

}  // namespace vorocl::command
