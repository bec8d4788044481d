#include "app/outputs/frame_statistics.hpp"

#include <fmt/format.h>

#include <functional>
#include <numeric>
#include <utility>

namespace vorocl::command {

namespace {

/// By id, in the picture: grids may change from frame to frame.
std::vector<std::uint32_t> labels_in_picture(Measures& measures) {
  return measures.view().in_picture(measures.labels_by_id().labels, no_label);
}

}  // namespace

FrameStatistics::FrameStatistics(const std::string& path, FrameJournal* journal)
    : file_(open_table(path,
                       "frame,cells,empty_cells,mean_area,area_deviation,changed_pixels,milliseconds,"
                       "box_x0,box_y0,box_x1,box_y1",
                       journal)) {}

void FrameStatistics::go_on_from(Measures& measures) { last_labels_ = labels_in_picture(measures); }

void FrameStatistics::add(int frame, double milliseconds, const std::optional<Box>& box, Measures& measures) {
  const CellStatistics statistics = measures.statistics();
  // Counted here and not on the device, where a particle's label may be another's in the next frame.
  std::vector<std::uint32_t> labels = labels_in_picture(measures);
  std::string changed;
  if (!last_labels_.empty()) {
    changed = fmt::format("{}", std::inner_product(labels.begin(), labels.end(), last_labels_.begin(),
                                                   std::size_t{0}, std::plus<>(), std::not_equal_to<>()));
  }
  last_labels_ = std::move(labels);
  *file_ << fmt::format("{},{},{},{},{},{},{:.6f},", frame, statistics.cells, statistics.empty_cells,
                        statistics.mean_area, statistics.area_deviation, changed, milliseconds)
         << (box ? fmt::format("{},{},{},{}\n", box->x0, box->y0, box->x1, box->y1) : ",,,\n");
}

}  // namespace vorocl::command
