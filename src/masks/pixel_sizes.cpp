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
constexpr double most_wrong = 0.01;                   // of a distance, by rounding
constexpr double shortest = 1e-140, longest = 1e140;  // the squares of distances are doubles

/// The bits of the square of an image's diagonal, in units. A key has 62 for it and the number of a site, and
/// one is left for what rounding adds. Costs of ways up to ten times a side of one pixel must fit, too: so 55
/// at most.
int bits_of_diagonal(const std::array<int, 3>& sides) {
  int bits = 61;
  for (int longest = *std::max_element(sides.begin(), sides.end()) - 1; longest > 0; longest /= 2) --bits;
  return std::min(bits, 55);
}

/// The square of an image's diagonal, from the squares of a pixel's lengths.
template <typename Square>
double diagonal_of(const std::array<Square, 3>& squares, const std::array<int, 3>& sides) {
  double sum = 0;
  for (std::size_t axis = 0; axis < sides.size(); ++axis)
    sum += double(sides[axis]) * double(sides[axis]) * double(squares[axis]);
  return sum;
}

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

/// The lengths as multiples of a part of the greatest one, if they are: whole numbers up to 1,000.
std::optional<WholeSizes> multiples_of(const Lengths& lengths, double part) {
  constexpr double tolerance = 4 * std::numeric_limits<double>::epsilon();
  WholeSizes whole;
  whole.unit = part * part;
  for (std::size_t axis = 0; axis < lengths.size(); ++axis) {
    const double multiple = std::nearbyint(lengths[axis] / part);
    if (multiple < 1 || multiple > most_apart ||
        std::abs(multiple * part - lengths[axis]) > tolerance * lengths[axis])
      return {};
    whole.squares[axis] = static_cast<std::int64_t>(multiple * multiple);
  }
  return whole;
}

}  // namespace

WholeSizes whole_sizes(const PixelSize& size, const std::array<int, 3>& sides) {
  const Lengths lengths = {size.x, size.y, size.z};
  check_lengths(lengths);
  const int bits = bits_of_diagonal(sides);
  const auto fits = [&](const std::optional<WholeSizes>& whole) {
    return whole && diagonal_of(whole->squares, sides) <= std::ldexp(1, bits);
  };
  if (const auto whole = multiples_of(lengths, 1); fits(whole)) return *whole;
  const double greatest = *std::max_element(lengths.begin(), lengths.end());
  for (double parts = 1; parts <= most_apart; ++parts) {
    if (const auto whole = multiples_of(lengths, greatest / parts); fits(whole)) return *whole;
  }
  const Lengths squares = {size.x * size.x, size.y * size.y, size.z * size.z};
  WholeSizes whole;
  whole.unit = std::ldexp(diagonal_of(squares, sides), -bits);
  const double least = *std::min_element(squares.begin(), squares.end());
  if (whole.unit / (2 * least) > most_wrong) {
    std::ostringstream text;
    text << "the lengths " << std::sqrt(least) << " and " << greatest
         << " of a pixel are too far apart for an image of " << sides[0] << " x " << sides[1] << " x "
         << sides[2]
         << " pixels: cut it into parts that overlap, or give lengths that are whole numbers up to 1,000";
    throw Error(text.str());
  }
  for (std::size_t axis = 0; axis < lengths.size(); ++axis) {
    whole.squares[axis] = static_cast<std::int64_t>(std::nearbyint(squares[axis] / whole.unit));
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
