// vorocl render --waves and --enlarge: the pictures against flooding on the host, wave by wave.
#define BOOST_TEST_MODULE waves
#include <fmt/format.h>

#include <opencv2/imgcodecs.hpp>

#include "reference_flood.hpp"
#include "run_command.hpp"
#include "vorocl/picture.hpp"

using namespace vorocl;

namespace {

const Grid grid(13, 8);
const std::vector<Pixel> seeds = {{2, 1}, {11, 6}, {5, 5}};
const std::string points = "x,y\n2.5,1.5\n11.5,6.5\n5.5,5.5\n";
const std::string render = "render --points p.csv --size 13x8 --bounds 0,0,13,8 ";

bool same(const cv::Mat& a, const cv::Mat& b) {
  return a.size() == b.size() && cv::norm(a, b, cv::NORM_INF) == 0;
}

/// The picture with each pixel as a square, by counting.
cv::Mat enlarged(const cv::Mat& picture, int factor) {
  cv::Mat result(picture.rows * factor, picture.cols * factor, CV_8UC3);
  for (int y = 0; y < result.rows; ++y) {
    for (int x = 0; x < result.cols; ++x)
      result.at<cv::Vec3b>(y, x) = picture.at<cv::Vec3b>(y / factor, x / factor);
  }
  return result;
}

void check_waves(const std::string& method, const Plan& plan, Metric metric = Metric::euclidean,
                 const std::string& options = "") {
  const TemporaryFolder folder;
  folder.file("p.csv", points);
  succeeds(folder, render + fmt::format("--method {} --metric {} --waves w/%02d.png --labels l.npy {}",
                                        method, name_of(metric), options));
  BOOST_TEST_CONTEXT(method << " " << options) {
    for (std::size_t i = 0; i <= plan.size(); ++i) {
      const Plan waves(plan.begin(), plan.begin() + static_cast<std::ptrdiff_t>(i));
      const auto labels = reference_flood(grid, seeds, waves, metric);
      const cv::Mat drawn = cv::imread(folder / fmt::format("w/{:02}.png", i));
      BOOST_TEST(same(drawn, color_by_id(labels, grid)), "wave " << i);
    }
    std::size_t files = 0;
    for ([[maybe_unused]] const auto& file : std::filesystem::directory_iterator(folder / "w")) ++files;
    BOOST_TEST(files == plan.size() + 1);
  }
}

/// Waves of step 1 until one changes nothing.
Plan standard_flooding_waves() {
  Plan plan;
  auto labels = reference_flood(grid, seeds, plan, Metric::euclidean);
  for (;;) {
    auto next = reference_flood(grid, seeds, {Wave{}}, Metric::euclidean, labels);
    if (next == labels) return plan;
    labels = next;
    plan.push_back({});
  }
}

}  // namespace

BOOST_AUTO_TEST_CASE(waves_are_drawn_one_by_one) {
  BOOST_TEST(standard_flooding_waves().size() > 4u);
  check_waves("standard-flooding", standard_flooding_waves());
  check_waves("jfa", {{8}, {4}, {2}, {1}});
  check_waves("jfa+1", {{8}, {4}, {2}, {1}, {1}});
  check_waves("jfa+2", {{8}, {4}, {2}, {1}, {2}, {1}});
  check_waves("1+jfa", {{1}, {8}, {4}, {2}, {1}}, Metric::manhattan);
  check_waves("djfa", {{8}, {4}, {2}, {1}});
  const Neighbourhood v = Neighbourhood::von_neumann;
  check_waves("jfa", {{8, v}, {4, v}, {2, v}, {1, v}}, Metric::euclidean, "--neighbourhood von-neumann");
}

BOOST_AUTO_TEST_CASE(a_grid_of_one_pixel_has_no_wave) {
  const TemporaryFolder folder;
  succeeds(folder, "render --random 1 --size 1x1 --method jfa --waves %d.png");
  BOOST_TEST((folder.names() == std::set<std::string>{"0.png"}));
}

BOOST_AUTO_TEST_CASE(waves_are_drawn_as_the_picture_is) {
  const TemporaryFolder folder;
  folder.file("p.csv", points);
  succeeds(folder, render + "--method jfa --color distance -o a.png --waves %d.png");
  BOOST_TEST(same(cv::imread(folder / "4.png"), cv::imread(folder / "a.png")));
  // On the final picture's scale a distance of 0 is the palette's start, and no label is black.
  const cv::Mat first = cv::imread(folder / "0.png");
  BOOST_TEST((first.at<cv::Vec3b>(1, 2) == cv::imread(folder / "a.png").at<cv::Vec3b>(1, 2)));
  BOOST_TEST((first.at<cv::Vec3b>(0, 0) == cv::Vec3b(0, 0, 0)));
}

BOOST_AUTO_TEST_CASE(pixels_are_enlarged_and_lines_stay_thin) {
  const TemporaryFolder folder;
  folder.file("p.csv", points);
  const auto draw = [&](const std::string& options) {
    succeeds(folder, render + "--method exact -o a.png " + options);
    return cv::imread(folder / "a.png");
  };
  for (const char* color : {"id", "distance", "area"}) {
    const std::string options = std::string(" --color ") + color;
    BOOST_TEST(same(draw("--enlarge 7" + options), enlarged(draw(options), 7)), color);
  }
  // The borders of the squares' labels, one pixel wide.
  const auto labels = brute_force(grid, seeds, Metric::euclidean);
  const Grid large(65, 40);
  std::vector<std::uint32_t> large_labels;
  for (std::size_t y = 0; y < 40; ++y) {
    for (std::size_t x = 0; x < 65; ++x) large_labels.push_back(labels[y / 5 * 13 + x / 5]);
  }
  cv::Mat expected = color_by_id(large_labels, large);
  draw_edges(expected, large_labels);
  draw_points(expected, {{12.5, 7.5}, {57.5, 32.5}, {27.5, 27.5}});
  BOOST_TEST(same(draw("--enlarge 5 --edges --points-overlay"), expected));
  const cv::Mat contours = draw("--enlarge 5 --contours 4");
  BOOST_TEST((contours.rows == 40 && contours.cols == 65));
  BOOST_TEST(!same(contours, color_by_id(large_labels, large)));
}

BOOST_AUTO_TEST_CASE(waves_that_cannot_be_drawn_are_refused) {
  const TemporaryFolder folder;
  const std::string random = "render --random 3 --size 40x20 ";
  refuses(folder, random + "--method exact --waves %d.png", usage, {"--waves", "exact", "no waves"});
  refuses(folder, random + "--method jfa --waves waves.png", usage, {"waves.png", "%05d.png"});
  refuses(folder, random + "--method jfa --waves %d.npy", usage, {"%d.npy", ".png"});
  refuses(folder, random + "--method jfa --waves missing/deep/%d.png", failure,
          {"missing/deep", "does not exist"});
  refuses(folder, random + "--method jfa", usage, {"nothing to write", "--waves"});
  refuses(folder, random + "--method jfa --labels a.npy --enlarge 4", usage, {"--enlarge", "-o or --waves"});
  refuses(folder, random + "--method jfa -o a.png --enlarge 0", usage, {"--enlarge"});
  refuses(folder, random + "--method jfa -o a.png --enlarge 820", usage, {"--enlarge 820", "at most 819"});
  refuses(folder, "simulate --random 3 --size 40x20 --frames 1 --step-length 1 --method jfa --enlarge 4",
          usage, {"--enlarge", "-o"});
}
