#include "app/outputs/exact_cell_files.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
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

/// Calls a function with whole periods of an axis and the way that they leave of one, from the shortest on
/// along both directions, as long as it returns true.
template <typename Use>
void each_image(const Axis& axis, double way, Use use) {
  if (!axis.is_periodic()) return static_cast<void>(use(0, way));
  const double length = axis.to() - axis.from(), nearest = std::nearbyint(-way / length);
  for (const double side : {1.0, -1.0}) {
    double periods = side > 0 ? nearest : nearest - 1;
    while (use(periods, way + periods * length)) periods += side;
  }
}

/// Moves a seed to the image that its cell lies around, which is the nearest one to the cell's centroid; of a
/// cell without an area to one in the period. Returns by how many periods.
PeriodCounts move_to_cell(Point& seed, const ExactCell& cell, const Grid& grid) {
  const bool has_area = cell.area > 0;
  const auto middle = [](const Axis& axis) { return axis.from() + (axis.to() - axis.from()) / 2; };
  const Point near = has_area ? cell.centroid : Point{middle(grid.x()), middle(grid.y()), middle(grid.z())};
  std::array<double, 3> periods = {};
  double least = std::numeric_limits<double>::infinity();
  each_image(grid.z(), seed.z - near.z, [&](double k, double z) {
    if (!(z * z < least)) return false;
    each_image(grid.y(), seed.y + k * grid.tilt_yz() - near.y, [&](double j, double y) {
      if (!(y * y + z * z < least)) return false;
      each_image(grid.x(), seed.x + k * grid.tilt_xz() + j * grid.tilt() - near.x, [&](double i, double x) {
        const double square = x * x + y * y + z * z;
        if (!(square < least)) return false;
        least = has_area ? square : 0;
        periods = {i, j, k};
        return true;
      });
      return true;
    });
    return true;
  });
  const auto length = [](const Axis& axis) { return axis.to() - axis.from(); };
  seed.z += periods[2] * length(grid.z());
  seed.x += periods[2] * grid.tilt_xz();
  seed.y += periods[2] * grid.tilt_yz();
  seed.y += periods[1] * length(grid.y());
  seed.x += periods[1] * grid.tilt();
  seed.x += periods[0] * length(grid.x());
  const auto whole = [&](std::size_t axis) { return static_cast<std::int32_t>(periods[axis]); };
  return {whole(0), whole(1), whole(2)};
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
