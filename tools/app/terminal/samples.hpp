// What is taken of a run: wall-clock time, and values of one quantity, one per frame or round.
#pragma once

#include <algorithm>
#include <chrono>
#include <numeric>
#include <vector>

#include "vorocl/distance_errors.hpp"

namespace vorocl::command {

/// Values of one quantity.
class Samples {
 public:
  void add(double value) { values_.push_back(value); }
  bool empty() const { return values_.empty(); }

  // Each of these needs at least one value.
  double mean() const {
    return std::accumulate(values_.begin(), values_.end(), 0.0) / static_cast<double>(values_.size());
  }
  double median() const {
    std::vector<double> sorted = values_;
    std::sort(sorted.begin(), sorted.end());
    const std::size_t half = sorted.size() / 2;
    return sorted.size() % 2 == 1 ? sorted[half] : (sorted[half - 1] + sorted[half]) / 2;
  }
  double least() const { return *std::min_element(values_.begin(), values_.end()); }
  double greatest() const { return *std::max_element(values_.begin(), values_.end()); }

 private:
  std::vector<double> values_;
};

/// Wall-clock time: runs from its construction on.
class Stopwatch {
 public:
  double seconds() const { return std::chrono::duration<double>(Clock::now() - start_).count(); }
  double milliseconds() const { return 1000 * seconds(); }

 private:
  using Clock = std::chrono::steady_clock;
  Clock::time_point start_ = Clock::now();
};

/// Errors of a method's diagrams against the exact diagrams, frame by frame.
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
