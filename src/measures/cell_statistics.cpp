#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "measures/measurement.hpp"
#include "runtime/buffer.hpp"
#include "vorocl/cells.hpp"

namespace vorocl {

/// What cell_sums() leaves on the device, which the statistics take.
struct CellSumsState : Measured {
  cl::Buffer area, sum_x, sum_y, sum_z;
  cl::Buffer home, home_sums, periods;  // while the sums are made: see cells.cl
};

std::size_t CellSumsResult::size() const { return state_ ? state_->size() : 0; }
const cl::Buffer& CellSumsResult::area() const { return buffer_of(state_, &CellSumsState::area); }
const cl::Buffer& CellSumsResult::sum_x() const { return buffer_of(state_, &CellSumsState::sum_x); }
const cl::Buffer& CellSumsResult::sum_y() const { return buffer_of(state_, &CellSumsState::sum_y); }
const cl::Buffer& CellSumsResult::sum_z() const { return buffer_of(state_, &CellSumsState::sum_z); }

Point CellSums::centroid() const {
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  if (area == 0) return {none, none, none};
  const auto mean = [this](std::int64_t sum) { return static_cast<double>(sum) / area + 0.5; };
  return {mean(sum_x), mean(sum_y), mean(sum_z)};
}

Report cell_sums(const Diagram& diagram, CellSumsResult& result) {
  Measuring<CellSumsState> measuring(result);
  CellSumsState& sums = measuring.state();
  MeasuredDiagram of = cells_of(diagram);
  const cl_uint count = of.count();
  make_room(sums.area, of.device, count * sizeof(cl_uint));
  for (cl::Buffer* const sum : {&sums.sum_x, &sums.sum_y, &sums.sum_z}) {
    make_room(*sum, of.device, count * sizeof(cl_long));
  }
  make_room(sums.home, of.device, count * sizeof(cl_ushort));
  make_room(sums.home_sums, of.device, count * (of.grid.has_voxels() ? sizeof(cl_uint4) : sizeof(cl_ulong)));
  const char* const file = "measures/cells.cl";
  const KernelOptions options = of.options_without_metric();
  const Blocks blocks(of.device, of.grid);
  const auto run_over_cells = [&](const char* name, const auto&... arguments) {
    return sums.kernels.get(of.device, file, name, of.grid, options).over_items(count, arguments...);
  };
  const auto clear_or_join = [&](const char* name) {
    return run_over_cells(name, of.positions(), count, of.size(), blocks.bits(), sums.area, sums.sum_x,
                          sums.sum_y, sums.sum_z, sums.home, sums.home_sums);
  };
  const cl::Event cleared = clear_or_join("clear_sums");
  const cl::Event added =
      blocks.run(sums.kernels, file, "add_sums", options, diagram.labels(), count, of.size(), blocks.bits(),
                 sums.area, sums.sum_x, sums.sum_y, sums.sum_z, sums.home, sums.home_sums);
  cl::Event last = clear_or_join("join_sums");
  if (of.grid.is_periodic() && count > 0) {
    make_room(sums.periods, of.device, std::size_t{3} * count * sizeof(cl_int));
    fill(of.device, sums.periods, cl_int{0}, std::size_t{3} * count);
    // Only in a tilted grid the metric says where a pixel lies.
    const KernelOptions of_places = of.window.grid().is_tilted() ? of.options() : options;
    blocks.run(sums.kernels, file, "add_periods", of_places, diagram.labels(), of.positions(), count,
               of.lattice(), of.size(), blocks.bits(), sums.periods);
    last = run_over_cells("unwrap_sums", count, of.lattice(), of.size(), sums.periods, sums.area, sums.sum_x,
                          sums.sum_y, sums.sum_z);
  }
  return count > 0 ? measuring.commit(std::move(of), cleared, last)
                   : measuring.commit(std::move(of), added, added);
}

std::vector<CellSums> CellSumsResult::read() const {
  if (size() == 0) return {};
  state_->of->check();
  const Device& device = state_->of->device;
  const auto area = download<cl_uint>(device, state_->area, size());
  const auto sum_x = download<cl_long>(device, state_->sum_x, size());
  const auto sum_y = download<cl_long>(device, state_->sum_y, size());
  const auto sum_z = download<cl_long>(device, state_->sum_z, size());
  std::vector<CellSums> cells;
  cells.reserve(size());
  for (std::size_t id = 0; id < size(); ++id) cells.push_back({area[id], sum_x[id], sum_y[id], sum_z[id]});
  return cells;
}

namespace {

constexpr std::size_t cells_per_item = 1024;
std::size_t items_of(std::size_t cells) { return (cells + cells_per_item - 1) / cells_per_item; }

}  // namespace

struct CellStatisticsState : Measured {
  cl::Buffer partial;                // see cells.cl
  cl::Buffer area, home, home_area;  // of a diagram that was not summed before
};

namespace {

constexpr const char* cells_file = "measures/cells.cl";

/// Leaves the areas of all cells. Returns the first command.
cl::Event add_areas(CellStatisticsState& statistics, const MeasuredDiagram& of, const cl::Buffer& labels) {
  const cl_uint count = of.count();
  make_room(statistics.area, of.device, count * sizeof(cl_uint));
  make_room(statistics.home, of.device, count * sizeof(cl_ushort));
  make_room(statistics.home_area, of.device, count * sizeof(cl_uint));
  const KernelOptions options = of.options_without_metric();
  const Blocks blocks(of.device, of.grid);
  const auto run_over_cells = [&](const char* name, const auto&... arguments) {
    return statistics.kernels.get(of.device, cells_file, name, of.grid, options)
        .over_items(count, of.positions(), count, arguments...);
  };
  const cl::Event first = run_over_cells("clear_areas", of.size(), blocks.bits(), statistics.area,
                                         statistics.home, statistics.home_area);
  const cl::Event added =
      blocks.run(statistics.kernels, cells_file, "add_areas", options, labels, count, of.size(),
                 blocks.bits(), statistics.area, statistics.home, statistics.home_area);
  run_over_cells("join_areas", statistics.area, statistics.home_area);
  return count > 0 ? first : added;
}

cl::Event sum_areas(CellStatisticsState& statistics, const MeasuredDiagram& of, const cl::Buffer& areas) {
  const std::size_t items = items_of(of.count());
  make_room(statistics.partial, of.device, items * sizeof(cl_ulong4));
  return statistics.kernels.get(of.device, cells_file, "sum_areas", of.grid, of.options_without_metric())
      .over_items(items, of.positions(), of.count(), of.lattice(), of.size(), areas,
                  static_cast<cl_uint>(cells_per_item), static_cast<cl_uint>(items), statistics.partial);
}

}  // namespace

Report cell_statistics(const Diagram& diagram, CellStatisticsResult& result) {
  Measuring<CellStatisticsState> measuring(result);
  CellStatisticsState& statistics = measuring.state();
  MeasuredDiagram of = cells_of(diagram, OnGlobe::yes);
  const cl::Event first = add_areas(statistics, of, diagram.labels());
  const cl::Event last = sum_areas(statistics, of, statistics.area);
  return measuring.commit(std::move(of), first, last() != nullptr ? last : first);
}

Report cell_statistics(const CellSumsResult& sums, CellStatisticsResult& result) {
  Measuring<CellStatisticsState> measuring(result);
  const CellSumsState* const summed = Internal::held(sums);
  if (summed == nullptr || summed->empty()) return {};
  CellStatisticsState& statistics = measuring.state();
  const std::size_t bytes = summed->size() * sizeof(cl_uint);
  make_room(statistics.area, summed->of->device, bytes);
  if (bytes > 0) copy(summed->of->device, summed->area, statistics.area, bytes);
  const cl::Event event = sum_areas(statistics, *summed->of, statistics.area);
  return measuring.commit(MeasuredDiagram(*summed->of), event, event);
}

std::vector<std::uint32_t> CellStatisticsResult::read_areas() const {
  if (!state_ || state_->empty()) return {};
  const MeasuredDiagram& of = *state_->of;
  of.check();
  return download<std::uint32_t>(of.device, state_->area, of.count());
}

CellStatistics CellStatisticsResult::read() const {
  CellStatistics statistics;
  if (!state_ || state_->empty()) return statistics;
  const MeasuredDiagram& of = *state_->of;
  of.check();
  std::uint64_t squares = 0;
  std::size_t cells_with_pixels = 0;
  for (const cl_ulong4& some : download<cl_ulong4>(of.device, state_->partial, items_of(of.count()))) {
    statistics.cells += some.s[0];
    cells_with_pixels += some.s[1];
    statistics.pixels += some.s[2];
    squares += some.s[3];
  }
  statistics.empty_cells = statistics.cells - cells_with_pixels;
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
