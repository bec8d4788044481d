// A picture by an installed VoroCL::picture.
#include <vorocl/picture.hpp>

int main() {
  const cv::Mat picture = vorocl::color_by_id({0, 1, 1, vorocl::no_label}, vorocl::Grid(2, 2));
  const bool right = picture.at<cv::Vec3b>(0, 1) == picture.at<cv::Vec3b>(1, 0) &&
                     picture.at<cv::Vec3b>(0, 0) != picture.at<cv::Vec3b>(0, 1) &&
                     picture.at<cv::Vec3b>(1, 1) == cv::Vec3b(0, 0, 0);
  return right ? 0 : 1;
}
