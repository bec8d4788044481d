// A table of the diagrams' statistics, one row per frame.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "app/outputs/journal.hpp"
#include "app/outputs/measures.hpp"

namespace vorocl::command {

class FrameStatistics {
 public:
  /// Throws Error if the file cannot be made there.
  explicit FrameStatistics(const std::string& path, Journal* journal = nullptr);

  /// Every frame, in order; `milliseconds` is the device's time for its diagram.
  void add(int frame, double milliseconds, Measures& measures);

  /// Goes on behind a frame that is in the table.
  void go_on_from(Measures& measures) { last_labels_ = measures.labels_by_id().labels; }

  void finish() { file_->finish(); }

 private:
  std::unique_ptr<GrowingFile> file_;
  std::vector<std::uint32_t> last_labels_;  // by id, of the frame before; empty: there is none
};

}  // namespace vorocl::command
