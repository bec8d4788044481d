// PNG files, read back by OpenCV.
#define BOOST_TEST_MODULE png
#include <fstream>
#include <iterator>
#include <opencv2/imgcodecs.hpp>
#include <random>
#include <string>

#include "fixture.hpp"
#include "formats/files.hpp"
#include "formats/images/pictures.hpp"
#include "temporary_folder.hpp"

using namespace vorocl;
using namespace vorocl::command;

namespace {

/// Blocks of one colour with noise in some of them.
cv::Mat some_picture(const cv::Size& size, int type) {
  cv::Mat picture(size, type);
  std::mt19937 random(1);
  const int bytes = size.width * picture.channels();
  for (int y = 0; y < size.height; ++y) {
    for (int x = 0; x < bytes; ++x) {
      const int block = x / 60 + 7 * (y / 20);
      const int value = block % 5 == 0 ? static_cast<int>(random() % 256) : block * 37 + x % 3;
      picture.ptr(y)[x] = static_cast<std::uint8_t>(value);
    }
  }
  return picture;
}

std::string content(const std::string& path) {
  std::ifstream file = open_to_read(path);
  return {std::istreambuf_iterator<char>(file), {}};
}

}  // namespace

BOOST_AUTO_TEST_CASE(any_size_is_read_back) {
  const TemporaryFolder folder;
  for (const int type : {CV_8UC1, CV_8UC3}) {
    for (const cv::Size& size :
         {cv::Size(1, 1), cv::Size(1, 4000), cv::Size(32768, 70), cv::Size(1023, 1500)}) {
      const cv::Mat picture = some_picture(size, type);
      write_png(folder / "a.png", picture);
      const cv::Mat read = cv::imread(folder / "a.png", cv::IMREAD_UNCHANGED);
      BOOST_REQUIRE((read.type() == type && read.size() == size));
      BOOST_TEST(cv::norm(read, picture, cv::NORM_INF) == 0);
      write_png(folder / "b.png", picture);
      BOOST_TEST((content(folder / "a.png") == content(folder / "b.png")));
    }
  }
}

BOOST_AUTO_TEST_CASE(a_part_of_a_picture_is_written) {
  const TemporaryFolder folder;
  const cv::Mat part = some_picture({300, 200}, CV_8UC3)(cv::Rect(50, 20, 101, 77));
  write_png(folder / "a.png", part);
  BOOST_TEST(cv::norm(cv::imread(folder / "a.png"), part, cv::NORM_INF) == 0);
}
