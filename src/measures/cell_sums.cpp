#include "measures/cell_sums.hpp"

#include <limits>

#include "runtime/buffer.hpp"

namespace vorocl {

CellSumsResult::CellSumsResult() = default;
CellSumsResult::~CellSumsResult() = default;
CellSumsResult::CellSumsResult(CellSumsResult&& other) noexcept = default;
CellSumsResult& CellSumsResult::operator=(CellSumsResult&& other) noexcept = default;
std::size_t CellSumsResult::size() const { return state_ ? state_->size() : 0; }
const cl::Buffer& CellSumsResult::area() const { return buffer_of(state_, &CellSumsState::area); }
const cl::Buffer& CellSumsResult::sum_x() const { return buffer_of(state_, &CellSumsState::sum_x); }
const cl::Buffer& CellSumsResult::sum_y() const { return buffer_of(state_, &CellSumsState::sum_y); }

Point CellSums::centroid() const {
  const double none = std::numeric_limits<double>::quiet_NaN();
  if (area == 0) return {none, none};
  return {static_cast<double>(sum_x) / area + 0.5, static_cast<double>(sum_y) / area + 0.5};
}

Report cell_sums(const Diagram& diagram, CellSumsResult& result) {
  Measuring<CellSumsState> measuring(result);
  CellSumsState& sums = measuring.state();
  MeasuredDiagram of = cells_of(diagram);
  const cl_uint count = of.count();
  make_room(sums.area, of.device, count * sizeof(cl_uint));
  make_room(sums.sum_x, of.device, count * sizeof(cl_long));
  make_room(sums.sum_y, of.device, count * sizeof(cl_long));
  make_room(sums.home, of.device, count * sizeof(cl_ushort));
  make_room(sums.home_sums, of.device, count * sizeof(cl_ulong));

  const char* const file = "measures/cells.cl";
  const KernelOptions options = of.options_without_metric();
  const Blocks blocks(of.device, of.grid);
  const int width = of.grid.width(), height = of.grid.height(), wide = blocks.wide(), high = blocks.high();
  const auto run_over_cells = [&](const char* name, const auto&... arguments) {
    return sums.kernels.get(of.device, file, name, of.grid, options).over_items(count, arguments...);
  };
  const cl::Event first = run_over_cells("clear_sums", of.positions(), count, width, height, wide, high,
                                         sums.area, sums.sum_x, sums.sum_y, sums.home, sums.home_sums);
  const cl::Event added =
      blocks.run(sums.kernels, file, "add_sums", options, diagram.labels(), count, width, height, wide, high,
                 sums.area, sums.sum_x, sums.sum_y, sums.home, sums.home_sums);
  cl::Event last = run_over_cells("join_sums", of.positions(), count, width, wide, high, sums.area,
                                  sums.sum_x, sums.sum_y, sums.home, sums.home_sums);
  if (of.grid.periodic() != Periodic::none && count > 0) {
    for (cl::Buffer* const periods : {&sums.periods_x, &sums.periods_y}) {
      make_room(*periods, of.device, count * sizeof(cl_int));
      fill(of.device, *periods, cl_int{0}, count);
    }
    // Only in a tilted grid the metric says where a pixel lies.
    const KernelOptions of_places = of.window.grid().is_tilted() ? of.options() : options;
    blocks.run(sums.kernels, file, "add_periods", of_places, diagram.labels(), of.positions(), count,
               of.periods(), width, height, wide, high, sums.periods_x, sums.periods_y);
    last = run_over_cells("unwrap_sums", count, of.periods(), width, height, sums.periods_x, sums.periods_y,
                          sums.area, sums.sum_x, sums.sum_y);
  }
  return measuring.commit(std::move(of), count > 0 ? first : added, count > 0 ? last : added);
}

std::vector<CellSums> CellSumsResult::read() const {
  if (size() == 0) return {};
  state_->of->check();
  const Device& device = state_->of->device;
  const auto area = download<cl_uint>(device, state_->area, size());
  const auto sum_x = download<cl_long>(device, state_->sum_x, size());
  const auto sum_y = download<cl_long>(device, state_->sum_y, size());
  std::vector<CellSums> cells;
  cells.reserve(size());
  for (std::size_t id = 0; id < size(); ++id) cells.push_back({area[id], sum_x[id], sum_y[id]});
  return cells;
}

}  // namespace vorocl
