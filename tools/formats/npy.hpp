// NumPy's array files (.npy, format versions 1 to 3): read in either order of bytes and of indices, written
// little-endian and in C order.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "formats/output_file.hpp"
#include "formats/raster.hpp"
#include "vorocl/grid.hpp"

namespace vorocl::command {

class NpyArray;

/// A file that holds an array of points: of shape (N, 2), or (N, 3) in a volume, and booleans or any integer
/// or floating-point type of at most 8 bytes. The points are read when they are asked for.
class NpyPoints {
 public:
  /// Throws Error if the file is something else, ends early or holds no points or more than `most`.
  explicit NpyPoints(const std::string& path, std::uint64_t most = no_label - 1, bool has_z = false);
  ~NpyPoints();

  std::uint64_t size() const { return size_; }

  /// The points from `first` on, which are there. Throws Error if they cannot be read.
  std::vector<Point> read(std::uint64_t first, std::size_t count);

 private:
  std::size_t dimensions_;
  std::unique_ptr<NpyArray> array_;
  std::uint64_t size_ = 0;
};

/// Whether the file holds an array of shape (N, 3). Throws Error if it is no .npy file.
bool holds_points_of_volume(const std::string& path);

/// All points of such a file, at most 2^30.
std::vector<Point> read_npy_points(const std::string& path, bool has_z = false);

/// One value per pixel (uint8, uint32 or float), row-major, to an array of shape (height, width), or of a
/// volume slice after slice to (depth, height, width). Throws Error if the file cannot be written.
template <typename T>
void write_npy(const OutputFile& file, const Raster& raster, const std::vector<T>& values);

/// What stands before the values (uint8, uint32, float or double) of an array of this shape.
template <typename T>
std::string npy_header(const std::vector<std::size_t>& shape);

/// Points to an array of double of shape (N, 2). Throws Error if the file cannot be written.
void write_npy_points(const OutputFile& file, const std::vector<Point>& points);

}  // namespace vorocl::command
