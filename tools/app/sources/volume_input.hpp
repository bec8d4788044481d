// The seeds of a volume that a command line asks for, and the grid that they are on.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "app/sources/seed_input.hpp"
#include "formats/trajectory/trajectory.hpp"

namespace vorocl::command {

/// The grid of a frame with these points: what its box, the bounds that are given, `all` or the points say
/// that it shows. `all` is what it shows along axes that are not periodic, unless the options have bounds;
/// without it each frame's own box. Voxels are counted along the coordinates. The periodic axes are those of
/// the file's box unless they are given. Where the sides of a frame's voxels are whole multiples of one
/// length in data units, up to 16, its axes are spaced so. Without a size it has few voxels, which do not
/// count. Throws Error, as if a point lies outside.
Grid grid_of_frame(const SeedOptions& options, const Frame& frame, const std::vector<Point>& points,
                   const std::optional<Bounds>& all = std::nullopt);

/// How a volume stands in the data, or in voxels alone.
View view_of_volume(const Grid& grid, bool in_pixels);

/// Where the volume of `where` ("frame 3: ") is no picture of the data to scale, a warning says so. Returns
/// whether it did.
bool warn_of_voxels(const Grid& grid, const std::string& where);

/// Says what may surprise: distances that count voxels as they are long, and data without an extent.
void note_scales(const Grid& grid);

/// Throws UsageError: volumes do not have this option.
[[noreturn]] void refuse_in_volumes(const std::string& option);

/// Throws UsageError for options of seeds that volumes do not have.
void check_volume_options(const SeedOptions& options);

/// Random seeds, or points: one outside the bounds is an Error.
Input read_volume_input(const SeedOptions& options);

}  // namespace vorocl::command
