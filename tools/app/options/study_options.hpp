// What an evaluation or an ablation is made of.
#pragma once

#include <string>
#include <vector>

#include "app/options/command_line.hpp"
#include "studies/configurations.hpp"

namespace vorocl::command {

struct StudyOptions {
  std::vector<int> sides;  // empty: the usual ones
  std::vector<SeedCount> seeds;
  EvaluationSettings settings;
};

/// Adds --sizes, --seeds (with what the help gives as their defaults), --frames, --timed-frames, --repeats,
/// --step-length and
/// --rng-seed.
void add_study_options(Command& command, StudyOptions& options, const std::string& usual_sides,
                       const std::string& usual_seeds);

}  // namespace vorocl::command
