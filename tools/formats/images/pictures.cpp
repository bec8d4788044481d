#include "formats/images/pictures.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <memory>
#include <opencv2/core.hpp>
#include <utility>

#include "formats/files.hpp"
#include "formats/image_rows.hpp"
#include "formats/modules.hpp"
#include "formats/raster_files.hpp"
#include "vorocl/error.hpp"

namespace vorocl::command {

namespace {

/// Appends up to so many bytes of a file.
void read_more(std::ifstream& file, std::size_t count, std::vector<std::uint8_t>& bytes) {
  const std::size_t before = bytes.size();
  bytes.resize(before + count);
  file.read(reinterpret_cast<char*>(&bytes[before]), static_cast<std::streamsize>(count));
  bytes.resize(before + static_cast<std::size_t>(file.gcount()));
}

ImageInfo info_of(const cv::Mat& picture, const ImageHeader& header) {
  ImageInfo info;
  info.width = picture.cols;
  info.height = picture.rows;
  info.bands = static_cast<std::size_t>(picture.channels());
  info.has_alpha = picture.channels() == 4;
  info.type = picture.depth() == CV_8U ? "u1" : picture.depth() == CV_16U ? "u2" : "f4";
  info.is_lossy = header.is_lossy;
  info.geotags = header.geotags;
  return info;
}

class PictureRows : public ImageRows {
 public:
  PictureRows(const cv::Mat& picture, const ImageHeader& header)
      : ImageRows(info_of(picture, header)), picture_(picture) {}

  void next(std::vector<double>& row) override {
    row.resize(static_cast<std::size_t>(info().width) * info().bands);
    cv::Mat numbers(1, picture_.cols, CV_64FC(picture_.channels()), row.data());
    picture_.row(row_++).convertTo(numbers, CV_64F);
    for (std::size_t i = 2; info().bands > 2 && i < row.size(); i += info().bands)
      std::swap(row[i - 2], row[i]);
  }

 private:
  cv::Mat picture_;
  int row_ = 0;
};

}  // namespace

std::unique_ptr<ImageRows> open_image(const std::string& path) {
  if (extension_of(path) == ".npy") return open_npy_image(path);
  if (extension_of(path.substr(0, path.find_last_not_of('/') + 1)) == ".zarr") {
    throw Error(path +
                " is an array of Zarr: Python's vorocl.mask_tiles() takes it, a slab of rows at a "
                "time; this command reads images and .npy");
  }
  std::ifstream file = open_to_read(path);
  std::vector<std::uint8_t> bytes;
  read_more(file, 16, bytes);  // looked at before the others, of which there may be many
  check_is_image(path, bytes);
  if (is_tiff(bytes)) {
    if (std::unique_ptr<ImageRows> rows = open_tiff_image(path)) return rows;
  }
  while (file) read_more(file, 1 << 20, bytes);
  if (file.bad()) throw Error("reading " + path + " failed");
  const ImageHeader header = read_image_header(path, bytes);
  diagram_size(path, header.width, header.height);  // or it is not decoded
  check_pixels(path, header, bytes.size());
  cv::Mat picture = image_module().decode(bytes, header.is_plain);
  if (picture.empty()) throw Error(path + " is no image that can be read, or is damaged");
  return std::make_unique<PictureRows>(picture, header);
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

MaskRows::MaskRows(const std::string& path, std::optional<double> threshold)
    : path_(path), threshold_(threshold), rows_(open_image(path)), rows_left_(height()) {
  const ImageInfo& info = rows_->info();
  const std::size_t colors = info.bands - (info.has_alpha ? 1 : 0);
  if (info.depth > 1) throw Error(path + " holds a volume; masks are planes");
  if (colors > 4) {
    throw Error(fmt::format("{} has {} bands; a mask has one, or the colours of a picture", path, colors));
  }
}

std::vector<std::string> MaskRows::notes() const {
  const ImageInfo& info = rows_->info();
  std::vector<std::string> notes;
  if (info.pages > 1) notes.push_back(fmt::format("{}: of {} pages the first is read", path_, info.pages));
  if (threshold_) return notes;
  if (info.is_white_zero)
    notes.push_back(path_ +
                    ": 0 is shown as white, and as everywhere the pixels that are not 0 are the seeds");
  if (info.is_lossy)
    notes.push_back(path_ + ": JPEG makes other numbers of zeros; --threshold 127 leaves them out");
  return notes;
}

void MaskRows::next(std::vector<std::uint8_t>& pixels) {
  const ImageInfo& info = rows_->info();
  const std::size_t all = info.bands, colors = all - (info.has_alpha ? 1 : 0);
  rows_->next(row_);
  for (const double* pixel = row_.data(); pixel < row_.data() + row_.size(); pixel += all) {
    const bool is_there = !info.has_alpha || pixel[colors] != 0;
    const bool is_set =
        is_there && std::any_of(pixel, pixel + colors, [&](double number) {
          return !rows_->is_absent(number) && (threshold_ ? number > *threshold_ : number != 0);
        });
    pixels.push_back(is_set ? 1 : 0);
    has_seeds_ = has_seeds_ || is_set;
  }
  if (--rows_left_ > 0 || has_seeds_) return;
  throw Error(fmt::format("{} has no pixel that is {}{}: there is no seed", path_,
                          threshold_ ? fmt::format("greater than {}", *threshold_) : "not zero",
                          info.pages > 1 ? fmt::format(" in the first of its {} pages", info.pages) : ""));
}

Mask read_mask(const std::string& path, std::optional<double> threshold) {
  MaskRows rows(path, threshold);
  Mask mask{diagram_size(path, rows.width(), rows.height()), {}, rows.notes(), rows.geotags()};
  mask.pixels.reserve(mask.size.pixels());
  for (int y = 0; y < mask.size.height(); ++y) rows.next(mask.pixels);
  return mask;
}

DensityImage read_density(const std::string& path) {
  const std::unique_ptr<ImageRows> rows = open_image(path);
  const ImageInfo& info = rows->info();
  const bool is_array = extension_of(path) == ".npy";
  if (info.depth > 1) throw Error(path + " holds a volume; a density is of a plane");
  const double white = info.type == "u1" ? 255 : info.type == "u2" ? 65535 : 0;
  const std::size_t all = info.bands, colors = all - (info.has_alpha ? 1 : 0);
  if (!is_array && (white == 0 || (colors != 1 && colors != 3)))
    throw Error(path + " is no picture of 8 or 16 bits, grey or in colours; give other numbers as .npy");
  DensityImage density{diagram_size(path, info.width, info.height), {}};
  density.values.reserve(density.size.pixels());
  std::vector<double> row;
  for (int y = 0; y < density.size.height(); ++y) {
    rows->next(row);
    for (const double* pixel = row.data(); pixel < row.data() + row.size(); pixel += all) {
      const double grey = colors == 1 ? pixel[0] : 0.299 * pixel[0] + 0.587 * pixel[1] + 0.114 * pixel[2];
      const double dark = info.is_white_zero ? grey : std::max(0.0, white - grey);
      const double weight = is_array                ? pixel[0]
                            : rows->is_absent(grey) ? 0
                            : info.has_alpha        ? dark * pixel[colors] / white
                                                    : dark;
      if (!(weight >= 0 && std::isfinite(weight))) {
        throw Error(fmt::format("{} holds {} at pixel ({}, {}); a density has finite numbers of at least 0",
                                path, weight, (pixel - row.data()) / static_cast<std::ptrdiff_t>(all), y));
      }
      density.values.push_back(static_cast<float>(weight));
    }
  }
  return density;
}

}  // namespace vorocl::command
