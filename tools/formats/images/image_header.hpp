// What an image file says of itself in its first bytes, looked at before anything is decoded.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "vorocl/grid.hpp"

namespace vorocl::command {

struct ImageHeader {
  std::int64_t width = 0;
  std::int64_t height = 0;
  std::uint64_t bits_per_pixel = 0;  // as they are before they are compressed
  bool is_compressed = true;
};

/// Throws Error unless a file that starts like this is a PNG, JPEG, BMP, TIFF or PNM (PBM, PGM, PPM) file:
/// what the image library makes of unknown bytes is not foreseeable.
void check_is_image(const std::string& path, const std::vector<std::uint8_t>& first_bytes);

/// Of such a file, whose content is `bytes`. Throws Error if it is damaged.
ImageHeader read_image_header(const std::string& path, const std::vector<std::uint8_t>& bytes);

/// The grid of the image's pixels. Throws Error if there can be no such grid, or so small a file cannot hold
/// so many pixels: memory is taken only for what the file has.
Grid checked_grid(const std::string& path, const ImageHeader& header, std::uint64_t file_bytes);

}  // namespace vorocl::command
