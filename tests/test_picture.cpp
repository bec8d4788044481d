// Pictures: colours by id and by distance, edges, dots.
#define BOOST_TEST_MODULE picture
#include <algorithm>
#include <cmath>
#include <limits>
#include <opencv2/imgproc.hpp>
#include <set>

#include "brute_force.hpp"
#include "fixture.hpp"
#include "vorocl/picture.hpp"

using namespace vorocl;

namespace {

const cv::Vec3b black(0, 0, 0);
const double not_a_number = std::numeric_limits<double>::quiet_NaN();

cv::Vec3b color_of(std::uint32_t id) { return color_by_id({id}, Grid(1, 1)).at<cv::Vec3b>(0, 0); }

/// In CIELAB, where 2.3 is a just noticeable difference.
cv::Vec3f lab(const cv::Vec3b& color) {
  cv::Mat value(1, 1, CV_32FC3, cv::Vec3f(color) / 255), result;
  cv::cvtColor(value, result, cv::COLOR_BGR2Lab);
  return result.at<cv::Vec3f>(0, 0);
}

double difference(const cv::Vec3b& a, const cv::Vec3b& b) { return cv::norm(lab(a) - lab(b)); }

int brightness(const cv::Vec3b& color) { return color[0] + color[1] + color[2]; }

}  // namespace

BOOST_AUTO_TEST_CASE(each_pixel_gets_the_colour_of_its_id) {
  const std::vector<std::uint32_t> labels = {7, 7, no_label, 4000000000u, 7, 0};
  const cv::Mat picture = color_by_id(labels, Grid(3, 2));
  BOOST_TEST(picture.type() == CV_8UC3);
  BOOST_REQUIRE(picture.size() == cv::Size(3, 2));
  for (int i = 0; i < 6; ++i) {
    const std::uint32_t label = labels[static_cast<std::size_t>(i)];
    BOOST_TEST((picture.at<cv::Vec3b>(i / 3, i % 3) == (label == no_label ? black : color_of(label))),
               "pixel " << i);
  }
}

BOOST_AUTO_TEST_CASE(ids_near_each_other_are_easily_told_apart) {
  for (const std::uint32_t first : {0u, 5000u, 3000000000u}) {
    for (std::uint32_t id = first; id < first + 200; ++id) {
      for (std::uint32_t other = id + 1; other < id + 8; ++other) {
        BOOST_TEST(difference(color_of(id), color_of(other)) > 8, id << " and " << other);
      }
    }
  }
}

BOOST_AUTO_TEST_CASE(neighbours_in_a_diagram_are_told_apart) {
  const Grid grid(120, 90);
  const std::vector<std::uint32_t> labels = brute_force(grid, random_pixels(grid, 300, 5), Metric::euclidean);
  int borders = 0, alike = 0;
  for (std::size_t i = 0; i + 1 < labels.size(); ++i) {
    if (labels[i] == labels[i + 1]) continue;
    ++borders;
    alike += difference(color_of(labels[i]), color_of(labels[i + 1])) < 5 ? 1 : 0;
  }
  BOOST_TEST(borders > 1000);
  BOOST_TEST(alike * 100 < borders);  // under one in a hundred
}

BOOST_AUTO_TEST_CASE(colours_have_every_hue_and_are_neither_dark_nor_neon) {
  std::set<int> hues;
  for (std::uint32_t id = 0; id < 2000; ++id) {
    const cv::Vec3f value = lab(color_of(id));
    const double chroma = std::hypot(value[1], value[2]);
    BOOST_TEST((value[0] > 45 && value[0] < 92 && chroma > 10 && chroma < 65), "id " << id << ": " << value);
    hues.insert(static_cast<int>(std::floor((std::atan2(value[2], value[1]) + CV_PI) / (2 * CV_PI) * 11.99)));
  }
  BOOST_TEST(hues.size() == 12u);
}

BOOST_AUTO_TEST_CASE(distances_run_through_the_palette) {
  // One seed at the left: the distances are 0 to 255, and the levels are those of the palette, one by one.
  const Grid grid(256, 1);
  cv::Mat levels(1, 256, CV_8U), expected;
  for (int x = 0; x < 256; ++x) levels.at<std::uint8_t>(0, x) = static_cast<std::uint8_t>(x);
  for (const Palette palette : {Palette::viridis, Palette::turbo}) {
    cv::applyColorMap(levels, expected,
                      palette == Palette::viridis ? cv::COLORMAP_VIRIDIS : cv::COLORMAP_TURBO);
    const std::vector<std::uint32_t> labels(256, 0);
    const cv::Mat picture = color_by_distance(labels, grid, {{0.9, 0.1}}, Metric::euclidean, palette);
    BOOST_TEST(cv::norm(picture, expected, cv::NORM_INF) == 0);
  }
}

BOOST_AUTO_TEST_CASE(distances_are_those_of_the_metric) {
  // From (0, 0) both (5, 5) and (7, 0) of an 8 x 6 grid: 7.07 and 7 for one metric, 10 and 7 for the other.
  const Grid grid(8, 6);
  const std::vector<std::uint32_t> labels(48, 1);
  const std::vector<Point> seeds = {{3, 3}, {0.5, 0.5}};
  const auto same_level = [&](Metric metric) {
    const cv::Mat picture = color_by_distance(labels, grid, seeds, metric, Palette::viridis);
    return brightness(picture.at<cv::Vec3b>(5, 5)) - brightness(picture.at<cv::Vec3b>(0, 7));
  };
  BOOST_TEST(std::abs(same_level(Metric::euclidean)) < 10);
  BOOST_TEST(same_level(Metric::manhattan) > 50);
}

BOOST_AUTO_TEST_CASE(a_picture_of_distances_may_have_gaps_or_no_distance_at_all) {
  const cv::Mat gap =
      color_by_distance({0, no_label}, Grid(2, 1), {{0.5, 0.5}}, Metric::euclidean, Palette::turbo);
  BOOST_TEST((gap.at<cv::Vec3b>(0, 0) != black));
  BOOST_TEST((gap.at<cv::Vec3b>(0, 1) == black));
}

BOOST_AUTO_TEST_CASE(edges_are_the_pixels_before_another_label) {
  const std::vector<std::uint32_t> labels = {1, 1, 2,  //
                                             1, 3, 2,  //
                                             1, 3, 3};
  cv::Mat picture(3, 3, CV_8UC3, cv::Scalar(200, 200, 200));
  draw_edges(picture, labels);
  const bool expected[3][3] = {{false, true, false}, {true, true, true}, {true, false, false}};
  for (int y = 0; y < 3; ++y) {
    for (int x = 0; x < 3; ++x) {
      BOOST_TEST((brightness(picture.at<cv::Vec3b>(y, x)) < 150) == expected[y][x],
                 "(" << x << ", " << y << ")");
    }
  }
}

BOOST_AUTO_TEST_CASE(dots_are_on_the_seeds) {
  for (const int side : {3, 20, 100, 400}) {  // from one pixel a seed to dots with rims
    cv::Mat picture(side, side, CV_8UC3, cv::Scalar(128, 128, 128));
    const double far = side - 0.5;
    draw_points(picture,
                {{0, 0}, {far, far}, {not_a_number, not_a_number}, {side / 2 + 0.9, side / 2 + 0.9}});
    for (const int at : {0, side / 2, side - 1}) BOOST_TEST(brightness(picture.at<cv::Vec3b>(at, at)) < 150);
    BOOST_TEST((picture.at<cv::Vec3b>(0, side - 1) == cv::Vec3b(128, 128, 128)));
  }
}

BOOST_AUTO_TEST_CASE(bad_arguments_are_refused) {
  const Grid grid(2, 2);
  cv::Mat picture(2, 2, CV_8UC3), grey(2, 2, CV_8U);
  const auto by_distance = [&](const std::vector<std::uint32_t>& labels) {
    color_by_distance(labels, grid, {{0, 0}, {not_a_number, not_a_number}}, Metric::euclidean,
                      Palette::viridis);
  };
  check_error([&] { color_by_id({1, 2, 3}, grid); }, {"3 labels", "2 x 2"});
  check_error([&] { by_distance({0, 0, 0}); }, {"3 labels"});
  check_error([&] { by_distance({0, 0, 2, 0}); }, {"label 2", "(0, 1)"});
  check_error([&] { by_distance({0, 1, 0, 0}); }, {"label 1", "(1, 0)"});
  check_error([&] { draw_edges(picture, {1, 2, 3}); }, {"3 labels"});
  check_error([&] { draw_edges(grey, {1, 2, 3, 4}); }, {"CV_8UC3"});
  check_error([&] { draw_points(picture, {{0, 0}, {2, 0}}); }, {"seed 1", "outside", "2 x 2"});
  check_error([&] { draw_points(grey, {{0, 0}}); }, {"CV_8UC3"});
}
