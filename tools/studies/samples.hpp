// Values of one quantity, one per frame or round.
#pragma once

#include <vector>

namespace vorocl::command {

class Samples {
 public:
  void add(double value) { values_.push_back(value); }
  bool empty() const { return values_.empty(); }

  // Each of these needs at least one value.
  double mean() const;
  double median() const;
  double least() const;
  double greatest() const;

 private:
  std::vector<double> values_;
};

}  // namespace vorocl::command
