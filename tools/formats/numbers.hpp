// Numbers in the bytes of files.
#pragma once

#include <cstddef>

namespace vorocl::command {

/// A type of numbers that arrays and images are made of.
struct NumberType {
  std::size_t size = 0;                                                           ///< in bytes
  void (*read)(const char* bytes, std::size_t count, double* numbers) = nullptr;  ///< in the host's order
};

/// Integers without a sign (kind 'u', and 'b' for booleans) and with one ('i'), of 1, 2, 4 or 8 bytes, and
/// floating-point numbers ('f') of 2, 4 or 8 (IEEE 754). Null: there is no such type.
const NumberType* number_type(char kind, std::size_t size);

}  // namespace vorocl::command
