// Pictures of diagrams, with OpenCV: the only part of the library that needs it (target VoroCL::picture).
#pragma once

#include <cstdint>
#include <opencv2/core.hpp>
#include <vector>

#include "vorocl/export.hpp"
#include "vorocl/grid.hpp"

namespace vorocl {

/// Colour maps for quantities, from the least to the greatest: viridis (dark blue to yellow, perceptually
/// uniform, also for the colour-blind) and turbo (dark blue by green to dark red, more contrast).
enum class Palette { viridis, turbo };

/// Colours each pixel by its label's id: CV_8UC3 (BGR), of the grid's size. An id has one colour, the same in
/// every picture and frame; ids that are near each other get colours that are easily told apart. no_label is
/// black, which is no id's colour. Throws Error unless there is one label a pixel.
VOROCL_API cv::Mat color_by_id(const std::vector<std::uint32_t>& labels, const Grid& grid);

/// Colours each pixel by the distance to its label's seed, from 0 to the largest one in the picture: CV_8UC3
/// (BGR). `seeds` holds the points by id, NaN for an absent one, as Seeds::read() gives them; distances are
/// between pixel centres. no_label is black. Throws Error unless there is one label a pixel and a seed for
/// every label.
VOROCL_API cv::Mat color_by_distance(const std::vector<std::uint32_t>& labels, const Grid& grid,
                                     const std::vector<Point>& seeds, Metric metric, Palette palette);

/// Draws the borders of the cells into a CV_8UC3 picture, in dark: the pixels whose right or lower neighbour
/// has another label. Throws Error unless the picture has the labels' size.
VOROCL_API void draw_edges(cv::Mat& picture, const std::vector<std::uint32_t>& labels);

/// Draws a dot on each seed that is not absent (NaN) into a CV_8UC3 picture: dark with a light rim where
/// there is room for it, down to one pixel where seeds are dense. Throws Error if a point is outside the
/// picture.
VOROCL_API void draw_points(cv::Mat& picture, const std::vector<Point>& seeds);

}  // namespace vorocl
