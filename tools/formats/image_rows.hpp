// The numbers of image files, row by row: what masks, densities and labels are read from.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "formats/raster.hpp"

namespace vorocl::command {

/// What an image file says of its pixels.
struct ImageInfo {
  std::int64_t width = 1, height = 1;            ///< which may be more than a diagram has
  std::int64_t depth = 1;                        ///< slices of a volume
  std::size_t bands = 1;                         ///< numbers of a pixel
  bool has_alpha = false;                        ///< the last of them says how opaque it is
  std::string type = "u1";                       ///< of the numbers: 'b', 'u', 'i' or 'f', and bytes
  std::optional<double> no_data = std::nullopt;  ///< what stands where there are none
  bool is_white_zero = false;                    ///< 0 is shown as white
  bool is_lossy = false;                         ///< packed so that numbers are nearly what they were
  int pages = 1;                                 ///< of which the first is read
  std::optional<GeoTags> geotags = std::nullopt;
};

/// An open file. Colours are red, green and blue; TIFF files have the numbers that are stored, whatever these
/// look like.
class ImageRows {
 public:
  explicit ImageRows(ImageInfo info) : info_(std::move(info)) {}
  virtual ~ImageRows() = default;

  const ImageInfo& info() const { return info_; }

  /// The numbers of the next row, slice after slice. Throws Error if the file is damaged.
  virtual void next(std::vector<double>& row) = 0;

  /// Whether a number says that there is none: what the file says, or no number.
  bool is_absent(double number) const { return std::isnan(number) || number == info_.no_data; }

 private:
  ImageInfo info_;
};

/// The size of a file's image. Throws Error if no diagram can have it.
Size diagram_size(const std::string& path, std::int64_t width, std::int64_t height);

/// An image of any kind that is read: .npy by its extension, others by their first bytes. Throws Error if the
/// file is something else or damaged.
std::unique_ptr<ImageRows> open_image(const std::string& path);

/// Those of .npy files, of shape (height, width) or (depth, height, width), and of TIFF files; null for a
/// TIFF file whose numbers are no grey or RGB values, such as those of a palette.
std::unique_ptr<ImageRows> open_npy_image(const std::string& path);
std::unique_ptr<ImageRows> open_tiff_image(const std::string& path);

}  // namespace vorocl::command
