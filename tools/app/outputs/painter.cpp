#include "app/outputs/painter.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "vorocl/error.hpp"

namespace vorocl::command {

namespace {

constexpr int most_contours = 10;

bool is_whole_or_none(double value) { return !std::isfinite(value) || value == std::round(value); }

cv::Mat enlarged(const cv::Mat& image, int factor) {
  cv::Mat result;
  cv::resize(image, result, {}, factor, factor, cv::INTER_NEAREST);
  return result;
}

/// Labels or distances of a grid.
template <typename T>
std::vector<T> enlarged(std::vector<T> image, const Grid& grid, int factor) {
  static_assert(sizeof(T) == sizeof(std::int32_t));
  const cv::Mat result = enlarged(cv::Mat(grid.height(), grid.width(), CV_32SC1, image.data()), factor);
  return {result.ptr<T>(), result.ptr<T>() + result.total()};
}

std::vector<std::optional<Point>> enlarged(std::vector<std::optional<Point>> points, int factor) {
  for (std::optional<Point>& point : points) {
    if (point) point = {point->x * factor, point->y * factor};
  }
  return points;
}

/// Without the seeds outside the grid.
std::vector<std::optional<Point>> in_grid(std::vector<std::optional<Point>> points, const Grid& grid) {
  for (std::optional<Point>& point : points) {
    if (point && !grid.holds(*point)) point.reset();
  }
  return points;
}

std::string title_of(const Coloring& color) {
  switch (color.quantity) {
    case Quantity::distance:
      return "distance (px)";
    case Quantity::area:
      return "area (px)";
    case Quantity::neighbours:
      return "neighbours";
    default:
      return color.column;
  }
}

}  // namespace

Painter::Painter(const PictureOptions& options, bool many)
    : options_(options),
      many_(many),
      palette_(options.palette.value_or(Palette::viridis)),
      scale_(options.scale),
      contour_interval_(options.contour_interval) {}

cv::Mat Painter::draw(Measures& measures, const std::vector<double>& values) {
  const Grid& grid = measures.grid();
  const int enlargement = options_.enlargement;
  cv::Mat picture = enlarged(color(measures, values), enlargement);
  if (options_.contours)
    draw_contour_lines(picture, enlarged(measures.distances(), grid, enlargement), grid.periodic());
  if (options_.edge_width > 0) {
    draw_edges(picture, enlarged(measures.labels().labels, grid, enlargement), options_.edge_width,
               grid.periodic());
  }
  if (options_.points_overlay) draw_points(picture, enlarged(in_grid(measures.seeds(), grid), enlargement));
  if (!options_.color_bar) return picture;
  if (!scale_) throw Error("there is no value yet for the colour bar to show; give --scale LOW,HIGH");
  return with_color_bar(picture, {*scale_, palette_, title_of(options_.color), whole_values_.value_or(false),
                                  many_ || options_.scale.has_value()});
}

bool Painter::is_independent() const {
  const Quantity quantity = options_.color.quantity;
  const bool has_scale = quantity == Quantity::id || scale_;
  const bool has_numbers = quantity == Quantity::id || quantity == Quantity::distance || whole_values_;
  return has_scale && has_numbers && (!options_.contours || contour_interval_);
}

cv::Mat Painter::color(Measures& measures, const std::vector<double>& values) {
  switch (options_.color.quantity) {
    case Quantity::distance: {
      const std::vector<float>& distances = measures.distances();
      return color_by_distance(distances, measures.grid(), scale(range_of(distances)), palette_);
    }
    case Quantity::area:
      return color_by_values(measures.labels(), measures.areas());
    case Quantity::neighbours:
      return color_by_values(measures.labels(), measures.neighbours());
    case Quantity::column:
      return color_by_values(measures.labels(), values);
    default:
      const std::vector<std::uint32_t>& ids = measures.labels_by_id().labels;
      return options_.palette ? color_by_id(ids, measures.grid(), palette_)
                              : color_by_id(ids, measures.grid());
  }
}

cv::Mat Painter::color_by_values(const LabelImage& image, const std::vector<double>& values) {
  const auto fraction = std::find_if_not(values.begin(), values.end(), is_whole_or_none);
  if (is_categorical(palette_) && fraction != values.end()) {
    throw Error(
        fmt::format("{} has the value {}, and --palette okabe-ito is for whole numbers; take viridis, "
                    "turbo or greys",
                    options_.color.column, *fraction));
  }
  if (!whole_values_) whole_values_ = fraction == values.end();
  return color_by_value(image.labels, image.grid, values, scale(range_of(image.labels, values)), palette_);
}

Scale Painter::scale(const std::optional<Scale>& range) {
  if (!scale_) scale_ = range;
  return scale_.value_or(Scale{});
}

void Painter::draw_contour_lines(cv::Mat& picture, const std::vector<float>& distances, Periodic axes) {
  if (!contour_interval_) {
    const double step = round_step({0, range_of(distances).value_or(Scale{0, 0}).high}, most_contours);
    if (step == 0) return;  // no pixel but the seeds'
    contour_interval_ = step;
  }
  draw_contours(picture, distances, *contour_interval_, axes);
}

}  // namespace vorocl::command
