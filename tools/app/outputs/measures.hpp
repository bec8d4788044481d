// A diagram and all that is measured of it, by the ids that files have.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "app/sources/view.hpp"
#include "app/terminal/console.hpp"
#include "formats/raster.hpp"
#include "vorocl/analysis.hpp"
#include "vorocl/method.hpp"

namespace vorocl::command {

/// The memory of measurements, on the device and the host: with one for all frames, later frames allocate
/// nothing.
struct MeasureBuffers {
  /// A diagram whose labels are made where they are read, if the device shares the host's memory.
  Diagram diagram_to_read(const Device& device, const Window& window);

  CellSumsResult sums;
  CellShapesResult shapes;
  CellStatisticsResult statistics;
  AdjacencyResult adjacency;
  VerticesResult vertices;
  Field<float> distances;
  Field<std::uint8_t> borders;
  std::vector<std::uint32_t> labels, ids, ids_in_picture;
  std::vector<float> distances_on_host;
};

/// How many cells there are, and how many of them have no pixel.
struct CellCount {
  std::size_t cells = 0, empty = 0;
};

/// What is known of a cell.
struct CellMeasures {
  std::uint32_t id = 0;
  Point seed;
  CellSums sums;
  CellShape shape;
  std::uint32_t neighbours = 0;
  std::uint32_t perimeter = 0;  ///< pixel edges shared with other cells
};

/// Measures of one diagram. Each is made when it is first asked for, and waits; all throw as the library's
/// functions of the same names.
class Measures {
 public:
  /// `ids` says what files call each seed, no_label for one that is absent; empty: their indices. `view` says
  /// how the diagram stands in the picture. Keeps references to all.
  Measures(const Seeds& seeds, const Diagram& diagram, const std::vector<std::uint32_t>& ids,
           const View& view, MeasureBuffers& buffers);

  const View& view() const { return view_; }
  Metric metric() const { return diagram_.metric(); }

  // Positions and images are in pixels of the diagram, and the view brings them into the picture.

  /// The labels as the diagram has them, as files have them, and these in the picture. Row-major.
  const std::vector<std::uint32_t>& labels();
  const std::vector<std::uint32_t>& labels_by_id();
  const std::vector<std::uint32_t>& labels_in_picture();

  /// By label, absent seeds included: the centre of its pixel; the area of its cell, in the view's units; the
  /// cells that share a pixel edge with that.
  const std::vector<std::optional<Point>>& seeds();
  std::vector<double> areas();
  std::vector<double> neighbours();

  /// In pixels, sorted by id; no absent seeds, and of those outside the diagram only those that own pixels.
  std::vector<CellMeasures> cells();

  /// In pixels, sorted by a and then b, a < b.
  std::vector<CellPair> pairs();
  std::size_t pair_count();
  std::size_t vertices();

  /// Areas in the view's units.
  CellStatistics statistics();

  /// As statistics() counts them; on the host where that can, which needs no program of the device.
  CellCount cell_count();

  /// In pixels, row-major.
  const std::vector<float>& distances();
  std::vector<std::uint8_t> borders();

 private:
  std::uint32_t id_of(std::size_t label) const;
  const AdjacencyResult& adjacency_result();
  CellSumsResult& sums_result();

  const Seeds& seeds_;
  const Diagram& diagram_;
  const std::vector<std::uint32_t>& ids_;
  const View& view_;
  MeasureBuffers& buffers_;
  bool has_sums_ = false;
  bool has_adjacency_ = false;
  bool has_labels_ = false;
  bool has_ids_ = false;
  bool has_distances_ = false;
  const std::vector<std::uint32_t>* ids_in_picture_ = nullptr;
  std::optional<std::vector<std::optional<Point>>> points_;
};

/// How a diagram of seeds was made, and how it stands in the data.
Json json_of_diagram(const Method& method, Metric metric, const Seeds& seeds, const View& view);

}  // namespace vorocl::command
