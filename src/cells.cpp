#include "vorocl/cells.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "buffer.hpp"
#include "measurement.hpp"
#include "vorocl/similarity.hpp"

namespace vorocl {

namespace {
constexpr std::size_t cells_per_item = 1024;
}  // namespace

Point CellSums::centroid() const {
  const double none = std::numeric_limits<double>::quiet_NaN();
  if (area == 0) return {none, none};
  return {static_cast<double>(sum_x) / area + 0.5, static_cast<double>(sum_y) / area + 0.5};
}

Report cell_sums(const Seeds& seeds, const Diagram& diagram, CellSumsResult& result) {
  const Stopwatch stopwatch;
  diagram.check_fits(seeds);
  const Device& device = diagram.device();
  const Grid& grid = diagram.grid();
  const auto count = static_cast<cl_uint>(seeds.size());
  make_room(result.area_, device, count * sizeof(cl_uint));
  make_room(result.sum_x_, device, count * sizeof(cl_ulong));
  make_room(result.sum_y_, device, count * sizeof(cl_ulong));
  make_room(result.home_, device, count * sizeof(cl_ushort));
  make_room(result.home_sums_, device, count * sizeof(cl_ulong));
  result.seeds_ = seeds;

  const Blocks blocks(device, grid);
  const int width = grid.width(), wide = blocks.wide(), high = blocks.high();
  const auto run_over_cells = [&](const char* name, const auto&... arguments) {
    return Kernel(device, "cells.cl", name, grid).over_items(count, arguments...);
  };
  const cl::Event first =
      run_over_cells("clear_sums", seeds.positions(), count, width, wide, high, result.area_, result.sum_x_,
                     result.sum_y_, result.home_, result.home_sums_);
  const cl::Event sums =
      blocks.run("cells.cl", "add_sums", diagram.labels(), count, width, grid.height(), wide, high,
                 result.area_, result.sum_x_, result.sum_y_, result.home_, result.home_sums_);
  const cl::Event last = run_over_cells("join_sums", count, width, wide, high, result.area_, result.sum_x_,
                                        result.sum_y_, result.home_, result.home_sums_);
  return stopwatch.report(device, count > 0 ? first : sums, count > 0 ? last : sums);
}

std::vector<CellSums> CellSumsResult::read() const {
  if (!seeds_) return {};
  seeds_->check();
  const Device& device = seeds_->device();
  const auto area = download<cl_uint>(device, area_, size());
  const auto sum_x = download<cl_ulong>(device, sum_x_, size()),
             sum_y = download<cl_ulong>(device, sum_y_, size());
  std::vector<CellSums> cells;
  cells.reserve(size());
  for (std::size_t id = 0; id < size(); ++id) cells.push_back({area[id], sum_x[id], sum_y[id]});
  return cells;
}

Report cell_shapes(const Seeds& seeds, const Diagram& diagram, CellShapesResult& result, Metric metric) {
  const Stopwatch stopwatch;
  diagram.check_fits(seeds);
  const Device& device = diagram.device();
  const Grid& grid = diagram.grid();
  const auto count = static_cast<cl_uint>(seeds.size());
  make_room(result.boxes_, device, count * sizeof(cl_int4));
  make_room(result.distances_, device, count * sizeof(cl_int));
  result.seeds_ = seeds;

  const Blocks blocks(device, grid);
  const cl::Event first = Kernel(device, "shapes.cl", "clear_shapes", grid, {metric})
                              .over_items(count, count, result.boxes_, result.distances_);
  const cl::Event last =
      blocks.run(metric, "shapes.cl", "add_shapes", diagram.labels(), seeds.positions(), count, grid.width(),
                 grid.height(), blocks.wide(), blocks.high(), result.boxes_, result.distances_);
  return stopwatch.report(device, count > 0 ? first : last, last);
}

std::vector<CellShape> CellShapesResult::read() const {
  if (!seeds_) return {};
  seeds_->check();
  const Grid& grid = seeds_->grid();
  const auto boxes = download<cl_int4>(seeds_->device(), boxes_, size());
  const auto distances = download<cl_int>(seeds_->device(), distances_, size());
  std::vector<CellShape> cells;
  cells.reserve(size());
  for (std::size_t id = 0; id < size(); ++id) {
    const int left = boxes[id].s[0], top = boxes[id].s[1], right = boxes[id].s[2], bottom = boxes[id].s[3];
    const bool touches = left == 0 || top == 0 || right == grid.width() - 1 || bottom == grid.height() - 1;
    cells.push_back({left, top, right, bottom, distances[id], touches});
  }
  return cells;
}

CellStatistics cell_statistics(const Seeds& seeds, const Diagram& diagram) {
  CellSumsResult sums;
  cell_sums(seeds, diagram, sums);
  diagram.wait();
  return cell_statistics(sums);
}

CellStatistics cell_statistics(CellSumsResult& sums) {
  CellStatistics statistics;
  if (!sums.seeds_) return statistics;
  const Seeds& seeds = *sums.seeds_;
  const Device& device = seeds.device();
  const std::size_t items = (seeds.size() + cells_per_item - 1) / cells_per_item;
  make_room(sums.partial_, device, items * sizeof(cl_ulong4));
  Kernel(device, "statistics.cl", "sum_areas", seeds.grid())
      .over_items(items, sums.area(), seeds.positions(), static_cast<cl_uint>(seeds.size()),
                  static_cast<cl_uint>(cells_per_item), static_cast<cl_uint>(items), sums.partial_);
  device.finish();
  seeds.check();
  std::uint64_t squares = 0;
  for (const cl_ulong4& some : download<cl_ulong4>(device, sums.partial_, items)) {
    statistics.cells += some.s[0];
    statistics.empty_cells += some.s[1];
    statistics.pixels += some.s[2];
    squares += some.s[3];
  }
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

std::size_t changed_pixels(const Diagram& a, const Diagram& b) {
  // A percentage of at most 2^30 pixels holds their count: its rounding is far below one pixel.
  return static_cast<std::size_t>(
      std::llround((100 - similarity(a, b)) / 100 * static_cast<double>(a.grid().pixels())));
}

}  // namespace vorocl
