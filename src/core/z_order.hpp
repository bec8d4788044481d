// Morton's order along a Z-curve, in which neighbours in the plane are mostly near each other.
#pragma once

#include <cstdint>

namespace vorocl {

/// The bits of a number at the even places of one of twice the length.
inline std::uint64_t spread_bits(std::uint32_t number) {
  std::uint64_t bits = number;
  bits = (bits | bits << 16) & 0x0000ffff0000ffffu;
  bits = (bits | bits << 8) & 0x00ff00ff00ff00ffu;
  bits = (bits | bits << 4) & 0x0f0f0f0f0f0f0f0fu;
  bits = (bits | bits << 2) & 0x3333333333333333u;
  return (bits | bits << 1) & 0x5555555555555555u;
}

/// The number that spread_bits() made these of; bits at odd places do not count.
inline std::uint32_t gather_bits(std::uint64_t bits) {
  bits &= 0x5555555555555555u;
  bits = (bits | bits >> 1) & 0x3333333333333333u;
  bits = (bits | bits >> 2) & 0x0f0f0f0f0f0f0f0fu;
  bits = (bits | bits >> 4) & 0x00ff00ff00ff00ffu;
  bits = (bits | bits >> 8) & 0x0000ffff0000ffffu;
  return static_cast<std::uint32_t>(bits | bits >> 16);
}

constexpr std::uint32_t z_bias = 0x80000000u;  // negative coordinates come first

/// The place of a position in the order.
inline std::uint64_t z_order(std::int32_t x, std::int32_t y) {
  return spread_bits(static_cast<std::uint32_t>(y) ^ z_bias) << 1 |
         spread_bits(static_cast<std::uint32_t>(x) ^ z_bias);
}

/// The position of a place in the order.
inline std::int32_t x_of_z_order(std::uint64_t order) {
  return static_cast<std::int32_t>(gather_bits(order) ^ z_bias);
}
inline std::int32_t y_of_z_order(std::uint64_t order) {
  return static_cast<std::int32_t>(gather_bits(order >> 1) ^ z_bias);
}

}  // namespace vorocl
