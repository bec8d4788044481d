#include "trials/samples.hpp"

#include <algorithm>
#include <numeric>

namespace vorocl::command {

double Samples::mean() const {
  return std::accumulate(values_.begin(), values_.end(), 0.0) / static_cast<double>(values_.size());
}

double Samples::median() const {
  std::vector<double> sorted = values_;
  std::sort(sorted.begin(), sorted.end());
  const std::size_t half = sorted.size() / 2;
  return sorted.size() % 2 == 1 ? sorted[half] : (sorted[half - 1] + sorted[half]) / 2;
}

double Samples::least() const { return *std::min_element(values_.begin(), values_.end()); }

double Samples::greatest() const { return *std::max_element(values_.begin(), values_.end()); }

}  // namespace vorocl::command
