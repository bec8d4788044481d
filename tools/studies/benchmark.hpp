// Methods side by side on the same seeds, in time and in wrong pixels.
#pragma once

#include <string>
#include <vector>

#include "studies/samples.hpp"
#include "vorocl/method.hpp"
#include "vorocl/seeds.hpp"

namespace vorocl::command {

/// OpenCV's distance transform. It takes part in a benchmark, but cannot fill a diagram: its `run` is null.
const Method& opencv_method();

struct BenchmarkResult {
  std::string method;
  Samples milliseconds;          ///< one value per round
  std::size_t wrong_pixels = 0;  ///< whose label is not at the least distance
};

struct BenchmarkOptions {
  MethodOptions method;
  int rounds = 1;
  int tile = 0;  ///< side of tiles in pixels, 0 for none
};

/// Times methods from seeds on the device to labels on the device, and with tiles the exact engine from seeds
/// on the host to labels on the host too: on the grid, and tile by tile from seeds that were sorted before.
///
/// Runs each method once, which builds its programs, allocates its memory and is judged; then the methods
/// take turns, so that a machine that slows down slows all of them. A method that goes on from the last frame
/// starts each run from the JFA of the seeds one random step of 5 pixels away.
std::vector<BenchmarkResult> benchmark(const std::vector<Method>& methods, const BenchmarkOptions& options,
                                       const Seeds& seeds);

}  // namespace vorocl::command
