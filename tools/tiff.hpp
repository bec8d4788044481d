// Label images as TIFF files of one 32-bit integer a pixel.
#pragma once

#include <string>

#include "label_image.hpp"

namespace vorocl::command {

/// Labels of a TIFF file in strips, of any compression. Throws Error if the file is something else or
/// damaged.
LabelImage read_tiff_labels(const std::string& path);

/// The labels' bits as signed integers, for some readers (OpenCV 4) refuse unsigned ones: labels from 2^31
/// on, and no_label, look negative there. Uncompressed; a BigTIFF where the file would pass 4 GiB. Throws
/// Error if the file cannot be written.
void write_tiff_labels(const std::string& path, const LabelImage& image);

}  // namespace vorocl::command
