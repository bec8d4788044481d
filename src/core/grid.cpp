#include "vorocl/grid.hpp"

#include <string>

#include "vorocl/error.hpp"

namespace vorocl {

namespace {

int checked_side(std::int64_t side, const char* name, bool periodic) {
  if (periodic && side > Grid::max_period && side <= Grid::max_side) {
    throw Error("the grid's " + std::string(name) + " is " + std::to_string(side) +
                "; along a periodic axis it may be " + std::to_string(Grid::max_period) + " pixels at most");
  }
  if (side < 1 || side > Grid::max_side) {
    throw Error("the grid's " + std::string(name) + " is " + std::to_string(side) +
                "; it must be from 1 to " + std::to_string(Grid::max_side) + " pixels");
  }
  return static_cast<int>(side);
}

}  // namespace

Grid::Grid(std::int64_t width, std::int64_t height, Periodic periodic)
    : width_(checked_side(width, "width", periodic == Periodic::x || periodic == Periodic::xy)),
      height_(checked_side(height, "height", periodic == Periodic::y || periodic == Periodic::xy)),
      periodic_(periodic) {
  if (pixels() > max_pixels) {
    throw Error("a grid of " + std::to_string(width) + " x " + std::to_string(height) +
                " has too many pixels; at most 2^30 (such as 32768 x 32768) are possible");
  }
}

}  // namespace vorocl
