#include "vorocl/cells.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "measures/measurement.hpp"
#include "runtime/buffer.hpp"

namespace vorocl {

namespace {
constexpr std::size_t cells_per_item = 1024;
}  // namespace

struct CellSumsState : Measured {
  cl::Buffer area, sum_x, sum_y;
  cl::Buffer home, home_sums, periods_x, periods_y;  // while the sums are made: see cells.cl
  cl::Buffer partial;                                // of the statistics
};

struct CellShapesState : Measured {
  cl::Buffer boxes, distances;
  cl::Buffer upper_words, lower_words;  // of distances that may not fit in 32 bits: see plane_shapes.cl

  bool far() const { return !empty() && frames.seeds->outer && frames.seeds->outer->extent == Extent::far; }
};

CellSumsResult::CellSumsResult() = default;
CellSumsResult::~CellSumsResult() = default;
CellSumsResult::CellSumsResult(CellSumsResult&& other) noexcept = default;
CellSumsResult& CellSumsResult::operator=(CellSumsResult&& other) noexcept = default;
std::size_t CellSumsResult::size() const { return state_ ? state_->size() : 0; }
const cl::Buffer& CellSumsResult::area() const { return buffer_of(state_, &CellSumsState::area); }
const cl::Buffer& CellSumsResult::sum_x() const { return buffer_of(state_, &CellSumsState::sum_x); }
const cl::Buffer& CellSumsResult::sum_y() const { return buffer_of(state_, &CellSumsState::sum_y); }

CellShapesResult::CellShapesResult() = default;
CellShapesResult::~CellShapesResult() = default;
CellShapesResult::CellShapesResult(CellShapesResult&& other) noexcept = default;
CellShapesResult& CellShapesResult::operator=(CellShapesResult&& other) noexcept = default;
std::size_t CellShapesResult::size() const { return state_ ? state_->size() : 0; }
const cl::Buffer& CellShapesResult::boxes() const { return buffer_of(state_, &CellShapesState::boxes); }
const cl::Buffer& CellShapesResult::largest_distances() const {
  static const cl::Buffer none;
  return state_ && state_->far() ? none : buffer_of(state_, &CellShapesState::distances);
}

Point CellSums::centroid() const {
  const double none = std::numeric_limits<double>::quiet_NaN();
  if (area == 0) return {none, none};
  return {static_cast<double>(sum_x) / area + 0.5, static_cast<double>(sum_y) / area + 0.5};
}

Report cell_sums(const Seeds& seeds, const Diagram& diagram, CellSumsResult& result) {
  const Stopwatch stopwatch;
  CellSumsState& sums = Internal::result(result);
  sums.frames = {};
  auto measured = frames_of(seeds, diagram);
  const Device& device = diagram.device();
  const Grid& grid = diagram.grid();
  const auto count = static_cast<cl_uint>(seeds.size());
  make_room(sums.area, device, count * sizeof(cl_uint));
  make_room(sums.sum_x, device, count * sizeof(cl_long));
  make_room(sums.sum_y, device, count * sizeof(cl_long));
  make_room(sums.home, device, count * sizeof(cl_ushort));
  make_room(sums.home_sums, device, count * sizeof(cl_ulong));

  const Blocks blocks(device, grid);
  const int width = grid.width(), wide = blocks.wide(), high = blocks.high();
  const auto run_over_cells = [&](const char* name, const auto&... arguments) {
    return sums.kernels.get(device, "measures/cells.cl", name, grid).over_items(count, arguments...);
  };
  const cl::Event first = run_over_cells("clear_sums", seeds.positions(), count, width, wide, high, sums.area,
                                         sums.sum_x, sums.sum_y, sums.home, sums.home_sums);
  const cl::Event added =
      blocks.run(sums.kernels, "measures/cells.cl", "add_sums", {}, diagram.labels(), count, width,
                 grid.height(), wide, high, sums.area, sums.sum_x, sums.sum_y, sums.home, sums.home_sums);
  cl::Event last = run_over_cells("join_sums", count, width, wide, high, sums.area, sums.sum_x, sums.sum_y,
                                  sums.home, sums.home_sums);
  if (grid.periodic() != Periodic::none && count > 0) {
    for (cl::Buffer* const periods : {&sums.periods_x, &sums.periods_y}) {
      make_room(*periods, device, count * sizeof(cl_int));
      fill(device, *periods, cl_int{0}, count);
    }
    blocks.run(sums.kernels, "measures/cells.cl", "add_periods", {}, diagram.labels(), seeds.positions(),
               count, width, grid.height(), wide, high, sums.periods_x, sums.periods_y);
    last = run_over_cells("unwrap_sums", count, width, grid.height(), sums.periods_x, sums.periods_y,
                          sums.sum_x, sums.sum_y);
  }
  Report report = report_of(stopwatch, device, count > 0 ? first : added, count > 0 ? last : added);
  sums.frames = std::move(measured);
  return report;
}

std::vector<CellSums> CellSumsResult::read() const {
  if (size() == 0) return {};
  state_->frames.check();
  const Device& device = state_->frames.seeds->device;
  const auto area = download<cl_uint>(device, state_->area, size());
  const auto sum_x = download<cl_long>(device, state_->sum_x, size());
  const auto sum_y = download<cl_long>(device, state_->sum_y, size());
  std::vector<CellSums> cells;
  cells.reserve(size());
  for (std::size_t id = 0; id < size(); ++id) cells.push_back({area[id], sum_x[id], sum_y[id]});
  return cells;
}

namespace {

/// Where there are outer seeds.
cl::Event add_plane_shapes(const MeasuredFrames& measured, const Diagram& diagram, CellShapesState& shapes,
                           Metric metric) {
  const Device& device = diagram.device();
  const Grid& grid = diagram.grid();
  const OuterSeeds& outer = *measured.seeds->outer;
  const auto count = static_cast<cl_uint>(measured.seeds->size);
  const Blocks blocks(device, grid);
  const KernelOptions options = {metric, Neighbourhood::moore, outer.extent};
  const bool far = outer.extent == Extent::far;
  if (far) {
    for (cl::Buffer* const words : {&shapes.upper_words, &shapes.lower_words}) {
      make_room(*words, device, count * sizeof(cl_int));
    }
    if (count > 0) {
      fill(device, shapes.upper_words, cl_int{-1}, count);
      fill(device, shapes.lower_words, cl_uint{0}, count);
    }
  }
  cl::Event added =
      blocks.run(shapes.kernels, "measures/plane_shapes.cl", "add_plane_shapes", options, diagram.labels(),
                 outer.seeds, count, outer.periods, grid.width(), grid.height(), blocks.wide(), blocks.high(),
                 shapes.boxes, far ? shapes.upper_words : shapes.distances);
  if (!far) return added;
  return blocks.run(shapes.kernels, "measures/plane_shapes.cl", "add_lower_words", options, diagram.labels(),
                    outer.seeds, count, outer.periods, grid.width(), grid.height(), blocks.wide(),
                    blocks.high(), shapes.upper_words, shapes.lower_words);
}

cl::Event add_shapes(const Seeds& seeds, const Diagram& diagram, CellShapesState& shapes, Metric metric) {
  const Grid& grid = diagram.grid();
  const Blocks blocks(diagram.device(), grid);
  return blocks.run(shapes.kernels, "measures/shapes.cl", "add_shapes", {metric}, diagram.labels(),
                    seeds.positions(), static_cast<cl_uint>(seeds.size()), grid.width(), grid.height(),
                    blocks.wide(), blocks.high(), shapes.boxes, shapes.distances);
}

}  // namespace

Report cell_shapes(const Seeds& seeds, const Diagram& diagram, CellShapesResult& result, Metric metric) {
  const Stopwatch stopwatch;
  CellShapesState& shapes = Internal::result(result);
  shapes.frames = {};
  auto measured = frames_of(seeds, diagram);
  const Device& device = diagram.device();
  const auto count = static_cast<cl_uint>(seeds.size());
  make_room(shapes.boxes, device, count * sizeof(cl_int4));
  make_room(shapes.distances, device, count * sizeof(cl_int));

  const cl::Event first =
      shapes.kernels.get(device, "measures/shapes.cl", "clear_shapes", diagram.grid(), {metric})
          .over_items(count, count, shapes.boxes, shapes.distances);
  const cl::Event last = measured.seeds->outer ? add_plane_shapes(measured, diagram, shapes, metric)
                                               : add_shapes(seeds, diagram, shapes, metric);
  Report report = report_of(stopwatch, device, count > 0 ? first : last, last);
  shapes.frames = std::move(measured);
  return report;
}

namespace {

std::vector<std::int64_t> largest_distances_on_host(const CellShapesState& shapes) {
  const Device& device = shapes.frames.seeds->device;
  if (!shapes.far()) {
    const auto distances = download<cl_int>(device, shapes.distances, shapes.size());
    return {distances.begin(), distances.end()};
  }
  const auto upper = download<cl_int>(device, shapes.upper_words, shapes.size());
  const auto lower = download<cl_uint>(device, shapes.lower_words, shapes.size());
  std::vector<std::int64_t> distances;
  distances.reserve(upper.size());
  for (std::size_t id = 0; id < upper.size(); ++id) {
    distances.push_back(upper[id] < 0 ? -1 : std::int64_t{upper[id]} << 32 | lower[id]);
  }
  return distances;
}

}  // namespace

std::vector<CellShape> CellShapesResult::read() const {
  if (size() == 0) return {};
  const SeedsFrame& seeds = *state_->frames.seeds;
  state_->frames.check();
  const auto boxes = download<cl_int4>(seeds.device, state_->boxes, size());
  const auto distances = largest_distances_on_host(*state_);
  std::vector<CellShape> cells;
  cells.reserve(size());
  for (std::size_t id = 0; id < size(); ++id) {
    const int left = boxes[id].s[0], top = boxes[id].s[1], right = boxes[id].s[2], bottom = boxes[id].s[3];
    const Grid& grid = seeds.grid;
    const bool touches = (!grid.periodic_x() && (left == 0 || right == grid.width() - 1)) ||
                         (!grid.periodic_y() && (top == 0 || bottom == grid.height() - 1));
    cells.push_back({left, top, right, bottom, distances[id], touches});
  }
  return cells;
}

namespace {

std::size_t outer_seeds_without_pixels(const OuterSeeds& outer, const CellSumsState& sums) {
  const SeedsFrame& seeds = *sums.frames.seeds;
  const auto areas = download<cl_uint>(seeds.device, sums.area, seeds.size);
  const auto positions = download<PlanePosition>(seeds.device, outer.seeds, seeds.size);
  std::size_t count = 0;
  for (std::size_t id = 0; id < seeds.size; ++id) {
    const bool outside = !is_absent(positions[id]) && !is_inside(seeds.grid, positions[id]);
    count += outside && areas[id] == 0 ? 1 : 0;
  }
  return count;
}

}  // namespace

CellStatistics cell_statistics(const Seeds& seeds, const Diagram& diagram) {
  CellSumsResult sums;
  cell_sums(seeds, diagram, sums);
  diagram.wait();
  return cell_statistics(sums);
}

CellStatistics cell_statistics(CellSumsResult& result) {
  CellStatistics statistics;
  if (result.size() == 0) return statistics;
  CellSumsState& sums = Internal::result(result);
  const SeedsFrame& seeds = *sums.frames.seeds;
  const std::size_t items = (seeds.size + cells_per_item - 1) / cells_per_item;
  make_room(sums.partial, seeds.device, items * sizeof(cl_ulong4));
  sums.kernels.get(seeds.device, "measures/statistics.cl", "sum_areas", seeds.grid)
      .over_items(items, sums.area, static_cast<cl_uint>(seeds.size), static_cast<cl_uint>(cells_per_item),
                  static_cast<cl_uint>(items), sums.partial);
  seeds.device.finish();
  sums.frames.check();
  std::uint64_t squares = 0;
  std::size_t cells_with_pixels = 0;
  for (const cl_ulong4& some : download<cl_ulong4>(seeds.device, sums.partial, items)) {
    cells_with_pixels += some.s[0];
    statistics.pixels += some.s[1];
    squares += some.s[2];
  }
  statistics.cells = seeds.alive();
  if (seeds.outer) statistics.cells -= outer_seeds_without_pixels(*seeds.outer, sums);
  statistics.empty_cells = statistics.cells - std::min(statistics.cells, cells_with_pixels);
  if (statistics.cells > 0) {
    const auto cells = static_cast<double>(statistics.cells);
    statistics.mean_area = static_cast<double>(statistics.pixels) / cells;
    // The difference of two large numbers may come out a little below 0.
    const double variance =
        static_cast<double>(squares) / cells - statistics.mean_area * statistics.mean_area;
    statistics.area_deviation = std::sqrt(std::max(variance, 0.0));
  }
  return statistics;
}

}  // namespace vorocl
