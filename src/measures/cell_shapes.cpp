#include "measures/measurement.hpp"
#include "runtime/buffer.hpp"
#include "vorocl/cells.hpp"

namespace vorocl {

struct CellShapesState : Measured {
  cl::Buffer boxes;
  cl::Buffer distances;                 // of 32 bits ...
  cl::Buffer upper_words, lower_words;  // ... or of more: see shapes.cl

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

Report cell_shapes(const Diagram& diagram, CellShapesResult& result) {
  Measuring<CellShapesState> measuring(result);
  CellShapesState& shapes = measuring.state();
  MeasuredDiagram of = cells_of(diagram, Volumes::taken);
  const cl_uint count = of.count();
  const bool is_volume = of.grid.is_volume();
  cl::Buffer& words = of.is_far() ? shapes.upper_words : shapes.distances;
  make_room(shapes.boxes, of.device, count * sides_of_box(of.grid) * sizeof(cl_int));
  make_room(words, of.device, count * sizeof(cl_int));
  const char* const file = is_volume ? "volumes/shapes.cl" : "measures/shapes.cl";
  const cl::Event first = shapes.kernels.get(of.device, file, "clear_shapes", of.grid, of.options())
                              .over_items(count, count, shapes.boxes, words);
  const Blocks blocks(of.device, of.grid);
  const int width = of.grid.width(), height = of.grid.height();
  const auto run = [&](const char* name, const auto&... arguments) {
    return blocks.run(shapes.kernels, file, name, of.options(), diagram.labels(), of.positions(), count,
                      arguments...);
  };
  cl::Event last = is_volume ? run("add_shapes", width, height, static_cast<cl_int>(of.grid.rows()),
                                   blocks.wide(), blocks.high(), shapes.boxes, words)
                             : run("add_shapes", of.periods(), width, height, blocks.wide(), blocks.high(),
                                   shapes.boxes, words);
  if (of.seeds->may_lack_some() && count > 0) {
    last = shapes.kernels.get(of.device, file, "clear_absent", of.grid, of.options())
               .over_items(count, of.positions(), count, shapes.boxes, words);
  }
  if (of.is_far()) {
    make_room(shapes.lower_words, of.device, count * sizeof(cl_uint));
    if (count > 0) fill(of.device, shapes.lower_words, cl_uint{0}, count);
    last = run("add_lower_words", of.periods(), width, height, blocks.wide(), blocks.high(),
               shapes.upper_words, shapes.lower_words);
  }
  return measuring.commit(std::move(of), count > 0 ? first : last, last);
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
  const auto upper = download<cl_int>(device, shapes.upper_words, shapes.size());
  const auto lower = download<cl_uint>(device, shapes.lower_words, shapes.size());
  std::vector<double> distances;
  distances.reserve(upper.size());
  for (std::size_t id = 0; id < upper.size(); ++id) {
    const auto distance = static_cast<double>(std::int64_t{upper[id]} << 32 | lower[id]);
    distances.push_back(upper[id] < 0 ? -1 : shapes.of->in_pixels(distance));
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
