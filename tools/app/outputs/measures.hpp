// A diagram, or exact cells, and all that is measured of it, by the ids that files have.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/sources/seed_input.hpp"
#include "app/sources/view.hpp"
#include "app/terminal/console.hpp"
#include "formats/raster.hpp"
#include "vorocl/analysis.hpp"
#include "vorocl/method.hpp"

namespace vorocl::command {

class ExactCellRows;

/// The images of one diagram on the host.
struct HostImages {
  std::vector<std::uint32_t> labels, ids, ids_in_picture;
  std::vector<float> distances;
};

/// The memory of measurements, on the device and the host: with one for all frames, later frames allocate
/// nothing.
struct MeasureBuffers {
  /// A diagram whose labels are made where the next Measures reads them, if the device shares the host's
  /// memory.
  Diagram diagram_to_read(const Device& device, const Window& window);

  /// Those of the next Measures: in turn, so that the images of one frame can be written while those of the
  /// next one are read.
  HostImages& take_images() { return images[taken++ % images.size()]; }

  CellSumsResult sums;
  CellShapesResult shapes;
  CellStatisticsResult statistics;
  AdjacencyResult adjacency;
  VerticesResult vertices;
  Field<float> distances;
  Field<std::uint8_t> borders;
  std::array<HostImages, 2> images;
  std::size_t taken = 0;
};

/// How many cells there are, and how many of them have no pixel.
struct CellCount {
  std::size_t cells = 0, empty = 0;
};

/// Measures of one diagram. Each is made and read from the device when it is first asked for, which waits;
/// all throw as the library's functions of the same names. Those that were read stay when the diagram
/// changes.
class Measures {
 public:
  /// `ids` says what files call each seed, no_label for one that is absent; empty: their indices. `view` says
  /// how the diagram stands in the picture. Keeps references to the seeds, the diagram and the buffers.
  Measures(const Seeds& seeds, const Diagram& diagram, const std::vector<std::uint32_t>& ids,
           const View& view, MeasureBuffers& buffers);

  /// Those of labels and seeds that were read before, which are all that can be asked for.
  Measures(const View& view, std::vector<std::uint32_t> labels, std::vector<std::optional<Point>> seeds,
           const std::vector<std::uint32_t>& ids, MeasureBuffers& buffers);

  /// Exact cells, which have ids, a view without pixels, kept columns and these measures alone.
  Measures(std::shared_ptr<ExactCellRows> exact, MeasureBuffers& buffers);
  ExactCellRows* exact() const { return exact_.get(); }

  /// Seeds and diagram may change from here on, and another thread may ask for what was read. What was not
  /// is an error.
  void leave_device();

  const View& view() const { return view_; }
  Metric metric() const { return metric_; }

  // Read from the device, in pixels of the diagram, by label, absent seeds included.

  /// Row-major.
  const std::vector<std::uint32_t>& labels();
  const std::vector<float>& distances();
  const std::vector<std::uint8_t>& borders();

  /// Where the seeds are.
  const std::vector<std::optional<Point>>& seeds();

  /// The pixels of the cells: alone in less time than their sums, if these were not read before.
  const std::vector<std::uint32_t>& pixels();
  const std::vector<CellSums>& sums();
  const std::vector<CellShape>& shapes();

  /// On the globe.
  bool is_on_globe() const { return metric_ == Metric::great_circle; }
  const std::vector<vorocl::CellRow>& on_globe();

  /// The cells that share a pixel edge with one, and how many edges that is.
  const std::vector<std::uint32_t>& neighbours();
  const std::vector<std::uint32_t>& perimeters();

  /// By index, sorted by a and then b, a < b.
  const std::vector<CellPair>& pairs();
  std::size_t pair_count();
  std::size_t vertices();

  /// Areas in the view's units.
  const CellStatistics& statistics();

  /// As statistics() counts them; on the host where that can, which needs no program of the device.
  CellCount cell_count();

  // Made of these on the host.

  /// The labels as files have them, and these in the picture.
  const std::vector<std::uint32_t>& labels_by_id();
  const std::vector<std::uint32_t>& labels_in_picture();

  /// Columns of the input, which rows of cells end with: those of --keep, which stay where they are.
  void keep(const KeptColumns& columns) { kept_ = &columns; }
  const KeptColumns* kept() const { return kept_; }

  /// What files call each label; empty: as it is.
  const std::vector<std::uint32_t>& ids() const { return ids_; }

  /// What files call a label.
  std::uint32_t id_of(std::size_t label) const {
    return ids_.empty() ? static_cast<std::uint32_t>(label) : ids_.at(label);
  }

  /// The areas of the cells by label, in the view's units.
  std::vector<double> areas();

  /// The labels of the cells, sorted by id: no absent seeds, and of those outside the diagram only those that
  /// own pixels. Of exact cells in the order of ExactCellRows.
  std::vector<std::uint32_t> cells();

  /// By id, sorted by a and then b, a < b.
  std::vector<CellPair> pairs_by_id();

 private:
  const Diagram& diagram() const;
  CellSumsResult& sums_result();
  const CellStatisticsResult& statistics_result();
  const AdjacencyResult& adjacency_result();

  std::shared_ptr<ExactCellRows> exact_;
  const Seeds* seeds_;  // null, as the diagram: they may have changed
  const Diagram* diagram_;
  Metric metric_;
  std::vector<std::uint32_t> ids_;
  View view_;
  const KeptColumns* kept_ = nullptr;
  MeasureBuffers& buffers_;
  HostImages& images_;
  bool has_sums_ = false, has_statistics_ = false, has_adjacency_ = false;
  bool has_labels_ = false, has_ids_ = false, has_distances_ = false;
  const std::vector<std::uint32_t>* ids_in_picture_ = nullptr;
  std::optional<std::vector<std::uint8_t>> borders_;
  std::optional<std::vector<std::optional<Point>>> points_;
  std::optional<std::vector<std::uint32_t>> pixels_, neighbours_, perimeters_;
  std::optional<std::vector<CellSums>> sums_;
  std::optional<std::vector<CellShape>> shapes_;
  std::optional<std::vector<CellPair>> pairs_;
  std::optional<CellStatistics> statistics_;
  std::optional<std::vector<vorocl::CellRow>> on_globe_;
};

/// Throws UsageError for a distance where lengths have no scale in the data.
void check_max_distance(const std::optional<double>& distance, const View& view);

/// Leaves pixels that are farther than this from their seed, in the view's units, without a label, and
/// returns how many, where that is asked for.
std::optional<std::size_t> leave_out_beyond(std::optional<double> distance, const Seeds& seeds,
                                            const View& view, Diagram& diagram);

/// The metric, the device and the grid of the seeds; the sides are those of what is shown.
Json json_of_grid(Metric metric, const Seeds& seeds, std::int64_t width, std::int64_t height);

/// How a diagram of seeds was made, and how it stands in the data.
Json json_of_diagram(const Method& method, Metric metric, const Seeds& seeds, const View& view);

/// How many pixels are left out, where that is asked for: a line on standard output.
void print_beyond(const std::optional<std::size_t>& beyond, const View& view);

/// "pixel", of a volume "voxel".
const char* name_of_pixel(const View& view);

/// What distances are in where they have no data units: "pixels", "voxels", "units of the spacing".
const char* unit_of_distances(const Grid& grid);

/// "512 x 256 pixels", the picture's; of a volume "64 x 32 x 16 voxels".
std::string size_text(const View& view);

/// How the diagram was made, on standard output, in a line.
void print_diagram(const Method& method, const Seeds& seeds, const View& view, const Report& report);

}  // namespace vorocl::command
