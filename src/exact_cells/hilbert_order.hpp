// Hilbert's order, along a curve without jumps: points that follow each other lie near each other, and those
// of a stretch of it in a box that is hardly larger than what they need.
#pragma once

#include <array>
#include <cstdint>

#include "core/z_order.hpp"

namespace vorocl {

/// How the curve goes on from one byte of a place in Morton's order to the next: the byte in Hilbert's order,
/// and how the four squares lie that the next one means.
struct HilbertStep {
  std::uint8_t order, way;
};

/// By way and byte. In each square of four the curve goes round a U; the first of its quarters is mirrored
/// along one diagonal, and the last along the other one.
constexpr std::array<std::array<HilbertStep, 256>, 4> hilbert_steps() {
  std::array<std::array<HilbertStep, 256>, 4> steps = {};
  for (unsigned way = 0; way < 4; ++way) {
    for (unsigned byte = 0; byte < 256; ++byte) {
      unsigned order = 0, is_swapped = way & 1, is_turned = way >> 1;
      for (unsigned shift = 8; shift > 0; shift -= 2) {
        const unsigned quarter = byte >> (shift - 2);
        const unsigned x = ((is_swapped != 0 ? quarter >> 1 : quarter) & 1) ^ is_turned;
        const unsigned y = ((is_swapped != 0 ? quarter : quarter >> 1) & 1) ^ is_turned;
        order = order << 2 | ((3 * x) ^ y);
        if (y == 0) {
          is_turned ^= x;
          is_swapped ^= 1;
        }
      }
      steps[way][byte] = {static_cast<std::uint8_t>(order),
                          static_cast<std::uint8_t>(is_swapped | is_turned << 1)};
    }
  }
  return steps;
}

/// The place of a position in the order.
inline std::uint64_t hilbert_order(std::uint32_t x, std::uint32_t y) {
  static constexpr auto steps = hilbert_steps();
  const std::uint64_t z_order = spread_bits(x) | spread_bits(y) << 1;
  std::uint64_t order = 0;
  std::size_t way = 0;
  for (int shift = 56; shift >= 0; shift -= 8) {
    const HilbertStep step = steps[way][z_order >> shift & 0xff];
    order = order << 8 | step.order;
    way = step.way;
  }
  return order;
}

constexpr int hilbert_bits = 21;  // of each coordinate in space

/// The place of a position in space, by Skilling's transposition ("Programming the Hilbert curve", 2004).
/// Coordinates beyond the bits count as the last one.
inline std::uint64_t hilbert_order(std::array<std::uint32_t, 3> at) {
  constexpr std::uint32_t top = 1u << (hilbert_bits - 1);
  for (std::uint32_t& coordinate : at) coordinate = coordinate < 2 * top ? coordinate : 2 * top - 1;
  for (std::uint32_t bit = top; bit > 1; bit >>= 1) {
    const std::uint32_t lower = bit - 1;
    for (std::uint32_t& coordinate : at) {
      const std::uint32_t is_set = (coordinate & bit) != 0 ? ~0u : 0u;
      const std::uint32_t swapped = (at[0] ^ coordinate) & lower & ~is_set;
      at[0] ^= (lower & is_set) | swapped;
      coordinate ^= swapped;
    }
  }
  at[1] ^= at[0];
  at[2] ^= at[1];
  std::uint32_t flipped = 0;
  for (std::uint32_t bit = top; bit > 1; bit >>= 1) flipped ^= (at[2] & bit) != 0 ? bit - 1 : 0;
  const auto spread = [flipped](std::uint32_t coordinate) {  // to each third bit
    std::uint64_t bits = coordinate ^ flipped;
    bits = (bits | bits << 32) & 0x001f00000000ffffu;
    bits = (bits | bits << 16) & 0x001f0000ff0000ffu;
    bits = (bits | bits << 8) & 0x100f00f00f00f00fu;
    bits = (bits | bits << 4) & 0x10c30c30c30c30c3u;
    return (bits | bits << 2) & 0x1249249249249249u;
  };
  return spread(at[0]) << 3 | spread(at[1]) << 2 | spread(at[2]) << 1;  // from bit 63 on, as in the plane
}

}  // namespace vorocl
