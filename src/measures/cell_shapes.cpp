#include "measures/measurement.hpp"
#include "runtime/buffer.hpp"
#include "vorocl/cells.hpp"

namespace vorocl {

struct CellShapesState : Measured {
  cl::Buffer boxes, distances;             // these of 32 bits, or of 64 if they are far
  cl::Buffer home, other_boxes, farthest;  // while the shapes of a plane are made: see shapes.cl

  bool is_far() const { return !empty() && of->is_far(); }
};

namespace {

/// Left, top, right, bottom; in a volume left, top, front, right, bottom, back.
std::size_t sides_of_box(const PixelGrid& grid) { return grid.is_volume() ? 6 : 4; }

}  // namespace

CellShapesResult::CellShapesResult() = default;
CellShapesResult::~CellShapesResult() = default;
CellShapesResult::CellShapesResult(CellShapesResult&& other) noexcept = default;
CellShapesResult& CellShapesResult::operator=(CellShapesResult&& other) noexcept = default;
std::size_t CellShapesResult::size() const { return state_ ? state_->size() : 0; }
const cl::Buffer& CellShapesResult::boxes() const { return buffer_of(state_, &CellShapesState::boxes); }
const cl::Buffer& CellShapesResult::largest_distances() const {
  static const cl::Buffer none;
  return state_ && state_->is_far() ? none : buffer_of(state_, &CellShapesState::distances);
}

namespace {

/// The first command and the last one.
using Enqueued = std::pair<cl::Event, cl::Event>;

Enqueued find_in_volume(CellShapesState& shapes, const MeasuredDiagram& of, const cl::Buffer& labels) {
  const cl_uint count = of.count();
  const char* const file = "volumes/shapes.cl";
  const auto run_over_cells = [&](const char* name, const auto&... arguments) {
    return shapes.kernels.get(of.device, file, name, of.grid, of.options())
        .over_items(count, arguments..., count, shapes.boxes, shapes.distances);
  };
  const cl::Event first = run_over_cells("clear_shapes");
  const Blocks blocks(of.device, of.grid);
  cl::Event last = blocks.run(shapes.kernels, file, "add_shapes", of.options(), labels, of.positions(), count,
                              of.grid.width(), of.grid.height(), static_cast<cl_int>(of.grid.rows()),
                              blocks.wide(), blocks.high(), shapes.boxes, shapes.distances);
  if (of.seeds->may_lack_some() && count > 0) last = run_over_cells("clear_absent", of.positions());
  return {count > 0 ? first : last, last};
}

Enqueued find_in_plane(CellShapesState& shapes, const MeasuredDiagram& of, const cl::Buffer& labels) {
  const cl_uint count = of.count();
  make_room(shapes.home, of.device, count * sizeof(cl_ushort));
  make_room(shapes.other_boxes, of.device, count * sizeof(cl_int4));
  make_room(shapes.farthest, of.device, count * sizeof(cl_uint));
  const char* const file = "measures/shapes.cl";
  const Blocks blocks(of.device, of.grid);
  const int width = of.grid.width(), height = of.grid.height(), wide = blocks.wide(), high = blocks.high();
  const auto run_over_cells = [&](const char* name, const auto&... arguments) {
    return shapes.kernels.get(of.device, file, name, of.grid, of.options())
        .over_items(count, of.positions(), count, of.periods(), width, height, arguments..., shapes.boxes,
                    shapes.distances, shapes.other_boxes, shapes.farthest);
  };
  const cl::Event first = run_over_cells("clear_shapes", wide, high, shapes.home);
  const cl::Event added = blocks.run(shapes.kernels, file, "add_shapes", of.options(), labels, of.positions(),
                                     count, of.periods(), width, height, wide, high, shapes.home,
                                     shapes.boxes, shapes.distances, shapes.other_boxes, shapes.farthest);
  const cl::Event last = run_over_cells("join_shapes");
  return count > 0 ? Enqueued(first, last) : Enqueued(added, added);
}

}  // namespace

Report cell_shapes(const Diagram& diagram, CellShapesResult& result) {
  Measuring<CellShapesState> measuring(result);
  CellShapesState& shapes = measuring.state();
  MeasuredDiagram of = cells_of(diagram, Volumes::taken);
  const cl_uint count = of.count();
  make_room(shapes.boxes, of.device, count * sides_of_box(of.grid) * sizeof(cl_int));
  make_room(shapes.distances, of.device, count * (of.is_far() ? sizeof(cl_long) : sizeof(cl_int)));
  const auto [first, last] = of.grid.is_volume() ? find_in_volume(shapes, of, diagram.labels())
                                                 : find_in_plane(shapes, of, diagram.labels());
  return measuring.commit(std::move(of), first, last);
}

namespace {

bool touches_border(const CellShape& cell, const PixelGrid& grid) {
  return (!grid.periodic_x() && (cell.left == 0 || cell.right == grid.width() - 1)) ||
         (!grid.periodic_y() && (cell.top == 0 || cell.bottom == grid.height() - 1)) ||
         (grid.depth() > 1 && !grid.periodic_z() && (cell.front == 0 || cell.back == grid.depth() - 1));
}

/// Those of empty cells are negative.
std::vector<double> largest_distances_on_host(const CellShapesState& shapes) {
  const Device& device = shapes.of->device;
  if (!shapes.is_far()) {
    const auto distances = download<cl_int>(device, shapes.distances, shapes.size());
    return {distances.begin(), distances.end()};
  }
  std::vector<double> distances;
  distances.reserve(shapes.size());
  for (const cl_long distance : download<cl_long>(device, shapes.distances, shapes.size())) {
    distances.push_back(distance < 0 ? -1 : shapes.of->in_pixels(static_cast<double>(distance)));
  }
  return distances;
}

}  // namespace

std::vector<CellShape> CellShapesResult::read() const {
  if (size() == 0) return {};
  const MeasuredDiagram& of = *state_->of;
  of.check();
  const PixelGrid& grid = of.grid;
  const std::size_t sides = sides_of_box(grid), axes = sides / 2;
  const auto boxes = download<cl_int>(of.device, state_->boxes, size() * sides);
  const auto distances = largest_distances_on_host(*state_);
  std::vector<CellShape> cells;
  cells.reserve(size());
  for (std::size_t id = 0; id < size(); ++id) {
    const cl_int *const first = boxes.data() + id * sides, *const last = first + axes;
    CellShape cell = {first[0], first[1], last[0], last[1], distances[id], false};
    if (grid.is_volume()) {
      cell.front = first[2];
      cell.back = last[2];
    }
    cell.touches_border = touches_border(cell, grid);
    cells.push_back(cell);
  }
  return cells;
}

}  // namespace vorocl
