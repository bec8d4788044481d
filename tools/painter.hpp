// Draws diagrams as the options say: measures them on the device, and colours what it finds.
#pragma once

#include <opencv2/core.hpp>
#include <optional>
#include <vector>

#include "label_image.hpp"
#include "picture_options.hpp"
#include "vorocl/adjacency.hpp"
#include "vorocl/cells.hpp"
#include "vorocl/diagram.hpp"
#include "vorocl/fields.hpp"
#include "vorocl/seeds.hpp"

namespace vorocl::command {

/// One state of the seeds and their diagram, as outputs show it.
struct Scene {
  const Seeds& seeds;
  const Diagram& diagram;
  LabelImage image;                   // the diagram's labels
  LabelImage named;                   // the same with the ids that files and colours go by
  const std::vector<double>& values;  // of the value column, by label; NaN: absent
};

/// Makes one picture, or those of a film: then they share scale and contours, and have one size.
class Painter {
 public:
  /// Of many, later ones may have values beyond the scale of the first: the colour bar says so.
  Painter(const PictureOptions& options, Metric metric, bool many = false);

  /// Throws Error where the options ask for what the scene does not have.
  cv::Mat draw(const Scene& scene);

 private:
  cv::Mat color(const Scene& scene);
  cv::Mat color_by_values(const Scene& scene, const std::vector<double>& values);
  std::vector<double> areas(const Scene& scene);
  std::vector<double> neighbours(const Scene& scene);
  /// The scale of all pictures: the option's, or else the range of the first that has one.
  Scale scale(const std::optional<Scale>& range);
  void draw_contour_lines(cv::Mat& picture, const std::vector<float>& distances);

  PictureOptions options_;
  Metric metric_;
  bool many_;
  Palette palette_;
  std::optional<Scale> scale_;
  std::optional<bool> whole_values_;  // whether those of the first picture are
  std::optional<double> contour_interval_;
  std::vector<float> distances_;  // of the present scene, where they are needed
  Field<float> distance_field_;
  CellSumsResult cell_sums_;
  AdjacencyResult adjacency_;
};

}  // namespace vorocl::command
