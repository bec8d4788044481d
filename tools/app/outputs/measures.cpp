#include "app/outputs/measures.hpp"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <tuple>

#include "app/sources/bounds.hpp"
#include "app/terminal/console.hpp"
#include "formats/values.hpp"

namespace vorocl::command {

Diagram MeasureBuffers::diagram_to_read(const Device& device, const Window& window) {
  labels.resize(window.pixels());
  return {device, window, labels.data()};
}

Measures::Measures(const Seeds& seeds, const Diagram& diagram, const std::vector<std::uint32_t>& ids,
                   const View& view, MeasureBuffers& buffers)
    : seeds_(seeds), diagram_(diagram), ids_(ids), view_(view), buffers_(buffers) {}

const std::vector<std::uint32_t>& Measures::labels() {
  if (!has_labels_) {
    buffers_.labels.resize(view_.size().pixels());
    diagram_.read(buffers_.labels.data());
  }
  has_labels_ = true;
  return buffers_.labels;
}

const std::vector<std::uint32_t>& Measures::labels_by_id() {
  if (ids_.empty()) return labels();
  if (!has_ids_) {
    buffers_.ids.resize(labels().size());
    std::transform(labels().begin(), labels().end(), buffers_.ids.begin(),
                   [this](std::uint32_t label) { return label == no_label ? no_label : id_of(label); });
  }
  has_ids_ = true;
  return buffers_.ids;
}

const std::vector<std::uint32_t>& Measures::labels_in_picture() {
  if (ids_in_picture_ == nullptr) {
    ids_in_picture_ = &view_.in_picture(labels_by_id(), no_label, buffers_.ids_in_picture);
  }
  return *ids_in_picture_;
}

const std::vector<std::optional<Point>>& Measures::seeds() {
  if (points_) return *points_;
  points_ = seeds_.read_pixels();
  for (std::optional<Point>& point : *points_) {
    if (point) point = view_.from_grid(*point);
  }
  return *points_;
}

std::vector<double> Measures::areas() {
  std::vector<double> areas;
  for (const CellSums& sums : sums_result().read()) areas.push_back(view_.units.area(sums.area));
  return areas;
}

std::vector<double> Measures::neighbours() {
  const std::vector<std::uint32_t> counts = adjacency_result().read_neighbours();
  return {counts.begin(), counts.end()};
}

std::vector<CellMeasures> Measures::cells() {
  cell_shapes(diagram_, buffers_.shapes);
  const std::vector<CellSums> sums = sums_result().read();
  const std::vector<CellShape> shapes = buffers_.shapes.read();
  const std::vector<std::uint32_t> neighbours = adjacency_result().read_neighbours();
  const std::vector<std::uint32_t> perimeters = adjacency_result().read_perimeters();
  std::vector<CellMeasures> cells;
  cells.reserve(seeds_.alive());
  for (std::size_t label = 0; label < seeds_.size(); ++label) {
    const std::optional<Point>& seed = seeds()[label];
    if (!seed || (sums[label].area == 0 && !view_.size().holds(*seed))) continue;
    cells.push_back({id_of(label), *seed, sums[label], shapes[label], neighbours[label], perimeters[label]});
  }
  std::sort(cells.begin(), cells.end(),
            [](const CellMeasures& a, const CellMeasures& b) { return a.id < b.id; });
  return cells;
}

std::vector<CellPair> Measures::pairs() {
  std::vector<CellPair> pairs = adjacency_result().read_pairs();
  if (ids_.empty()) return pairs;
  for (CellPair& pair : pairs) {
    std::tie(pair.a, pair.b) = std::minmax({id_of(pair.a), id_of(pair.b)});
  }
  std::sort(pairs.begin(), pairs.end(),
            [](const CellPair& p, const CellPair& q) { return std::tie(p.a, p.b) < std::tie(q.a, q.b); });
  return pairs;
}

std::size_t Measures::pair_count() { return adjacency_result().pairs(); }

std::size_t Measures::vertices() {
  vorocl::vertices(diagram_, buffers_.vertices);
  return buffers_.vertices.count();
}

CellStatistics Measures::statistics() {
  has_sums_ ? cell_statistics(buffers_.sums, buffers_.statistics)
            : cell_statistics(diagram_, buffers_.statistics);
  CellStatistics statistics = buffers_.statistics.read();
  statistics.mean_area = view_.units.area(statistics.mean_area);
  statistics.area_deviation = view_.units.area(statistics.area_deviation);
  return statistics;
}

CellCount Measures::cell_count() {
  constexpr std::size_t few_pixels = std::size_t{1} << 24;  // to copy to the host for this alone
  const bool is_copied = has_labels_ || diagram_.window().pixels() <= few_pixels;
  if (!diagram_.window().is_whole() || seeds_.outside() > 0 || !is_copied) {
    const CellStatistics of_window = statistics();
    return {of_window.cells, of_window.empty_cells};
  }
  std::vector<bool> has_pixels(seeds_.size());
  std::size_t count = 0;
  std::uint32_t last = no_label;
  for (const std::uint32_t label : labels()) {
    if (label == last) continue;
    last = label;
    if (label == no_label || has_pixels.at(label)) continue;
    has_pixels[label] = true;
    ++count;
  }
  return {seeds_.alive(), seeds_.alive() - count};
}

const std::vector<float>& Measures::distances() {
  if (!has_distances_) {
    distance_field(diagram_, buffers_.distances);
    buffers_.distances_on_host.resize(view_.size().pixels());
    buffers_.distances.read(buffers_.distances_on_host.data());
  }
  has_distances_ = true;
  return buffers_.distances_on_host;
}

std::vector<std::uint8_t> Measures::borders() {
  border_mask(diagram_, buffers_.borders);
  return buffers_.borders.read();
}

std::uint32_t Measures::id_of(std::size_t label) const {
  return ids_.empty() ? static_cast<std::uint32_t>(label) : ids_.at(label);
}

const AdjacencyResult& Measures::adjacency_result() {
  if (!has_adjacency_) adjacency(diagram_, buffers_.adjacency);
  has_adjacency_ = true;
  return buffers_.adjacency;
}

CellSumsResult& Measures::sums_result() {
  if (!has_sums_) cell_sums(diagram_, buffers_.sums);
  has_sums_ = true;
  return buffers_.sums;
}

Json json_of_diagram(const Method& method, Metric metric, const Seeds& seeds, const View& view) {
  return {{"method", method.name},
          {"metric", to_string(metric)},
          {"device", seeds.device().name()},
          {"width", view.picture.size.width()},
          {"height", view.picture.size.height()},
          {"periodic", to_string(seeds.grid().periodic())},
          {"area_unit", view.units.of_area()},
          {"length_unit", view.units.of_length()}};
}

}  // namespace vorocl::command
