// NumPy's array files (.npy, format versions 1 to 3), little-endian and in C order.
#pragma once

#include <string>
#include <vector>

#include "formats/label_image.hpp"
#include "formats/output_file.hpp"
#include "vorocl/grid.hpp"

namespace vorocl::command {

/// The points of an array of shape (N, 2), of any integer or floating-point type of 1 to 8 bytes. Throws
/// Error if the file is something else, ends early or holds no points.
std::vector<Point> read_npy_points(const std::string& path);

/// Labels: uint32, shape (height, width). Throws Error if the file is something else.
LabelImage read_npy_labels(const std::string& path);

/// One value per pixel (uint8, uint32 or float), row-major, to an array of shape (height, width). Throws
/// Error if the file cannot be written.
template <typename T>
void write_npy(const OutputFile& file, const Grid& grid, const std::vector<T>& values);

/// Points to an array of double of shape (N, 2). Throws Error if the file cannot be written.
void write_npy_points(const OutputFile& file, const std::vector<Point>& points);

}  // namespace vorocl::command
