// A hash of bytes, the same on every machine.
#pragma once

#include <cstddef>
#include <cstdint>

namespace vorocl::command {

/// 64-bit FNV-1a (Fowler, Noll, Vo) of whole numbers, byte by byte from the lowest one.
class Hash {
 public:
  template <typename T>
  void add(T number) {
    static_assert(static_cast<T>(-1) > 0, "unsigned numbers");
    for (std::size_t i = 0; i < sizeof number; ++i) {
      value_ = (value_ ^ ((number >> (8 * i)) & 0xff)) * 0x100000001b3u;
    }
  }

  std::uint64_t value() const { return value_; }

 private:
  std::uint64_t value_ = 0xcbf29ce484222325u;
};

}  // namespace vorocl::command
