#include <algorithm>
#include <opencv2/imgproc.hpp>

#include "app/bench/benchmark.hpp"
#include "vorocl/error.hpp"

namespace vorocl::command {

namespace {

cv::Point pixel_of(const Point& seed) { return {static_cast<int>(seed.x), static_cast<int>(seed.y)}; }

}  // namespace

OpenCvBaseline::OpenCvBaseline(const Grid& grid, const std::vector<std::optional<Point>>& seeds,
                               Metric metric)
    : seeds_(seeds),
      metric_(metric),
      image_(Size(grid).height(), Size(grid).width(), CV_8U, cv::Scalar(255)) {
  if (grid.periodic() != Axes::none) throw Error("opencv knows no periodic axes; leave it out");
  for (const std::optional<Point>& seed : seeds_) {
    if (seed) image_.at<std::uint8_t>(pixel_of(*seed)) = 0;
  }
}

void OpenCvBaseline::run() {
  const auto transform = [this](int distance, int mask) {
    cv::distanceTransform(image_, distances_, labels_, distance, mask, cv::DIST_LABEL_PIXEL);
  };
  switch (metric_) {
    case Metric::euclidean:
      return transform(cv::DIST_L2, cv::DIST_MASK_5);
    case Metric::manhattan:
      return transform(cv::DIST_L1, cv::DIST_MASK_3);
    case Metric::great_circle:  // which commands that compare do not take
      break;
  }
}

std::vector<std::uint32_t> OpenCvBaseline::labels() const {
  // OpenCV numbers the zero pixels in an order of its own, from 1; each holds its own number.
  std::vector<std::uint32_t> id_of(image_.total() + 1, no_label);
  for (std::size_t id = 0; id < seeds_.size(); ++id) {
    if (!seeds_[id]) continue;
    std::uint32_t& entry = id_of[static_cast<std::size_t>(labels_.at<int>(pixel_of(*seeds_[id])))];
    entry = std::min(entry, static_cast<std::uint32_t>(id));
  }
  std::vector<std::uint32_t> ids(labels_.total());
  std::transform(labels_.begin<int>(), labels_.end<int>(), ids.begin(),
                 [&](int label) { return id_of[static_cast<std::size_t>(label)]; });
  return ids;
}

}  // namespace vorocl::command
