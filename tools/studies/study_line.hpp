// The command line of vorocl-study: its subcommands, the options that both have, and the configurations that
// these name.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "app/options/command_line.hpp"
#include "studies/evaluation.hpp"

namespace vorocl::command {

/// A number of seeds: "100", or "1%" of the pixels.
struct SeedCount {
  std::string text;
  std::size_t count = 0;
  std::optional<double> percent;  ///< instead of the count
};

/// Throws Error if the text is no side of a grid (of side x side pixels).
int parse_side(const std::string& text);

/// Throws Error if the text is no number of seeds. More seeds than pixels are possible.
SeedCount parse_seed_count(const std::string& text);

/// Every side with every number of seeds, the small ones first, each once. Throws Error where a
/// percentage makes less than one seed or more than there can be.
std::vector<Configuration> configurations(const std::vector<int>& sides,
                                          const std::vector<SeedCount>& counts);

/// What the options below say.
struct StudyOptions {
  std::vector<int> sides;  // empty: the usual ones
  std::vector<SeedCount> seeds;
  EvaluationSettings settings;
};

/// Adds --sizes, --seeds (with what the help gives as their defaults), --frames, --timed-frames, --repeats,
/// --step-length and --rng-seed.
void add_study_options(Command& command, StudyOptions& options, const std::string& usual_sides,
                       const std::string& usual_seeds);

/// Add the subcommands: the paper's experiment, and what each choice of dJFA is worth.
void add_evaluate(CommandLine& line);
void add_ablation(CommandLine& line);

/// Parses a command line and runs the subcommand that it names. Throws UsageError for one that makes no
/// sense, and what the work throws.
void run_study(int argc, char** argv);

}  // namespace vorocl::command
