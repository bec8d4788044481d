// Errors of a method's diagrams against the exact diagrams, frame by frame.
#pragma once

#include "studies/samples.hpp"
#include "vorocl/distance_errors.hpp"

namespace vorocl::command {

struct ErrorSamples {
  Samples wrong_percent;   // of the pixels
  Samples largest_excess;  // in pixels
  Samples mean_excess;     // over all pixels

  void add(const DistanceErrors& errors) {
    wrong_percent.add(errors.wrong_percent());
    largest_excess.add(errors.largest_excess);
    mean_excess.add(errors.mean_excess);
  }
};

}  // namespace vorocl::command
