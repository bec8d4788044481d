// Launches for which a driver finishes a kernel, which takes it far longer than the device takes for it.
#pragma once

#include <utility>
#include <vector>

#include "vorocl/opencl.hpp"

namespace vorocl {

/// A first launch, behind the command before it: what passes between them is the compiler's time.
using FirstLaunch = std::pair<cl::Event, cl::Event>;

/// Collects the first launches of its thread for as long as it lives.
class FirstLaunches {
 public:
  FirstLaunches() : outer_(innermost()) { innermost() = this; }
  ~FirstLaunches() { innermost() = outer_; }
  FirstLaunches(const FirstLaunches&) = delete;
  FirstLaunches& operator=(const FirstLaunches&) = delete;

  static void add(const cl::Event& before, const cl::Event& launch) {
    for (FirstLaunches* each = innermost(); each != nullptr; each = each->outer_)
      each->all_.emplace_back(before, launch);
  }

  std::vector<FirstLaunch> take() { return std::exchange(all_, {}); }

 private:
  static FirstLaunches*& innermost() {
    thread_local FirstLaunches* present = nullptr;
    return present;
  }

  FirstLaunches* outer_;
  std::vector<FirstLaunch> all_;
};

}  // namespace vorocl
