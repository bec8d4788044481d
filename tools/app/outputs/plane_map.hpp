// A picture of a plane, for people to look at.
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "formats/planes/plane_file.hpp"

namespace vorocl::command {

/// The longest side of the picture.
constexpr std::int64_t longest_side_of_map = 4096;

/// A picture of a tiling's part in which each pixel stands for a square of the plane's, and has the colour of
/// the one in its middle: that of its seed's id, as in render's pictures. Until it is finished its labels
/// are kept in a file. Throws Error as plane_file().
std::unique_ptr<PlaneFile> plane_map(const std::string& path, const Tiling& tiling);

}  // namespace vorocl::command
