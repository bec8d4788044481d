// Similarities, against OpenCV's comparison of two images.
#define BOOST_TEST_MODULE opencv_similarity
#include <opencv2/core.hpp>

#include "brute_force.hpp"
#include "fixture.hpp"
#include "read_measures.hpp"
#include "vorocl/picture.hpp"

using namespace vorocl;

namespace {

/// Pixels that match, in percent. OpenCV compares no uint32: of int32 equal bits are equal.
double by_opencv(std::vector<std::uint32_t> a, std::vector<std::uint32_t> b, const Grid& grid) {
  const auto width = static_cast<int>(grid.width()), height = static_cast<int>(grid.height());
  const cv::Mat first(height, width, CV_32S, a.data()), second(height, width, CV_32S, b.data());
  cv::Mat equal;
  cv::compare(first, second, equal, cv::CMP_EQ);
  return 100.0 * cv::countNonZero(equal) / static_cast<double>(grid.pixels());
}

/// Pixels of two pictures that have one colour, in percent.
double by_colour(const cv::Mat& a, const cv::Mat& b) {
  cv::Mat difference, channels[3];
  cv::absdiff(a, b, difference);
  cv::split(difference, channels);
  const cv::Mat any = channels[0] | channels[1] | channels[2];
  return 100.0 * (1 - cv::countNonZero(any) / static_cast<double>(any.total()));
}

}  // namespace

// Frames of dJFA and JFA, with odd widths, so that the last pixels of a row do not fill a vector.
BOOST_AUTO_TEST_CASE(opencv_finds_the_same_similarity) {
  for (const Grid& grid : {Grid(1, 1), Grid(61, 47), Grid(1000, 333)}) {
    Seeds seeds = Seeds::random(test_device(), grid, grid.pixels() / 20 + 1, 1);
    Diagram dynamic(test_device(), grid), jfa(test_device(), grid);
    for (std::uint32_t frame = 0; frame < 4; ++frame) {
      dynamic_jump_flooding(seeds, dynamic);
      jump_flooding(seeds, jfa);
      const std::vector<std::uint32_t> a = dynamic.read(), b = jfa.read();
      const double expected = by_opencv(a, b, grid);
      BOOST_TEST(similarity_of(dynamic, jfa) == expected, boost::test_tools::tolerance(1e-12));
      BOOST_TEST(similarity(a, b) == expected, boost::test_tools::tolerance(1e-12));
      random_step(seeds, 5, Border::reflect, 2, frame);
    }
  }
}

// Of two metrics, so that much differs: the pictures of the two diagrams match where their labels do, but for
// the few seeds that have one colour.
BOOST_AUTO_TEST_CASE(so_do_the_pixels_of_two_pictures) {
  const Grid grid(500, 377);
  const Seeds seeds = Seeds::random(test_device(), grid, 1000, 3);
  Diagram euclidean(test_device(), grid), manhattan(test_device(), grid);
  exact_diagram(seeds, euclidean);
  exact_diagram(seeds, manhattan, {Metric::manhattan});
  const std::vector<std::uint32_t> a = euclidean.read(), b = manhattan.read();
  const double labels = similarity_of(euclidean, manhattan),
               colours = by_colour(color_by_id(a, grid), color_by_id(b, grid));
  BOOST_TEST(labels < 95);
  BOOST_TEST(labels > 80);
  BOOST_TEST(colours >= labels - 1e-9);
  BOOST_TEST(colours < labels + 0.2);
}
