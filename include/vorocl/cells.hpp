// Measures of the cells of a diagram: area, centroid, extent.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "vorocl/diagram.hpp"
#include "vorocl/export.h"
#include "vorocl/opencl.hpp"
#include "vorocl/report.hpp"
#include "vorocl/seeds.hpp"

namespace vorocl {

struct CellSumsState;
struct CellShapesState;

/// What cell_sums() knows of a cell: exact integers, the same on every device. Along a periodic axis of the
/// grid each pixel counts where it lies the shorter way round from the seed (half a period away: behind it),
/// which may be outside the grid. In a window of a plane, which may repeat (Domain), the pixels count where
/// the grid shows them.
struct CellSums {
  std::uint32_t area = 0;  ///< pixels
  std::int64_t sum_x = 0;  ///< of the pixels' columns ...
  std::int64_t sum_y = 0;  ///< ... and rows

  /// The mean of the centres of the pixels, in pixel units; (NaN, NaN) of an empty cell. It may be outside a
  /// periodic grid, near the seed.
  VOROCL_API Point centroid() const;
};

/// What cell_shapes() knows of a cell. An empty cell has right < left, bottom < top and largest_distance -1.
struct CellShape {
  int left = 0, top = 0, right = 0,
      bottom = 0;                     ///< the bounding box of the pixels, where CellSums counts them
  std::int64_t largest_distance = 0;  ///< of its pixels to its seed; squared if Euclidean
  bool touches_border = false;        ///< it has a pixel next to a border; a periodic axis has none
};

/// What cell_sums() found, on the device: buffers with one entry per seed, by id. Measuring into them again
/// allocates nothing unless there are more seeds. Empty before the first time, and after it was moved from or
/// cell_sums() threw: then its buffers are null.
///
/// Threads: one thread at a time.
///
/// Lifetime: a result keeps its device, and remembers the frames of seeds that it was made from; seeds and
/// diagram may change at once after the call. Its buffers are valid until the next measurement into it.
///
/// Ordering: all work goes to the device's in-order queue, in the order of the calls.
class VOROCL_API CellSumsResult {
 public:
  CellSumsResult();
  ~CellSumsResult();
  CellSumsResult(CellSumsResult&& other) noexcept;
  CellSumsResult& operator=(CellSumsResult&& other) noexcept;

  std::size_t size() const;
  const cl::Buffer& area() const;   ///< uint32 per cell
  const cl::Buffer& sum_x() const;  ///< int64 per cell
  const cl::Buffer& sum_y() const;  ///< int64 per cell

  /// Waits. Throws BadPoint if the frame of the seeds, or that which the diagram was made from, had one.
  std::vector<CellSums> read() const;

 private:
  friend struct Internal;
  std::unique_ptr<CellSumsState> state_;
};

/// What cell_shapes() found, as CellSumsResult.
class VOROCL_API CellShapesResult {
 public:
  CellShapesResult();
  ~CellShapesResult();
  CellShapesResult(CellShapesResult&& other) noexcept;
  CellShapesResult& operator=(CellShapesResult&& other) noexcept;

  std::size_t size() const;
  const cl::Buffer& boxes() const;  ///< int32 left, top, right, bottom per cell

  /// int32 per cell. A null buffer if a seed lies so far outside the grid that its distances may need more
  /// bits; read() gives them in any case.
  const cl::Buffer& largest_distances() const;

  /// Waits. Throws BadPoint if the frame of the seeds, or that which the diagram was made from, had one.
  std::vector<CellShape> read() const;

 private:
  friend struct Internal;
  std::unique_ptr<CellShapesState> state_;
};

/// Sums the pixels of every cell. The sums are 64-bit integers made with 32-bit atomics alone, so they are
/// the same on every device. Areas sum to the pixels that have a label. Cost: about one wave of flooding,
/// with few seeds as with many; 30 bytes of device memory per seed. Enqueues and returns. Throws Error if
/// seeds and diagram do not fit together or the device has too little memory.
VOROCL_API Report cell_sums(const Seeds& seeds, const Diagram& diagram, CellSumsResult& result);

/// Finds the extent of every cell: its bounding box, whether it touches the grid's border, and how far its
/// farthest pixel is from its seed. Enqueues and returns. Throws as cell_sums().
VOROCL_API Report cell_shapes(const Seeds& seeds, const Diagram& diagram, CellShapesResult& result,
                              Metric metric = Metric::euclidean);

/// The cells of a diagram as a whole. Absent seeds do not count.
struct CellStatistics {
  std::size_t cells = 0;        ///< seeds that are there; of those outside the grid the ones that own pixels
  std::size_t empty_cells = 0;  ///< seeds without a pixel: another seed is on theirs
  std::uint64_t pixels = 0;     ///< with a label
  double mean_area = 0;         ///< 0 if there are no cells
  double area_deviation = 0;    ///< the standard deviation (of all cells, not of a sample)
};

/// Counts the cells and the spread of their areas, on the device. Waits. Throws as cell_sums().
VOROCL_API CellStatistics cell_statistics(const Seeds& seeds, const Diagram& diagram);

/// As above, of sums that have been made. Allocates nothing if it did for as many seeds before. Nothing but
/// zeros if nothing has been summed.
VOROCL_API CellStatistics cell_statistics(CellSumsResult& sums);

/// The pixels whose labels differ between two diagrams. Waits. Throws as similarity().
VOROCL_API std::size_t changed_pixels(const Diagram& a, const Diagram& b);

}  // namespace vorocl
