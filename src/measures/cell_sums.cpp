#include "measures/cell_sums.hpp"

#include <initializer_list>
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
  const double none = std::numeric_limits<double>::quiet_NaN();
  if (area == 0) return {none, none};
  return {static_cast<double>(sum_x) / area + 0.5, static_cast<double>(sum_y) / area + 0.5};
}

Point3 CellSums::centroid3() const {
  const Point in_slice = centroid();
  return {in_slice.x, in_slice.y, area == 0 ? in_slice.x : static_cast<double>(sum_z) / area + 0.5};
}

namespace {

/// The first command and the last one.
using Enqueued = std::pair<cl::Event, cl::Event>;

/// What add_periods of the kernels adds to, with one number per cell.
void clear_periods(const Device& device, std::initializer_list<cl::Buffer*> buffers, cl_uint count) {
  for (cl::Buffer* const periods : buffers) {
    make_room(*periods, device, count * sizeof(cl_int));
    fill(device, *periods, cl_int{0}, count);
  }
}

Enqueued sum_voxels(CellSumsState& sums, const MeasuredDiagram& of, const cl::Buffer& labels) {
  const cl_uint count = of.count();
  make_room(sums.sum_z, of.device, count * sizeof(cl_long));
  make_room(sums.home_sums, of.device, count * sizeof(cl_uint4));
  const char* const file = "volumes/cells.cl";
  const KernelOptions options = of.options_without_metric();
  const Cuboids blocks(of.device, of.grid);
  const auto run_over_cells = [&](const char* name) {
    return sums.kernels.get(of.device, file, name, of.grid, options)
        .over_items(count, of.positions(), count, blocks.size(), blocks.bits(), sums.area, sums.sum_x,
                    sums.sum_y, sums.sum_z, sums.home, sums.home_sums);
  };
  const cl::Event first = run_over_cells("clear_sums");
  const cl::Event added =
      blocks.run(sums.kernels, file, "add_sums", options, labels, count, blocks.size(), blocks.bits(),
                 sums.area, sums.sum_x, sums.sum_y, sums.sum_z, sums.home, sums.home_sums);
  cl::Event last = run_over_cells("join_sums");
  if ((of.grid.periodic() != Periodic::none || of.grid.periodic_z()) && count > 0) {
    clear_periods(of.device, {&sums.periods_x, &sums.periods_y, &sums.periods_z}, count);
    blocks.run(sums.kernels, file, "add_periods", options, labels, of.positions(), count, blocks.size(),
               blocks.bits(), sums.periods_x, sums.periods_y, sums.periods_z);
    last = sums.kernels.get(of.device, file, "unwrap_sums", of.grid, options)
               .over_items(count, count, blocks.size(), sums.periods_x, sums.periods_y, sums.periods_z,
                           sums.area, sums.sum_x, sums.sum_y, sums.sum_z);
  }
  return count > 0 ? Enqueued(first, last) : Enqueued(added, added);
}

Enqueued sum_pixels(CellSumsState& sums, const MeasuredDiagram& of, const cl::Buffer& labels) {
  const cl_uint count = of.count();
  make_room(sums.home_sums, of.device, count * sizeof(cl_ulong));
  sums.sum_z = cl::Buffer();  // of a volume that was measured before
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
      blocks.run(sums.kernels, file, "add_sums", options, labels, count, width, height, wide, high, sums.area,
                 sums.sum_x, sums.sum_y, sums.home, sums.home_sums);
  cl::Event last = run_over_cells("join_sums", of.positions(), count, width, wide, high, sums.area,
                                  sums.sum_x, sums.sum_y, sums.home, sums.home_sums);
  if (of.grid.periodic() != Periodic::none && count > 0) {
    clear_periods(of.device, {&sums.periods_x, &sums.periods_y}, count);
    // Only in a tilted grid the metric says where a pixel lies.
    const KernelOptions of_places = of.window.grid().is_tilted() ? of.options() : options;
    blocks.run(sums.kernels, file, "add_periods", of_places, labels, of.positions(), count, of.periods(),
               width, height, wide, high, sums.periods_x, sums.periods_y);
    last = run_over_cells("unwrap_sums", count, of.periods(), width, height, sums.periods_x, sums.periods_y,
                          sums.area, sums.sum_x, sums.sum_y);
  }
  return count > 0 ? Enqueued(first, last) : Enqueued(added, added);
}

}  // namespace

Report cell_sums(const Diagram& diagram, CellSumsResult& result) {
  Measuring<CellSumsState> measuring(result);
  CellSumsState& sums = measuring.state();
  MeasuredDiagram of = cells_of(diagram, Volumes::taken);
  const cl_uint count = of.count();
  make_room(sums.area, of.device, count * sizeof(cl_uint));
  make_room(sums.sum_x, of.device, count * sizeof(cl_long));
  make_room(sums.sum_y, of.device, count * sizeof(cl_long));
  make_room(sums.home, of.device, count * sizeof(cl_ushort));
  const auto [first, last] =
      of.grid.is_volume() ? sum_voxels(sums, of, diagram.labels()) : sum_pixels(sums, of, diagram.labels());
  return measuring.commit(std::move(of), first, last);
}

std::vector<CellSums> CellSumsResult::read() const {
  if (size() == 0) return {};
  state_->of->check();
  const Device& device = state_->of->device;
  const auto area = download<cl_uint>(device, state_->area, size());
  const auto sum_x = download<cl_long>(device, state_->sum_x, size());
  const auto sum_y = download<cl_long>(device, state_->sum_y, size());
  // The slices of a plane are the one that it is.
  const auto sum_z = state_->of->grid.is_volume() ? download<cl_long>(device, state_->sum_z, size())
                                                  : std::vector<cl_long>(size());
  std::vector<CellSums> cells;
  cells.reserve(size());
  for (std::size_t id = 0; id < size(); ++id) cells.push_back({area[id], sum_x[id], sum_y[id], sum_z[id]});
  return cells;
}

}  // namespace vorocl
