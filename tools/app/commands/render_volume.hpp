// vorocl render of a volume: its labels, and a picture of a slice of it.
#pragma once

#include <string>

#include "app/outputs/painter.hpp"
#include "app/sources/seed_input.hpp"
#include "vorocl/method.hpp"

namespace vorocl::command {

struct VolumeRendering {
  SeedOptions seeds;
  Method method;
  MethodOptions method_options;
  std::string device;
  std::string picture_path;
  std::string labels_path;
  PictureOptions picture;
  bool json;
};

/// Makes the volume and writes what is asked for. Throws UsageError for what volumes do not have, Error if it
/// cannot be made.
void render_volume(const VolumeRendering& options);

}  // namespace vorocl::command
