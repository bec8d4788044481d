// vorocl-study evaluate: the paper's experiment over grid sizes and numbers of seeds, as one table.
#include <fmt/format.h>

#include <memory>
#include <nlohmann/json.hpp>

#include "app/options/option_groups.hpp"
#include "app/terminal/console.hpp"
#include "app/terminal/end_of_run.hpp"
#include "app/terminal/progress.hpp"
#include "app/terminal/selected_device.hpp"
#include "formats/files.hpp"
#include "studies/study_line.hpp"
#include "studies/tables.hpp"

namespace vorocl::command {

namespace {

struct EvaluateOptions {
  StudyOptions study;
  bool full = false;
  std::string path;
  bool resume = false;
  std::string device;
  bool json = false;
};

/// Up to the paper's largest grid with --full; without it, what two cores do in some minutes.
std::vector<int> sides_of(const EvaluateOptions& options) {
  if (!options.study.sides.empty()) return options.study.sides;
  if (options.full) return {1000, 2000, 4000, 5000, 10000, 20000};
  return {500, 1000, 2000};
}

/// The range of the authors' notebook with --full, n^2 / (100 i) for i from 100 to 1: 10,000 to 100 pixels
/// per seed. Without it, from 20,000 to 16.
std::vector<SeedCount> seeds_of(const EvaluateOptions& options) {
  if (!options.study.seeds.empty()) return options.study.seeds;
  const std::vector<const char*> usual = {"0.005%", "0.01%", "0.05%", "0.1%", "0.5%", "1%", "3%", "6.25%"};
  const std::vector<const char*> full = {"0.01%", "0.0125%", "0.02%", "0.05%", "0.1%", "0.2%", "0.5%", "1%"};
  std::vector<SeedCount> counts;
  for (const char* text : options.full ? full : usual) counts.push_back(parse_seed_count(text));
  return counts;
}

/// How much of the evaluation is done, in pixels of diagrams.
class Course {
 public:
  Course(const std::vector<Configuration>& configurations, const EvaluationSettings& settings) {
    for (const Configuration& configuration : configurations) {
      all_ += diagrams_of(settings) * static_cast<double>(configuration.pixels());
    }
  }

  /// Throws Error once Ctrl-C has come.
  void made(const Configuration& configuration, int diagrams) {
    done_ += diagrams * static_cast<double>(configuration.pixels());
    frames_ += diagrams;
    progress_.show(frames_, done_ / all_);
    if (interruption_.came()) throw Error("interrupted");
  }
  void erase_progress() { progress_.erase(); }

 private:
  Interruption interruption_;
  Progress progress_;
  double all_ = 0;
  double done_ = 0;
  int frames_ = 0;
};

void print_table_head() {
  print("{:>6} {:>10} {:>13} {:>9} {:>8} {:>8} {:>8} {:>13} {:>13} {:>13}\n", "", "", "pixels", "JFA",
        "speedup", "speedup", "speedup", "similarity %", "wrong %", "wrong %");
  print("{:>6} {:>10} {:>13} {:>9} {:>8} {:>8} {:>8} {:>13} {:>13} {:>13}\n", "n", "seeds", "per seed",
        "ms/frame", "dJFAe", "dJFAm", "exact", "dJFAe to JFA", "JFA", "dJFAe");
}

void print_table_row(const Configuration& configuration, const EvaluationSettings& settings,
                     const ConfigurationResult& result) {
  const auto euclidean = Metric::euclidean;
  const MethodResult& jfa = result.of("jfa", euclidean);
  const MethodResult& djfa = result.of("djfa", euclidean);
  const double jfa_time = jfa.milliseconds.median();
  const auto speedup = [&](const MethodResult& of) { return jfa_time / of.milliseconds.median(); };
  print("{:>6} {:>10} {:>13.1f} {:>9.3f} {:>8.2f} {:>8.2f} {:>8.2f} {:>13.4f} {:>13.4f} {:>13.4f}\n",
        configuration.side, configuration.seeds,
        static_cast<double>(configuration.pixels()) / static_cast<double>(configuration.seeds),
        jfa_time / settings.timed_frames, speedup(djfa), speedup(result.of("djfa", Metric::manhattan)),
        speedup(result.of("exact", euclidean)), djfa.similarity_to_euclidean_jfa.mean(),
        jfa.errors.wrong_percent.mean(), djfa.errors.wrong_percent.mean());
  flush_standard_output();
}

/// Those that the file does not have yet.
std::vector<Configuration> missing(const std::vector<Configuration>& wanted, const EvaluationFile& file) {
  std::vector<Configuration> missing;
  for (const Configuration& configuration : wanted) {
    if (!file.has(configuration)) missing.push_back(configuration);
  }
  return missing;
}

/// Four diagrams of flooding (13 bytes per pixel) and two exact ones (5.3) exist at a time. The driver does
/// not know their sum, and may promise more memory than there is. Throws Error that names the first grid too
/// large.
void check_memory(const Device& device, const std::vector<Configuration>& wanted) {
  constexpr double bytes_per_pixel = 64;
  cl_ulong there = 0;
  clGetDeviceInfo(device.cl_device()(), CL_DEVICE_GLOBAL_MEM_SIZE, sizeof there, &there, nullptr);
  for (const Configuration& configuration : wanted) {
    const double needed = bytes_per_pixel * static_cast<double>(configuration.pixels());
    if (needed <= static_cast<double>(there)) continue;
    throw Error(fmt::format(
        "too little device memory for {0} x {0} pixels: the methods together need {1:.1f} GiB, "
        "{2} has {3:.1f} GiB; take smaller --sizes",
        configuration.side, needed / (1 << 30), device.name(), static_cast<double>(there) / (1 << 30)));
  }
}

void evaluate_all(const EvaluateOptions& options, const std::vector<Configuration>& todo,
                  const Device& device, EvaluationFile& file) {
  if (!options.json && !todo.empty()) print_table_head();
  Course course(todo, options.study.settings);
  for (const Configuration& configuration : todo) {
    const ConfigurationResult result = evaluate(device, configuration, options.study.settings,
                                                [&](int diagrams) { course.made(configuration, diagrams); });
    file.add(configuration, result);
    course.erase_progress();
    if (!options.json) print_table_row(configuration, options.study.settings, result);
  }
}

void run(const EvaluateOptions& options) {
  const std::vector<Configuration> wanted =
      as_usage([&] { return configurations(sides_of(options), seeds_of(options)); });
  as_usage([&] { check_extension(options.path, {".csv"}); });
  EvaluationFile file(options.path, options.resume);
  const Device device = select_device(options.device);
  const FinishAtEnd finish(device);
  check_memory(device, wanted);
  for (const std::string& dropped : file.begin(origin_of(device, options.study.settings)))
    print_note(dropped);
  const std::vector<Configuration> todo = missing(wanted, file);
  const auto complete = [&] { return wanted.size() - missing(wanted, file).size(); };
  try {
    evaluate_all(options, todo, device, file);
  } catch (const std::exception& error) {  // ours, or out of memory
    throw Error(
        fmt::format("{}; of {} configurations {} are complete in {}, and --resume goes on with the rest",
                    message_of(error), wanted.size(), complete(), file.path()));
  }
  if (options.json) {
    print_json({{"device", device.name()},
                {"configurations", wanted.size()},
                {"made_before", wanted.size() - todo.size()},
                {"file", file.path()}});
  } else {
    print("{} configurations, {} of them made before, on {}: wrote {}\n", wanted.size(),
          wanted.size() - todo.size(), device.name(), file.path());
  }
}

}  // namespace

void add_evaluate(CommandLine& line) {
  const auto options = std::make_shared<EvaluateOptions>();
  Command command =
      line.add("evaluate",
               "The paper's experiment: JFA, dJFA and exact diagrams of moving seeds, in accuracy and time");
  command.add("-o", options->path, "Table to write: a .csv file that grows with each configuration")
      .value_name("FILE")
      .required();
  command.add("--resume", options->resume, "Continue the file if it exists");
  command.add("--full", options->full,
              "The range of the paper's authors, for a GPU: grids of 1000 to 20000 pixels a side, 0.01% to "
              "1% seeds, timed "
              "over all frames");
  add_study_options(command, options->study, "500,1000,2000", "eight from 0.005% to 6.25%");
  add_device_option(command, options->device);
  add_json_option(command, options->json);
  command.set_work([command, options] {
    if (options->full && !command.has("--timed-frames")) {
      options->study.settings.timed_frames = options->study.settings.frames;
    }
    run(*options);
  });
}

}  // namespace vorocl::command
