#include "studies/study_line.hpp"

#include <fmt/format.h>

#include <cmath>
#include <set>

#include "formats/raster.hpp"
#include "formats/values.hpp"
#include "vorocl/error.hpp"
#include "vorocl/version.hpp"

namespace vorocl::command {

namespace {

constexpr std::size_t most_seeds = Window::max_pixels;

std::size_t seeds_on(int side, const SeedCount& count) {
  if (!count.percent) return count.count;
  const double pixels = static_cast<double>(side) * side, seeds = std::round(*count.percent / 100 * pixels);
  if (!(seeds >= 1 && seeds <= static_cast<double>(most_seeds))) {
    throw Error(fmt::format("--seeds: {} of {} x {} pixels are {} seeds; 1 to {} are possible", count.text,
                            side, side, seeds, most_seeds));
  }
  return static_cast<std::size_t>(seeds);
}

}  // namespace

int parse_side(const std::string& text) {
  const auto side = parse_number<int>(text);
  if (!side || *side < 1 || *side > Size::max_side) {
    throw Error(fmt::format("\"{}\" must be a side of the grid in pixels, 1 to {}", text, Size::max_side));
  }
  return *side;
}

SeedCount parse_seed_count(const std::string& text) {
  if (!text.empty() && text.back() == '%') {
    const auto percent = parse_number<double>(text.substr(0, text.size() - 1));
    if (percent && *percent > 0 && std::isfinite(*percent)) return {text, 0, percent};
  } else if (const auto count = parse_number<std::size_t>(text);
             count && *count >= 1 && *count <= most_seeds) {
    return {text, *count, std::nullopt};
  }
  throw Error(
      fmt::format("\"{}\" must be a number of seeds, 1 to {}, or a percentage of the pixels, such as 1%",
                  text, most_seeds));
}

std::vector<Configuration> configurations(const std::vector<int>& sides,
                                          const std::vector<SeedCount>& counts) {
  std::set<Configuration> all;
  for (const int side : sides) {
    for (const SeedCount& count : counts) all.insert({side, seeds_on(side, count)});
  }
  return {all.begin(), all.end()};
}

void add_study_options(Command& command, StudyOptions& options, const std::string& usual_sides,
                       const std::string& usual_seeds) {
  constexpr int most = 1000000;
  EvaluationSettings& settings = options.settings;
  command.add_list("--sizes", options.sides, parse_side, "Grids, of n x n pixels")
      .value_name("n,...")
      .default_text(usual_sides);
  command
      .add_list("--seeds", options.seeds, parse_seed_count, "Numbers of seeds, or percentages of the pixels")
      .value_name("S|P%,...")
      .default_text(usual_seeds);
  command.add("--frames", settings.frames, "Frames over which similarities and errors are measured")
      .value_name("A")
      .in_range(1, most)
      .default_is_value();
  command.add("--timed-frames", settings.timed_frames, "Frames of a timed run")
      .value_name("T")
      .in_range(1, most)
      .default_is_value();
  command.add("--repeats", settings.repeats, "Timed runs per method; the methods take turns")
      .value_name("R")
      .in_range(3, most)
      .default_is_value();
  command
      .add("--step-length", settings.step_length,
           "Each seed moves at random, by up to this many pixels along x and y per frame")
      .value_name("D")
      .in_range(0, Size::max_side)
      .default_is_value();
  command.add("--rng-seed", settings.rng_seed, "Seed of the random numbers")
      .value_name("R")
      .default_is_value();
}

void run_study(int argc, char** argv) {
  CommandLine line("The study of the paper's methods: its experiment, and what each choice of dJFA is worth.",
                   "vorocl-study", "vorocl-study " VOROCL_VERSION);
  add_evaluate(line);
  add_ablation(line);
  line.run(argc, argv);
}

}  // namespace vorocl::command
