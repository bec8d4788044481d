#include "measures/cell_sums.hpp"

#include <limits>
#include <utility>

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
  make_room(sums.home_sums, of.device, count * (of.grid.is_volume() ? sizeof(cl_uint4) : sizeof(cl_ulong)));
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
               of.periods(), of.size(), blocks.bits(), sums.periods);
    last = run_over_cells("unwrap_sums", count, of.periods(), of.size(), sums.periods, sums.area, sums.sum_x,
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

}  // namespace vorocl
