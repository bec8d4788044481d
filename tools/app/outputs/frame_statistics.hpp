// A table of the diagrams' statistics, one row per frame.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "app/outputs/frame_journal.hpp"
#include "app/outputs/measures.hpp"
#include "formats/trajectory/trajectory.hpp"

namespace vorocl::command {

class FrameStatistics {
 public:
  /// Throws Error if the file cannot be made there.
  explicit FrameStatistics(const std::string& path, FrameJournal* journal = nullptr);

  /// Every frame, in order; `milliseconds` is the device's time for its diagram, `box` the trajectory's.
  void add(int frame, double milliseconds, const std::optional<Box>& box, Measures& measures);

  /// Goes on behind a frame that is in the table.
  void go_on_from(Measures& measures);

  void finish() { file_->finish(); }

 private:
  std::unique_ptr<GrowingFile> file_;
  std::vector<std::uint32_t> last_labels_;  // by id, in the picture of the frame before; empty: there is none
};

}  // namespace vorocl::command
