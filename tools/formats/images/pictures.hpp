// Picture files: what they say of themselves in their first bytes, looked at before anything is decoded;
// reading and writing them; and masks.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

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
  bool is_grey = false;  // there are no colours, in a palette neither
};

/// Throws Error unless a file that starts like this is a PNG, JPEG, BMP, TIFF or PNM (PBM, PGM, PPM) file:
/// what the image library makes of unknown bytes is not foreseeable.
void check_is_image(const std::string& path, const std::vector<std::uint8_t>& first_bytes);

/// Of such a file, whose content is `bytes`. Throws Error if it is damaged.
ImageHeader read_image_header(const std::string& path, const std::vector<std::uint8_t>& bytes);

/// The size of the image. Throws Error if no diagram can have it, or so small a file cannot hold
/// so many pixels: memory is taken only for what the file has.
Size checked_size(const std::string& path, const ImageHeader& header, std::uint64_t file_bytes);

/// The extensions of files that a picture can be written to.
const std::vector<std::string>& picture_extensions();

/// One channel of an image without colours, else three (BGR), of the file's depth, as the file has them: not
/// turned by what it says of the camera. Throws Error if the file cannot be read.
cv::Mat read_picture(const std::string& path);

/// Of 8 bits, in one channel or three (BGR). Throws Error if the file cannot be written.
void write_picture(const OutputFile& file, const cv::Mat& picture);

/// Each pixel that is not zero is a seed.
struct Mask {
  Size size;
  std::vector<std::uint8_t> pixels;  // row-major, 0 where there is no seed
};

/// From any image that OpenCV reads; a pixel is set if one of its colour channels is not 0 (an alpha channel
/// does not count). Memory: a byte per pixel besides the decoded image. Throws Error if the file cannot be
/// read or no pixel is set.
Mask read_mask(const std::string& path);

/// The darkness of each pixel of any image that OpenCV reads in 8 or 16 bits: how far its grey value (ITU-R
/// BT.601) is from white, as ink on paper. An alpha channel does not count. Throws Error if the file cannot
/// be read or has no such bits.
DensityImage read_darkness(const std::string& path);

}  // namespace vorocl::command
