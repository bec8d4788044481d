// Leaves no work behind on a device.
#pragma once

#include <exception>

#include "vorocl/device.hpp"

namespace vorocl::command {

/// Waits for the device at the end of a scope, also where an error ends it: PoCL crashes a process that exits
/// while its threads still build or run a kernel.
class FinishAtEnd {
 public:
  explicit FinishAtEnd(const Device& device) : device_(device) {}
  ~FinishAtEnd() {
    try {
      device_.finish();
    } catch (const std::exception&) {  // the error that ends the scope is the one to report
    }
  }
  FinishAtEnd(const FinishAtEnd&) = delete;
  FinishAtEnd& operator=(const FinishAtEnd&) = delete;

 private:
  Device device_;
};

}  // namespace vorocl::command
