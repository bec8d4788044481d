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
  MeasuredDiagram of = cells_of(diagram);
  const cl_uint count = of.count();
  cl::Buffer& words = of.is_far() ? shapes.upper_words : shapes.distances;
  make_room(shapes.boxes, of.device, count * sizeof(cl_int4));
  make_room(words, of.device, count * sizeof(cl_int));
  const char* const file = "measures/shapes.cl";
  const cl::Event first = shapes.kernels.get(of.device, file, "clear_shapes", of.grid, of.options())
                              .over_items(count, count, shapes.boxes, words);
  const Blocks blocks(of.device, of.grid);
  const auto run = [&](const char* name, const cl::Buffer& one, const cl::Buffer& other) {
    return blocks.run(shapes.kernels, file, name, of.options(), diagram.labels(), of.positions(), count,
                      of.periods(), of.grid.width(), of.grid.height(), blocks.wide(), blocks.high(), one,
                      other);
  };
  cl::Event last = run("add_shapes", shapes.boxes, words);
  if (of.seeds->may_lack_some() && count > 0) {
    last = shapes.kernels.get(of.device, file, "clear_absent", of.grid, of.options())
               .over_items(count, of.positions(), count, shapes.boxes, words);
  }
  if (of.is_far()) {
    make_room(shapes.lower_words, of.device, count * sizeof(cl_uint));
    if (count > 0) fill(of.device, shapes.lower_words, cl_uint{0}, count);
    last = run("add_lower_words", shapes.upper_words, shapes.lower_words);
  }
  return measuring.commit(std::move(of), count > 0 ? first : last, last);
}

namespace {

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
  const auto boxes = download<cl_int4>(of.device, state_->boxes, size());
  const auto distances = largest_distances_on_host(*state_);
  const PixelGrid& grid = of.grid;
  std::vector<CellShape> cells;
  cells.reserve(size());
  for (std::size_t id = 0; id < size(); ++id) {
    const int left = boxes[id].s[0], top = boxes[id].s[1], right = boxes[id].s[2], bottom = boxes[id].s[3];
    const bool touches = (!grid.periodic_x() && (left == 0 || right == grid.width() - 1)) ||
                         (!grid.periodic_y() && (top == 0 || bottom == grid.height() - 1));
    cells.push_back({left, top, right, bottom, distances[id], touches});
  }
  return cells;
}

}  // namespace vorocl
