// Picture files: what they say of themselves in their first bytes, looked at before anything is decoded;
// writing them; and masks and densities.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "formats/image_rows.hpp"
#include "formats/output_file.hpp"
#include "formats/raster.hpp"

namespace cv {
class Mat;
}

namespace vorocl::command {

/// What a picture file says of itself.
struct ImageHeader {
  std::int64_t width = 0;
  std::int64_t height = 0;
  std::uint64_t bits_per_pixel = 0;  // as they are before they are compressed
  bool is_compressed = true;
  bool is_lossy = false;
  bool is_plain = false;  // decoded as it is: one channel if it is grey, with alpha if it has that
  std::optional<GeoTags> geotags = std::nullopt;
};

/// Throws Error unless a file that starts like this is a PNG, JPEG, BMP, TIFF or PNM (PBM, PGM, PPM) file:
/// what the image library makes of unknown bytes is not foreseeable.
void check_is_image(const std::string& path, const std::vector<std::uint8_t>& first_bytes);

/// Of such a file, whose content is `bytes`. Throws Error if it is damaged.
ImageHeader read_image_header(const std::string& path, const std::vector<std::uint8_t>& bytes);

/// Throws Error if so small a file cannot hold so many pixels: memory is taken only for what the file has.
void check_pixels(const std::string& path, const ImageHeader& header, std::uint64_t file_bytes);

/// The extensions of files that a picture can be written to.
inline const std::vector<std::string> picture_extensions = {".png", ".jpg", ".jpeg", ".bmp", ".tif", ".tiff"};

/// Of 8 bits, in one channel or three (BGR). Throws Error if the file cannot be written.
void write_picture(const OutputFile& file, const cv::Mat& picture);

/// As .png, without OpenCV's module of image files, which takes longer to load than a picture to write. Rows
/// are stored as differences to the rows above and deflated in strips, each by a thread: quickly rather than
/// densely, and the same bytes with any number of threads.
void write_png(const OutputFile& file, const cv::Mat& picture);

/// Which pixels of an image are seeds, row by row, of any image, or .npy: those of which one band is not 0,
/// or greater than the threshold. None is where a pixel is transparent, or a number is NaN or what the file
/// says for no data. Memory: that of some rows, and for files that OpenCV decodes the decoded image.
class MaskRows {
 public:
  /// Throws Error if the file cannot be read, or holds a volume or other bands than colours.
  MaskRows(const std::string& path, std::optional<double> threshold);

  std::int64_t width() const { return rows_->info().width; }
  std::int64_t height() const { return rows_->info().height; }
  const std::optional<GeoTags>& geotags() const { return rows_->info().geotags; }

  /// Of what a user may not expect of the file.
  std::vector<std::string> notes() const;

  /// Appends the next row: 1 where a pixel is a seed, else 0. Throws Error if the file is damaged, and at the
  /// last row if there is no seed.
  void next(std::vector<std::uint8_t>& pixels);

 private:
  std::string path_;
  std::optional<double> threshold_;
  std::unique_ptr<ImageRows> rows_;
  std::vector<double> row_;
  std::int64_t rows_left_;
  bool has_seeds_ = false;
};

/// All of them.
struct Mask {
  Size size;
  std::vector<std::uint8_t> pixels;  // row-major, 0 where there is no seed
  std::vector<std::string> notes;
  std::optional<GeoTags> geotags = std::nullopt;
};

/// Memory: a byte per pixel beside that of the rows. Throws Error as MaskRows, and if no diagram can have the
/// size.
Mask read_mask(const std::string& path, std::optional<double> threshold = std::nullopt);

/// How much pixels weigh: the numbers of .npy, or the darkness of pixels of 8 or 16 bits: how far its grey
/// value (ITU-R BT.601) is from white, as ink on paper, and less where it is transparent. No data weigh
/// nothing. Throws Error if the file cannot be read or has other pixels, or a number is negative or not
/// finite.
DensityImage read_density(const std::string& path);

}  // namespace vorocl::command
