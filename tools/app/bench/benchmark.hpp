// Methods side by side on the same seeds, in time and in wrong pixels: what bench does. Beside them stand a
// ground truth that shares nothing with the engines, and OpenCV.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <opencv2/core.hpp>
#include <optional>
#include <string>
#include <vector>

#include "app/terminal/samples.hpp"
#include "formats/raster.hpp"
#include "vorocl/grid.hpp"
#include "vorocl/method.hpp"
#include "vorocl/seeds.hpp"

namespace vorocl::command {

/// The least distances, by an exact method that shares nothing with the engines (a k-d tree). Seeds may lie
/// anywhere within their pixels.
class GroundTruth {
 public:
  /// `seeds` holds the positions by id, as Seeds::read_pixels() gives them.
  /// Finds the least distance of every pixel: about a microsecond per pixel and core, and 8 bytes per pixel.
  GroundTruth(const Grid& grid, const std::vector<std::optional<Point>>& seeds, Metric metric);

  /// Pixels without a label, or with the label of a seed that is not there or not at the least distance.
  std::size_t wrong_pixels(const std::vector<std::uint32_t>& labels) const;

 private:
  using Position = std::array<std::int64_t, 3>;  // in parts of a pixel
  std::uint64_t distance(const Position& a, const Position& b) const;

  /// Calls visit(index, where its centre is) for each pixel of a row.
  template <typename Visit>
  void visit_row(std::int64_t row, const Visit& visit) const;

  Grid grid_;
  Metric metric_;
  std::vector<std::optional<Position>> seeds_;  // by id
  std::vector<std::uint64_t> least_;            // row-major; squared if euclidean
};

/// OpenCV's labelled distance transform, as a baseline for the methods.
class OpenCvBaseline {
 public:
  /// `seeds` holds the positions by id, as Seeds::read_pixels() gives them.
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

/// OpenCV's distance transform. It takes part in a benchmark, but cannot fill a diagram: its `run` is null.
const Method& opencv_method();

struct BenchmarkResult {
  std::string method;
  Samples milliseconds;          ///< one value per round
  std::size_t wrong_pixels = 0;  ///< whose label is not at the least distance
};

struct BenchmarkOptions {
  MethodOptions method;
  int rounds = 1;
};

/// Times methods from seeds on the device to labels on the device. All are judged by the seeds as they were
/// placed, snapped or not.
///
/// Runs each method once, which builds its programs, allocates its memory and is judged; then the methods
/// take turns, so that a machine that slows down slows all of them. A method that goes on from the last frame
/// starts each run from the JFA of the seeds one random step of 5 pixels away.
std::vector<BenchmarkResult> benchmark(const std::vector<Method>& methods, const BenchmarkOptions& options,
                                       const Seeds& seeds);

}  // namespace vorocl::command
