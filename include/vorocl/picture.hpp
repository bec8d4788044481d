// Pictures of diagrams, with OpenCV: the only part of the library that needs it (target VoroCL::picture).
//
// Values come from the measurements (cells.hpp, adjacency.hpp, fields.hpp) or from the caller; pictures only
// colour them. All pictures are CV_8UC3 (BGR).
#pragma once

#include <cstdint>
#include <opencv2/core.hpp>
#include <optional>
#include <string>
#include <vector>

#include "vorocl/export.h"
#include "vorocl/grid.hpp"

namespace vorocl {

/// Colour maps. For quantities, from the least to the greatest: viridis (dark blue to yellow, perceptually
/// uniform, also for the colour-blind), turbo (dark blue by green to dark red, more contrast) and greys
/// (black to white), and the same reversed. For classes: okabe_ito, eight colours that the colour-blind can
/// tell apart too (Okabe and Ito 2008, with grey in the place of black, which means no_label here); a whole
/// number gets the colour of its remainder by 8.
enum class Palette { viridis, turbo, greys, viridis_r, turbo_r, greys_r, okabe_ito };

/// Whether a palette is one of classes, such as ids, and not one of quantities.
VOROCL_API bool is_categorical(Palette palette);

/// The values that the ends of a palette stand for, low <= high; values beyond get the colours of the ends,
/// and of a categorical palette their own.
/// Colours go by the values or, where the scale is logarithmic and low > 0, by their logarithms: values of 0
/// or less are absent then. A logarithmic scale is for quantities: with a categorical palette it is a bad
/// one.
struct Scale {
  double low = 0;
  double high = 1;
  bool logarithmic = false;
};

/// The range of the values that a picture shows: of the cells that have a pixel, infinite and absent (NaN)
/// values apart. None if there is no value. `values` holds one per seed, by id. Throws Error for a label
/// without a value.
VOROCL_API std::optional<Scale> range_of(const std::vector<std::uint32_t>& labels,
                                         const std::vector<double>& values);

/// The same of an image of distances.
VOROCL_API std::optional<Scale> range_of(const std::vector<float>& distances);

/// Colours each pixel by its label's id. An id has one colour, the same in every picture and frame; ids that
/// are near each other get colours that are easily told apart. no_label is black, which is no id's colour.
/// Throws Error unless there is one label per pixel.
VOROCL_API cv::Mat color_by_id(const std::vector<std::uint32_t>& labels, const Window& window);

/// As above, with the few colours of a categorical palette: neighbours may share one. Throws Error for
/// another palette.
VOROCL_API cv::Mat color_by_id(const std::vector<std::uint32_t>& labels, const Window& window,
                               Palette palette);

/// Colours each pixel by the value of its label's seed. `values` holds one per seed, by id; an absent value
/// (NaN) is light grey and no_label is black. With a categorical palette values are rounded to whole numbers.
/// Throws Error unless there is one label per pixel and a value for every label, and for a bad scale.
VOROCL_API cv::Mat color_by_value(const std::vector<std::uint32_t>& labels, const Window& window,
                                  const std::vector<double>& values, const Scale& scale, Palette palette);

/// Colours each pixel by the colour (BGR) of its label's seed. `colors` holds one per seed, by id; no_label
/// is black. Throws Error unless there is one label per pixel and a colour for every label.
VOROCL_API cv::Mat color_by_seed(const std::vector<std::uint32_t>& labels, const Window& window,
                                 const std::vector<cv::Vec3b>& colors);

/// Colours each pixel by its distance, as distance_field() gives it; a pixel without a label (infinity) is
/// black. Throws Error unless there is one distance per pixel, for a bad scale and for a categorical palette.
VOROCL_API cv::Mat color_by_distance(const std::vector<float>& distances, const Window& window,
                                     const Scale& scale, Palette palette);

/// The widest borders that draw_edges() draws, in pixels.
constexpr int widest_edge = 100;

/// Draws the borders of the cells into a picture, in dark, `width` pixels wide. An even width has as many
/// pixels on both sides of a border, an odd one one more on the left of it or above. Borders fade where they
/// would hide the cells: in a cell whose area is a square of less than 8 pixels a side, to nothing at 2
/// pixels. Throws Error unless the picture has the labels' size and the width is 1 to 100. Along the grid's
/// periodic `axes` a border may lie between its last pixel and its first.
VOROCL_API void draw_edges(cv::Mat& picture, const std::vector<std::uint32_t>& labels, int width = 1,
                           Axes axes = Axes::none);

/// Draws lines of equal distance to the nearest seed into a picture, one every `interval` pixels of distance:
/// dark on bright colours and light on dark ones. A line's pixels are the nearest that are no nearer than its
/// distance. Throws Error unless there is one distance per pixel and the interval is positive and finite.
VOROCL_API void draw_contours(cv::Mat& picture, const std::vector<float>& distances, double interval,
                              Axes axes = Axes::none);

/// Draws a dot on each seed that is not absent into a picture: dark with a light rim where there is room for
/// it, down to one pixel where seeds are dense. Throws Error if a point is outside the picture.
VOROCL_API void draw_points(cv::Mat& picture, const std::vector<Point>& seeds);
VOROCL_API void draw_points(cv::Mat& picture, const std::vector<std::optional<Point>>& seeds);

/// Writes a line of text (ASCII) into the lower left corner of a picture, dark on a light ground. The text
/// grows with the picture's height; what is too long for its width is broken at a comma, or else cut off.
VOROCL_API void draw_text(cv::Mat& picture, const std::string& text);

/// What a colour bar says.
struct ColorBar {
  Scale scale;
  Palette palette = Palette::viridis;
  std::string title;                    ///< the quantity and its unit: "area (px)"; ASCII
  bool whole_values = false;            ///< no ticks between whole numbers
  bool open_ended = false;              ///< there may be values beyond the scale: its ends are pointed
  std::vector<std::string> names = {};  ///< that ticks have in the place of 0, 1, 2, ...: whole values; ASCII
};

/// The picture with a colour bar at its right: a white strip with the title, the bar with its least value at
/// the bottom, and ticks with numbers at round values; of a logarithmic scale, at 1, 2 and 5 times powers of
/// ten, or powers alone, where there are two of these. The text grows with the picture's height; a picture of
/// less than 96 rows gets white ones below. The result's width is even, for films, and bars that are alike
/// make results of one size. Throws Error for a bad scale.
VOROCL_API cv::Mat with_color_bar(const cv::Mat& picture, const ColorBar& bar);

/// The least of 1, 2 and 5 times a power of ten that makes at most `most` steps (at least 1) within the
/// scale; 0 if the scale has no extent. For ticks and contours. Throws Error for a bad scale.
VOROCL_API double round_step(const Scale& scale, int most);

}  // namespace vorocl
