// The seeds of a plane shared among the processes of MPI, and tiles handed out to them.
#pragma once

#include <mpi.h>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "vorocl/export.h"
#include "vorocl/tiles.hpp"

namespace vorocl {

struct SharedSeedsState;

/// The seeds of a plane, in equal parts on the processes (ranks) of a communicator: they are sorted along a
/// Z-curve and cut, however they are clustered. All ranks know the box of every 512 seeds.
/// A tile's seeds are found by the boxes, and those of other ranks are fetched from their memory, without
/// their help (MPI_Get). Memory per rank: 16 bytes for each of its seeds, 32 while they are shared out; 0.1
/// bytes for each seed of the plane; 64 MiB for seeds that were fetched; and what PlaneSeeds need for those
/// near a tile.
///
/// What is said to be collective must be called by all ranks. Where one of them has too little memory for its
/// seeds, all throw. Another error of one rank alone leaves the others waiting, as is usual with MPI: end
/// them (MPI_Abort).
///
/// Threads: one, that may call MPI.
class VOROCL_API SharedSeeds : public SeedSource {
 public:
  /// Collective. The communicator is copied.
  SharedSeeds(MPI_Comm communicator, const Grid& grid, Snap snap = Snap::none);

  /// Collective, for it frees what the ranks share.
  ~SharedSeeds() override;
  SharedSeeds(const SharedSeeds&) = delete;
  SharedSeeds& operator=(const SharedSeeds&) = delete;

  /// Makes room for so many seeds of this rank.
  void reserve(std::size_t count);

  /// Takes seeds from this rank, in any order, as PlaneSeeds::add(): with ids of their own, or the ids first,
  /// first + 1, ...
  void add(const PlaneSeed* seeds, std::size_t count);
  void add(const Points& points, std::uint64_t first);

  /// Collective: sorts the seeds and shares them out.
  void share();

  const Grid& grid() const override;
  std::uint64_t id_end() const override;
  Snap snap() const override;

  /// The seeds of all ranks, and those that this one holds. After share().
  std::uint64_t size() const;
  std::uint64_t held() const;

  /// About how many seeds lie in a window, as the boxes say. After share().
  double expected(const Window& window) const;

  /// Fetches seeds. Not collective. Throws Error before share().
  void find_near(const Window& window, Metric metric, std::vector<PlaneSeed>& seeds) const override;

 private:
  std::unique_ptr<SharedSeedsState> state_;
};

/// Collective. Throws Error on all ranks if they run different versions of the library.
VOROCL_API void check_versions(MPI_Comm communicator);

struct TileCounterState;

/// Hands out tiles to ranks: to each a run of neighbours that is three quarters of its share, and the others
/// one by one to whoever asks first (MPI_Fetch_and_op). Tiles are weighed by their pixels and their seeds.
class VOROCL_API TileCounter {
 public:
  /// Collective. Of all tiles, or of those with these numbers, the same on all ranks. The seeds are shared
  /// out.
  TileCounter(MPI_Comm communicator, const SharedSeeds& seeds, const Tiling& tiling);
  TileCounter(MPI_Comm communicator, const SharedSeeds& seeds, const Tiling& tiling,
              const std::vector<std::uint64_t>& tiles);

  /// Collective.
  ~TileCounter();
  TileCounter(const TileCounter&) = delete;
  TileCounter& operator=(const TileCounter&) = delete;

  /// The number of the next tile for this rank; none at the end. Not collective.
  std::optional<std::uint64_t> next();

 private:
  std::unique_ptr<TileCounterState> state_;
};

}  // namespace vorocl
