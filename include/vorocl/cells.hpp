// Measures of the cells of a diagram: area, centroid, extent.
#pragma once

#include <CL/opencl.hpp>
#include <cstdint>
#include <optional>
#include <vector>

#include "vorocl/diagram.hpp"
#include "vorocl/export.hpp"
#include "vorocl/report.hpp"
#include "vorocl/seeds.hpp"

namespace vorocl {

/// What cell_sums() knows of a cell: exact integers, the same on every device.
struct CellSums {
  std::uint32_t area = 0;   ///< pixels
  std::uint64_t sum_x = 0;  ///< of the pixels' columns ...
  std::uint64_t sum_y = 0;  ///< ... and rows

  /// The mean of the centres of the pixels, in pixel units; (NaN, NaN) of an empty cell.
  VOROCL_API Point centroid() const;
};

/// What cell_shapes() knows of a cell. An empty cell has right < left, bottom < top and largest_distance -1.
struct CellShape {
  int left = 0, top = 0, right = 0, bottom = 0;  ///< the bounding box: first and last columns and rows
  std::int32_t largest_distance = 0;             ///< of its pixels to its seed; squared if Euclidean
  bool touches_border = false;                   ///< it has a pixel in the first or last row or column
};

struct CellStatistics;

/// The buffers of a measurement with one entry a seed, by id. Measuring into them again allocates nothing
/// unless there are more seeds.
class VOROCL_API CellSumsResult {
 public:
  std::size_t size() const { return seeds_ ? seeds_->size() : 0; }
  const cl::Buffer& area() const { return area_; }    ///< uint32 a cell
  const cl::Buffer& sum_x() const { return sum_x_; }  ///< uint64 a cell
  const cl::Buffer& sum_y() const { return sum_y_; }  ///< uint64 a cell

  /// Waits. Throws Error if the seeds had a bad point.
  std::vector<CellSums> read() const;

 private:
  friend Report cell_sums(const Seeds& seeds, const Diagram& diagram, CellSumsResult& result);
  friend CellStatistics cell_statistics(CellSumsResult& sums);
  std::optional<Seeds> seeds_;
  cl::Buffer area_, sum_x_, sum_y_, home_, home_sums_, partial_;
};

class VOROCL_API CellShapesResult {
 public:
  std::size_t size() const { return seeds_ ? seeds_->size() : 0; }
  const cl::Buffer& boxes() const { return boxes_; }  ///< int32 left, top, right, bottom a cell
  const cl::Buffer& largest_distances() const { return distances_; }  ///< int32 a cell

  /// Waits. Throws Error if the seeds had a bad point.
  std::vector<CellShape> read() const;

 private:
  friend Report cell_shapes(const Seeds& seeds, const Diagram& diagram, CellShapesResult& result,
                            Metric metric);
  std::optional<Seeds> seeds_;
  cl::Buffer boxes_, distances_;
};

/// Sums the pixels of every cell. The sums are 64-bit integers made with 32-bit atomics alone, so they are
/// the same on every device. Areas sum to the pixels that have a label. Cost: about one wave of flooding,
/// with few seeds as with many; 30 bytes of device memory a seed. Enqueues and returns. Throws Error if seeds
/// and diagram do not fit together or the device has too little memory.
VOROCL_API Report cell_sums(const Seeds& seeds, const Diagram& diagram, CellSumsResult& result);

/// Finds the extent of every cell: its bounding box, whether it touches the grid's border, and how far its
/// farthest pixel is from its seed. Enqueues and returns. Throws as cell_sums().
VOROCL_API Report cell_shapes(const Seeds& seeds, const Diagram& diagram, CellShapesResult& result,
                              Metric metric = Metric::euclidean);

/// The cells of a diagram as a whole. Absent seeds do not count.
struct CellStatistics {
  std::size_t cells = 0;        ///< seeds
  std::size_t empty_cells = 0;  ///< seeds without a pixel: another seed is on theirs
  std::uint64_t pixels = 0;     ///< with a label
  double mean_area = 0;         ///< 0 if there are no cells
  double area_deviation = 0;    ///< the standard deviation (of all cells, not of a sample)
};

/// Counts the cells and the spread of their areas, on the device. Waits. Throws as cell_sums().
VOROCL_API CellStatistics cell_statistics(const Seeds& seeds, const Diagram& diagram);

/// As above, of sums that have been made; the seeds must not have moved since. Allocates nothing if it did
/// for as many seeds before. Nothing but zeros if nothing has been summed.
VOROCL_API CellStatistics cell_statistics(CellSumsResult& sums);

/// The pixels whose labels differ between two diagrams. Waits. Throws as similarity().
VOROCL_API std::size_t changed_pixels(const Diagram& a, const Diagram& b);

}  // namespace vorocl
