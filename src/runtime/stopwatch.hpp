// The host's time for enqueueing something.
#pragma once

#include <chrono>

#include "runtime/device_state.hpp"

namespace vorocl {

/// Runs from its making on, without the times in which a full queue made it wait.
class Stopwatch {
 public:
  double milliseconds() const {
    const std::chrono::duration<double, std::milli> passed = std::chrono::steady_clock::now() - started_;
    return passed.count() - (DeviceState::milliseconds_waited() - waited_before_);
  }

 private:
  std::chrono::steady_clock::time_point started_ = std::chrono::steady_clock::now();
  double waited_before_ = DeviceState::milliseconds_waited();
};

}  // namespace vorocl
