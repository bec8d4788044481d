// The exceptions of the library.
#pragma once

#include <cstddef>
#include <stdexcept>
#include <string>

#include "vorocl/export.h"
#include "vorocl/grid.hpp"

namespace vorocl {

/// What kind of thing went wrong. The C interface has a status for each.
enum class ErrorKind {
  bad_argument,   ///< an argument is out of its range, or two do not fit together: nothing was enqueued
  bad_point,      ///< a seed's point is NaN, infinite or too far away (see BadPoint)
  device_memory,  ///< the device has too little memory
  host_memory,    ///< the host has too little memory (std::bad_alloc says the same)
  device,         ///< there is no such device, or OpenCL or its driver failed
  kernel_build,   ///< a kernel could not be built; the message holds the compiler's log
  file,           ///< a file cannot be read or written, or its contents are bad
};

/// What went wrong and what to do about it, in one line (a kernel's build log adds lines of its own).
///
/// An object that a call failed on stays usable: a diagram that was to be filled counts as never filled, a
/// result is empty, seeds have the points that they had.
class VOROCL_API Error : public std::runtime_error {
 public:
  explicit Error(const std::string& message, ErrorKind kind = ErrorKind::bad_argument)
      : std::runtime_error(message), kind_(kind) {}

  ErrorKind kind() const noexcept { return kind_; }

 private:
  ErrorKind kind_;
};

/// A point that cannot be a seed's.
class VOROCL_API BadPoint : public Error {
 public:
  /// "point 7 (12, 3) " and what is bad about it; with z unless that is 0.
  BadPoint(std::size_t index, const Point& point, const std::string& what);

  std::size_t index() const noexcept { return index_; }  ///< in the caller's list: the seed's id
  const Point& point() const noexcept { return point_; }

 private:
  std::size_t index_;
  Point point_;
};

}  // namespace vorocl
