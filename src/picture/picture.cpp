#include "vorocl/picture.hpp"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <string>
#include <unordered_map>

#include "picture/palette.hpp"
#include "vorocl/error.hpp"

namespace vorocl {

namespace {

std::string size_text(int width, int height) {
  return std::to_string(width) + " x " + std::to_string(height);
}

void check_count(std::size_t count, const char* of, int width, int height) {
  if (count != static_cast<std::size_t>(width) * static_cast<std::size_t>(height)) {
    throw Error("there are " + std::to_string(count) + " " + of + " for " + size_text(width, height) +
                " pixels");
  }
}

std::uint8_t srgb_byte(double linear) {
  const double clipped = std::clamp(linear, 0.0, 1.0);
  const double encoded = clipped <= 0.0031308 ? 12.92 * clipped : 1.055 * std::pow(clipped, 1 / 2.4) - 0.055;
  return static_cast<std::uint8_t>(std::lround(255 * encoded));
}

double cube(double number) { return number * number * number; }

/// From Oklab (Ottosson 2020), where equal steps look equally large, in polar coordinates; the hue is in
/// turns.
cv::Vec3b from_oklab(double lightness, double chroma, double hue) {
  const double a = chroma * std::cos(2 * CV_PI * hue), b = chroma * std::sin(2 * CV_PI * hue);
  const double l = cube(lightness + 0.3963377774 * a + 0.2158037573 * b);
  const double m = cube(lightness - 0.1055613458 * a - 0.0638541728 * b);
  const double s = cube(lightness - 0.0894841775 * a - 1.2914855480 * b);
  return {srgb_byte(-0.0041960863 * l - 0.7034186147 * m + 1.7076147010 * s),
          srgb_byte(-1.2684380046 * l + 2.6097574011 * m - 0.3413193965 * s),
          srgb_byte(4.0767416621 * l - 3.3077115913 * m + 0.2309699292 * s)};
}

/// Any hue, at soft lightness and chroma. Each is a multiple of the id modulo 1, by the three irrational
/// factors that spread such points most evenly (1 / g, 1 / g^2, 1 / g^3 with g^4 = g + 1; Roberts 2018): ids
/// near each other get colours far apart, and any set of ids fills the whole range.
cv::Vec3b color_of(std::uint32_t id) {
  const auto spread = [id](std::uint32_t factor) { return static_cast<double>(id * factor) / 4294967296.0; };
  const double hue = spread(0xd1b54a33u), lightness = spread(0xabc98389u), chroma = spread(0x8cb92ba7u);
  return from_oklab(0.60 + 0.28 * lightness, 0.055 + 0.065 * chroma, hue);
}

/// color_of(), which takes long, kept for ids that come again in the next row.
class ColorsOfIds {
 public:
  cv::Vec3b operator()(std::uint32_t id) {
    Entry& entry = entries_[id % entries_.size()];
    if (entry.id != id) entry = {id, color_of(id)};
    return entry.color;
  }

 private:
  struct Entry {
    std::uint32_t id = no_label;
    cv::Vec3b color;
  };
  std::vector<Entry> entries_ = std::vector<Entry>(1u << 16u);
};

/// Calls on_run(begin, end) for each run of pixels with one label: cells are made of few runs.
template <typename OnRun>
void for_each_run(const std::vector<std::uint32_t>& labels, OnRun on_run) {
  for (std::size_t begin = 0, end = 0; begin < labels.size(); begin = end) {
    while (end < labels.size() && labels[end] == labels[begin]) ++end;
    on_run(begin, end);
  }
}

int rows_of(const Window& window) { return static_cast<int>(window.height()); }
int columns_of(const Window& window) { return static_cast<int>(window.width()); }

cv::Mat empty_picture(const Window& window) { return cv::Mat(rows_of(window), columns_of(window), CV_8UC3); }

/// A picture with color(label) in each pixel, and black where there is no label.
template <typename Color>
cv::Mat color_by_label(const std::vector<std::uint32_t>& labels, const Window& window, Color color) {
  check_count(labels.size(), "labels", columns_of(window), rows_of(window));
  cv::Mat picture = empty_picture(window);
  auto* const pixels = picture.ptr<cv::Vec3b>();
  for_each_run(labels, [&](std::size_t begin, std::size_t end) {
    const cv::Vec3b of_run = labels[begin] == no_label ? black : color(labels[begin]);
    std::fill(pixels + begin, pixels + end, of_run);
  });
  return picture;
}

template <typename T>
T entry_of(std::uint32_t label, const std::vector<T>& entries, const char* name) {
  if (label < entries.size()) return entries[label];
  throw Error("the label " + std::to_string(label) + " has no " + name + "; there are " +
              std::to_string(entries.size()));
}

/// A picture with the colour that each label has in a table, and black where there is no label. To look up
/// each pixel takes less time than to foresee where the next run begins.
cv::Mat color_by_entry(const std::vector<std::uint32_t>& labels, const Window& window,
                       const std::vector<cv::Vec3b>& colors, const char* name) {
  check_count(labels.size(), "labels", columns_of(window), rows_of(window));
  cv::Mat picture = empty_picture(window);
  std::transform(labels.begin(), labels.end(), picture.ptr<cv::Vec3b>(), [&](std::uint32_t label) {
    return label == no_label ? black : entry_of(label, colors, name);
  });
  return picture;
}

double value_of(std::uint32_t label, const std::vector<double>& values) {
  return entry_of(label, values, "value");
}

/// The range of the finite values that it is given.
class Range {
 public:
  void add(double value) {
    if (!std::isfinite(value)) return;
    scale_ =
        scale_ ? Scale{std::min(scale_->low, value), std::max(scale_->high, value)} : Scale{value, value};
  }
  const std::optional<Scale>& scale() const { return scale_; }

 private:
  std::optional<Scale> scale_;
};

/// The pixel that comes before or behind one along an axis; none at the border of one that is not periodic.
std::optional<int> neighbour(int at, int step, int size, bool periodic) {
  const int next = at + step;
  if (next >= 0 && next < size) return next;
  return periodic ? std::optional<int>(next < 0 ? size - 1 : 0) : std::nullopt;
}

/// 255 for the pixels whose right or lower neighbour has another label.
cv::Mat thin_edges(const std::vector<std::uint32_t>& labels, const cv::Size& size, Axes axes) {
  cv::Mat edges(size, CV_8U, cv::Scalar(0));
  const auto row = [&](int y) { return labels.data() + static_cast<std::ptrdiff_t>(y) * size.width; };
  for (int y = 0; y < size.height; ++y) {
    const std::uint32_t* const own = row(y);
    const std::uint32_t* const below = row(neighbour(y, 1, size.height, has_y(axes)).value_or(y));
    for (int x = 0; x < size.width; ++x) {
      const int right = x + 1 < size.width ? x + 1 : has_x(axes) ? 0 : x;
      if (own[right] != own[x] || below[x] != own[x]) edges.at<std::uint8_t>(y, x) = 255;
    }
  }
  return edges;
}

/// A filled circle in a square of this many pixels per side.
cv::Mat disk(int diameter) {
  cv::Mat result(diameter, diameter, CV_8U);
  const double centre = (diameter - 1) / 2.0;
  for (int y = 0; y < diameter; ++y) {
    for (int x = 0; x < diameter; ++x) {
      result.at<std::uint8_t>(y, x) = std::hypot(x - centre, y - centre) <= diameter / 2.0 ? 1 : 0;
    }
  }
  return result;
}

/// Edges made this wide; along periodic axes they go on at the other side.
cv::Mat widened(const cv::Mat& edges, int width, Axes axes) {
  const int x = has_x(axes) ? width : 0, y = has_y(axes) ? width : 0;
  cv::Mat padded;
  cv::copyMakeBorder(edges, padded, y, y, x, x, cv::BORDER_WRAP);
  cv::dilate(padded, padded, disk(width));
  return padded(cv::Rect({x, y}, edges.size()));
}

/// How dark borders are in each cell: so much of their colour.
std::unordered_map<std::uint32_t, double> darkness_of_edges(const std::vector<std::uint32_t>& labels) {
  constexpr double faintest = 2, fullest = 8;       // sides of squares
  std::unordered_map<std::uint32_t, double> cells;  // first their areas
  for_each_run(labels, [&](std::size_t begin, std::size_t end) {
    cells[labels[begin]] += static_cast<double>(end - begin);
  });
  for (auto& [label, value] : cells) {
    const double faded = (std::sqrt(value) - faintest) / (fullest - faintest);
    value = label == no_label ? 1 : std::clamp(faded, 0.0, 1.0);
  }
  return cells;
}

/// Draws the edges of a mask into the cells that they are in.
void draw_mask(cv::Mat& picture, const cv::Mat& edges, const std::vector<std::uint32_t>& labels) {
  const std::unordered_map<std::uint32_t, double> darkness = darkness_of_edges(labels);
  for_each_run(labels, [&](std::size_t begin, std::size_t end) {
    const double part = darkness.at(labels[begin]);
    for (std::size_t i = begin; i < end; ++i) {
      const auto at = static_cast<int>(i);
      const int y = at / picture.cols, x = at % picture.cols;
      if (edges.at<std::uint8_t>(y, x) == 0) continue;
      auto& pixel = picture.at<cv::Vec3b>(y, x);
      pixel = cv::Vec3b(cv::Vec3d(pixel) + part * (cv::Vec3d(dark) - cv::Vec3d(pixel)));
    }
  });
}

/// The colour of a thin line on this one.
cv::Vec3b line_on(const cv::Vec3b& color) {
  const bool is_bright = 0.114 * color[0] + 0.587 * color[1] + 0.299 * color[2] > 110;
  return is_bright ? dark : light;
}

}  // namespace

std::optional<Scale> range_of(const std::vector<std::uint32_t>& labels, const std::vector<double>& values) {
  Range range;
  for_each_run(labels, [&](std::size_t begin, std::size_t) {
    if (labels[begin] != no_label) range.add(value_of(labels[begin], values));
  });
  return range.scale();
}

std::optional<Scale> range_of(const std::vector<float>& distances) {
  Range range;
  for (const float distance : distances) range.add(static_cast<double>(distance));
  return range.scale();
}

cv::Mat color_by_id(const std::vector<std::uint32_t>& labels, const Window& window) {
  ColorsOfIds colors;
  return color_by_label(labels, window, [&](std::uint32_t label) { return colors(label); });
}

cv::Mat color_by_id(const std::vector<std::uint32_t>& labels, const Window& window, Palette palette) {
  if (!is_categorical(palette)) throw Error("ids are coloured by a categorical palette, such as okabe_ito");
  return color_by_label(labels, window, categorical_color);
}

cv::Mat color_by_seed(const std::vector<std::uint32_t>& labels, const Window& window,
                      const std::vector<cv::Vec3b>& colors) {
  return color_by_entry(labels, window, colors, "colour");
}

cv::Mat color_by_value(const std::vector<std::uint32_t>& labels, const Window& window,
                       const std::vector<double>& values, const Scale& scale, Palette palette) {
  std::vector<cv::Vec3b> colors(values.size());
  std::transform(values.begin(), values.end(), colors.begin(), Colors(scale, palette));
  return color_by_entry(labels, window, colors, "value");
}

cv::Mat color_by_distance(const std::vector<float>& distances, const Window& window, const Scale& scale,
                          Palette palette) {
  if (is_categorical(palette))
    throw Error("distances are coloured by a palette of quantities, such as viridis");
  const Colors colors(scale, palette);
  check_count(distances.size(), "distances", columns_of(window), rows_of(window));
  cv::Mat picture = empty_picture(window);
  std::transform(distances.begin(), distances.end(), picture.begin<cv::Vec3b>(), [&](float distance) {
    return std::isinf(distance) ? black : colors(static_cast<double>(distance));
  });
  return picture;
}

void draw_edges(cv::Mat& picture, const std::vector<std::uint32_t>& labels, int width, Axes axes) {
  check_picture(picture);
  check_count(labels.size(), "labels", picture.cols, picture.rows);
  if (width < 1 || width > widest_edge) {
    throw Error("edges cannot be " + std::to_string(width) + " pixels wide; they are 1 to " +
                std::to_string(widest_edge));
  }
  const cv::Mat edges = thin_edges(labels, picture.size(), axes);
  draw_mask(picture, width > 1 ? widened(edges, width, axes) : edges, labels);
}

void draw_contours(cv::Mat& picture, const std::vector<float>& distances, double interval, Axes axes) {
  check_picture(picture);
  check_count(distances.size(), "distances", picture.cols, picture.rows);
  if (!(interval > 0 && std::isfinite(interval))) {
    throw Error("contours cannot be " + std::to_string(interval) + " pixels apart");
  }
  const cv::Mat field(picture.rows, picture.cols, CV_32F, const_cast<float*>(distances.data()));
  const auto band = [&](int y, int x) {
    return std::floor(static_cast<double>(field.at<float>(y, x)) / interval);
  };
  for (int y = 0; y < picture.rows; ++y) {
    for (int x = 0; x < picture.cols; ++x) {
      const double here = band(y, x);
      if (!std::isfinite(here)) continue;
      const auto is_lower = [&](int dx, int dy) {
        const auto next_x = neighbour(x, dx, picture.cols, has_x(axes));
        const auto next_y = neighbour(y, dy, picture.rows, has_y(axes));
        return next_x && next_y && band(*next_y, *next_x) < here;
      };
      const bool is_on_line = is_lower(-1, 0) || is_lower(0, -1) || is_lower(1, 0) || is_lower(0, 1);
      auto& pixel = picture.at<cv::Vec3b>(y, x);
      if (is_on_line) pixel = line_on(pixel);
    }
  }
}

void draw_points(cv::Mat& picture, const std::vector<Point>& seeds) {
  draw_points(picture, std::vector<std::optional<Point>>(seeds.begin(), seeds.end()));
}

void draw_points(cv::Mat& picture, const std::vector<std::optional<Point>>& seeds) {
  check_picture(picture);
  std::vector<cv::Point> pixels;
  for (std::size_t id = 0; id < seeds.size(); ++id) {
    if (!seeds[id]) continue;
    const Point& seed = *seeds[id];
    if (!(seed.x >= 0 && seed.x < picture.cols && seed.y >= 0 && seed.y < picture.rows)) {
      throw Error("seed " + std::to_string(id) + " at (" + std::to_string(seed.x) + ", " +
                  std::to_string(seed.y) + ") is outside the picture of " +
                  size_text(picture.cols, picture.rows));
    }
    pixels.emplace_back(static_cast<int>(seed.x), static_cast<int>(seed.y));
  }
  // A dot may cover about a fiftieth of a mean cell, so that the cells stay visible.
  const double mean_side =
      std::sqrt(static_cast<double>(picture.total()) / static_cast<double>(pixels.size()));
  const int radius = static_cast<int>(std::clamp(mean_side / 12, 0.0, 4.0));
  const auto draw_disks = [&](int disk_radius, const cv::Vec3b& color) {
    for (const cv::Point& pixel : pixels) {
      cv::circle(picture, pixel, disk_radius, color, cv::FILLED, cv::LINE_AA);
      picture.at<cv::Vec3b>(pixel) = color;  // a circle of radius 0 is nothing
    }
  };
  if (radius >= 2) draw_disks(radius + 1, light);  // all rims first: they must not hide another seed's dot
  draw_disks(radius, dark);
}

}  // namespace vorocl
