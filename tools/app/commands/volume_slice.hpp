// A slice of a volume as a picture.
#pragma once

#include <cstdint>
#include <opencv2/core/mat.hpp>
#include <optional>
#include <string>
#include <vector>

#include "app/options/command_line.hpp"
#include "app/outputs/painter.hpp"
#include "vorocl/seeds.hpp"

namespace vorocl::command {

/// A slice of a volume, across an axis.
struct VolumeSlice {
  char axis;  // x, y or z
  std::int64_t at;
};

/// "z=K" to a slice. Throws Error if it is not that.
VolumeSlice parse_slice(const std::string& text);

/// Adds --slice.
void add_slice_option(Command& command, std::optional<VolumeSlice>& slice);

/// Throws UsageError unless there is a slice of a volume of these sides where there is a picture, and none
/// where there is none, and for options of pictures that slices do not have.
void check_slice(const std::optional<VolumeSlice>& slice, const std::string& picture_path,
                 const PictureOptions& options, const VolumeSize& sides);

/// Draws a slice as the diagram of a plane. `labels` are those of the volume, by seed; `ids` those that they
/// stand for, by seed, or none.
cv::Mat draw_slice(const VolumeSlice& slice, const PictureOptions& options, const Seeds& seeds,
                   const std::vector<std::uint32_t>& labels, const std::vector<std::uint32_t>& ids);

}  // namespace vorocl::command
