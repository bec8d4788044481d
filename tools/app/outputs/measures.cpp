#include "app/outputs/measures.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <tuple>
#include <utility>

#include "app/outputs/exact_cell_files.hpp"
#include "app/sources/bounds.hpp"
#include "app/terminal/console.hpp"
#include "formats/id_order.hpp"
#include "formats/values.hpp"

namespace vorocl::command {

namespace {

/// By the id of each; those of one id stay in their order.
template <typename T, typename IdOf>
std::vector<T> in_order(const std::vector<T>& items, const IdOf& id_of_item) {
  std::vector<IdAndRow> rows, spare;
  rows.reserve(items.size());
  for (const T& item : items) rows.push_back(id_and_row(id_of_item(item), rows.size()));
  sort_by_id(rows, spare);
  std::vector<T> sorted;
  sorted.reserve(items.size());
  for (const IdAndRow row : rows) sorted.push_back(items[row_of(row)]);
  return sorted;
}

}  // namespace

Diagram MeasureBuffers::diagram_to_read(const Device& device, const Window& window) {
  std::vector<std::uint32_t>& labels = images[taken % images.size()].labels;
  labels.resize(window.pixels());
  return {device, window, labels.data()};
}

Measures::Measures(const Seeds& seeds, const Diagram& diagram, const std::vector<std::uint32_t>& ids,
                   const View& view, MeasureBuffers& buffers)
    : seeds_(&seeds),
      diagram_(&diagram),
      metric_(diagram.metric()),
      ids_(ids),
      view_(view),
      buffers_(buffers),
      images_(buffers.take_images()) {}

Measures::Measures(const View& view, std::vector<std::uint32_t> labels,
                   std::vector<std::optional<Point>> seeds, const std::vector<std::uint32_t>& ids,
                   MeasureBuffers& buffers)
    : seeds_(nullptr),
      diagram_(nullptr),
      metric_(Metric::euclidean),
      ids_(ids),
      view_(view),
      buffers_(buffers),
      images_(buffers.take_images()),
      has_labels_(true),
      points_(std::move(seeds)) {
  images_.labels = std::move(labels);
}

Measures::Measures(std::shared_ptr<ExactCellRows> exact, MeasureBuffers& buffers)
    : exact_(std::move(exact)),
      seeds_(nullptr),
      diagram_(nullptr),
      metric_(Metric::euclidean),
      ids_(exact_->input().ids),
      view_(exact_->input().view),
      buffers_(buffers),
      images_(buffers.take_images()) {
  view_.units = {};  // the data's, which tables need not name
  if (!exact_->input().kept.names.empty()) keep(exact_->input().kept);
}

void Measures::leave_device() {
  seeds_ = nullptr;
  diagram_ = nullptr;
}

const Diagram& Measures::diagram() const {
  if (diagram_ == nullptr) throw std::logic_error("a measure of a frame was not read in time");
  return *diagram_;
}

const std::vector<std::uint32_t>& Measures::labels() {
  if (!has_labels_) {
    images_.labels.resize(view_.window.pixels());
    diagram().read(images_.labels.data());
  }
  has_labels_ = true;
  return images_.labels;
}

const std::vector<float>& Measures::distances() {
  if (!has_distances_) {
    distance_field(diagram(), buffers_.distances);
    images_.distances.resize(view_.window.pixels());
    buffers_.distances.read(images_.distances.data());
  }
  has_distances_ = true;
  return images_.distances;
}

const std::vector<std::uint8_t>& Measures::borders() {
  return once(borders_, [&] {
    border_mask(diagram(), buffers_.borders);
    return buffers_.borders.read();
  });
}

const std::vector<std::optional<Point>>& Measures::seeds() {
  return once(points_, [&] {
    diagram();
    std::vector<std::optional<Point>> points = seeds_->read_pixels();
    for (std::optional<Point>& point : points) {
      if (point) point = view_.from_grid(*point);
    }
    return points;
  });
}

const std::vector<std::uint32_t>& Measures::pixels() {
  return once(pixels_, [&] {
    if (!sums_) return statistics_result().read_areas();
    std::vector<std::uint32_t> pixels;
    pixels.reserve(sums_->size());
    for (const CellSums& sums : *sums_) pixels.push_back(sums.area);
    return pixels;
  });
}

const std::vector<CellSums>& Measures::sums() {
  return once(sums_, [&] { return sums_result().read(); });
}

const std::vector<CellShape>& Measures::shapes() {
  return once(shapes_, [&] {
    cell_shapes(diagram(), buffers_.shapes);
    return buffers_.shapes.read();
  });
}

const std::vector<std::uint32_t>& Measures::neighbours() {
  return once(neighbours_, [&] { return adjacency_result().read_neighbours(); });
}

const std::vector<std::uint32_t>& Measures::perimeters() {
  return once(perimeters_, [&] { return adjacency_result().read_perimeters(); });
}

const std::vector<CellPair>& Measures::pairs() {
  return once(pairs_, [&] { return adjacency_result().read_pairs(); });
}

std::size_t Measures::pair_count() { return adjacency_result().pairs(); }

std::size_t Measures::vertices() {
  vorocl::vertices(diagram(), buffers_.vertices);
  return buffers_.vertices.count();
}

const std::vector<vorocl::CellRow>& Measures::on_globe() {
  return once(on_globe_, [&] {
    std::vector<vorocl::CellRow> cells(pixels().size());
    for (const vorocl::CellRow& cell : cell_table(diagram())) cells[cell.id] = cell;
    return cells;
  });
}

const CellStatistics& Measures::statistics() {
  return once(statistics_, [&] {
    CellStatistics statistics = statistics_result().read();
    if (is_on_globe()) {
      double sum = 0, squares = 0;
      for (const double area : areas()) {
        sum += area;
        squares += area * area;
      }
      const auto cells = static_cast<double>(std::max<std::size_t>(statistics.cells, 1));
      statistics.mean_area = sum / cells;
      statistics.area_deviation =
          std::sqrt(std::max(squares / cells - statistics.mean_area * statistics.mean_area, 0.0));
      return statistics;
    }
    statistics.mean_area = view_.units.area(statistics.mean_area);
    statistics.area_deviation = view_.units.area(statistics.area_deviation);
    return statistics;
  });
}

CellCount Measures::cell_count() {
  constexpr std::size_t few_pixels = std::size_t{1} << 24;  // to copy to the host for this alone
  const bool is_copied = has_labels_ || diagram().window().pixels() <= few_pixels;
  if (!diagram().window().is_whole() || seeds_->outside() > 0 || !is_copied) {
    return {statistics().cells, statistics().empty_cells};
  }
  // To mark a cell for each pixel takes less time than to ask whether the pixel is one of the last one's
  // cell, which no processor foresees.
  const auto none = static_cast<std::uint32_t>(seeds_->size());
  std::vector<std::uint8_t> has_pixels(seeds_->size() + 1);
  for (const std::uint32_t label : labels()) has_pixels[std::min(label, none)] = 1;
  const auto count = static_cast<std::size_t>(std::count(has_pixels.begin(), has_pixels.end() - 1, 1));
  return {seeds_->alive(), seeds_->alive() - count};
}

const std::vector<std::uint32_t>& Measures::labels_by_id() {
  if (ids_.empty()) return labels();
  if (!has_ids_) {
    images_.ids.resize(labels().size());
    std::transform(labels().begin(), labels().end(), images_.ids.begin(),
                   [this](std::uint32_t label) { return label == no_label ? no_label : id_of(label); });
  }
  has_ids_ = true;
  return images_.ids;
}

const std::vector<std::uint32_t>& Measures::labels_in_picture() {
  if (ids_in_picture_ == nullptr) {
    ids_in_picture_ = &view_.in_picture(labels_by_id(), no_label, images_.ids_in_picture);
  }
  return *ids_in_picture_;
}

std::vector<double> Measures::areas() {
  std::vector<double> areas;
  areas.reserve(pixels().size());
  if (is_on_globe()) {
    for (const vorocl::CellRow& cell : on_globe()) areas.push_back(cell.area);
    return areas;
  }
  for (const std::uint32_t pixels_of_cell : pixels()) areas.push_back(view_.units.area(pixels_of_cell));
  return areas;
}

std::vector<std::uint32_t> Measures::cells() {
  if (exact_) return exact_->order();
  const auto is_inside = [this, size = view_.size()](std::size_t label) {
    const std::optional<Point>& seed = seeds()[label];
    return seed && size.holds(*seed);
  };
  std::vector<std::uint32_t> cells;
  cells.reserve(pixels().size());
  for (std::size_t label = 0; label < pixels().size(); ++label) {
    if (pixels()[label] > 0 || is_inside(label)) cells.push_back(static_cast<std::uint32_t>(label));
  }
  if (ids_.empty()) return cells;
  return in_order(cells, [this](std::uint32_t label) { return id_of(label); });
}

std::vector<CellPair> Measures::pairs_by_id() {
  std::vector<CellPair> pairs = this->pairs();
  if (ids_.empty()) return pairs;
  for (CellPair& pair : pairs) {
    std::tie(pair.a, pair.b) = std::minmax({id_of(pair.a), id_of(pair.b)});
  }
  return in_order(in_order(pairs, [](const CellPair& pair) { return pair.b; }),
                  [](const CellPair& pair) { return pair.a; });
}

CellSumsResult& Measures::sums_result() {
  if (!has_sums_) cell_sums(diagram(), buffers_.sums);
  has_sums_ = true;
  return buffers_.sums;
}

const CellStatisticsResult& Measures::statistics_result() {
  if (!has_statistics_) {
    has_sums_ ? cell_statistics(buffers_.sums, buffers_.statistics)
              : cell_statistics(diagram(), buffers_.statistics);
  }
  has_statistics_ = true;
  return buffers_.statistics;
}

const AdjacencyResult& Measures::adjacency_result() {
  if (!has_adjacency_) adjacency(diagram(), buffers_.adjacency);
  has_adjacency_ = true;
  return buffers_.adjacency;
}

void check_max_distance(const std::optional<double>& distance, const View& view) {
  if (!distance || !view.units.lengths_stay_in_pixels()) return;
  throw UsageError(
      "--max-distance: pixels are no squares, voxels no cubes, in data units, so distances are in pixels; "
      "say --units px if D is, or give a --size of the shape of the bounds");
}

std::optional<std::size_t> leave_out_beyond(std::optional<double> distance, const Seeds& seeds,
                                            const View& view, Diagram& diagram) {
  if (!distance) return std::nullopt;
  Field<float> field;
  distance_field(diagram, field);
  const std::vector<float> distances = view.units.lengths(field.read());
  const double most = *distance * (1 + 1e-6);  // a float's rounding leaves out no pixel
  std::vector<std::uint32_t> labels = diagram.read();
  std::size_t beyond = 0;
  for (std::size_t i = 0; i < labels.size(); ++i) {
    if (labels[i] == no_label || !(static_cast<double>(distances[i]) > most)) continue;
    labels[i] = no_label;
    ++beyond;
  }
  diagram.write(labels, seeds, diagram.metric());
  return beyond;
}

Json json_of_grid(Metric metric, const Seeds& seeds, std::int64_t width, std::int64_t height) {
  const Grid& grid = seeds.grid();
  Json json = {
      {"metric", to_string(metric)}, {"device", seeds.device().name()}, {"width", width}, {"height", height}};
  if (grid.is_volume()) json["depth"] = grid.depth();
  if (grid.is_spaced()) json["spacing"] = {grid.x().spacing(), grid.y().spacing(), grid.z().spacing()};
  json["periodic"] = to_string(grid.periodic());
  return json;
}

Json json_of_diagram(const Method& method, Metric metric, const Seeds& seeds, const View& view) {
  const Size& size = view.picture.size;
  Json json = {{"method", method.name}};
  json.update(json_of_grid(metric, seeds, size.width(), size.height()));
  json.update(Json{{seeds.grid().is_volume() ? "volume_unit" : "area_unit", view.units.of_area()},
                   {"length_unit", view.units.of_length()}});
  return json;
}

void print_beyond(const std::optional<std::size_t>& beyond, const View& view) {
  if (beyond)
    print("{} farther than --max-distance, without a label\n", counted(*beyond, name_of_pixel(view)));
}

const char* name_of_pixel(const View& view) { return view.is_volume() ? "voxel" : "pixel"; }

const char* unit_of_distances(const Grid& grid) {
  return grid.is_spaced() ? "units of the spacing" : grid.is_volume() ? "voxels" : "pixels";
}

std::string size_text(const View& view) {
  const Size& size = view.picture.size;
  const Grid sides(size.width(), size.height(), view.picture.depth);
  return fmt::format("{} {}s", sides_of(sides), name_of_pixel(view));
}

void print_diagram(const Method& method, const Seeds& seeds, const View& view, const Report& report) {
  print("{}: {} on {} in {:.1f} ms, {}, on {}\n", method.name, counted(seeds.alive(), "seed"),
        size_text(view), report.milliseconds(), counted(report.waves(), "wave"), seeds.device().name());
}

}  // namespace vorocl::command
