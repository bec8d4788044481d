#include <algorithm>
#include <exception>
#include <numeric>

#include "mpi/agreement.hpp"
#include "vorocl/mpi.hpp"

namespace vorocl {

namespace {

/// What a tile is expected to cost, in pixels: a seed costs as much as this many.
double cost_of(const SharedSeeds& seeds, const Window& tile) {
  constexpr double pixels_per_seed = 20;
  return static_cast<double>(tile.pixels()) + pixels_per_seed * seeds.expected(tile);
}

std::vector<std::uint64_t> all_of(const Tiling& tiling) {
  std::vector<std::uint64_t> tiles(tiling.count());
  std::iota(tiles.begin(), tiles.end(), std::uint64_t{0});
  return tiles;
}

}  // namespace

struct TileCounterState {
  TileCounterState(MPI_Comm communicator_of_caller, const SharedSeeds& seeds, const Tiling& tiling,
                   const std::vector<std::uint64_t>& tiles)
      : communicator(copy_of(communicator_of_caller)) {
    std::vector<double> costs;
    double all = 0;
    for (const std::uint64_t tile : tiles) {
      costs.push_back(cost_of(seeds, tiling.tile(tile)));
      all += costs.back();
    }
    const double share = all / ranks_of(communicator);
    double before = 0;
    for (std::size_t i = 0; i < tiles.size(); ++i) {
      // The rank in whose share the middle of the tile falls, and how far into that.
      const double place = (before + costs[i] / 2) / share;
      const auto rank = static_cast<int>(place);
      if (place - rank > 0.75) {
        common.push_back(tiles[i]);
      } else if (rank == rank_of(communicator)) {
        own.push_back(tiles[i]);
      }
      before += costs[i];
    }
    std::reverse(own.begin(), own.end());
    MPI_Win_allocate(rank_of(communicator) == 0 ? sizeof(std::uint64_t) : 0, sizeof(std::uint64_t),
                     MPI_INFO_NULL, communicator, &taken, &window);
    if (rank_of(communicator) == 0) *taken = 0;
    MPI_Win_lock_all(0, window);
    MPI_Win_sync(window);
    MPI_Barrier(communicator);
  }

  ~TileCounterState() {
    // An error on one rank ends all of them, and this one must not wait for the others.
    if (std::uncaught_exceptions() > exceptions) return;
    MPI_Win_unlock_all(window);
    MPI_Win_free(&window);
    MPI_Comm_free(&communicator);
  }

  std::optional<std::uint64_t> next() {
    if (!own.empty()) {
      const std::uint64_t tile = own.back();
      own.pop_back();
      return tile;
    }
    const std::uint64_t one = 1;
    std::uint64_t number = 0;
    MPI_Fetch_and_op(&one, &number, MPI_UINT64_T, 0, 0, MPI_SUM, window);
    MPI_Win_flush(0, window);
    return number < common.size() ? std::optional<std::uint64_t>(common[number]) : std::nullopt;
  }

  MPI_Comm communicator;
  std::vector<std::uint64_t> own, common;  // those of this rank, the next one last; those of all
  std::uint64_t* taken = nullptr;          // of the common ones, on rank 0
  MPI_Win window = MPI_WIN_NULL;
  int exceptions = std::uncaught_exceptions();
};

TileCounter::TileCounter(MPI_Comm communicator, const SharedSeeds& seeds, const Tiling& tiling,
                         const std::vector<std::uint64_t>& tiles)
    : state_(std::make_unique<TileCounterState>(communicator, seeds, tiling, tiles)) {}
TileCounter::TileCounter(MPI_Comm communicator, const SharedSeeds& seeds, const Tiling& tiling)
    : TileCounter(communicator, seeds, tiling, all_of(tiling)) {}
TileCounter::~TileCounter() = default;
std::optional<std::uint64_t> TileCounter::next() { return state_->next(); }

}  // namespace vorocl
