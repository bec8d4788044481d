#include "app/outputs/exact_cell_files.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "app/terminal/console.hpp"
#include "formats/files.hpp"
#include "formats/polygon_files.hpp"

namespace vorocl::command {

namespace {

template <typename Offset>
Vertices vertices_of(const std::vector<Point>& vertices, const std::vector<Offset>& offsets,
                     std::size_t seed) {
  return {vertices.data() + offsets[seed], vertices.data() + offsets[seed + 1]};
}

/// Moves a seed to the image that its cell lies around; of a cell without an area to one in the period.
/// Returns by how many periods.
PeriodCounts move_to_cell(Point& seed, const ExactCell& cell, const Grid& grid) {
  const auto move = [&](const Axis& axis, double Point::*along) {
    const double length = axis.to() - axis.from();
    const double near = cell.area > 0 ? cell.centroid.*along : axis.from() + length / 2;
    const double periods = axis.is_periodic() ? std::nearbyint((near - seed.*along) / length) : 0;
    seed.*along += periods * length;
    return static_cast<std::int32_t>(periods);
  };
  PeriodCounts moved = {0, 0, move(grid.z(), &Point::z)};
  seed.x += moved[2] * grid.tilt_xz();
  seed.y += moved[2] * grid.tilt_yz();
  moved[1] = move(grid.y(), &Point::y);
  seed.x += moved[1] * grid.tilt();
  moved[0] = move(grid.x(), &Point::x);
  return moved;
}

}  // namespace

ExactCellRows::ExactCellRows(const Seeds& seeds, const ExactCellsResult& result, Input input,
                             const SeedOptions& options)
    : result_(result),
      input_(std::move(input)),
      y_up_(points_up(options) && !is_volume()),
      crs_(options.crs),
      points_(seeds.read()),
      cells_(result.read()),
      periods_(cells_.size()) {
  const Grid& grid = seeds.grid();
  for (std::size_t seed = 0; seed < cells_.size(); ++seed) {
    std::optional<Point>& point = points_[seed];
    if (point) periods_[seed] = move_to_cell(*point, cells_[seed], grid);
    const auto is_inside = [&] {
      return grid.is_volume() || (grid.x().covers(point->x) && grid.y().covers(point->y));
    };
    if (point && (cells_[seed].area > 0 || is_inside())) order_.push_back(static_cast<std::uint32_t>(seed));
  }
}

const ExactPolygons& ExactCellRows::polygons() {
  return once(polygons_, [&] { return result_.read_polygons(); });
}

const ExactPolyhedra& ExactCellRows::polyhedra() {
  return once(polyhedra_, [&] { return result_.read_polyhedra(); });
}

const std::vector<ExactPair>& ExactCellRows::pairs() {
  return once(pairs_, [&] { return result_.read_pairs(); });
}

const std::vector<ExactFace>& ExactCellRows::faces() {
  return once(faces_, [&] {
    std::vector<ExactFace> faces = result_.read_faces();
    for (ExactFace& face : faces) {  // images of the points as rows have them
      for (std::size_t axis = 0; axis < 3; ++axis)
        face.image[axis] += periods_[face.a][axis] - periods_[face.b][axis];
    }
    return faces;
  });
}

Vertices ExactCellRows::vertices(std::size_t seed) {
  return is_volume() ? vertices_of(polyhedra().vertices, polyhedra().vertex_offsets, seed)
                     : vertices_of(polygons().vertices, polygons().offsets, seed);
}

void ExactCellRows::write_polygons(const OutputFile& file) {
  std::vector<PolygonCell> cells;
  cells.reserve(order_.size());
  const KeptColumns& kept = input_.kept;
  for (const std::size_t seed : order_) {
    cells.push_back({id_of(seed),
                     *points_[seed],
                     cells_[seed].area,
                     cells_[seed].neighbours,
                     {},
                     kept.fields.empty() ? CsvFields() : kept.fields[seed]});
    if (is_volume()) continue;
    const Vertices polygon = vertices(seed);
    cells.back().polygon.assign(polygon.begin(), polygon.end());
  }
  if (is_volume()) return write_polyhedra(file, cells, order_, polyhedra(), kept.names);
  const Axis& x = input_.view.window.grid().x();
  const bool has_date_line = x.is_periodic() && x.from() == -180 && x.to() == 180;
  command::write_polygons(file, cells, {kept.names, crs_, has_date_line});
}

std::size_t ExactCellRows::empty_cells() const {
  return static_cast<std::size_t>(std::count_if(
      order_.begin(), order_.end(), [this](std::uint32_t seed) { return cells_[seed].area == 0; }));
}

std::size_t ExactCellRows::uncertified() const {
  return static_cast<std::size_t>(
      std::count_if(cells_.begin(), cells_.end(), [](const ExactCell& cell) { return !cell.certified; }));
}

double ExactCellRows::mean_area() const {
  double sum = 0;
  for (const std::size_t seed : order_) sum += cells_[seed].area;
  return order_.empty() ? 0 : sum / static_cast<double>(order_.size());
}

double ExactCellRows::area_deviation() const {
  const double mean = mean_area();
  double squares = 0;
  for (const std::size_t seed : order_) squares += (cells_[seed].area - mean) * (cells_[seed].area - mean);
  return order_.empty() ? 0 : std::sqrt(squares / static_cast<double>(order_.size()));
}

void check_polygons(const std::string& path, bool of_volume) {
  if (path.empty() || (extension_of(path) == polyhedra_extension) == of_volume) return;
  throw UsageError("--polygons " + path +
                   (of_volume ? ": cells of a volume are polyhedra, which .vtu files hold"
                              : ": .vtu files hold polyhedra, and cells of a plane are polygons"));
}

}  // namespace vorocl::command
