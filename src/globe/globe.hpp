// Seeds and pixels on the globe, as kernels of great circles take them: see kernels/globe/globe.cl.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "core/seeds_frame.hpp"
#include "exact_cells/sites.hpp"
#include "measures/measurement.hpp"
#include "vorocl/cells.hpp"

namespace vorocl {

constexpr double direction_length = 2147483647;  // in whole numbers: the greatest of 32 bits
constexpr double earth_radius = 6371.0088;       // of the mean sphere, in kilometres

/// The directions of a frame's seeds, and the tree that engines look for them in.
struct GlobeSeeds {
  cl::Buffer directions;  // int4 by id: x, y, z, and how far east; zeros of a seed that is absent
  cl::Buffer places, boxes, levels, ids;
  cl_uint sites = 0;
  cl_int top_level = 0;
};

/// Other boxes of a tree: of each group BOX_NUMBERS times eight numbers, of which the first three are whole
/// and the others floats.
std::vector<cl_int> boxes_along(const DirectionSites& tree);

/// The longitudes and latitudes of a frame's seeds: of those that are snapped the centres of their pixels.
/// Throws BadPoint if one is no latitude.
std::vector<std::optional<Point>> points_on_globe(const SeedsFrame& frame);

std::shared_ptr<const GlobeSeeds> seeds_on_globe(const SeedsFrame& frame);

/// The columns and the rows of a window, as kernels take them.
struct GlobePixels {
  explicit GlobePixels(const Device& device, const Window& window);
  cl::Buffer columns, rows;
};

/// Throws Error unless a grid is one of longitudes and latitudes, in degrees.
void check_globe(const Grid& grid);

/// The pixels of seeds in a window of such a grid, for measures that count labels; those outside are beside
/// it. Throws BadPoint for a latitude beyond a pole.
std::shared_ptr<const PointPlacement> place_on_globe(const Window& window, const PixelGrid& shown,
                                                     const SeedsFrame& frame);

Report exact_diagram_on_globe(Filling& filling, DiagramState& state);

/// The cells of a diagram of great circles, from the labels and the distances of its pixels; of neighbours
/// there is a number for each id.
std::vector<CellRow> cells_on_globe(const MeasuredDiagram& of, const std::vector<std::uint32_t>& labels,
                                    const std::vector<float>& distances,
                                    const std::vector<std::uint32_t>& neighbours);

}  // namespace vorocl
