// Grids in the units of the data: those of volumes, and of exact cells, which have no pixels.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "app/sources/seed_input.hpp"
#include "formats/trajectory/trajectory.hpp"

namespace vorocl::command {

/// The box of a volume of points, which must lie in it: the bounds, or the points' bounding box. Voxels are
/// counted along the coordinates. Where their sides are whole multiples of one length in data units, axes are
/// spaced so. Without a size it has few voxels, which do not count. Throws Error.
Grid box_of_points(const SeedOptions& options, const std::vector<Point>& points,
                   const std::vector<std::uint32_t>& ids);

/// The same of a frame with these points: what its box, the bounds that are given, `all` or the points say
/// that it shows. `all` is what it shows along axes that are not periodic, unless the options have bounds;
/// without it each frame's own box. The periodic axes are those of the file's box unless they are given.
Grid box_of_frame(const SeedOptions& options, const Frame& frame, const std::vector<Point>& points,
                  const std::optional<Bounds>& all = std::nullopt);

/// The rectangle of exact cells: the bounds, else the domain, the box of the frame or the points' bounding
/// box. Along a periodic axis it is the domain or the box. Says on standard error how many points lie
/// outside. Throws Error.
Grid rectangle_of_points(const SeedOptions& options, const std::vector<Point>& points);
Grid rectangle_of_frame(const SeedOptions& options, const Frame& frame, bool is_first);

/// How such a grid stands in the data, or in pixels alone.
View view_of_grid(const Grid& grid, bool in_pixels);

/// Where the volume of `where` ("frame 3: ") is no picture of the data to scale, a warning says so. Returns
/// whether it did.
bool warn_of_voxels(const Grid& grid, const std::string& where);

/// Says what may surprise: distances that count voxels as they are long, and data without an extent.
void note_scales(const SeedOptions& options, const Grid& grid);

}  // namespace vorocl::command
