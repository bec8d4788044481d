#include "masks/pixel_sizes.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <sstream>

#include "vorocl/error.hpp"

namespace vorocl {

namespace {

using Lengths = std::array<double, 3>;

constexpr double most_apart = 1000;
constexpr double shortest = 1e-140, longest = 1e140;  // the squares of distances are doubles

/// Keys have 62 bits for squared distances and the number of a site: so long sides have shorter numbers.
constexpr std::int64_t most_of_long_sides = 8192;
int bits_of_squares(std::int64_t longest_side) { return longest_side <= most_of_long_sides ? 20 : 15; }

void check_lengths(const Lengths& lengths) {
  std::ostringstream text;
  for (const double length : lengths) {
    if (length >= shortest && length <= longest) continue;
    text << "a pixel cannot have the length " << length << "; it must be positive and finite, from "
         << shortest << " to " << longest;
    throw Error(text.str());
  }
  const auto [least, most] = std::minmax_element(lengths.begin(), lengths.end());
  if (*most <= *least * most_apart) return;
  text << "a pixel has the lengths " << *least << " and " << *most << "; none may be more than " << most_apart
       << " times another";
  throw Error(text.str());
}

/// The lengths as multiples of a part of the greatest one, if they are: whole numbers up to `most`.
std::optional<WholeSizes> multiples_of(const Lengths& lengths, double part, double most) {
  constexpr double tolerance = 4 * std::numeric_limits<double>::epsilon();
  WholeSizes whole;
  whole.unit = part * part;
  for (std::size_t axis = 0; axis < lengths.size(); ++axis) {
    const double multiple = std::nearbyint(lengths[axis] / part);
    if (multiple < 1 || multiple > most ||
        std::abs(multiple * part - lengths[axis]) > tolerance * lengths[axis])
      return {};
    whole.squares[axis] = static_cast<std::int64_t>(multiple * multiple);
  }
  return whole;
}

}  // namespace

WholeSizes whole_sizes(const PixelSize& size, std::int64_t longest_side) {
  const Lengths lengths = {size.x, size.y, size.z};
  check_lengths(lengths);
  const int bits = bits_of_squares(longest_side);
  const double most = std::min(most_apart, std::floor(std::sqrt(std::ldexp(1, bits))));
  if (const auto whole = multiples_of(lengths, 1, most)) return *whole;
  const double greatest = *std::max_element(lengths.begin(), lengths.end());
  for (double parts = 1; parts <= most; ++parts) {
    if (const auto whole = multiples_of(lengths, greatest / parts, most)) return *whole;
  }
  WholeSizes whole;
  whole.unit = std::ldexp(greatest * greatest, -bits);
  for (std::size_t axis = 0; axis < lengths.size(); ++axis) {
    const double square = std::nearbyint(lengths[axis] * lengths[axis] / whole.unit);
    whole.squares[axis] = std::max<std::int64_t>(1, static_cast<std::int64_t>(square));
  }
  return whole;
}

std::int64_t WholeSizes::most_within(double distance) const {
  constexpr std::int64_t all = std::int64_t{1} << 62;
  const double length = std::sqrt(unit), square = distance / length * (distance / length);
  if (!(square < static_cast<double>(all))) return all;
  const auto is_within = [&](std::int64_t units) {
    return std::sqrt(static_cast<double>(units)) * length <= distance;
  };
  auto most = static_cast<std::int64_t>(square);
  while (most > 0 && !is_within(most)) --most;
  while (is_within(most + 1)) ++most;
  return most;
}

}  // namespace vorocl
