// Exact diagrams of grids that are larger than a device, tile by tile.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "vorocl/device.hpp"
#include "vorocl/export.h"
#include "vorocl/grid.hpp"
#include "vorocl/opencl.hpp"
#include "vorocl/own_state.hpp"
#include "vorocl/points.hpp"
#include "vorocl/seeds.hpp"

namespace vorocl {

/// How a window of a grid is cut into tiles: squares, from its first pixel on, numbered row-major. Those at
/// the right and at the bottom may be smaller. A tile is a window of the same grid.
class VOROCL_API Tiling {
 public:
  /// A grid is the window that shows all of it. Throws Error unless the side is in [1, Window::max_side] and
  /// side * side at most Window::max_pixels, or if the window is longer than a period.
  Tiling(const Window& window, std::int64_t side);

  const Window& window() const { return window_; }
  int side() const { return side_; }
  std::uint64_t columns() const { return columns_; }
  std::uint64_t rows() const { return rows_; }
  std::uint64_t count() const { return columns_ * rows_; }

  /// Throws Error unless number < count().
  Window tile(std::uint64_t number) const;

 private:
  Window window_;
  int side_;
  std::uint64_t columns_, rows_;
};

/// A side for tiles that a device holds with a quarter of its memory, and labels fast: 256 to 4096, a power
/// of two.
VOROCL_API int default_tile_side(const Device& device);

/// A seed of a grid: its pixel, which may be outside the grid, its id, and where in the pixel it lies.
struct PlaneSeed {
  std::int32_t x = 0, y = 0;
  std::uint32_t id = 0;
  std::uint16_t part_x = 2048, part_y = 2048;  ///< in 1/4096 pixel; the centre, where seeds are snapped
};

/// Where tiles get the seeds of a grid from.
class VOROCL_API SeedSource {
 public:
  virtual ~SeedSource();

  virtual const Grid& grid() const = 0;

  /// One more than the greatest id of a seed.
  virtual std::uint64_t id_end() const = 0;

  /// Whether tiles take the centres of the seeds' pixels.
  virtual Snap snap() const { return Snap::to_pixels; }

  /// Replaces what a list has by the seeds that own pixels of a window of the grid, and few others. Of seeds
  /// at one place only the one that owns pixels. The window has at most Window::max_side pixels along a
  /// side.
  virtual void find_near(const Window& window, Metric metric, std::vector<PlaneSeed>& seeds) const = 0;
};

struct PlaneSeedsState;

/// The seeds of a grid of any size, on the host: 13 bytes each, 24 while they are sorted, which happens at
/// the first question; 4 and 8 more if they are not snapped. Ids are less than 2^32 - 1. Of seeds at one
/// place, or that are snapped and share a pixel, the lowest id owns the cell.
///
/// Threads: one thread at a time until the first question, which sort() can be; any number from then on.
class VOROCL_API PlaneSeeds : public SeedSource {
 public:
  /// What becomes of points outside the grid, and within their pixels, is as for Seeds.
  explicit PlaneSeeds(const Grid& grid, const SeedsOptions& options = {});
  PlaneSeeds(const Grid& grid, const Points& points, const SeedsOptions& options = {});

  /// Makes room for so many seeds in all, so that add() need not copy those that are there.
  void reserve(std::size_t count);

  /// Adds the seeds of points in the units of the data; their ids go on from the last id, and an absent point
  /// takes one too. Along a periodic axis points wrap. Throws BadPoint naming the first point that is NaN,
  /// infinite, 2^31 pixels or more away from a pixel of the grid along an axis, or refused, and Error if ids
  /// run out or the seeds were sorted already; nothing is added then.
  void add(const Points& points);

  /// Adds seeds with ids of their own, in any order, each id once: a part of the seeds of a grid that
  /// several machines share. Where in their pixels they lie is not looked at if they are snapped. Throws
  /// Error for a pixel that is too far away, as above, or outside the period.
  void add(const PlaneSeed* seeds, std::size_t count);

  const Grid& grid() const override;
  std::uint64_t id_end() const override;
  Snap snap() const override;

  /// The seeds that were added and are there.
  std::size_t alive() const;

  /// How many of them lie outside the grid.
  std::size_t outside() const;

  /// Sorts them along a Z-curve and makes the index.
  void sort() const;

  /// Those inside the window, and those that own points of its rim. Cost: in proportion to what is found, and
  /// some microseconds for each cell on the rim.
  void find_near(const Window& window, Metric metric, std::vector<PlaneSeed>& seeds) const override;

 private:
  PlaneSeedsState& state() const;
  OwnState<PlaneSeedsState> state_;
};

struct PlaneMaskState;

/// The pixels of a grid of any size that are not 0, as seeds: ids are their numbers, row by row from 0, as of
/// Seeds::from_mask(). On the host: a bit for each pixel, and 8 bytes for each row.
///
/// Threads: one thread at a time while rows are added, any number from then on.
class VOROCL_API PlaneMask : public SeedSource {
 public:
  /// Without rows. Throws Error for a volume or a tilted grid.
  explicit PlaneMask(const Grid& grid);

  /// Appends rows, a byte for each pixel. Throws Error if the grid has fewer, or there are 2^32 - 1 seeds or
  /// more, which ids cannot number; what was added before is kept.
  void add_rows(const std::uint8_t* pixels, std::int64_t count);

  /// The rows that were added.
  std::int64_t rows() const;

  const Grid& grid() const override;

  /// How many seeds there are.
  std::uint64_t id_end() const override;

  /// As PlaneSeeds::find_near(). Throws Error if rows are missing, too.
  void find_near(const Window& window, Metric metric, std::vector<PlaneSeed>& seeds) const override;

 private:
  PlaneMaskState& state() const;
  OwnState<PlaneMaskState> state_;
};

/// A tile with its labels, which are ids of seeds or no_label, row-major.
struct TileLabels {
  std::uint64_t number = 0;  ///< in its Tiling
  Window tile;
  const std::uint32_t* labels = nullptr;  ///< on the host, until the function that is given them returns
  const float* distances = nullptr;       ///< likewise, if they are wanted: see distance_field()
};

struct PlaneCellsState;

/// A cell of a grid. Along a periodic axis a pixel counts where it lies the shorter way round from the seed
/// (half a period away: behind it), as in CellSums.
struct PlaneCell {
  std::uint64_t area = 0;                                   ///< pixels
  Point centroid;                                           ///< (NaN, NaN) of an empty cell
  std::int64_t left = 0, top = 0, right = -1, bottom = -1;  ///< the bounding box
  bool touches_border = false;  ///< it has a pixel next to the plane's border; a periodic axis has none
};

/// Two cells of a plane that share a pixel edge.
struct PlaneCellPair {
  std::uint32_t a = 0, b = 0;  ///< their ids, a < b
  std::uint64_t length = 0;    ///< the pixel edges they share
};

/// The cells of a plane, summed over its tiles, on the host: 96 bytes per cell that has pixels, and 16 per
/// pair, and while they are summed up to twice that. The sums are exact integers, of 128 bits where 64 can
/// overflow, so they do not depend on the tiles.
///
/// Threads: one thread at a time, for questions too.
class VOROCL_API PlaneCells {
 public:
  PlaneCells();

  /// The cells by id.
  std::uint64_t size() const;
  PlaneCell cell(std::uint64_t id) const;

  /// The pairs that touch, in the order of a and then b. Of a part of the plane: along and in that.
  std::vector<PlaneCellPair> pairs() const;

  /// Gives away what was summed so far, as bytes that add() of another object takes, and forgets it: for runs
  /// that another one goes on with, and for processes that share a plane.
  std::vector<char> take();

  /// Adds what another object gave away, of other tiles of the same plane and tiling. Throws Error if it is
  /// no such bytes, or of another plane.
  void add(const std::vector<char>& taken);

 private:
  friend struct Internal;
  OwnState<PlaneCellsState> state_;
};

struct TileOptions {
  Metric metric = Metric::euclidean;
  PlaneCells* cells = nullptr;  ///< where cells are summed too; none: nowhere
  bool distances = false;       ///< whether tiles have them
};

/// The number of the next tile to make; none at the end. It is asked from the thread that called.
using NextTile = std::function<std::optional<std::uint64_t>()>;

/// Makes the exact diagram of a plane tile by tile: the labels are those of exact_diagram() on a grid that
/// held all of it, tie rule included, whatever the tiles, their order and the device. While the device makes
/// one tile, the function gets the one before. If it throws, nothing more is made.
///
/// How: a host finds the seeds that may own a pixel of the tile (SeedSource), and an exact diagram is
/// made of a window of the plane. Memory: 20 bytes of the device's per pixel of a tile, 14 where tiles have
/// one size, 8 more with distances, and what its seeds need (Seeds), and nothing that grows with the plane.
/// Throws Error as Diagram and exact_diagram().
VOROCL_API void exact_tiles(const Device& device, const SeedSource& seeds, const Tiling& tiling,
                            const std::function<void(const TileLabels&)>& use,
                            const TileOptions& options = {});

/// As above, those tiles that `next` names.
VOROCL_API void exact_tiles(const Device& device, const SeedSource& seeds, const Tiling& tiling,
                            const NextTile& next, const std::function<void(const TileLabels&)>& use,
                            const TileOptions& options = {});

}  // namespace vorocl
