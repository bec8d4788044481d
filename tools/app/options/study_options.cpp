#include "app/options/study_options.hpp"

namespace vorocl::command {

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
      .in_range(0, Grid::max_side)
      .default_is_value();
  command.add("--rng-seed", settings.rng_seed, "Seed of the random numbers")
      .value_name("R")
      .default_is_value();
}

}  // namespace vorocl::command
