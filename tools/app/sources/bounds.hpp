// The bounds of the data: read, written, and chosen where none are given.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "app/terminal/end_of_run.hpp"
#include "formats/raster.hpp"
#include "formats/trajectory/trajectory.hpp"
#include "vorocl/grid.hpp"

namespace vorocl::command {

/// Throws Error unless the bounds are finite, with x0 <= x1 and y0 <= y1, have an extent along the periodic
/// axes, and are neither so far apart nor so near that an Axis has no scale for them.
void check_bounds(const Bounds& bounds, Axes axes = Axes::none);

/// "X0,Y0,X1,Y1" to bounds, or "X0,Y0,Z0,X1,Y1,Z1" where there may be volumes. Throws Error unless these are
/// so many finite numbers with X0 < X1, Y0 < Y1 and Z0 < Z1.
Bounds parse_bounds(const std::string& text, bool of_volumes = false);

std::string to_string(const Bounds& bounds);

/// The grid with the bounds as its axes: periods, or closed where these are the bounds of points.
Grid with_bounds(const Grid& pixels, const Bounds& bounds, bool closed, bool y_up = false);

/// The axes by the names that --periodic and JSON give them.
std::string to_string(Axes axes);

/// The least bounds that hold all points (at least one). Throws Error if one is not finite.
Bounds bounding_box(const std::vector<Point>& points, bool of_volume = false);

/// The least bounds that hold both.
Bounds joined(const Bounds& a, const Bounds& b);

/// The bounds, farther all round by so many percent of their longer side.
Bounds widened(const Bounds& bounds, double percent);

/// The size of this width whose pixels are square in data units, to the nearest whole height. Throws Error if
/// the bounds have no width or the size is not possible.
Size size_of_width(const Bounds& bounds, int width);

/// True if a pixel is a square in data units, to the nearest whole number of pixels, which may change its
/// sides by 5 %. If not, the seed that is nearest in pixels need not be the nearest in the data. An axis
/// without extent has no scale.
bool has_square_pixels(const Bounds& bounds, const Grid& grid);

/// Warns on standard error unless pixels are square.
void warn_of_scales(const Bounds& bounds, const Grid& grid, const std::string& advice = "");

/// Says on standard error how many points lie outside the bounds, if some do. Throws Error instead where they
/// are kept inside by what the text names ("bench cannot take").
void note_outside(std::size_t outside, std::size_t points, const Bounds& bounds,
                  const std::string& keeps_inside = "");

/// Says on standard error what may surprise of a trajectory, by one of its frames: that the box is turned,
/// that z is left out, and that the box has other periodic axes than what counts instead, if that is told.
void note_of_frame(const Frame& frame, int number, const std::optional<Axes>& told, bool of_volume);

Axes periodic_axes(const Box& box, bool of_volume);

/// The particles, with z where a volume was wanted.
std::vector<Point> points_of(const Frame& frame);

/// A frame's box, else the bounding box of its particles; none if it has neither.
std::optional<Bounds> bounds_of(const Frame& frame);

/// The least bounds that hold those of all frames of a file, or of the first and so many after it, up to the
/// first frame that is bad, read with a progress bar; none for a pipe, which cannot be read twice. Throws
/// Error if it is interrupted, or the file cannot be read.
std::optional<Bounds> bounds_of_all_frames(const std::string& path, bool of_volume, std::optional<int> frames,
                                           const Interruption& interruption);

}  // namespace vorocl::command
