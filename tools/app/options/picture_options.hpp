// How diagrams are drawn.
#pragma once

#include <string>

#include "app/options/command_line.hpp"
#include "app/outputs/painter.hpp"

namespace vorocl::command {

/// Adds --color, --palette, --scale, --log, --color-bar, --edges, --contours, --points-overlay, --stamp and
/// --enlarge.
void add_picture_options(Command& command, PictureOptions& options);

/// For a command line that asks for no picture. Throws UsageError if one of the options above was given, and
/// says that it is of use with `files`.
void refuse_picture_options(const Command& command, const std::string& files);

/// Throws UsageError for options that contradict each other.
void check_picture_options(const PictureOptions& options);

/// Throws UsageError if the pictures of a grid would be too large.
void check_picture_size(const PictureOptions& options, const Grid& grid);

/// "LOW,HIGH" or "LOW%,HIGH%" to the ends of a scale. Throws Error unless these are two finite numbers, LOW <
/// HIGH, and percentages from 0 to 100.
ScaleEnds parse_scale(const std::string& text);

}  // namespace vorocl::command
