// vorocl render of a volume: its labels, and a picture of a slice of it.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "app/outputs/painter.hpp"
#include "app/sources/seed_input.hpp"
#include "vorocl/method.hpp"

namespace vorocl::command {

/// A slice of a volume, across an axis.
struct VolumeSlice {
  char axis;  // x, y or z
  std::int64_t at;
};

/// "z=K" to a slice. Throws Error if it is not that.
VolumeSlice parse_slice(const std::string& text);

struct VolumeRendering {
  SeedOptions seeds;
  Method method;
  MethodOptions method_options;
  std::string device;
  std::string picture_path;
  std::string labels_path;
  PictureOptions picture;
  std::optional<VolumeSlice> slice;
  bool json;
};

/// Makes the volume and writes what is asked for. Throws UsageError for what volumes do not have, Error if it
/// cannot be made.
void render_volume(const VolumeRendering& options);

}  // namespace vorocl::command
