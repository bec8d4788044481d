// Values of one quantity, a frame or a round each.
#pragma once

#include <vector>

namespace vorocl::command {

class Samples {
 public:
  void add(double value) { values_.push_back(value); }
  bool empty() const { return values_.empty(); }

  // None of these may be asked for while there are no values.
  double mean() const;
  double median() const;
  double least() const;
  double greatest() const;

 private:
  std::vector<double> values_;
};

}  // namespace vorocl::command
