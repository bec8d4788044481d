#include "measures/measurement.hpp"
#include "runtime/buffer.hpp"
#include "vorocl/cells.hpp"

namespace vorocl {

struct CellShapesState : Measured {
  cl::Buffer boxes, distances;                         // these of 32 bits, or of 64 if they are far
  cl::Buffer home, home_boxes, other_boxes, farthest;  // while they are made: see shapes.cl

  bool is_far() const { return !empty() && of->is_far(); }
};

namespace {

constexpr std::size_t sides = 6;  // of a box: left, top, front, right, bottom, back

}  // namespace

std::size_t CellShapesResult::size() const { return state_ ? state_->size() : 0; }
const cl::Buffer& CellShapesResult::boxes() const { return buffer_of(state_, &CellShapesState::boxes); }
const cl::Buffer& CellShapesResult::largest_distances() const {
  static const cl::Buffer none;
  return state_ && state_->is_far() ? none : buffer_of(state_, &CellShapesState::distances);
}

Report cell_shapes(const Diagram& diagram, CellShapesResult& result) {
  Measuring<CellShapesState> measuring(result);
  CellShapesState& shapes = measuring.state();
  MeasuredDiagram of = cells_of(diagram);
  const cl_uint count = of.count();
  const std::size_t box = of.grid.has_voxels() ? sizeof(cl_int8) : sizeof(cl_int4);
  make_room(shapes.boxes, of.device, count * sides * sizeof(cl_int));
  make_room(shapes.distances, of.device, count * (of.is_far() ? sizeof(cl_long) : sizeof(cl_int)));
  make_room(shapes.home, of.device, count * sizeof(cl_ushort));
  make_room(shapes.home_boxes, of.device, count * box);
  make_room(shapes.other_boxes, of.device, count * box);
  make_room(shapes.farthest, of.device, count * sizeof(cl_uint));
  const char* const file = "measures/shapes.cl";
  const Blocks blocks(of.device, of.grid);
  const auto run_over_cells = [&](const char* name, const auto&... arguments) {
    return shapes.kernels.get(of.device, file, name, of.grid, of.options())
        .over_items(count, of.positions(), count, of.lattice(), of.size(), arguments...);
  };
  const cl::Event cleared = run_over_cells("clear_shapes", blocks.bits(), shapes.home, shapes.home_boxes,
                                           shapes.other_boxes, shapes.distances, shapes.farthest);
  const cl::Event added =
      blocks.run(shapes.kernels, file, "add_shapes", of.options(), diagram.labels(), of.positions(), count,
                 of.lattice(), of.size(), blocks.bits(), shapes.home, shapes.home_boxes, shapes.other_boxes,
                 shapes.distances, shapes.farthest);
  const cl::Event joined = run_over_cells("join_shapes", shapes.home_boxes, shapes.other_boxes,
                                          shapes.distances, shapes.farthest, shapes.boxes);
  return count > 0 ? measuring.commit(std::move(of), cleared, joined)
                   : measuring.commit(std::move(of), added, added);
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
  const auto boxes = download<cl_int>(of.device, state_->boxes, size() * sides);
  const auto distances = largest_distances_on_host(*state_);
  std::vector<CellShape> cells;
  cells.reserve(size());
  for (std::size_t id = 0; id < size(); ++id) {
    const cl_int* const box = boxes.data() + id * sides;
    CellShape cell = {box[0], box[1], box[3], box[4], distances[id], false, box[2], box[5]};
    cell.touches_border = touches_border(cell, grid);
    cells.push_back(cell);
  }
  return cells;
}

}  // namespace vorocl
