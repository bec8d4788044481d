#include "app/outputs/measures.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace vorocl::command {

Analysis::Analysis(const Seeds& seeds, const Diagram& diagram, const std::vector<std::uint32_t>& ids,
                   Metric metric, AnalysisBuffers& buffers)
    : seeds_(seeds), diagram_(diagram), ids_(ids), metric_(metric), buffers_(buffers) {}

const LabelImage& Analysis::image() {
  if (!image_) image_ = {diagram_.grid(), diagram_.read()};
  return *image_;
}

const LabelImage& Analysis::named() {
  if (ids_.empty()) return image();
  if (!named_) named_ = with_ids(image(), ids_);
  return *named_;
}

const std::vector<std::optional<Point>>& Analysis::seeds() {
  if (!points_) points_ = seeds_.read();
  return *points_;
}

std::vector<double> Analysis::areas() {
  std::vector<double> areas;
  for (const CellSums& sums : sums_result().read()) areas.push_back(sums.area);
  return areas;
}

std::vector<double> Analysis::neighbours() {
  const std::vector<std::uint32_t> counts = adjacency_result().read_neighbours();
  return {counts.begin(), counts.end()};
}

std::vector<CellMeasures> Analysis::cells() {
  cell_shapes(seeds_, diagram_, buffers_.shapes, metric_);
  const std::vector<CellSums> sums = sums_result().read();
  const std::vector<CellShape> shapes = buffers_.shapes.read();
  const std::vector<std::uint32_t> neighbours = adjacency_result().read_neighbours();
  const std::vector<std::uint32_t> perimeters = adjacency_result().read_perimeters();
  std::vector<CellMeasures> cells;
  cells.reserve(seeds_.alive());
  for (std::size_t label = 0; label < seeds_.size(); ++label) {
    const std::optional<Point>& seed = seeds()[label];
    if (!seed) continue;
    cells.push_back({id_of(label), *seed, sums[label], shapes[label], neighbours[label], perimeters[label]});
  }
  std::sort(cells.begin(), cells.end(),
            [](const CellMeasures& a, const CellMeasures& b) { return a.id < b.id; });
  return cells;
}

std::vector<CellPair> Analysis::pairs() {
  std::vector<CellPair> pairs = adjacency_result().read_pairs();
  if (ids_.empty()) return pairs;
  for (CellPair& pair : pairs) {
    std::tie(pair.a, pair.b) = std::minmax({id_of(pair.a), id_of(pair.b)});
  }
  std::sort(pairs.begin(), pairs.end(),
            [](const CellPair& p, const CellPair& q) { return std::tie(p.a, p.b) < std::tie(q.a, q.b); });
  return pairs;
}

std::size_t Analysis::pair_count() { return adjacency_result().pairs(); }

CellStatistics Analysis::statistics() { return cell_statistics(sums_result()); }

const std::vector<float>& Analysis::distances() {
  if (!distances_) {
    distance_field(seeds_, diagram_, buffers_.distances, metric_);
    distances_ = buffers_.distances.read();
  }
  return *distances_;
}

std::vector<std::uint8_t> Analysis::borders() {
  border_mask(diagram_, buffers_.borders);
  return buffers_.borders.read();
}

std::uint32_t Analysis::id_of(std::size_t label) const {
  return ids_.empty() ? static_cast<std::uint32_t>(label) : ids_.at(label);
}

const AdjacencyResult& Analysis::adjacency_result() {
  if (!has_adjacency_) adjacency(seeds_, diagram_, buffers_.adjacency);
  has_adjacency_ = true;
  return buffers_.adjacency;
}

CellSumsResult& Analysis::sums_result() {
  if (!has_sums_) cell_sums(seeds_, diagram_, buffers_.sums);
  has_sums_ = true;
  return buffers_.sums;
}

}  // namespace vorocl::command
