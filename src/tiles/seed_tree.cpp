#include "tiles/seed_tree.hpp"

#include <algorithm>
#include <array>
#include <utility>

namespace vorocl {

void SeedTree::reserve(std::size_t count) {
  places_.reserve(count);
  ids_.reserve(count);
  if (has_parts_) parts_.reserve(count);
}

void SeedTree::add(const PlaneSeed& seed) {
  places_.push_back(z_order(seed.x, seed.y));
  ids_.push_back(seed.id);
  if (has_parts_) parts_.push_back(std::uint32_t{seed.part_y} << 16 | seed.part_x);
}

void SeedTree::shorten(std::size_t count) {
  places_.resize(count);
  ids_.resize(count);
  if (has_parts_) parts_.resize(count);
}

// By the digits of their places, the lowest first; those that all seeds share are left out.
void SeedTree::sort_places() {
  constexpr int digit_bits = 11;
  constexpr std::uint64_t digit_mask = (1u << digit_bits) - 1;
  std::uint64_t varying = 0;
  for (const std::uint64_t place : places_) varying |= place ^ places_.front();
  std::vector<std::uint64_t> next_places(places_.size());
  std::vector<std::uint32_t> next_ids(ids_.size()), next_parts(parts_.size());
  for (int shift = 0; shift < 64; shift += digit_bits) {
    if ((varying >> shift & digit_mask) == 0) continue;
    std::array<std::size_t, digit_mask + 2> starts = {};
    for (const std::uint64_t place : places_) ++starts[(place >> shift & digit_mask) + 1];
    for (std::size_t digit = 1; digit < starts.size(); ++digit) starts[digit] += starts[digit - 1];
    for (std::size_t i = 0; i < places_.size(); ++i) {
      const std::size_t to = starts[places_[i] >> shift & digit_mask]++;
      next_places[to] = places_[i];
      next_ids[to] = ids_[i];
      if (has_parts_) next_parts[to] = parts_[i];
    }
    places_.swap(next_places);
    ids_.swap(next_ids);
    parts_.swap(next_parts);
  }
}

void SeedTree::sort_within_pixels() {
  std::vector<std::uint64_t> seeds;  // of a pixel: the parts, and the id below them
  for (std::size_t first = 0, end = 0; first < places_.size(); first = end) {
    while (end < places_.size() && places_[end] == places_[first]) ++end;
    if (end - first == 1) continue;
    seeds.clear();
    for (std::size_t i = first; i < end; ++i) seeds.push_back(std::uint64_t{parts_[i]} << 32 | ids_[i]);
    std::sort(seeds.begin(), seeds.end());
    for (std::size_t i = first; i < end; ++i) {
      parts_[i] = static_cast<std::uint32_t>(seeds[i - first] >> 32);
      ids_[i] = static_cast<std::uint32_t>(seeds[i - first]);
    }
  }
}

void SeedTree::sort() {
  if (!std::is_sorted(places_.begin(), places_.end())) sort_places();
  if (has_parts_) sort_within_pixels();
  const auto is_at = [this](std::size_t a, std::size_t b) {
    return places_[a] == places_[b] && (!has_parts_ || parts_[a] == parts_[b]);
  };
  std::size_t kept = 0;
  for (std::size_t i = 0; i < places_.size(); ++i) {
    if (kept > 0 && is_at(kept - 1, i)) {
      ids_[kept - 1] = std::min(ids_[kept - 1], ids_[i]);
    } else {
      places_[kept] = places_[i];
      if (has_parts_) parts_[kept] = parts_[i];
      ids_[kept++] = ids_[i];
    }
  }
  shorten(kept);
  boxes_.make(places_.size(), [&](std::size_t i) {
    const std::int32_t x = x_of_z_order(places_[i]), y = y_of_z_order(places_[i]);
    return Box{x, y, x, y};
  });
  for (std::uint64_t& place : places_) {
    place = static_cast<std::uint64_t>(gather_bits(place >> 1)) << 32 | gather_bits(place);
  }
}

void SeedTree::find_inside(const PlaneRectangle& rectangle, std::vector<PlaneSeed>& found) const {
  boxes_.visit_inside(rectangle, [&](std::size_t first, std::size_t end, bool all) {
    if (all) {
      const std::size_t before = found.size();
      found.resize(before + end - first);
      for (std::size_t i = first; i < end; ++i) found[before + i - first] = seed(i);
    } else {
      for (std::size_t i = first; i < end; ++i) {
        if (holds(rectangle, x_of(i), y_of(i))) found.push_back(seed(i));
      }
    }
  });
}

}  // namespace vorocl
