// Pictures: what is drawn on them: edges, contours, dots, text.
#define BOOST_TEST_MODULE picture
#include <algorithm>
#include <cmath>
#include <limits>
#include <opencv2/imgproc.hpp>

#include "fixture.hpp"
#include "vorocl/picture.hpp"

using namespace vorocl;

namespace {

const double not_a_number = std::numeric_limits<double>::quiet_NaN();
const double infinite = std::numeric_limits<double>::infinity();

int brightness(const cv::Vec3b& color) { return color[0] + color[1] + color[2]; }

}  // namespace

BOOST_AUTO_TEST_CASE(a_line_of_text_is_in_the_lower_left_corner) {
  const cv::Mat before(100, 300, CV_8UC3, cv::Scalar::all(128));
  cv::Mat picture = before.clone();
  draw_text(picture, "frame 12");
  const cv::Rect corner(0, 80, 150, 20);
  BOOST_TEST(cv::norm(picture(corner), before(corner), cv::NORM_INF) > 90);
  before(corner).copyTo(picture(corner));
  BOOST_TEST(cv::norm(picture, before, cv::NORM_INF) == 0);
  cv::Mat narrow(100, 90, CV_8UC3, cv::Scalar::all(128)), lines = narrow.clone(),
                                                          above = lines.rowRange(0, 84);
  draw_text(narrow, "frame 12, step 500");
  draw_text(lines, "step 500");
  draw_text(above, "frame 12");
  BOOST_TEST(cv::norm(narrow, lines, cv::NORM_INF) == 0);
  cv::Mat small(5, 7, CV_8UC3, cv::Scalar::all(128));
  draw_text(small, "frame 12");  // what does not fit is cut off
}

BOOST_AUTO_TEST_CASE(round_steps_are_1_2_and_5_times_powers_of_ten) {
  BOOST_TEST(round_step({0, 10}, 10) == 1);
  BOOST_TEST(round_step({0, 10}, 9) == 2);
  BOOST_TEST(round_step({990, 1033}, 10) == 5);
  BOOST_TEST(round_step({0, 61}, 10) == 10);
  BOOST_TEST(std::abs(round_step({0, 0.3}, 10) - 0.05) < 1e-12);
  BOOST_TEST(round_step({-4e8, 4e8}, 4) == 2e8);
  BOOST_TEST(round_step({3, 3}, 4) == 0);
}

BOOST_AUTO_TEST_CASE(edges_are_the_pixels_before_another_label) {
  constexpr int side = 10;  // of squares with one label
  const std::uint32_t squares[3][3] = {{1, 1, 2}, {1, 3, 2}, {1, 3, 3}};
  const bool right_edges[3][3] = {{false, true, false}, {true, true, false}, {true, false, false}};
  const bool lower_edges[3][3] = {{false, true, false}, {false, false, true}, {false, false, false}};
  constexpr std::size_t columns = 3 * std::size_t{side};
  std::vector<std::uint32_t> labels(columns * columns);
  for (std::size_t i = 0; i < labels.size(); ++i) labels[i] = squares[i / columns / side][i % columns / side];
  cv::Mat picture(3 * side, 3 * side, CV_8UC3, cv::Scalar(200, 200, 200));
  draw_edges(picture, labels);
  for (int y = 0; y < 3 * side; ++y) {
    for (int x = 0; x < 3 * side; ++x) {
      const bool expected = (x % side == side - 1 && right_edges[y / side][x / side]) ||
                            (y % side == side - 1 && lower_edges[y / side][x / side]);
      BOOST_TEST((brightness(picture.at<cv::Vec3b>(y, x)) < 150) == expected, "(" << x << ", " << y << ")");
    }
  }
}

BOOST_AUTO_TEST_CASE(edges_fade_where_cells_are_small) {
  // A checkerboard of squares, whose edges are along the sides.
  const auto darkest = [](int side) {
    const int cells = 6;
    std::vector<std::uint32_t> labels;
    for (int y = 0; y < cells * side; ++y) {
      for (int x = 0; x < cells * side; ++x)
        labels.push_back(static_cast<std::uint32_t>(y / side * cells + x / side));
    }
    cv::Mat picture(cells * side, cells * side, CV_8UC3, cv::Scalar::all(200));
    draw_edges(picture, labels);
    return brightness(picture.at<cv::Vec3b>(0, side - 1));
  };
  BOOST_TEST(darkest(1) == 600);
  BOOST_TEST(darkest(2) == 600);
  BOOST_TEST(darkest(3) < 600);
  for (int side = 3; side < 8; ++side) BOOST_TEST(darkest(side + 1) < darkest(side));
  BOOST_TEST(darkest(8) == darkest(20));
}

BOOST_AUTO_TEST_CASE(edges_lie_around_the_border) {
  // Borders between columns 20 and 21 and between rows 14 and 15, where nothing else is near.
  const Grid grid(41, 31);
  std::vector<std::uint32_t> upright, level;
  for (int y = 0; y < grid.height(); ++y) {
    for (int x = 0; x < grid.width(); ++x) {
      upright.push_back(x <= 20 ? 0 : 1);
      level.push_back(y <= 14 ? 0 : 1);
    }
  }
  for (const int width : {1, 2, 3, 4, 5, 8}) {
    const auto is_edge = [&](int at, int last_before) {
      return at > last_before - (width + 1) / 2 && at <= last_before + width / 2;
    };
    cv::Mat columns(31, 41, CV_8UC3, cv::Scalar::all(200)), rows = columns.clone();
    draw_edges(columns, upright, width);
    draw_edges(rows, level, width);
    for (int y = 0; y < grid.height(); ++y) {
      for (int x = 0; x < grid.width(); ++x) {
        BOOST_TEST((brightness(columns.at<cv::Vec3b>(y, x)) < 150) == is_edge(x, 20));
        BOOST_TEST((brightness(rows.at<cv::Vec3b>(y, x)) < 150) == is_edge(y, 14));
      }
    }
  }
}

BOOST_AUTO_TEST_CASE(slanting_edges_are_about_as_wide) {
  const Grid grid(200, 200);
  for (const bool falling : {false, true}) {
    std::vector<std::uint32_t> labels;
    for (int y = 0; y < 200; ++y) {
      for (int x = 0; x < 200; ++x) labels.push_back((falling ? x > y : x + y > 199) ? 1 : 0);
    }
    for (const int width : {2, 4, 7, 12}) {
      cv::Mat picture(200, 200, CV_8UC3, cv::Scalar::all(200));
      draw_edges(picture, labels, width);
      int dark = 0;
      for (int x = 0; x < 200; ++x) dark += brightness(picture.at<cv::Vec3b>(100, x)) < 150 ? 1 : 0;
      BOOST_TEST(std::abs(dark / std::sqrt(2) - width) < 1, width << ": " << dark << " in a row");
    }
  }
}

BOOST_AUTO_TEST_CASE(edges_go_on_across_a_periodic_border) {
  // The middle one of 3 x 3 copies of a picture side by side.
  const int width = 30, height = 20;
  const cv::Rect middle(width, height, width, height);
  for (const int edge_width : {1, 2, 5, 9}) {
    std::vector<std::uint32_t> labels, copies;
    const auto label = [&](int x, int y) { return x % width < 2 || y % height > 15 ? 1u : 0u; };
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x) labels.push_back(label(x, y));
    }
    for (int y = 0; y < 3 * height; ++y) {
      for (int x = 0; x < 3 * width; ++x) copies.push_back(label(x, y));
    }
    cv::Mat picture(height, width, CV_8UC3, cv::Scalar::all(200));
    cv::Mat expected(3 * height, 3 * width, CV_8UC3, cv::Scalar::all(200));
    draw_edges(picture, labels, edge_width, Axes::xy);
    draw_edges(expected, copies, edge_width);
    BOOST_TEST(cv::norm(picture, expected(middle), cv::NORM_INF) == 0, edge_width << " pixels");
  }
}

BOOST_AUTO_TEST_CASE(contours_are_at_their_distance) {
  const Grid grid(61, 51);
  std::vector<float> distances;
  for (int y = 0; y < grid.height(); ++y) {
    for (int x = 0; x < grid.width(); ++x)
      distances.push_back(static_cast<float>(std::hypot(x - 25, y - 20)));
  }
  for (const double interval : {10.0, 7.5}) {
    cv::Mat bright(51, 61, CV_8UC3, cv::Scalar::all(200)), dim(51, 61, CV_8UC3, cv::Scalar::all(40));
    draw_contours(bright, distances, interval);
    draw_contours(dim, distances, interval);
    for (int y = 0; y < grid.height(); ++y) {
      for (int x = 0; x < grid.width(); ++x) {
        const double distance = std::hypot(x - 25, y - 20);
        const double beyond = std::fmod(distance, interval);
        const bool drawn = brightness(bright.at<cv::Vec3b>(y, x)) < 150;
        BOOST_TEST((brightness(dim.at<cv::Vec3b>(y, x)) > 600) == drawn);
        // A ring of one pixel: nothing inside it or more than a pixel outside, and no hole to walk through.
        if (distance < interval || beyond >= 1) BOOST_TEST(!drawn, x << ", " << y);
        if (distance >= interval && beyond < std::sqrt(0.5) - 0.05) BOOST_TEST(drawn, x << ", " << y);
      }
    }
  }
  cv::Mat on_axis(51, 61, CV_8UC3, cv::Scalar::all(200));
  draw_contours(on_axis, distances, 10);
  for (int x = 25; x < 61; ++x) {
    BOOST_TEST((brightness(on_axis.at<cv::Vec3b>(20, x)) < 150) == (x == 35 || x == 45 || x == 55), x);
  }
  cv::Mat none(1, 2, CV_8UC3, cv::Scalar::all(200));
  draw_contours(none, std::vector<float>(2, std::numeric_limits<float>::infinity()), 1);
  BOOST_TEST(cv::norm(none, cv::Mat(1, 2, CV_8UC3, cv::Scalar::all(200)), cv::NORM_INF) == 0);
}

BOOST_AUTO_TEST_CASE(dots_are_on_the_seeds) {
  for (const int side : {3, 20, 100, 400}) {  // from one pixel per seed to dots with rims
    cv::Mat picture(side, side, CV_8UC3, cv::Scalar(128, 128, 128));
    const int middle = side / 2;
    const double far = side - 0.5;
    const std::vector<std::optional<Point>> seeds = {Point{0, 0}, Point{far, far}, std::nullopt,
                                                     Point{middle + 0.9, middle + 0.9}};
    draw_points(picture, seeds);
    for (const int at : {0, middle, side - 1}) BOOST_TEST(brightness(picture.at<cv::Vec3b>(at, at)) < 150);
    BOOST_TEST((picture.at<cv::Vec3b>(0, side - 1) == cv::Vec3b(128, 128, 128)));
  }
}

BOOST_AUTO_TEST_CASE(bad_arguments_are_refused) {
  cv::Mat picture(2, 2, CV_8UC3), grey(2, 2, CV_8U);
  const std::vector<float> distances = {0, 1, 2, 3};
  check_error([&] { draw_edges(picture, {1, 2, 3}); }, {"3 labels"});
  check_error([&] { draw_edges(grey, {1, 2, 3, 4}); }, {"CV_8UC3"});
  check_error([&] { draw_edges(picture, {1, 2, 3, 4}, 0); }, {"0 pixels wide", "100"});
  check_error([&] { draw_edges(picture, {1, 2, 3, 4}, 101); }, {"101 pixels wide", "100"});
  check_error([&] { draw_contours(picture, {1, 2}, 1); }, {"2 distances"});
  check_error([&] { draw_contours(grey, distances, 1); }, {"CV_8UC3"});
  for (const double bad : {0.0, -1.0, not_a_number, infinite}) {
    check_error([&] { draw_contours(picture, distances, bad); }, {"contours"});
  }
  check_error([&] { draw_points(picture, {{0, 0}, {2, 0}}); }, {"seed 1", "outside", "2 x 2"});
  check_error([&] { draw_points(grey, {{0, 0}}); }, {"CV_8UC3"});
}
