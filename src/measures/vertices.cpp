#include "measures/measurement.hpp"
#include "runtime/buffer.hpp"
#include "vorocl/adjacency.hpp"

namespace vorocl {

namespace {

constexpr int word_bits = 32;  // WORD_BITS of vertices.cl
constexpr int words_per_item = 32;

/// The corners between pixels, in rows of words, one bit each.
struct Corners {
  explicit Corners(const PixelGrid& grid)
      : columns(grid.width() == 1   ? 0
                : grid.periodic_x() ? grid.width()
                                    : grid.width() - 1),
        rows(grid.height() == 1  ? 0
             : grid.periodic_y() ? grid.height()
                                 : grid.height() - 1) {}

  int columns, rows;  // one pixel has no corner between it and itself

  bool none() const { return columns == 0 || rows == 0; }
  int words_of_row() const { return (columns - 1) / word_bits + 1; }
  std::size_t words() const {
    return static_cast<std::size_t>(words_of_row()) * static_cast<std::size_t>(rows);
  }
  std::size_t items() const {
    const int across = (words_of_row() - 1) / words_per_item + 1;
    return static_cast<std::size_t>(across) * static_cast<std::size_t>(rows);
  }
};

}  // namespace

struct VerticesState : Measured {
  cl::Buffer words, count;
};

VerticesResult::VerticesResult() = default;
VerticesResult::~VerticesResult() = default;
VerticesResult::VerticesResult(VerticesResult&& other) noexcept = default;
VerticesResult& VerticesResult::operator=(VerticesResult&& other) noexcept = default;

Report vertices(const Diagram& diagram, VerticesResult& result) {
  Measuring<VerticesState> measuring(result);
  VerticesState& found = measuring.state();
  MeasuredDiagram of = labels_of(diagram);
  make_room(found.count, of.device, sizeof(cl_uint));
  const cl::Event first = fill(of.device, found.count, cl_uint{0}, 1);
  cl::Event last = first;
  const Corners corners(of.grid);
  if (!corners.none()) {
    make_room(found.words, of.device, corners.words() * sizeof(cl_uint));
    last = found.kernels.get(of.device, "measures/vertices.cl", "find_vertices", of.grid)
               .over_items(corners.items(), diagram.labels(), of.grid.width(), of.grid.height(),
                           cl_int{words_per_item}, found.words, found.count);
  }
  return measuring.commit(std::move(of), first, last);
}

std::size_t VerticesResult::count() const {
  if (!state_ || state_->empty()) return 0;
  state_->of->check();
  return download<cl_uint>(state_->of->device, state_->count, 1).front();
}

std::vector<Point> VerticesResult::read() const {
  std::vector<Point> points;
  const std::size_t number = count();
  if (number == 0) return points;
  points.reserve(number);
  const Corners corners(state_->of->grid);
  const int words_of_row = corners.words_of_row();
  int x = 0, y = 0;  // of a word's first corner
  for (std::uint32_t word : download<std::uint32_t>(state_->of->device, state_->words, corners.words())) {
    for (int bit = 0; word != 0; ++bit, word >>= 1) {
      if ((word & 1) != 0) points.push_back({x + bit + 1.0, y + 1.0});
    }
    x += word_bits;
    if (x == words_of_row * word_bits) x = 0, ++y;
  }
  return points;
}

}  // namespace vorocl
