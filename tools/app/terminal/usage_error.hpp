// The error of a wrong command line: exit code 2, where other errors give 1.
#pragma once

#include "vorocl/error.hpp"

namespace vorocl::command {

class UsageError : public Error {
 public:
  using Error::Error;
};

/// Does what checks or reads something of the command line: its Error is a UsageError.
template <typename Check>
auto as_usage(const Check& check) {
  try {
    return check();
  } catch (const Error& error) {
    throw UsageError(error.what());
  }
}

}  // namespace vorocl::command
