// The colour bar beside a picture: its place, its colours and its ticks.
#define BOOST_TEST_MODULE color_bar
#include <cmath>
#include <opencv2/core.hpp>

#include "fixture.hpp"
#include "vorocl/picture.hpp"

using namespace vorocl;

namespace {

const cv::Vec3b white(255, 255, 255);

cv::Mat grey_picture(int width, int height) { return {height, width, CV_8UC3, cv::Scalar::all(128)}; }

cv::Vec3b color_of(double value, const ColorBar& bar) {
  return color_by_value({0}, Grid(1, 1), {value}, bar.scale, bar.palette).at<cv::Vec3b>(0, 0);
}

/// The bar as it stands in the result: found by its outline, from the middle row.
struct Found {
  int left = 0, right = 0;  // first and last column
  int top = 0, bottom = 0;  // first and last row within the outline
  std::vector<int> ticks;   // rows
};

Found find(const cv::Mat& result, int picture_width) {
  Found found;
  const int middle = result.rows / 2;
  const auto at = [&](int x, int y) { return result.at<cv::Vec3b>(y, x); };
  int x = picture_width;
  while (at(x, middle) == white) ++x;
  const cv::Vec3b outline = at(x, middle);
  found.left = x + 1;
  do {
    ++x;
  } while (at(x, middle) != outline);
  found.right = x - 1;
  const int inside = (found.left + found.right) / 2;
  found.top = found.bottom = middle;
  while (at(inside, found.top - 1) != outline) --found.top;
  while (at(inside, found.bottom + 1) != outline) ++found.bottom;
  for (int y = found.top; y <= found.bottom; ++y) {
    if (at(found.right + 2, y) == outline) found.ticks.push_back(y);
  }
  return found;
}

}  // namespace

BOOST_AUTO_TEST_CASE(letters_that_opencv_does_not_have_are_one_mark_each) {
  const auto bar = [](const std::string& title) {
    return with_color_bar(grey_picture(64, 100), {{0, 1}, Palette::turbo, title, false, false});
  };
  const auto is_same = [](const cv::Mat& a, const cv::Mat& b) {
    return a.size() == b.size() && cv::norm(a, b, cv::NORM_INF) == 0;
  };
  BOOST_TEST(is_same(bar("gr\xc3\xbcn"), bar("gr?n")));
  BOOST_TEST(is_same(bar("\xe6\x97\xa5\xf0\x9f\x98\x80"), bar("??")));
  BOOST_TEST(is_same(bar("t (\xc2\xb5m)"), bar("t (um)")));
  BOOST_TEST(is_same(bar("\xce\xbcm"), bar("um")));
  BOOST_TEST(!is_same(bar("um"), bar("??")));
}

BOOST_AUTO_TEST_CASE(the_picture_keeps_its_place_and_the_width_is_even) {
  for (const cv::Size& size :
       {cv::Size(1, 1), cv::Size(64, 48), cv::Size(333, 95), cv::Size(640, 481), cv::Size(3, 2000)}) {
    const cv::Mat picture = grey_picture(size.width, size.height);
    const cv::Mat result = with_color_bar(picture, {{0, 1}, Palette::turbo, "distance (px)", false, false});
    BOOST_TEST(result.type() == CV_8UC3);
    BOOST_TEST(result.cols % 2 == 0);
    BOOST_TEST(result.rows == std::max(96, size.height));
    BOOST_TEST(cv::norm(result(cv::Rect({0, 0}, size)), picture, cv::NORM_INF) == 0);
    BOOST_TEST((result.at<cv::Vec3b>(result.rows - 1, size.width) == white));
    // A margin: no letter is cut off.
    BOOST_TEST(cv::norm(result.col(result.cols - 1), cv::Mat(result.rows, 1, CV_8UC3, cv::Scalar::all(255)),
                        cv::NORM_INF) == 0);
  }
}

BOOST_AUTO_TEST_CASE(the_colours_are_those_of_the_values) {
  for (const Palette palette : {Palette::viridis, Palette::turbo}) {
    for (const int height : {96, 300, 1000}) {
      const ColorBar bar = {{-3, 17}, palette, "v", false, false};
      const cv::Mat result = with_color_bar(grey_picture(50, height), bar);
      const Found found = find(result, 50);
      const double rows = found.bottom - found.top + 1;
      BOOST_TEST(rows > height / 2);
      BOOST_TEST(found.right - found.left + 1 >= 10);
      for (int y = found.top; y <= found.bottom; ++y) {
        const double value = 17 - 20 * (y - found.top + 0.5) / rows;
        BOOST_TEST(cv::norm(result.at<cv::Vec3b>(y, found.left), color_of(value, bar), cv::NORM_INF) <= 4);
        BOOST_TEST((result.at<cv::Vec3b>(y, found.left) == result.at<cv::Vec3b>(y, found.right)));
      }
    }
  }
}

BOOST_AUTO_TEST_CASE(ticks_are_at_round_values) {
  const auto ticks = [](const ColorBar& bar) { return find(with_color_bar(grey_picture(50, 480), bar), 50); };
  // 0, 20, ..., 100 from the lowest row to the highest
  Found found = ticks({{0, 100}, Palette::viridis, "v", false, false});
  BOOST_REQUIRE(found.ticks.size() == 6u);
  BOOST_TEST(found.ticks.front() == found.top);
  BOOST_TEST(found.ticks.back() == found.bottom);
  for (std::size_t i = 0; i < 6; ++i) {
    BOOST_TEST(std::abs(found.ticks[i] -
                        (found.top + static_cast<double>(i) * (found.bottom - found.top) / 5)) <= 1);
  }
  // 4, 6, 8, 10, 12
  found = ticks({{3, 12}, Palette::viridis, "v", false, false});
  BOOST_REQUIRE(found.ticks.size() == 5u);
  BOOST_TEST(found.ticks.front() == found.top);
  BOOST_TEST(std::abs(found.bottom - found.ticks.back() - (found.bottom - found.top) / 9.0) <= 1);
  BOOST_TEST(ticks({{2, 4}, Palette::viridis, "v", false, false}).ticks.size() > 3u);
  BOOST_TEST(ticks({{2, 4}, Palette::viridis, "v", true, false}).ticks.size() == 3u);  // 2, 3, 4
  BOOST_TEST(ticks({{7, 7}, Palette::viridis, "v", true, false}).ticks.size() == 1u);
  // Steps that are next to nothing beside the values.
  BOOST_TEST(!ticks({{1e16, 1e16 + 2}, Palette::viridis, "v", false, false}).ticks.empty());
  check_error(
      [&] {
        ticks({{-1e308, 1e308}, Palette::viridis, "v", false, false});
      },
      {"scale", "difference"});
}

BOOST_AUTO_TEST_CASE(a_logarithmic_bar_is_divided_by_powers_of_ten) {
  const cv::Mat picture = grey_picture(10, 300);
  const auto bar = [&](const Scale& scale) {
    return with_color_bar(picture, {scale, Palette::greys, "", false, false});
  };
  const Found found = find(bar({1, 10000, true}), 10), linear = find(bar({0, 4}), 10);
  BOOST_TEST_REQUIRE(found.ticks.size() == 5u);  // 1, 10, ... 10000; the other bar has them at 0, 0.5, ... 4
  for (std::size_t i = 0; i < 5; ++i) BOOST_TEST(found.ticks[i] == linear.ticks.at(2 * i));
  const cv::Mat strip = bar({1, 10000, true}), of_exponents = bar({0, 4});
  for (int y = found.top; y <= found.bottom; ++y) {
    BOOST_TEST(
        std::abs(strip.at<cv::Vec3b>(y, found.left)[0] - of_exponents.at<cv::Vec3b>(y, found.left)[0]) <= 1);
  }
  BOOST_TEST(find(bar({1, 100, true}), 10).ticks.size() == 7u);  // 1, 2, 5, 10, 20, 50, 100
  // Where one such number is on the scale, or none, ticks are at 6, 8, ... 14 and at 3, 3.2, ... 4.
  BOOST_TEST(find(bar({6, 15, true}), 10).ticks.size() == 5u);
  BOOST_TEST(find(bar({3, 4, true}), 10).ticks.size() == 6u);
  BOOST_TEST(find(bar({5, 5, true}), 10).ticks.size() == 1u);
  for (const Scale& scale : {Scale{1e-9, 1e9, true}, {0.5, 70, true}}) BOOST_TEST(bar(scale).cols > 10);
  // Classes have no logarithms.
  check_error(
      [&] {
        with_color_bar(picture, {{1, 8, true}, Palette::okabe_ito, "", true, false});
      },
      {"logarithmic", "categorical"});
}

BOOST_AUTO_TEST_CASE(the_ends_of_a_logarithmic_bar_may_be_any_numbers) {
  const auto bar = [](const Scale& scale) {
    return with_color_bar(grey_picture(10, 300), {scale, Palette::greys, "", false, false});
  };
  const cv::Mat strip = bar({1e-300, 1e300, true}), of_exponents = bar({-300, 300});
  const Found found = find(strip, 10);
  for (int y = found.top; y <= found.bottom; ++y) {
    BOOST_TEST(
        std::abs(strip.at<cv::Vec3b>(y, found.left)[0] - of_exponents.at<cv::Vec3b>(y, found.left)[0]) <= 1);
  }
}

BOOST_AUTO_TEST_CASE(classes_are_blocks_with_a_tick_each) {
  const ColorBar bar = {{2, 5}, Palette::okabe_ito, "type", true, false};
  const cv::Mat result = with_color_bar(grey_picture(50, 480), bar);
  const Found found = find(result, 50);
  BOOST_REQUIRE(found.ticks.size() == 4u);
  const int block = (found.bottom - found.top + 1) / 4;
  for (int i = 0; i < 4; ++i) {
    const int tick = found.ticks[static_cast<std::size_t>(i)];
    BOOST_TEST(std::abs(tick - (found.top + i * block + block / 2)) <= 2);
    for (const int y : {tick - block / 2 + 3, tick, tick + block / 2 - 3}) {
      BOOST_TEST((result.at<cv::Vec3b>(y, found.left) == color_of(5 - i, bar)), "block " << i);
    }
  }
}

BOOST_AUTO_TEST_CASE(open_ends_are_pointed) {
  const ColorBar bar = {{0, 100}, Palette::viridis, "v", false, true};
  const cv::Mat result = with_color_bar(grey_picture(50, 480), bar);
  const Found found = find(result, 50);
  const int middle = (found.left + found.right) / 2;
  for (const auto& [y, value] : {std::pair(found.top + 2, 100.0), std::pair(found.bottom - 2, 0.0)}) {
    BOOST_TEST((result.at<cv::Vec3b>(y, middle) == color_of(value, bar)));
    BOOST_TEST((result.at<cv::Vec3b>(y, found.left) == white));
    BOOST_TEST((result.at<cv::Vec3b>(y, found.right) == white));
  }
  BOOST_REQUIRE(found.ticks.size() == 6u);
  const int point = (found.right - found.left + 1) / 2;  // of 100 and 0, next to the points
  BOOST_TEST(std::abs(found.ticks.front() - (found.top + point)) <= 1);
  BOOST_TEST(std::abs(found.ticks.back() - (found.bottom - point)) <= 1);
}

BOOST_AUTO_TEST_CASE(the_outline_encloses_the_colours_to_the_pixel) {
  for (const int height : {96, 480, 1003}) {
    for (const bool open_ended : {false, true}) {
      const ColorBar bar = {{0, 100}, Palette::viridis, "v", false, open_ended};
      const cv::Mat result = with_color_bar(grey_picture(50, height), bar);
      const Found found = find(result, 50);
      const int middle = (found.left + found.right + 1) / 2, width = found.right - found.left + 1;
      const cv::Vec3b outline = result.at<cv::Vec3b>(result.rows / 2, found.left - 1);
      std::vector<std::pair<int, int>> runs;  // of the colours, by row
      for (int y = found.top; y <= found.bottom; ++y) {
        int left = middle, right = middle;
        while (result.at<cv::Vec3b>(y, left - 1) != outline) --left;
        while (result.at<cv::Vec3b>(y, right + 1) != outline) ++right;
        for (int x = left; x <= right; ++x) BOOST_TEST((result.at<cv::Vec3b>(y, x) != white));
        for (int x = found.left - 2; x < left - 2; ++x) BOOST_TEST((result.at<cv::Vec3b>(y, x) == white));
        // A pointed end has a slope of one half of the width to as many rows.
        const int to_tip = std::min(y - found.top, found.bottom - y);
        const int half = open_ended ? std::min(to_tip, width / 2) : width;
        BOOST_TEST(std::abs(left - std::max(found.left, middle - half)) <= 2);
        BOOST_TEST(std::abs(right - std::min(found.right, middle + half)) <= 2);
        runs.emplace_back(left, right);
      }
      BOOST_TEST(std::equal(runs.begin(), runs.end(), runs.rbegin()));  // upside down the same
      for (const int x : {middle - 1, middle, middle + 1}) {
        const int beyond = open_ended ? 3 : 2;
        BOOST_TEST((result.at<cv::Vec3b>(found.top - beyond, x) == white));
        BOOST_TEST((result.at<cv::Vec3b>(found.bottom + beyond, x) == white));
      }
    }
  }
}

BOOST_AUTO_TEST_CASE(marks_are_bars_around_their_rows) {
  for (const int height : {96, 480, 2000}) {
    const ColorBar bar = {{0, 1}, Palette::viridis, "v", true, false};
    const cv::Mat result = with_color_bar(grey_picture(50, height), bar);
    const Found found = find(result, 50);
    const cv::Vec3b outline = result.at<cv::Vec3b>(result.rows / 2, found.left - 1);
    const auto is_dark = [&](int y, int x) { return result.at<cv::Vec3b>(y, x) == outline; };
    int end = found.right + 2;  // of the mark at the upper end
    while (is_dark(found.top, end)) ++end;
    for (const int row : {found.top, found.bottom}) {
      int first = row, last = row;
      while (is_dark(first - 1, end - 1)) --first;
      while (is_dark(last + 1, end - 1)) ++last;
      BOOST_TEST((last - row == row - first || last - row == row - first + 1), "height " << height);
      for (int y = first; y <= last; ++y) BOOST_TEST((is_dark(y, found.right + 2) && !is_dark(y, end)));
    }
  }
}

BOOST_AUTO_TEST_CASE(a_number_stands_beside_each_tick) {
  for (const int height : {96, 200, 480, 2000}) {
    const ColorBar bar = {{0, 100}, Palette::viridis, "", false, false};
    const cv::Mat result = with_color_bar(grey_picture(50, height), bar);
    const Found found = find(result, 50);
    const int unit = (found.right - found.left + 1) / 2;
    const cv::Range columns(found.right + 2 + unit / 2, result.cols);
    std::vector<int> numbers;  // their middle rows
    const auto is_white = [&](int y) {
      const cv::Mat row = result(cv::Range(y, y + 1), columns);
      return cv::norm(row, cv::Mat(row.size(), row.type(), cv::Scalar::all(255)), cv::NORM_INF) == 0;
    };
    for (int y = 0, first = 0; y < result.rows; ++y) {
      if (is_white(y)) continue;
      for (first = y; !is_white(y); ++y) continue;
      numbers.push_back((first + y) / 2);
    }
    std::vector<int> ticks;  // the first rows of their marks
    for (const int row : found.ticks) {
      if (ticks.empty() || row > ticks.back() + unit / 2) ticks.push_back(row);
    }
    BOOST_TEST_REQUIRE(numbers.size() == ticks.size(), "height " << height);
    BOOST_TEST(ticks.size() >= 2u);
    for (std::size_t i = 0; i < ticks.size(); ++i) {
      BOOST_TEST(std::abs(numbers[i] - ticks[i]) <= 2 + unit / 8, "height " << height);
    }
  }
}

BOOST_AUTO_TEST_CASE(titles_are_shown_and_long_ones_shortened) {
  const auto bar_with = [](const std::string& title) {
    return with_color_bar(grey_picture(50, 480), {{0, 1}, Palette::viridis, title, false, false});
  };
  const cv::Mat untitled = bar_with(""), titled = bar_with("area (px)");
  const cv::Rect head(50, 0, untitled.cols - 50, 25);
  BOOST_TEST(cv::norm(untitled(head), cv::Mat(head.size(), CV_8UC3, cv::Scalar::all(255)), cv::NORM_INF) ==
             0);
  BOOST_TEST(cv::norm(untitled(head), titled(head), cv::NORM_INF) > 100);
  BOOST_TEST(bar_with(std::string(31, 'w')).cols < bar_with(std::string(30, 'w')).cols);
  BOOST_TEST(bar_with(std::string(1000, 'w')).cols < 800);
}

BOOST_AUTO_TEST_CASE(any_scale_has_a_bar) {
  for (const Scale& scale : {Scale{-1e300, 1e300}, Scale{0, 1e-300}, Scale{1e15, 1e15 + 1},
                             Scale{-5e-7, 3e-7}, Scale{0, 1073741824}, Scale{0, 0}}) {
    for (const Palette palette : {Palette::viridis, Palette::okabe_ito}) {
      for (const bool whole : {false, true}) {
        const cv::Mat result = with_color_bar(grey_picture(10, 200), {scale, palette, "v", whole, true});
        BOOST_TEST(result.cols < 300);
      }
    }
  }
  check_error(
      [] {
        with_color_bar(grey_picture(9, 9), {{1, 0}, Palette::viridis, "v", false, false});
      },
      {"scale"});
  check_error(
      [] {
        with_color_bar(cv::Mat(9, 9, CV_8U), {{0, 1}, Palette::viridis, "v", false, false});
      },
      {"CV_8UC3"});
}
