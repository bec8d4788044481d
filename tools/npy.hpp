// NumPy's array files (.npy, format versions 1 to 3), little-endian and in C order.
#pragma once

#include <string>
#include <vector>

#include "label_image.hpp"
#include "vorocl/grid.hpp"

namespace vorocl::command {

/// The points of an array of shape (N, 2), of any integer or floating-point type of 1 to 8 bytes. Throws
/// Error if the file is something else, ends early or holds no points.
std::vector<Point> read_npy_points(const std::string& path);

/// Labels: uint32, shape (height, width). Throws Error if the file is something else or cannot be written.
LabelImage read_npy_labels(const std::string& path);
void write_npy_labels(const std::string& path, const LabelImage& image);

}  // namespace vorocl::command
