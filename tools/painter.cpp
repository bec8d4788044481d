#include "painter.hpp"

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

std::vector<Point> enlarged(std::vector<Point> points, int factor) {
  for (Point& point : points) point = {point.x * factor, point.y * factor};
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

Painter::Painter(const PictureOptions& options, Metric metric, bool many)
    : options_(options),
      metric_(metric),
      many_(many),
      palette_(options.palette.value_or(Palette::viridis)),
      scale_(options.scale),
      contour_interval_(options.contour_interval) {}

cv::Mat Painter::draw(const Scene& scene) {
  if (options_.contours || options_.color.quantity == Quantity::distance) {
    distance_field(scene.seeds, scene.diagram, distance_field_, metric_);
    distances_ = distance_field_.read();
  }
  const Grid& grid = scene.image.grid;
  const int enlargement = options_.enlargement;
  cv::Mat picture = enlarged(color(scene), enlargement);
  if (options_.contours) draw_contour_lines(picture, enlarged(distances_, grid, enlargement));
  if (options_.edge_width > 0) {
    draw_edges(picture, enlarged(scene.image.labels, grid, enlargement), options_.edge_width);
  }
  if (options_.points_overlay) draw_points(picture, enlarged(scene.seeds.read(), enlargement));
  if (!options_.color_bar) return picture;
  if (!scale_) throw Error("there is no value yet for the colour bar to show; give --scale LOW,HIGH");
  return with_color_bar(picture, {*scale_, palette_, title_of(options_.color), whole_values_.value_or(false),
                                  many_ || options_.scale.has_value()});
}

cv::Mat Painter::color(const Scene& scene) {
  const LabelImage& named = scene.named;
  switch (options_.color.quantity) {
    case Quantity::distance:
      return color_by_distance(distances_, named.grid, scale(range_of(distances_)), palette_);
    case Quantity::area:
      return color_by_values(scene, areas(scene));
    case Quantity::neighbours:
      return color_by_values(scene, neighbours(scene));
    case Quantity::column:
      return color_by_values(scene, scene.values);
    default:
      return options_.palette ? color_by_id(named.labels, named.grid, palette_)
                              : color_by_id(named.labels, named.grid);
  }
}

cv::Mat Painter::color_by_values(const Scene& scene, const std::vector<double>& values) {
  const auto fraction = std::find_if_not(values.begin(), values.end(), is_whole_or_none);
  if (is_categorical(palette_) && fraction != values.end()) {
    throw Error(
        fmt::format("{} has the value {}, and --palette okabe-ito is for whole numbers; take viridis, "
                    "turbo or greys",
                    options_.color.column, *fraction));
  }
  const std::vector<std::uint32_t>& labels = scene.image.labels;
  if (!whole_values_) whole_values_ = fraction == values.end();
  return color_by_value(labels, scene.image.grid, values, scale(range_of(labels, values)), palette_);
}

std::vector<double> Painter::areas(const Scene& scene) {
  cell_sums(scene.seeds, scene.diagram, cell_sums_);
  std::vector<double> areas;
  for (const CellSums& sums : cell_sums_.read()) areas.push_back(sums.area);
  return areas;
}

std::vector<double> Painter::neighbours(const Scene& scene) {
  adjacency(scene.seeds, scene.diagram, adjacency_);
  const std::vector<std::uint32_t> counts = adjacency_.read_neighbours();
  return {counts.begin(), counts.end()};
}

Scale Painter::scale(const std::optional<Scale>& range) {
  if (!scale_) scale_ = range;
  return scale_.value_or(Scale{});
}

void Painter::draw_contour_lines(cv::Mat& picture, const std::vector<float>& distances) {
  if (!contour_interval_) {
    const double step = round_step({0, range_of(distances_).value_or(Scale{0, 0}).high}, most_contours);
    if (step == 0) return;  // no pixel but the seeds'
    contour_interval_ = step;
  }
  draw_contours(picture, distances, *contour_interval_);
}

}  // namespace vorocl::command
