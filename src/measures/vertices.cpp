#include <algorithm>

#include "measures/measurement.hpp"
#include "runtime/buffer.hpp"
#include "vorocl/adjacency.hpp"

namespace vorocl {

namespace {

constexpr int vectors_of_chunk = 32;  // VECTORS_OF_CHUNK of vertices.cl
constexpr int corners_of_item = 1024;

/// The corners between pixels, row by row, as vertices.cl marks them for a vector width.
struct Corners {
  Corners(const MeasuredDiagram& diagram, int vector_width)
      : width(vector_width),
        columns(along(diagram.grid.width(), diagram.grid.periodic_x())),
        rows(along(diagram.grid.height(), diagram.grid.periodic_y(), diagram.shifts_in_pixels().s[0])) {}

  int width;  // words of a chunk
  int columns, rows;

  bool none() const { return columns == 0 || rows == 0; }
  int chunk() const { return vectors_of_chunk * width; }
  int chunks_of_row() const { return (columns - 1) / chunk() + 1; }
  int chunks_of_item() const { return std::max(corners_of_item / chunk(), 1); }
  std::size_t words() const { return of_rows(chunks_of_row() * width); }
  std::size_t items() const { return of_rows((chunks_of_row() - 1) / chunks_of_item() + 1); }

  /// Calls a function with the column and row of each vertex, in row-major order.
  template <typename Use>
  void each_vertex(const std::vector<std::uint32_t>& marks, Use use) const {
    const std::uint32_t* words = marks.data();
    for (int y = 0; y < rows; ++y) {
      for (int first = 0; first < columns; first += chunk(), words += width) {
        if (std::all_of(words, words + width, [](std::uint32_t word) { return word == 0; })) continue;
        for (int i = 0; i < chunk(); ++i) {
          if ((words[i % width] >> i / width & 1) != 0) use(first + i, y);
        }
      }
    }
  }

 private:
  /// One pixel has no corner between it and itself, unless the next one is shifted.
  static int along(int pixels, bool periodic, int shift = 0) {
    return periodic && (pixels > 1 || shift != 0) ? pixels : pixels - 1;
  }

  std::size_t of_rows(int of_one) const {
    return static_cast<std::size_t>(of_one) * static_cast<std::size_t>(rows);
  }
};

}  // namespace

struct VerticesState : Measured {
  cl::Buffer words, count, behind;  // see vertices.cl
  int vector_width = 1;             // that it was built for
};

Report vertices(const Diagram& diagram, VerticesResult& result) {
  Measuring<VerticesState> measuring(result);
  VerticesState& found = measuring.state();
  refuse_volume(diagram.window().grid(), "the vertices of a diagram");
  MeasuredDiagram of = labels_of(diagram);
  make_room(found.count, of.device, sizeof(cl_uint));
  const cl::Event first = fill(of.device, found.count, cl_uint{0}, 1);
  cl::Event last = first;
  Kernel& kernel = found.kernels.get(of.device, "measures/vertices.cl", "find_vertices", of.grid);
  found.vector_width = static_cast<int>(kernel.vector_width());
  const Corners corners(of, found.vector_width);
  if (!corners.none()) {
    make_room(found.words, of.device, corners.words() * sizeof(cl_uint));
    last = kernel.over_items(corners.items(), diagram.labels(),
                             rows_behind(of, found.kernels, diagram.labels(), found.behind), of.grid.width(),
                             of.grid.height(), corners.chunks_of_item(), found.words, found.count);
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
  const Corners corners(*state_->of, state_->vector_width);
  corners.each_vertex(download<std::uint32_t>(state_->of->device, state_->words, corners.words()),
                      [&](int x, int y) {
                        points.push_back({x + 1.0, y + 1.0});
                      });
  return points;
}

}  // namespace vorocl
