#include <algorithm>
#include <cmath>

#include "measures/cell_sums.hpp"
#include "runtime/buffer.hpp"

namespace vorocl {

namespace {

constexpr std::size_t cells_per_item = 1024;
std::size_t items_of(std::size_t cells) { return (cells + cells_per_item - 1) / cells_per_item; }

}  // namespace

struct CellStatisticsState : Measured {
  cl::Buffer partial;   // see cells.cl
  CellSumsResult sums;  // of a diagram that was not summed before
};

CellStatisticsResult::CellStatisticsResult() = default;
CellStatisticsResult::~CellStatisticsResult() = default;
CellStatisticsResult::CellStatisticsResult(CellStatisticsResult&& other) noexcept = default;
CellStatisticsResult& CellStatisticsResult::operator=(CellStatisticsResult&& other) noexcept = default;

namespace {

cl::Event sum_areas(CellStatisticsState& statistics, const MeasuredDiagram& of, const cl::Buffer& areas) {
  const std::size_t items = items_of(of.count());
  make_room(statistics.partial, of.device, items * sizeof(cl_ulong4));
  return statistics.kernels
      .get(of.device, "measures/cells.cl", "sum_areas", of.grid, of.options_without_metric())
      .over_items(items, of.positions(), of.count(), of.periods(), of.grid.width(), of.grid.height(), areas,
                  static_cast<cl_uint>(cells_per_item), static_cast<cl_uint>(items), statistics.partial);
}

}  // namespace

Report cell_statistics(const Diagram& diagram, CellStatisticsResult& result) {
  Measuring<CellStatisticsState> measuring(result);
  CellStatisticsState& statistics = measuring.state();
  const Report summed = cell_sums(diagram, statistics.sums);
  const cl::Event last = sum_areas(statistics, cells_of(diagram), statistics.sums.area());
  return measuring.commit(cells_of(diagram), Internal::first(summed),
                          last() != nullptr ? last : summed.event());
}

Report cell_statistics(const CellSumsResult& sums, CellStatisticsResult& result) {
  Measuring<CellStatisticsState> measuring(result);
  const CellSumsState* const summed = Internal::held(sums);
  if (summed == nullptr || summed->empty()) return {};
  const cl::Event event = sum_areas(measuring.state(), *summed->of, summed->area);
  return measuring.commit(MeasuredDiagram(*summed->of), event, event);
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
