// Pictures: colours by id, value and distance, edges, contours, dots.
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
const double infinite = std::numeric_limits<double>::infinity();

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

BOOST_AUTO_TEST_CASE(a_categorical_palette_has_the_published_colours) {
  // Okabe and Ito 2008, https://jfly.uni-koeln.de/color/; grey is that of their followers.
  const int rgb[8][3] = {{230, 159, 0}, {86, 180, 233}, {0, 158, 115},   {240, 228, 66},
                         {0, 114, 178}, {213, 94, 0},   {204, 121, 167}, {153, 153, 153}};
  std::vector<std::uint32_t> labels;
  std::vector<double> values;
  for (std::uint32_t id = 0; id < 24; ++id) {
    labels.push_back(id);
    values.push_back(static_cast<double>(id) - 8);
  }
  const cv::Mat by_id = color_by_id(labels, Grid(24, 1), Palette::okabe_ito);
  const cv::Mat by_value = color_by_value(labels, Grid(24, 1), values, {-8, 15}, Palette::okabe_ito);
  for (int i = 0; i < 24; ++i) {
    const int* const color = rgb[i % 8];
    BOOST_TEST((by_id.at<cv::Vec3b>(0, i) == cv::Vec3b(static_cast<std::uint8_t>(color[2]),
                                                       static_cast<std::uint8_t>(color[1]),
                                                       static_cast<std::uint8_t>(color[0]))),
               "id " << i);
  }
  BOOST_TEST(cv::norm(by_id, by_value, cv::NORM_INF) == 0);
  BOOST_TEST((color_by_id({no_label}, Grid(1, 1), Palette::okabe_ito).at<cv::Vec3b>(0, 0) == black));
}

BOOST_AUTO_TEST_CASE(values_and_distances_run_through_the_palette) {
  // The levels are those of the palette, one by one.
  const Grid grid(256, 1);
  cv::Mat levels(1, 256, CV_8U), expected;
  std::vector<std::uint32_t> labels;
  std::vector<double> values;
  std::vector<float> distances;
  for (int x = 0; x < 256; ++x) {
    levels.at<std::uint8_t>(0, x) = static_cast<std::uint8_t>(x);
    labels.push_back(static_cast<std::uint32_t>(255 - x));
    values.push_back(1000 - 0.5 * x);  // of label x: the labels fall and so the values rise
    distances.push_back(static_cast<float>(x));
  }
  for (const Palette palette : {Palette::viridis, Palette::turbo, Palette::greys}) {
    if (palette == Palette::greys) {
      cv::cvtColor(levels, expected, cv::COLOR_GRAY2BGR);
    } else {
      cv::applyColorMap(levels, expected,
                        palette == Palette::viridis ? cv::COLORMAP_VIRIDIS : cv::COLORMAP_TURBO);
    }
    const cv::Mat by_value = color_by_value(labels, grid, values, {872.5, 1000}, palette);
    const cv::Mat by_distance = color_by_distance(distances, grid, {0, 255}, palette);
    BOOST_TEST(by_value.type() == CV_8UC3);
    BOOST_TEST(cv::norm(by_value, expected, cv::NORM_INF) == 0);
    BOOST_TEST(cv::norm(by_distance, expected, cv::NORM_INF) == 0);
  }
}

BOOST_AUTO_TEST_CASE(a_logarithmic_scale_goes_by_the_logarithms) {
  const std::vector<std::uint32_t> labels = {0, 1, 2, 3, 4, no_label};
  const Grid grid(6, 1);
  const cv::Mat logarithmic =
      color_by_value(labels, grid, {0.01, 1, 100, 0, -3}, {0.01, 100, true}, Palette::turbo);
  const cv::Mat linear =
      color_by_value(labels, grid, {0, 1, 2, not_a_number, not_a_number}, {0, 2}, Palette::turbo);
  BOOST_TEST(cv::norm(logarithmic, linear, cv::NORM_INF) <= 3);  // one of 256 levels, by rounding
  check_error(
      [&] {
        color_by_value({0}, Grid(1, 1), {1}, {0, 1, true}, Palette::turbo);
      },
      {"logarithmic", "above 0"});
  check_error(
      [&] {
        color_by_value({0}, Grid(1, 1), {1}, {1, 2, true}, Palette::okabe_ito);
      },
      {"logarithmic", "categorical", "viridis"});
}

BOOST_AUTO_TEST_CASE(bad_scales_are_told_with_their_numbers) {
  const auto color = [](const Scale& scale) { color_by_value({0}, Grid(1, 1), {1}, scale, Palette::turbo); };
  check_error([&] { color({-1e-9, 1, true}); }, {"begin at -1e-09;"});
  check_error([&] { color({2e-9, 1e-9}); }, {"from 2e-09 to 1e-09;"});
  check_error([&] { color({-1e308, 1e308}); }, {"from -1e+308 to 1e+308;"});
}

BOOST_AUTO_TEST_CASE(reversed_palettes_run_the_other_way) {
  using Pair = std::pair<Palette, Palette>;
  for (const auto& [palette, reversed] :
       {Pair(Palette::viridis, Palette::viridis_r), Pair(Palette::turbo, Palette::turbo_r),
        Pair(Palette::greys, Palette::greys_r)}) {
    for (int level = 0; level < 256; ++level) {
      const cv::Mat a = color_by_value({0}, Grid(1, 1), {level / 255.0}, {0, 1}, palette);
      const cv::Mat b = color_by_value({0}, Grid(1, 1), {1 - level / 255.0}, {0, 1}, reversed);
      BOOST_TEST((a.at<cv::Vec3b>(0, 0) == b.at<cv::Vec3b>(0, 0)), level);
    }
  }
}

BOOST_AUTO_TEST_CASE(a_line_of_text_is_in_the_lower_left_corner) {
  const cv::Mat before(100, 300, CV_8UC3, cv::Scalar::all(128));
  cv::Mat picture = before.clone();
  draw_text(picture, "frame 12");
  const cv::Rect corner(0, 80, 150, 20);
  BOOST_TEST(cv::norm(picture(corner), before(corner), cv::NORM_INF) > 90);
  before(corner).copyTo(picture(corner));
  BOOST_TEST(cv::norm(picture, before, cv::NORM_INF) == 0);
  cv::Mat small(5, 7, CV_8UC3, cv::Scalar::all(128));
  draw_text(small, "frame 12");  // what does not fit is cut off
}

BOOST_AUTO_TEST_CASE(a_value_s_colour_is_that_of_the_scale_alone) {
  const Scale scale = {10, 20};
  const auto color = [&](double value, Palette palette) {
    return color_by_value({1, 0}, Grid(2, 1), {5, value}, scale, palette).at<cv::Vec3b>(0, 0);
  };
  for (const Palette palette : {Palette::viridis, Palette::turbo, Palette::greys, Palette::okabe_ito}) {
    BOOST_TEST((color(9, palette) == color(10, palette)));
    BOOST_TEST((color(-infinite, palette) == color(10, palette)));
    BOOST_TEST((color(1e300, palette) == color(20, palette)));
    BOOST_TEST((color(10, palette) != color(20, palette)));
    const cv::Vec3b absent = color(not_a_number, palette);
    BOOST_TEST((absent[0] == absent[1] && absent[1] == absent[2] && absent != black));
    const cv::Vec3b without_extent =
        color_by_value({1}, Grid(1, 1), {5, 7}, {7, 7}, palette).at<cv::Vec3b>(0, 0);
    BOOST_TEST((without_extent != absent));
    if (palette != Palette::okabe_ito) BOOST_TEST((without_extent == color(10, palette)));
    BOOST_TEST((color_by_value({no_label}, Grid(1, 1), {}, scale, palette).at<cv::Vec3b>(0, 0) == black));
  }
  const cv::Mat distances =
      color_by_distance({15, std::numeric_limits<float>::infinity()}, Grid(2, 1), scale, Palette::viridis);
  BOOST_TEST((distances.at<cv::Vec3b>(0, 0) == color(15, Palette::viridis)));
  BOOST_TEST((distances.at<cv::Vec3b>(0, 1) == black));
}

BOOST_AUTO_TEST_CASE(a_range_is_that_of_what_the_picture_shows) {
  const auto range = range_of({1, 1, no_label, 2, 3, 4}, {-100, 3, 7.5, not_a_number, infinite, 1e6});
  BOOST_TEST((range && range->low == 3 && range->high == 7.5));  // neither 0 nor 5 has a pixel
  BOOST_TEST(!range_of({no_label, 0}, {not_a_number}));
  const auto distances = range_of({4, std::numeric_limits<float>::infinity(), 0.5f});
  BOOST_TEST((distances && distances->low == 0.5 && distances->high == 4));
  BOOST_TEST(!range_of({std::numeric_limits<float>::infinity()}));
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
  std::vector<std::uint32_t> labels;
  for (int i = 0; i < 9 * side * side; ++i)
    labels.push_back(squares[i / (3 * side) / side][i % (3 * side) / side]);
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
    draw_edges(picture, labels, edge_width, Periodic::xy);
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
    const double far = side - 0.5;
    const std::vector<std::optional<Point>> seeds = {Point{0, 0}, Point{far, far}, std::nullopt,
                                                     Point{side / 2 + 0.9, side / 2 + 0.9}};
    draw_points(picture, seeds);
    for (const int at : {0, side / 2, side - 1}) BOOST_TEST(brightness(picture.at<cv::Vec3b>(at, at)) < 150);
    BOOST_TEST((picture.at<cv::Vec3b>(0, side - 1) == cv::Vec3b(128, 128, 128)));
  }
}

BOOST_AUTO_TEST_CASE(bad_arguments_are_refused) {
  const Grid grid(2, 2);
  cv::Mat picture(2, 2, CV_8UC3), grey(2, 2, CV_8U);
  const std::vector<float> distances = {0, 1, 2, 3};
  const auto by_value = [&](const std::vector<std::uint32_t>& labels, const Scale& scale) {
    color_by_value(labels, grid, {5, 6}, scale, Palette::viridis);
  };
  check_error([&] { color_by_id({1, 2, 3}, grid); }, {"3 labels", "2 x 2"});
  check_error([&] { color_by_id({1, 2, 3, 4}, grid, Palette::turbo); }, {"categorical"});
  check_error([&] { by_value({0, 0, 0}, {0, 1}); }, {"3 labels"});
  check_error([&] { by_value({0, 0, 2, 0}, {0, 1}); }, {"label 2", "no value"});
  check_error([&] { by_value({0, 0, 0, 0}, {2, 1}); }, {"scale", "from 2", "to 1"});
  check_error([&] { by_value({0, 0, 0, 0}, {0, infinite}); }, {"scale", "inf"});
  check_error([&] { range_of({0, 3}, {5, 6}); }, {"label 3", "no value"});
  check_error([&] { color_by_distance({1}, grid, {0, 1}, Palette::viridis); }, {"1 distances", "2 x 2"});
  check_error([&] { color_by_distance(distances, grid, {0, 1}, Palette::okabe_ito); }, {"viridis"});
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
