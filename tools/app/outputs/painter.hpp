// Draws diagrams.
#pragma once

#include <cstdint>
#include <functional>
#include <opencv2/core/mat.hpp>
#include <optional>
#include <string>
#include <vector>

#include "app/outputs/measures.hpp"
#include "vorocl/picture.hpp"

namespace vorocl::command {

/// A slice of a volume, across an axis.
struct VolumeSlice {
  char axis;  // x, y or z
  std::int64_t at;
};

/// How many slices there are along the axis.
std::int64_t slices_along(const Grid& grid, char axis);

/// The pixels of a slice: x and y across z, x and z across y, y and z across x.
Size size_of_slice(const Grid& grid, const VolumeSlice& slice);

/// What the colour of a pixel shows.
enum class Quantity { id, distance, area, neighbours, column };

struct Coloring {
  Quantity quantity = Quantity::id;
  std::string column;  // its name; empty for the other quantities
};

/// The ends of a scale: values, or percentiles of those that the picture shows.
struct ScaleEnds {
  double low = 0;
  double high = 1;
  bool percent = false;
};

struct PictureOptions {
  std::optional<VolumeSlice> slice;  // of volumes: what their pictures show
  Coloring color;
  std::optional<Palette> palette;
  std::optional<ScaleEnds> scale;
  bool logarithmic = false;
  bool color_bar = false;
  int edge_width = 0;  // 0: no edges
  bool contours = false;
  std::optional<double> contour_interval;  // none: a round one
  bool points_overlay = false;
  bool stamp = false;
  int enlargement = 1;  // the sides of a pixel's square in the picture
};

/// "frame 3, step 7500", or without the time step.
std::string stamp_of(int frame, const std::optional<std::int64_t>& timestep);

/// Makes one picture, or those of a film: then they share scale and contours, and have one size.
class Painter {
 public:
  /// Of many, later ones may have values beyond the scale of the first: the colour bar says so.
  explicit Painter(const PictureOptions& options, bool many = false);

  /// Reads what draw() draws, from the device.
  void read(Measures& measures) const;

  /// `values` are those of the value column, by label. `stamp` is written where the options ask
  /// for it. Throws Error if they ask for a scale or colours that the values do not allow. Notes on standard
  /// error, once, what a logarithmic scale leaves out of the first picture.
  cv::Mat draw(Measures& measures, const ColumnValues& values, const std::string& stamp = "");

  /// Says on standard error, if the scale is the first picture's and another has more than half of its values
  /// beyond it, which one holds all; or which texts the first picture does not have.
  void note_of_scale() const;

  /// Whether the next picture would be the same without those that were drawn before.
  bool is_independent() const;

 private:
  cv::Mat draw_plane(Measures& measures, const ColumnValues& values, const std::string& stamp);
  cv::Mat color(Measures& measures, const ColumnValues& values);
  cv::Mat color_by_id(Measures& measures);
  cv::Mat color_by_text(Measures& measures, const ColumnValues& values);
  cv::Mat color_by_values(Measures& measures, const std::vector<double>& values);
  /// The scale of all pictures: the option's, or else the range of the first that has one. `shown` are the
  /// values there.
  Scale scale(const std::function<std::vector<double>()>& values);
  template <typename T>
  void watch(const std::vector<T>& values);
  void draw_contour_lines(cv::Mat& picture, const std::vector<float>& distances, Axes axes);

  PictureOptions options_;
  bool many_;
  Palette palette_;
  std::optional<Scale> scale_;
  std::optional<Scale> seen_;            // the range of all pictures
  bool is_beyond_ = false;               // some picture's values are, of the scale
  bool omission_noted_ = false;          // of what the scale leaves out, or of colours that recur
  std::optional<bool> whole_values_;     // whether those of the first picture are
  std::vector<std::string> late_texts_;  // those that the first picture does not have
  std::optional<double> contour_interval_;
  std::vector<std::uint32_t> colored_ids_;  // those of the last picture, by label, and their colours
  std::vector<cv::Vec3b> colors_of_ids_;
};

}  // namespace vorocl::command
