// Measures of the cells of a diagram: area, centroid, extent; of a volume their volume for area.
#pragma once

#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "vorocl/diagram.hpp"
#include "vorocl/export.h"
#include "vorocl/opencl.hpp"
#include "vorocl/own_state.hpp"
#include "vorocl/report.hpp"
#include "vorocl/seeds.hpp"

namespace vorocl {

struct CellSumsState;
struct CellShapesState;
struct CellStatisticsState;

/// What cell_sums() knows of a cell: exact integers, the same on every device. Where the
/// diagram's window shows one whole period of an axis (Window::periodic()), each pixel counts where it lies
/// the shorter way round from the seed. That place may be outside the window; half a period away it is behind
/// the seed. Along other axes
/// it counts where the window shows it. Labels that name absent seeds count nowhere.
///
/// In a tilted grid a pixel lies the shortest of all ways from the seed, in the diagram's metric, and perhaps
/// between pixels: then `sum_x`, and in a volume `sum_y`, are rounded, and a bounding box has the pixels that
/// hold the centres.
///
/// A measure has one name in planes and volumes: the area of a volume's cell is its volume, in voxels.
struct CellSums {
  std::uint32_t area = 0;  ///< pixels, in a volume voxels
  std::int64_t sum_x = 0;  ///< of the pixels' columns, from the window's first one on, ...
  std::int64_t sum_y = 0;  ///< ... rows ...
  std::int64_t sum_z = 0;  ///< ... and slices: 0 in a plane

  /// The mean of the centres of the pixels, in pixels from the window's first one: in a plane z is 0.5. All
  /// NaN of an empty cell.
  VOROCL_API Point centroid() const;
};

/// What cell_shapes() knows of a cell. An empty cell has right < left, bottom < top, back <
/// front, and largest_distance -1. In a grid with an axis that is spaced (Axis::spaced()) that distance is in
/// units of the spacing.
struct CellShape {
  int left = 0, top = 0, right = 0,
      bottom = 0;               ///< the bounding box of the pixels, where CellSums counts them
  double largest_distance = 0;  ///< of its pixels to its seed, in pixels; squared if Euclidean
  bool touches_border = false;  ///< it has a pixel next to a border; a periodic axis has none
  int front = 0, back = 0;      ///< of the box: its first slice and its last one, 0 in a plane

  /// The distance itself, of a diagram by this metric; NaN of an empty cell.
  double farthest(Metric metric) const {
    if (largest_distance < 0) return std::numeric_limits<double>::quiet_NaN();
    return metric == Metric::euclidean ? std::sqrt(largest_distance) : largest_distance;
  }
};

/// What cell_sums() found, on the device: buffers with one entry per seed, by id. Measuring into them again
/// allocates nothing unless there are more seeds. Empty before the first time, and after it was moved from or
/// cell_sums() threw: then its buffers are null.
///
/// Threads: one thread at a time.
///
/// Lifetime: a result keeps its device, and remembers the frame of seeds that it was made from; seeds and
/// diagram may change at once after the call. Its buffers are valid until the next measurement into it.
///
/// Ordering: all work goes to the device's in-order queue, in the order of the calls.
class VOROCL_API CellSumsResult {
 public:
  std::size_t size() const;
  const cl::Buffer& area() const;   ///< uint32 per cell
  const cl::Buffer& sum_x() const;  ///< int64 per cell
  const cl::Buffer& sum_y() const;  ///< int64 per cell
  const cl::Buffer& sum_z() const;  ///< int64 per cell; of a plane 0

  /// Waits. Throws BadPoint if the frame of the seeds had one.
  std::vector<CellSums> read() const;

 private:
  friend struct Internal;
  OwnState<CellSumsState> state_;
};

/// What cell_shapes() found, as CellSumsResult.
class VOROCL_API CellShapesResult {
 public:
  std::size_t size() const;

  /// int32 left, top, front, right, bottom, back per cell; front and back of a plane are 0.
  const cl::Buffer& boxes() const;

  /// int32 per cell. A null buffer if a seed lies so far outside the window that its distances may need more
  /// bits; read() gives them in any case.
  const cl::Buffer& largest_distances() const;

  /// Waits. Throws BadPoint if the frame of the seeds had one.
  std::vector<CellShape> read() const;

 private:
  friend struct Internal;
  OwnState<CellShapesState> state_;
};

/// The cells of a diagram as a whole. Absent seeds do not count.
struct CellStatistics {
  std::size_t cells = 0;  ///< seeds that are there; of those outside the window the ones that own pixels
  std::size_t empty_cells = 0;  ///< seeds without a pixel: another seed is on theirs
  std::uint64_t pixels = 0;     ///< with a label
  double mean_area = 0;         ///< 0 if there are no cells
  double area_deviation = 0;    ///< the standard deviation (of all cells, not of a sample)
};

/// What cell_statistics() found, on the device; as CellSumsResult.
class VOROCL_API CellStatisticsResult {
 public:
  /// Waits. Nothing but zeros while the result is empty. Throws BadPoint if the frame of the seeds had one.
  CellStatistics read() const;

  /// The pixels of each cell, by id, as CellSums::area: the statistics are made of them, and take less than
  /// all sums. Waits. Empty while the result is. Throws BadPoint if the frame of the seeds had one.
  std::vector<std::uint32_t> read_areas() const;

 private:
  friend struct Internal;
  OwnState<CellStatisticsState> state_;
};

/// Sums the pixels of every cell. The sums are 64-bit integers made with 32-bit atomics alone, so they are
/// the same on every device. Areas sum to the pixels that have a label. Cost: about one wave of flooding,
/// with few seeds as with many; 38 bytes of device memory per seed, in a volume 46. Enqueues and returns.
/// Throws Error if the diagram knows no seeds (see Diagram::write()) or the device has too little memory.
VOROCL_API Report cell_sums(const Diagram& diagram, CellSumsResult& result);

/// Finds the extent of every cell: its bounding box, whether it touches the window's border, and how far its
/// farthest pixel is from its seed, in the diagram's metric. Enqueues and returns. Throws as cell_sums().
VOROCL_API Report cell_shapes(const Diagram& diagram, CellShapesResult& result);

/// Counts the cells and the spread of their areas, on the device. Enqueues and returns. Throws as
/// cell_sums().
VOROCL_API Report cell_statistics(const Diagram& diagram, CellStatisticsResult& result);

/// As above, of sums that have been made. Allocates nothing if it did for as many seeds before. Empties the
/// result if nothing has been summed.
VOROCL_API Report cell_statistics(const CellSumsResult& sums, CellStatisticsResult& result);

/// One row of a table of cells, in the units of the data; by great circles with areas in square kilometres,
/// and centroids on the sphere, in degrees.
struct CellRow {
  std::uint32_t id = 0;
  Point seed;                    ///< as it was given
  std::uint32_t pixels = 0;      ///< of the cell
  double area = 0;               ///< pixels times the area of one; in a volume, the volume
  Point centroid;                ///< all NaN of an empty cell; across a period's end it may lie outside
  bool touches_border = false;   ///< of the window; on the globe a pole is none
  std::uint32_t neighbours = 0;  ///< cells that it shares an edge with, in a volume a face
  double largest_distance =
      0;  ///< of its pixels to the seed, as distance_field() has it; NaN of an empty cell
};

/// All cells of the seeds that are there, by id. Takes cell_sums(), cell_shapes() and adjacency(), and waits.
/// Throws as they do.
VOROCL_API std::vector<CellRow> cell_table(const Diagram& diagram);

}  // namespace vorocl
