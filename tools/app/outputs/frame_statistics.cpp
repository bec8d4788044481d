#include "app/outputs/frame_statistics.hpp"

#include <fmt/format.h>

#include <functional>
#include <numeric>

namespace vorocl::command {

FrameStatistics::FrameStatistics(const std::string& path, Journal* journal)
    : file_(open_table(path, "frame,cells,empty_cells,mean_area,area_deviation,changed_pixels,milliseconds",
                       journal)) {}

void FrameStatistics::add(int frame, double milliseconds, Measures& measures) {
  const CellStatistics statistics = measures.statistics();
  // Counted here and not on the device, where a particle's label may be another's in the next frame.
  const std::vector<std::uint32_t>& labels = measures.labels_by_id().labels;
  std::string changed;
  if (!last_labels_.empty()) {
    changed = fmt::format("{}", std::inner_product(labels.begin(), labels.end(), last_labels_.begin(),
                                                   std::size_t{0}, std::plus<>(), std::not_equal_to<>()));
  }
  last_labels_ = labels;
  *file_ << fmt::format("{},{},{},{},{},{},{:.6f}\n", frame, statistics.cells, statistics.empty_cells,
                        statistics.mean_area, statistics.area_deviation, changed, milliseconds);
}

}  // namespace vorocl::command
