// Images of one 32-bit value per pixel as TIFF files.
#pragma once

#include <string>
#include <vector>

#include "formats/label_image.hpp"

namespace vorocl::command {

/// Labels of a TIFF file in strips, of any compression. Throws Error if the file is something else or
/// damaged.
LabelImage read_tiff_labels(const std::string& path);

/// One value per pixel, float or uint32, row-major. The bits of a uint32 are written as a signed integer, for
/// some readers (OpenCV 4) refuse unsigned ones: labels from 2^31 on, and no_label, look negative there.
/// Uncompressed; a BigTIFF where the file would pass 4 GiB. Throws Error if the file cannot be written.
template <typename T>
void write_tiff(const std::string& path, const Grid& grid, const std::vector<T>& values);

}  // namespace vorocl::command
