// Images of one 32-bit value per pixel as TIFF files.
#pragma once

#include <string>
#include <vector>

#include "formats/images/image_header.hpp"
#include "formats/label_image.hpp"
#include "formats/output_file.hpp"

namespace vorocl::command {

/// Whether a file that starts like this is one, in either byte order, a BigTIFF too.
bool is_tiff(const std::vector<std::uint8_t>& bytes);

/// Throws Error if the file is something else or damaged.
ImageHeader read_tiff_header(const std::string& path);

/// Labels of a TIFF file in strips, of any compression. Throws Error if the file is something else or
/// damaged.
LabelImage read_tiff_labels(const std::string& path);

/// One value per pixel, float or uint32, row-major. The bits of a uint32 are written as a signed integer, for
/// some readers (OpenCV 4) refuse unsigned ones: labels from 2^31 on, and no_label, look negative there.
/// Uncompressed; a BigTIFF where the file would pass 4 GiB. Throws Error if the file cannot be written,
/// or is a pipe.
template <typename T>
void write_tiff(const OutputFile& file, const Grid& grid, const std::vector<T>& values);

}  // namespace vorocl::command
