// OpenCV's labelled distance transform, as a baseline for the methods in bench.
#pragma once

#include <cstdint>
#include <opencv2/core.hpp>
#include <optional>
#include <vector>

#include "vorocl/grid.hpp"

namespace vorocl::command {

class OpenCvBaseline {
 public:
  /// `seeds` holds the points by id, as Seeds::read() gives them.
  OpenCvBaseline(const Grid& grid, const std::vector<std::optional<Point>>& seeds, Metric metric);

  /// One cv::distanceTransform with DIST_LABEL_PIXEL from the image of the seeds to its labels, with the
  /// finest mask that it has for the metric's labels: 5 x 5 for euclidean, 3 x 3 for manhattan.
  void run();

  /// The labels of the last run, as seed ids: of the seeds on one pixel the lowest.
  std::vector<std::uint32_t> labels() const;

 private:
  std::vector<std::optional<Point>> seeds_;
  Metric metric_;
  cv::Mat image_;  // 0 at the seeds, 255 elsewhere
  cv::Mat distances_;
  cv::Mat labels_;
};

}  // namespace vorocl::command
