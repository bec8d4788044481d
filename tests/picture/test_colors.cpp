// Pictures: colours by id, by value and by distance.
#define BOOST_TEST_MODULE colors
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

BOOST_AUTO_TEST_CASE(each_seed_may_have_a_colour_of_its_own) {
  const std::vector<cv::Vec3b> colors = {{1, 2, 3}, {0, 0, 255}, {9, 8, 7}};
  const std::vector<std::uint32_t> labels = {2, 0, no_label, 1, 1, 0};
  const cv::Mat picture = color_by_seed(labels, Grid(3, 2), colors);
  BOOST_TEST((picture.type() == CV_8UC3 && picture.size() == cv::Size(3, 2)));
  for (int i = 0; i < 6; ++i) {
    const std::uint32_t label = labels[static_cast<std::size_t>(i)];
    BOOST_TEST((picture.at<cv::Vec3b>(i / 3, i % 3) == (label == no_label ? black : colors[label])),
               "pixel " << i);
  }
  const auto refused = [&](const std::vector<std::uint32_t>& wrong, const std::string& why) {
    BOOST_CHECK_EXCEPTION(color_by_seed(wrong, Grid(3, 2), colors), Error, [&](const Error& error) {
      return std::string(error.what()).find(why) != std::string::npos;
    });
  };
  refused({0, 1, 2, 3, 0, 0}, "the label 3 has no colour; there are 3");
  refused({0, 1}, "there are 2 labels for 3 x 2 pixels");
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

BOOST_AUTO_TEST_CASE(a_window_has_the_colours_of_its_labels) {
  const Window window(Grid(2000000000, 1000), 1999999998, 7, 2, 3);
  const std::vector<std::uint32_t> labels = {4, no_label, 2, 2, 9, 0};
  const cv::Mat picture = color_by_id(labels, window);
  BOOST_TEST((picture.cols == 2 && picture.rows == 3));
  BOOST_TEST(cv::norm(picture, color_by_id(labels, Grid(2, 3)), cv::NORM_INF) == 0);
  check_error([&] { color_by_id(labels, window.grid()); }, {"6 labels"});
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

BOOST_AUTO_TEST_CASE(a_value_s_colour_is_that_of_the_scale_alone) {
  const Scale scale = {10, 20};
  const auto color = [&](double value, Palette palette) {
    return color_by_value({1, 0}, Grid(2, 1), {5, value}, scale, palette).at<cv::Vec3b>(0, 0);
  };
  for (const Palette palette : {Palette::viridis, Palette::turbo, Palette::greys, Palette::okabe_ito}) {
    // Classes have their own colours, also beyond the scale.
    const bool has_classes = is_categorical(palette);
    BOOST_TEST((color(9, palette) == color(has_classes ? 17 : 10, palette)));
    BOOST_TEST((color(23, palette) == color(has_classes ? 15 : 20, palette)));
    BOOST_TEST((color(-infinite, palette) == color(10, palette)));
    BOOST_TEST((color(infinite, palette) == color(20, palette)));
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

BOOST_AUTO_TEST_CASE(bad_arguments_are_refused) {
  const Grid grid(2, 2);
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
  check_error([&] { color_by_distance({0, 1, 2, 3}, grid, {0, 1}, Palette::okabe_ito); }, {"viridis"});
}
