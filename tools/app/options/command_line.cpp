#include "app/options/command_line.hpp"

#include <fmt/format.h>
#include <pthread.h>
#include <sys/resource.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <string>
#include <string_view>
#include <system_error>
#include <thread>

#include "app/terminal/console.hpp"
#include "app/terminal/end_of_run.hpp"

namespace vorocl::command {

namespace {

std::size_t distance_between(const std::string& a, const std::string& b) {
  std::vector<std::vector<std::size_t>> steps(a.size() + 1, std::vector<std::size_t>(b.size() + 1));
  for (std::size_t i = 0; i <= a.size(); ++i) {
    for (std::size_t j = 0; j <= b.size(); ++j) {
      if (i == 0 || j == 0) {
        steps[i][j] = i + j;
        continue;
      }
      steps[i][j] = std::min(
          {steps[i - 1][j] + 1, steps[i][j - 1] + 1, steps[i - 1][j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1)});
      const bool is_swapped = i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1];
      if (is_swapped) steps[i][j] = std::min(steps[i][j], steps[i - 2][j - 2] + 1);
    }
  }
  return steps[a.size()][b.size()];
}

}  // namespace

std::string did_you_mean(const std::string& word, const std::vector<std::string>& names) {
  constexpr std::size_t longest = 100;
  if (word.size() > longest) return {};
  std::size_t least = word.size() / 3 + 1;
  std::string nearest;
  for (const std::string& name : names) {
    const std::size_t distance = distance_between(word, name);
    if (distance >= least) continue;
    least = distance;
    nearest = name;
  }
  return nearest.empty() ? "" : "did you mean " + nearest + "? ";
}

Option& Option::required() {
  option_->required();
  return *this;
}

Option& Option::value_optional() {
  option_->expected(0, 1);
  return *this;
}

Option& Option::value_name(const std::string& name) {
  option_->type_name(name);
  return *this;
}

Option& Option::default_text(const std::string& text) {
  option_->default_str(text);
  return *this;
}

Option& Option::default_is_value() {
  option_->capture_default_str();
  return *this;
}

template <typename T>
Option& Option::in_range(T low, T high) {
  option_->check(CLI::Range(low, high));
  return *this;
}

template Option& Option::in_range(int, int);
template Option& Option::in_range(std::size_t, std::size_t);

Option& Option::in_range(double low, double high) {
  const auto not_a_number = [low, high](const std::string& text) {
    const bool is_none = std::isnan(std::strtod(text.c_str(), nullptr));  // which CLI::Range() lets pass
    return is_none ? fmt::format("Value {} not in range [{} - {}]", text, low, high) : std::string();
  };
  option_->check(CLI::Range(low, high))->check(not_a_number);
  return *this;
}

Option& Option::needs(const Option& other) {
  option_->needs(other.option_);
  return *this;
}

Option& Option::excludes(const Option& other) {
  option_->excludes(other.option_);
  return *this;
}

Option& Option::in_section(const char* title) {
  option_->group(title);
  return *this;
}

Option Command::add(const std::string& name, bool& flag, const std::string& about) {
  return Option(*app_->add_flag(name, flag, about));
}

Option Command::add_pair(const std::string& names, const std::function<void(bool is_on)>& set,
                         const std::string& about) {
  return Option(*app_->add_flag_function(
      names, [set](std::int64_t count) { set(count > 0); }, about));
}

template <typename T>
Option Command::add(const std::string& name, T& value, const std::string& about) {
  return Option(*app_->add_option(name, value, about));
}

template Option Command::add(const std::string&, std::string&, const std::string&);
template Option Command::add(const std::string&, int&, const std::string&);
template Option Command::add(const std::string&, std::optional<int>&, const std::string&);
template Option Command::add(const std::string&, std::uint64_t&, const std::string&);
template Option Command::add(const std::string&, double&, const std::string&);

namespace {

/// An Error of what takes the value is one that names the option.
template <typename Value>
std::function<void(const Value&)> checked(const std::string& name,
                                          const std::function<void(const Value&)>& set) {
  return [set, name](const Value& value) {
    try {
      set(value);
    } catch (const Error& error) {
      throw CLI::ValidationError(name, error.what());
    }
  };
}

}  // namespace

Option Command::add_text(const std::string& name, const Setter& set, const std::string& about) {
  return Option(*app_->add_option_function<std::string>(name, checked(name, set), about));
}

Option Command::add_texts(const std::string& name, const ListSetter& set, const std::string& about) {
  CLI::Option* const option =
      app_->add_option_function<std::vector<std::string>>(name, checked(name, set), about);
  return Option(*option->delimiter(','));
}

void Command::refuse_words(const std::function<std::string(const std::string& word)>& advice) {
  const auto refuse = [advice, app = app_](const std::string& word) -> void {
    // The word may be the value of an option that there is not: that one is to blame.
    for (const std::string& unknown : app->remaining()) {
      if (unknown.front() == '-') throw CLI::ExtrasError({unknown});
    }
    throw CLI::ValidationError(advice(word));
  };
  app_->add_option_function<std::string>("word", refuse)->group("");  // which help does not show
}

Command Command::add_group(const std::string& name, const std::string& about, std::size_t least,
                           std::size_t most) {
  CLI::App* const group = app_->add_option_group(name, about);
  group->set_help_flag();
  group->require_option(least, most);
  return Command(*group);
}

void Command::begin_section(const char* title) { app_->option_defaults()->group(title); }

Option Command::option(const std::string& name) const { return Option(*app_->get_option(name)); }

// CLI11's own search by name ends the process where memory runs out.
bool Command::has(const std::string& name) const {
  const auto options = app_->get_options([](const CLI::Option* option) { return option->count() > 0; });
  return std::any_of(options.begin(), options.end(),
                     [&name](const CLI::Option* option) { return option->get_name() == name; });
}

std::string Command::given(const std::vector<std::string>& others) const {
  const auto is_meant = [&others](const CLI::Option* option) {
    return option->count() > 0 && std::find(others.begin(), others.end(), option->get_name()) == others.end();
  };
  std::string lines;
  for (const CLI::Option* const option : app_->get_options(is_meant)) {
    lines += option->get_name() + " " + CLI::detail::join(option->results(), ",") + "\n";
  }
  return lines;
}

void Command::set_work(const std::function<void()>& work) { app_->callback(work); }

namespace {

class Help : public CLI::Formatter {
 public:
  /// Of a subcommand: groups of options, of which one must be given, and then sections.
  std::string make_help(const CLI::App* app, std::string name, CLI::AppFormatMode mode) const override {
    if (app->get_parent() == nullptr) return Formatter::make_help(app, name, mode);
    std::string text = make_description(app) + make_usage(app, name) + make_positionals(app);
    const auto add_section = [&](const CLI::App* of, const std::string& title, const std::string& group) {
      const auto options = of->get_options(
          [&](const CLI::Option* option) { return option->get_group() == group && option->nonpositional(); });
      if (!options.empty()) text += make_group(title, false, options);
    };
    for (const CLI::App* const group : app->get_subcommands({}))
      add_section(group, group->get_description(), "Options");
    std::vector<std::string> titles = app->get_groups();
    const auto rank = [](const std::string& title) {
      return title == files_to_write ? 0 : title == grid_section ? 1 : title == run_section ? 3 : 2;
    };
    std::stable_sort(titles.begin(), titles.end(),
                     [&rank](const std::string& a, const std::string& b) { return rank(a) < rank(b); });
    for (const std::string& title : titles) {
      if (!title.empty()) add_section(app, title, title);
    }
    return text;
  }

  /// CLI11 shows the words of refuse_words() in the usage, without their name.
  std::string make_usage(const CLI::App* app, std::string name) const override {
    constexpr std::string_view nameless = " []";
    std::string usage = Formatter::make_usage(app, std::move(name));
    const std::size_t at = usage.find(nameless);
    return at == std::string::npos ? usage : usage.erase(at, nameless.size());
  }
};

}  // namespace

CommandLine::CommandLine(const std::string& about, const std::string& name, const std::string& version)
    : app_(std::make_unique<CLI::App>(about, name)) {
  name_program(name);
  app_->formatter(std::make_shared<Help>());
  app_->set_version_flag("--version", version);
  app_->require_subcommand(-1);  // at most one: where there is none, run() first names what else was given
}

CommandLine::~CommandLine() = default;

Command CommandLine::add(const std::string& name, const std::string& about) {
  CLI::App* const subcommand = app_->add_subcommand(name, about);
  subcommand->get_help_ptr()->group(run_section);
  return Command(*subcommand);
}

void CommandLine::run(int argc, char** argv) {
  // CLI11 2.1 takes an empty word for an option group, and may then parse without end.
  if (std::find(argv, argv + argc, std::string_view()) != argv + argc) {
    throw UsageError("an argument is empty; if it is a variable of the shell, it is not set");
  }
  try {
    app_->parse(argc, argv);
  } catch (const CLI::Success& help_or_version) {
    app_->exit(help_or_version);
    return;
  } catch (const CLI::ExtrasError&) {
    throw UsageError(about_unknown());
  } catch (const CLI::ParseError& error) {
    throw UsageError(error.what());
  }
  if (app_->get_subcommands().empty()) {
    throw UsageError("no subcommand was given; " + see_help());
  }
}

std::string CommandLine::see_help() const {
  std::string command = app_->get_name();
  for (const CLI::App* const subcommand : app_->get_subcommands()) command += " " + subcommand->get_name();
  return "see " + command + " --help";
}

std::string CommandLine::about_unknown() const {
  const auto chosen = app_->get_subcommands();
  const CLI::App& last = chosen.empty() ? *app_ : *chosen.back();
  std::vector<std::string> names;
  const auto add_options_of = [&names](const CLI::App& app) {
    for (const CLI::Option* const option : app.get_options()) names.push_back(option->get_name());
  };
  for (const CLI::App* const subcommand : app_->get_subcommands({})) names.push_back(subcommand->get_name());
  add_options_of(last);
  for (const CLI::App* const group : last.get_subcommands({})) add_options_of(*group);
  // The first word is to blame: what follows an unknown subcommand is unknown, too, and so is an option's
  // value.
  const std::string word = app_->remaining(true).front();
  return word + " is unknown; " + did_you_mean(word, names) + see_help();
}

namespace {

/// Where `ulimit -s` leaves little, PoCL's compiler and kernels crash: the work, and what threads a driver
/// makes, get the stacks that are usual.
template <typename Work>
void with_enough_stack(const Work& work) {
  constexpr rlim_t usual = 8 << 20;
  struct rlimit limit = {};
  pthread_attr_t attributes;
  if (getrlimit(RLIMIT_STACK, &limit) != 0 || limit.rlim_cur >= usual ||
      pthread_attr_init(&attributes) != 0) {
    work();
    return;
  }
  pthread_attr_setstacksize(&attributes, usual);
  pthread_setattr_default_np(&attributes);
  pthread_attr_destroy(&attributes);
  std::thread thread;
  try {
    thread = std::thread(work);
  } catch (const std::system_error&) {
    work();
    return;
  }
  thread.join();
}

/// Returns the exit code.
int run_to_the_end(void (*run)(int argc, char** argv), int argc, char** argv) {
  constexpr int success = 0, failure = 1, usage = 2;
  try {
    run(argc, argv);
    flush_standard_output();
    return success;
  } catch (const UsageError& error) {
    print_error(error);
    return usage;
  } catch (const std::exception& error) {
    print_error(error);
  }
  return failure;
}

}  // namespace

int run_program(void (*run)(int argc, char** argv), int argc, char** argv) {
  open_standard_streams();
  remove_temporary_files_on_signals();
  int code = 0;
  with_enough_stack([&] { code = run_to_the_end(run, argc, argv); });
  return code;
}

}  // namespace vorocl::command
