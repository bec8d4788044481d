// vorocl render of a volume: its labels, and a picture of a slice of it.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "app/commands/volume_slice.hpp"
#include "app/sources/seed_input.hpp"
#include "vorocl/method.hpp"

namespace vorocl::command {

/// Throws UsageError for a method that knows planes alone.
void check_volume_method(const Method& method);

/// Puts the ids that labels stand for in their place, if there are any.
void name_labels(std::vector<std::uint32_t>& labels, const std::vector<std::uint32_t>& ids);

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
