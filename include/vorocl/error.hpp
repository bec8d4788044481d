// The one exception type of the library.
#pragma once

#include <stdexcept>

#include "vorocl/export.hpp"

namespace vorocl {

/// What went wrong and what to do about it, in one line (a kernel's build log adds lines of its own).
class VOROCL_API Error : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace vorocl
