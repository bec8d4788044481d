#include "studies/configurations.hpp"

#include <fmt/format.h>

#include <cmath>
#include <set>

#include "formats/numbers.hpp"
#include "vorocl/error.hpp"

namespace vorocl::command {

namespace {

constexpr std::size_t most_seeds = Grid::max_pixels;

std::size_t seeds_on(int side, const SeedCount& count) {
  if (!count.percent) return count.count;
  const double pixels = static_cast<double>(side) * side, seeds = std::round(*count.percent / 100 * pixels);
  if (!(seeds >= 1 && seeds <= static_cast<double>(most_seeds))) {
    throw Error(fmt::format("--seeds: {} of {} x {} pixels are {} seeds; 1 to {} are possible", count.text,
                            side, side, seeds, most_seeds));
  }
  return static_cast<std::size_t>(seeds);
}

}  // namespace

int parse_side(const std::string& text) {
  const auto side = parse_number<int>(text);
  if (!side || *side < 1 || *side > Grid::max_side) {
    throw Error(fmt::format("\"{}\" must be a side of the grid in pixels, 1 to {}", text, Grid::max_side));
  }
  return *side;
}

SeedCount parse_seed_count(const std::string& text) {
  if (!text.empty() && text.back() == '%') {
    const auto percent = parse_number<double>(text.substr(0, text.size() - 1));
    if (percent && *percent > 0 && std::isfinite(*percent)) return {text, 0, percent};
  } else if (const auto count = parse_number<std::size_t>(text);
             count && *count >= 1 && *count <= most_seeds) {
    return {text, *count, std::nullopt};
  }
  throw Error(
      fmt::format("\"{}\" must be a number of seeds, 1 to {}, or a percentage of the pixels, such as 1%",
                  text, most_seeds));
}

std::vector<Configuration> configurations(const std::vector<int>& sides,
                                          const std::vector<SeedCount>& counts) {
  std::set<Configuration> all;
  for (const int side : sides) {
    for (const SeedCount& count : counts) all.insert({side, seeds_on(side, count)});
  }
  return {all.begin(), all.end()};
}

}  // namespace vorocl::command
