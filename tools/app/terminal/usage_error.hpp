// The error of a command line that cannot be meant: exit code 2, where other errors give 1.
#pragma once

#include "vorocl/error.hpp"

namespace vorocl::command {

class UsageError : public Error {
 public:
  using Error::Error;
};

}  // namespace vorocl::command
