#include <algorithm>
#include <cmath>
#include <utility>

#include "measures/cell_sums.hpp"
#include "runtime/buffer.hpp"

namespace vorocl {

namespace {

constexpr std::size_t cells_per_item = 1024;
std::size_t items_of(std::size_t cells) { return (cells + cells_per_item - 1) / cells_per_item; }

}  // namespace

struct CellStatisticsState : Measured {
  cl::Buffer partial;                // see cells.cl
  cl::Buffer area, home, home_area;  // of a diagram that was not summed before
};

CellStatisticsResult::CellStatisticsResult() = default;
CellStatisticsResult::~CellStatisticsResult() = default;
CellStatisticsResult::CellStatisticsResult(CellStatisticsResult&& other) noexcept = default;
CellStatisticsResult& CellStatisticsResult::operator=(CellStatisticsResult&& other) noexcept = default;

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
      .over_items(items, of.positions(), of.count(), of.periods(), of.size(), areas,
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
