#include "vorocl/picture.hpp"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <string>
#include <unordered_map>

#include "vorocl/error.hpp"

namespace vorocl {

namespace {

const cv::Vec3b black(0, 0, 0);
const cv::Vec3b dark(32, 28, 26);
const cv::Vec3b light(250, 250, 250);

std::string size_text(int width, int height) {
  return std::to_string(width) + " x " + std::to_string(height);
}

void check_count(const std::vector<std::uint32_t>& labels, int width, int height) {
  if (labels.size() != static_cast<std::size_t>(width) * static_cast<std::size_t>(height)) {
    throw Error("there are " + std::to_string(labels.size()) + " labels for " + size_text(width, height) +
                " pixels");
  }
}

void check_picture(const cv::Mat& picture) {
  if (picture.type() != CV_8UC3)
    throw Error("the picture to draw into must have 3 channels of 8 bits (CV_8UC3)");
}

std::uint8_t srgb_byte(double linear) {
  const double clipped = std::clamp(linear, 0.0, 1.0);
  const double encoded = clipped <= 0.0031308 ? 12.92 * clipped : 1.055 * std::pow(clipped, 1 / 2.4) - 0.055;
  return static_cast<std::uint8_t>(std::lround(255 * encoded));
}

/// From Oklab (Ottosson 2020), where equal steps look equally large, in polar coordinates; the hue is in
/// turns.
cv::Vec3b from_oklab(double lightness, double chroma, double hue) {
  const double a = chroma * std::cos(2 * CV_PI * hue), b = chroma * std::sin(2 * CV_PI * hue);
  const double l = std::pow(lightness + 0.3963377774 * a + 0.2158037573 * b, 3);
  const double m = std::pow(lightness - 0.1055613458 * a - 0.0638541728 * b, 3);
  const double s = std::pow(lightness - 0.0894841775 * a - 1.2914855480 * b, 3);
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

bool is_present(const Point& seed) { return !std::isnan(seed.x); }

double distance(const Point& seed, int x, int y, Metric metric) {
  const double dx = std::floor(seed.x) - x, dy = std::floor(seed.y) - y;
  return metric == Metric::euclidean ? std::hypot(dx, dy) : std::abs(dx) + std::abs(dy);
}

}  // namespace

cv::Mat color_by_id(const std::vector<std::uint32_t>& labels, const Grid& grid) {
  check_count(labels, grid.width(), grid.height());
  cv::Mat picture(grid.height(), grid.width(), CV_8UC3);
  std::unordered_map<std::uint32_t, cv::Vec3b> colors = {{no_label, black}};
  std::uint32_t last = no_label;
  cv::Vec3b color = black;
  auto label = labels.begin();
  for (auto pixel = picture.begin<cv::Vec3b>(); pixel != picture.end<cv::Vec3b>(); ++pixel, ++label) {
    if (*label != last) {  // cells are runs of one label: few pixels get here
      last = *label;
      const auto found = colors.find(last);
      color = found != colors.end() ? found->second : colors.emplace(last, color_of(last)).first->second;
    }
    *pixel = color;
  }
  return picture;
}

cv::Mat color_by_distance(const std::vector<std::uint32_t>& labels, const Grid& grid,
                          const std::vector<Point>& seeds, Metric metric, Palette palette) {
  check_count(labels, grid.width(), grid.height());
  cv::Mat distances(grid.height(), grid.width(), CV_32F, cv::Scalar(0));
  cv::Mat unlabelled(grid.height(), grid.width(), CV_8U, cv::Scalar(0));
  auto label = labels.begin();
  for (int y = 0; y < grid.height(); ++y) {
    for (int x = 0; x < grid.width(); ++x, ++label) {
      if (*label == no_label) {
        unlabelled.at<std::uint8_t>(y, x) = 1;
      } else if (*label < seeds.size() && is_present(seeds[*label])) {
        distances.at<float>(y, x) = static_cast<float>(distance(seeds[*label], x, y, metric));
      } else {
        throw Error("the label " + std::to_string(*label) + " at (" + std::to_string(x) + ", " +
                    std::to_string(y) + ") names no seed");
      }
    }
  }
  double largest = 0;
  cv::minMaxLoc(distances, nullptr, &largest);
  cv::Mat levels, picture;
  distances.convertTo(levels, CV_8U, largest > 0 ? 255 / largest : 0);
  cv::applyColorMap(levels, picture, palette == Palette::viridis ? cv::COLORMAP_VIRIDIS : cv::COLORMAP_TURBO);
  picture.setTo(black, unlabelled);
  return picture;
}

void draw_edges(cv::Mat& picture, const std::vector<std::uint32_t>& labels) {
  check_picture(picture);
  check_count(labels, picture.cols, picture.rows);
  const auto width = static_cast<std::size_t>(picture.cols);
  const std::uint32_t* label = labels.data();
  for (int y = 0; y < picture.rows; ++y) {
    for (int x = 0; x < picture.cols; ++x, ++label) {
      const bool right_differs = x + 1 < picture.cols && label[1] != label[0];
      const bool lower_differs = y + 1 < picture.rows && label[width] != label[0];
      if (right_differs || lower_differs) picture.at<cv::Vec3b>(y, x) = dark;
    }
  }
}

void draw_points(cv::Mat& picture, const std::vector<Point>& seeds) {
  check_picture(picture);
  std::vector<cv::Point> pixels;
  for (std::size_t id = 0; id < seeds.size(); ++id) {
    const Point& seed = seeds[id];
    if (!is_present(seed)) continue;
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
