#include "app/outputs/painter.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <utility>

#include "app/terminal/console.hpp"
#include "vorocl/error.hpp"

namespace vorocl::command {

namespace {

constexpr int most_contours = 10;

bool is_whole_or_none(double value) { return !std::isfinite(value) || value == std::round(value); }

cv::Mat enlarged(const cv::Mat& image, int factor) {
  if (factor == 1) return image;
  cv::Mat result;
  cv::resize(image, result, {}, factor, factor, cv::INTER_NEAREST);
  return result;
}

/// Labels or distances of an image.
template <typename T>
std::vector<T> enlarged(std::vector<T> image, const Size& size, int factor) {
  static_assert(sizeof(T) == sizeof(std::int32_t));
  if (factor == 1) return image;
  const cv::Mat result = enlarged(cv::Mat(size.height(), size.width(), CV_32SC1, image.data()), factor);
  return {result.ptr<T>(), result.ptr<T>() + result.total()};
}

std::vector<std::optional<Point>> enlarged(std::vector<std::optional<Point>> points, int factor) {
  for (std::optional<Point>& point : points) {
    if (point) point = {point->x * factor, point->y * factor};
  }
  return points;
}

/// Without the seeds outside the diagram.
std::vector<std::optional<Point>> in_diagram(std::vector<std::optional<Point>> points, const Size& size) {
  for (std::optional<Point>& point : points) {
    if (point && !size.holds(*point)) point.reset();
  }
  return points;
}

/// Of sorted values, with linear interpolation between them.
double percentile(const std::vector<double>& sorted, double percent) {
  const double place = percent / 100 * static_cast<double>(sorted.size() - 1);
  const auto below = static_cast<std::size_t>(place);
  const std::size_t above = std::min(below + 1, sorted.size() - 1);
  return sorted[below] + (place - static_cast<double>(below)) * (sorted[above] - sorted[below]);
}

/// The values of the labels that an image has, each once.
std::vector<double> shown(const std::vector<std::uint32_t>& labels, const std::vector<double>& values) {
  std::vector<bool> is_there(values.size());
  for (const std::uint32_t label : labels) {
    if (label != no_label) is_there.at(label) = true;
  }
  std::vector<double> result;
  for (std::size_t label = 0; label < values.size(); ++label) {
    if (is_there[label]) result.push_back(values[label]);
  }
  return result;
}

std::string title_of(const Coloring& color, const Units& units) {
  switch (color.quantity) {
    case Quantity::distance:
      return fmt::format("distance ({})", units.length_title());
    case Quantity::area:
      return fmt::format("area ({})", units.area_title());
    case Quantity::neighbours:
      return "neighbours";
    default:
      return color.column;
  }
}

/// Around the picture of a diagram it is as where there is no label.
cv::Mat in_picture(const cv::Mat& of_diagram, const View& view, int factor) {
  if (view.fills_picture()) return of_diagram;
  const Size& size = view.picture.size;
  cv::Mat result(size.height() * factor, size.width() * factor, of_diagram.type(), cv::Scalar::all(0));
  of_diagram.copyTo(result(cv::Rect({view.x * factor, view.y * factor}, of_diagram.size())));
  return result;
}

/// The plane of a slice: x and y of a slice across z, x and z across y, y and z across x.
struct Plane {
  Size size;
  std::size_t first, along_row, along_column;  // of its pixels in the volume
  bool is_periodic_x, is_periodic_y;

  Grid grid() const { return size.grid(axes_of(is_periodic_x, is_periodic_y)); }
};

Plane plane_of(const Grid& grid, const VolumeSlice& slice) {
  const auto width = static_cast<std::size_t>(grid.width()), at = static_cast<std::size_t>(slice.at);
  const std::size_t area = width * static_cast<std::size_t>(grid.height());
  // Of a tilted box the last row, or slice, does not lie on the first one: no line is drawn between them.
  const bool x = grid.x().is_periodic(), y = grid.y().is_periodic() && grid.tilt() == 0,
             z = grid.z().is_periodic() && grid.tilt_xz() == 0 && grid.tilt_yz() == 0;
  if (slice.axis == 'x') return {{grid.height(), grid.depth()}, at, width, area, y, z};
  if (slice.axis == 'y') return {{grid.width(), grid.depth()}, at * width, 1, area, x, z};
  return {{grid.width(), grid.height()}, at * area, 1, width, x, y};
}

std::vector<std::uint32_t> labels_in(const Plane& plane, const std::vector<std::uint32_t>& labels) {
  const auto columns = static_cast<std::size_t>(plane.size.width()),
             rows = static_cast<std::size_t>(plane.size.height());
  std::vector<std::uint32_t> of_slice;
  of_slice.reserve(columns * rows);
  for (std::size_t row = 0; row < rows; ++row) {
    for (std::size_t column = 0; column < columns; ++column) {
      of_slice.push_back(labels[plane.first + row * plane.along_column + column * plane.along_row]);
    }
  }
  return of_slice;
}

/// The seeds in the slice; the others are absent.
std::vector<std::optional<Point>> seeds_in(const VolumeSlice& slice,
                                           const std::vector<std::optional<Point>>& voxels) {
  std::vector<std::optional<Point>> points;
  for (const std::optional<Point>& voxel : voxels) {
    std::optional<Point>& point = points.emplace_back();
    if (!voxel) continue;
    const double across = slice.axis == 'x' ? voxel->x : slice.axis == 'y' ? voxel->y : voxel->z;
    if (static_cast<std::int64_t>(across) != slice.at) continue;
    point = slice.axis == 'x'   ? Point{voxel->y, voxel->z}
            : slice.axis == 'y' ? Point{voxel->x, voxel->z}
                                : Point{voxel->x, voxel->y};
  }
  return points;
}

/// The labels in a slice, and if asked for the seeds, as those of a plane. Reads those of the volume from the
/// device, if they were not read before, and needs nothing else of it. The buffers must live as long.
Measures in_slice(Measures& volume, const VolumeSlice& slice, bool with_seeds, MeasureBuffers& buffers) {
  const Plane plane = plane_of(volume.view().window.grid(), slice);
  std::vector<std::optional<Point>> seeds;
  if (with_seeds) seeds = seeds_in(slice, volume.seeds());
  return {
      {plane.size, plane.grid()}, labels_in(plane, volume.labels()), std::move(seeds), volume.ids(), buffers};
}

}  // namespace

std::int64_t slices_along(const Grid& grid, char axis) {
  return axis == 'x' ? grid.width() : axis == 'y' ? grid.height() : grid.depth();
}

Size size_of_slice(const Grid& grid, const VolumeSlice& slice) { return plane_of(grid, slice).size; }

std::string stamp_of(int frame, const std::optional<std::int64_t>& timestep) {
  return fmt::format("frame {}", frame) + (timestep ? fmt::format(", step {}", *timestep) : "");
}

Painter::Painter(const PictureOptions& options, bool many)
    : options_(options),
      many_(many),
      palette_(options.palette.value_or(Palette::viridis)),
      contour_interval_(options.contour_interval) {}

void Painter::read(Measures& measures) const {
  if (options_.slice) {
    measures.labels();
    if (options_.points_overlay) measures.seeds();
    return;
  }
  const Quantity quantity = options_.color.quantity;
  if (quantity == Quantity::area) measures.pixels();
  if (quantity == Quantity::neighbours) measures.neighbours();
  if (quantity == Quantity::distance || options_.contours) measures.distances();
  if (quantity != Quantity::distance || options_.edge_width > 0) measures.labels();
  if (options_.points_overlay) measures.seeds();
}

cv::Mat Painter::draw(Measures& measures, const ColumnValues& values, const std::string& stamp) {
  if (!options_.slice) return draw_plane(measures, values, stamp);
  MeasureBuffers buffers;
  Measures of_slice = in_slice(measures, *options_.slice, options_.points_overlay, buffers);
  return draw_plane(of_slice, values, stamp);
}

cv::Mat Painter::draw_plane(Measures& measures, const ColumnValues& values, const std::string& stamp) {
  const View& view = measures.view();
  const Size size = view.size();
  // As plane_of() has it.
  const Window& window = view.window;
  const Axes axes = window.grid().is_tilted() && has_x(window.periodic()) ? Axes::x : window.periodic();
  const int enlargement = options_.enlargement;
  cv::Mat picture = enlarged(color(measures, values), enlargement);
  if (options_.contours) draw_contour_lines(picture, enlarged(measures.distances(), size, enlargement), axes);
  if (options_.edge_width > 0) {
    draw_edges(picture, enlarged(measures.labels(), size, enlargement), options_.edge_width, axes);
  }
  if (options_.points_overlay)
    draw_points(picture, enlarged(in_diagram(measures.seeds(), size), enlargement));
  picture = in_picture(picture, view, enlargement);
  if (options_.stamp) draw_text(picture, stamp);
  if (!options_.color_bar) return picture;
  if (!scale_) throw Error("there is no value for the colour bar to show; give --scale LOW,HIGH");
  return with_color_bar(
      picture, {*scale_, palette_, title_of(options_.color, view.units), whole_values_.value_or(false),
                many_ || options_.scale.has_value(), values.texts});
}

bool Painter::is_independent() const {
  const Quantity quantity = options_.color.quantity;
  const bool has_scale = quantity == Quantity::id || scale_;
  const bool has_numbers = quantity == Quantity::id || quantity == Quantity::distance || whole_values_;
  return has_scale && has_numbers && (!options_.contours || contour_interval_);
}

cv::Mat Painter::color(Measures& measures, const ColumnValues& values) {
  switch (options_.color.quantity) {
    case Quantity::distance: {
      const std::vector<float> distances = measures.view().units.lengths(measures.distances());
      const Scale of_all = scale([&] { return std::vector<double>(distances.begin(), distances.end()); });
      watch(distances);
      return color_by_distance(distances, measures.view().window, of_all, palette_);
    }
    case Quantity::area:
      return color_by_values(measures, measures.areas());
    case Quantity::neighbours:
      return color_by_values(measures, {measures.neighbours().begin(), measures.neighbours().end()});
    case Quantity::column:
      return values.texts.empty() ? color_by_values(measures, values.numbers)
                                  : color_by_text(measures, values);
    default:
      return color_by_id(measures);
  }
}

cv::Mat Painter::color_by_id(Measures& measures) {
  const auto color = [this](const std::vector<std::uint32_t>& ids, const Window& window) {
    return options_.palette ? vorocl::color_by_id(ids, window, palette_) : vorocl::color_by_id(ids, window);
  };
  const std::vector<std::uint32_t>& ids = measures.ids();
  const Window& window = measures.view().window;
  if (ids.empty()) return color(measures.labels(), window);
  // A label mostly has the id that it had in the last picture.
  colored_ids_.resize(ids.size(), no_label);
  colors_of_ids_.resize(ids.size());
  std::vector<std::uint32_t> changed, their_ids;
  for (std::uint32_t label = 0; label < ids.size(); ++label) {
    if (ids[label] == colored_ids_[label]) continue;
    changed.push_back(label);
    their_ids.push_back(ids[label]);
  }
  if (!changed.empty()) {
    const cv::Mat_<cv::Vec3b> row = color(their_ids, Grid(static_cast<std::int64_t>(changed.size()), 1));
    for (std::size_t i = 0; i < changed.size(); ++i) colors_of_ids_[changed[i]] = row(0, static_cast<int>(i));
    colored_ids_ = ids;
  }
  return color_by_seed(measures.labels(), window, colors_of_ids_);
}

cv::Mat Painter::color_by_text(Measures& measures, const ColumnValues& values) {
  if (options_.scale || options_.logarithmic)
    throw Error(options_.color.column + " has texts, and --scale and --log are for numbers");
  palette_ = options_.palette.value_or(Palette::okabe_ito);
  const std::size_t texts = values.texts.size();
  if (texts > 8 && is_categorical(palette_) && !std::exchange(omission_noted_, true)) {
    print_note(fmt::format("{} has {} texts, and okabe-ito 8 colours, which recur; --palette turbo has more",
                           options_.color.column, texts));
  }
  if (!scale_) scale_ = {0, static_cast<double>(texts - 1)};
  late_texts_.assign(values.texts.begin() + static_cast<std::ptrdiff_t>(scale_->high) + 1,
                     values.texts.end());
  whole_values_ = true;
  return color_by_value(measures.labels(), measures.view().size().grid(), values.numbers, *scale_, palette_);
}

cv::Mat Painter::color_by_values(Measures& measures, const std::vector<double>& values) {
  const auto fraction = std::find_if_not(values.begin(), values.end(), is_whole_or_none);
  if (is_categorical(palette_) && fraction != values.end()) {
    throw Error(
        fmt::format("{} has the value {}, and --palette okabe-ito is for whole numbers; take viridis, "
                    "turbo or greys",
                    options_.color.column, *fraction));
  }
  if (!whole_values_) whole_values_ = fraction == values.end();
  const Scale of_all = scale([&] { return shown(measures.labels(), values); });
  watch(values);
  return color_by_value(measures.labels(), measures.view().size().grid(), values, of_all, palette_);
}

Scale Painter::scale(const std::function<std::vector<double>()>& values) {
  if (scale_) return *scale_;
  std::vector<double> shown = values();
  const auto is_absent = [](double value) { return !std::isfinite(value); };
  shown.erase(std::remove_if(shown.begin(), shown.end(), is_absent), shown.end());
  if (options_.logarithmic) {
    const std::size_t all = shown.size();
    shown.erase(std::remove_if(shown.begin(), shown.end(), [](double value) { return value <= 0; }),
                shown.end());
    if (shown.size() < all && !std::exchange(omission_noted_, true)) {
      print_note(
          fmt::format("{} of {} values are 0 or less; a logarithmic scale leaves them out, and they are grey",
                      all - shown.size(), all));
    }
  }
  if (options_.scale && !options_.scale->percent) {
    scale_ = {options_.scale->low, options_.scale->high};
  } else if (!shown.empty() && options_.scale) {
    std::sort(shown.begin(), shown.end());
    scale_ = {percentile(shown, options_.scale->low), percentile(shown, options_.scale->high)};
  } else if (!shown.empty()) {
    const auto [low, high] = std::minmax_element(shown.begin(), shown.end());
    scale_ = {*low, *high};
  }
  if (scale_) scale_->logarithmic = options_.logarithmic;
  return scale_.value_or(Scale{1, 1, options_.logarithmic});  // there is no value, or none that is shown
}

template <typename T>
void Painter::watch(const std::vector<T>& values) {
  if (!many_ || !scale_ || (options_.scale && !options_.scale->percent)) return;
  if (!seen_) seen_ = scale_;
  const bool has_size =
      options_.logarithmic || options_.color.quantity == Quantity::area;  // else it is not shown
  std::size_t all = 0, beyond = 0;
  for (const T of_any : values) {
    const auto value = static_cast<double>(of_any);
    if (!std::isfinite(value) || (has_size && value <= 0)) continue;
    ++all;
    beyond += value < scale_->low || value > scale_->high ? 1 : 0;
    seen_->low = std::min(seen_->low, value);
    seen_->high = std::max(seen_->high, value);
  }
  is_beyond_ = is_beyond_ || 2 * beyond > all;
}

void Painter::note_of_scale() const {
  const bool have_colors = is_categorical(palette_);
  if (!late_texts_.empty() && (options_.color_bar || !have_colors)) {
    print_note(fmt::format("the first picture does not have {}: {}", fmt::join(late_texts_, ", "),
                           have_colors ? "they have colours, but no names on the colour bar"
                                       : "they have the colour of its last text, unlike with "
                                         "--palette okabe-ito"));
  }
  if (!is_beyond_) return;
  print_note(
      fmt::format("the colours are by the values of the first picture, {:.4g} to {:.4g}, and another has "
                  "more than half of its own "
                  "beyond them; --scale {:.4g},{:.4g} holds all",
                  scale_->low, scale_->high, seen_->low, seen_->high));
}

void Painter::draw_contour_lines(cv::Mat& picture, const std::vector<float>& distances, Axes axes) {
  if (!contour_interval_) {
    const double step = round_step({0, range_of(distances).value_or(Scale{0, 0}).high}, most_contours);
    if (step == 0) return;  // no pixel but the seeds'
    contour_interval_ = step;
  }
  draw_contours(picture, distances, *contour_interval_, axes);
}

}  // namespace vorocl::command
