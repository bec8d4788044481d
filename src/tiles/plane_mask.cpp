#include <memory>
#include <string>

#include "runtime/pixel_grid.hpp"
#include "tiles/mask_index.hpp"
#include "tiles/near_seeds.hpp"
#include "vorocl/error.hpp"
#include "vorocl/tiles.hpp"

namespace vorocl {

struct PlaneMaskState {
  explicit PlaneMaskState(const Grid& of) : grid(of), index(grid.width(), grid.height()) {}

  Grid grid;
  MaskIndex index;
};

PlaneMask::PlaneMask(const Grid& grid) {
  refuse_volume(grid, "a mask of tiles");
  refuse_tilted(grid, "a mask of tiles");
  state_ = std::make_unique<PlaneMaskState>(grid);
}
PlaneMask::~PlaneMask() = default;
PlaneMask::PlaneMask(PlaneMask&& other) noexcept = default;
PlaneMask& PlaneMask::operator=(PlaneMask&& other) noexcept = default;

PlaneMaskState& PlaneMask::state() const {
  if (!state_) throw Error("this mask was moved from, and has no rows; use the one it was moved to");
  return *state_;
}

void PlaneMask::add_rows(const std::uint8_t* pixels, std::int64_t count) {
  auto& [grid, index] = state();
  if (count < 0 || count > grid.height() - index.rows()) {
    throw Error("the mask has " + std::to_string(index.rows()) + " of " + std::to_string(grid.height()) +
                " rows, and cannot take " + std::to_string(count) + " more");
  }
  for (std::int64_t row = 0; row < count; ++row, pixels += grid.width()) {
    if (!index.add_row(pixels, no_label))
      throw Error("the mask has 2^32 - 1 seeds or more, which ids cannot number");
  }
}

std::int64_t PlaneMask::rows() const { return state().index.rows(); }
const Grid& PlaneMask::grid() const { return state().grid; }
std::uint64_t PlaneMask::id_end() const { return state().index.size(); }

void PlaneMask::find_near(const Window& window, Metric metric, std::vector<PlaneSeed>& seeds) const {
  const auto& [grid, index] = state();
  if (index.rows() < grid.height()) {
    throw Error("the mask has " + std::to_string(index.rows()) + " of " + std::to_string(grid.height()) +
                " rows; add the others before tiles are made");
  }
  NearSeeds(index, grid, metric).find(window, seeds);
}

}  // namespace vorocl
