#include "formats/images/pictures.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <limits>
#include <opencv2/core.hpp>

#include "formats/files.hpp"
#include "formats/images/png.hpp"
#include "formats/modules.hpp"
#include "vorocl/error.hpp"

namespace vorocl::command {

const std::vector<std::string>& picture_extensions() {
  static const std::vector<std::string> all = {".png", ".jpg", ".jpeg", ".bmp", ".tif", ".tiff"};
  return all;
}

namespace {

/// Of a file that may be a picture: the first bytes are looked at before the others, of which there may be
/// many.
std::vector<std::uint8_t> read_image_file(const std::string& path) {
  std::ifstream file = open_to_read(path);
  std::vector<std::uint8_t> bytes;
  std::size_t wanted = 16;
  while (file) {
    const std::size_t before = bytes.size();
    bytes.resize(before + wanted);
    file.read(reinterpret_cast<char*>(&bytes[before]), static_cast<std::streamsize>(wanted));
    bytes.resize(before + static_cast<std::size_t>(file.gcount()));
    if (before == 0) check_is_image(path, bytes);
    wanted = 1 << 20;
  }
  if (file.bad()) throw Error("reading " + path + " failed");
  return bytes;
}

}  // namespace

cv::Mat read_picture(const std::string& path) {
  const std::vector<std::uint8_t> bytes = read_image_file(path);
  const ImageHeader header = read_image_header(path, bytes);
  checked_size(path, header, bytes.size());
  cv::Mat picture = image_module().decode(bytes, header.is_grey);
  if (picture.empty()) throw Error(path + " is no image that can be read");
  return picture;
}

void write_picture(const OutputFile& file, const cv::Mat& picture) {
  if (extension_of(file.path()) == ".png") return write_png(file, picture);
  const std::vector<std::uint8_t> bytes = image_module().encode(extension_of(file.path()), picture);
  if (bytes.empty()) {
    throw Error(fmt::format("cannot write {}: its format has no pictures of {} x {} pixels", file.path(),
                            picture.cols, picture.rows));
  }
  GrowingFile written(file);
  written.write(bytes.data(), bytes.size());
  written.finish();
}

Mask read_mask(const std::string& path) {
  const cv::Mat image = read_picture(path);
  Mask mask{Size(image.cols, image.rows), {}};
  mask.pixels.reserve(image.total());
  bool has_seeds = false;
  const std::ptrdiff_t channels = image.channels();
  for (int y = 0; y < image.rows; ++y) {
    const cv::Mat set = image.row(y) != 0;
    for (const std::uint8_t* pixel = set.data; pixel < set.data + set.cols * channels; pixel += channels) {
      mask.pixels.push_back(*std::max_element(pixel, pixel + channels));
      has_seeds = has_seeds || mask.pixels.back() != 0;
    }
  }
  if (!has_seeds) throw Error(path + " has no pixel that is not zero: there is no seed");
  return mask;
}

namespace {

template <typename T>
void add_darkness(const T* pixel, int pixels, int channels, std::vector<float>& values) {
  constexpr float white = std::numeric_limits<T>::max();
  for (const T* const end = pixel + std::ptrdiff_t{pixels} * channels; pixel < end; pixel += channels) {
    const float grey = channels == 1 ? pixel[0] : 0.114F * pixel[0] + 0.587F * pixel[1] + 0.299F * pixel[2];
    values.push_back(std::max(0.0F, white - grey));
  }
}

}  // namespace

DensityImage read_darkness(const std::string& path) {
  const cv::Mat image = read_picture(path);
  if (image.depth() != CV_8U && image.depth() != CV_16U) {
    throw Error(path + " is no picture of 8 or 16 bits; give other numbers as .npy");
  }
  DensityImage dark{Size(image.cols, image.rows), {}};
  dark.values.reserve(image.total());
  for (int y = 0; y < image.rows; ++y) {
    if (image.depth() == CV_8U) {
      add_darkness(image.ptr<std::uint8_t>(y), image.cols, image.channels(), dark.values);
    } else {
      add_darkness(image.ptr<std::uint16_t>(y), image.cols, image.channels(), dark.values);
    }
  }
  return dark;
}

}  // namespace vorocl::command
