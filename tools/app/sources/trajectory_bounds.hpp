// What the frames of a trajectory fill.
#pragma once

#include <optional>
#include <string>

#include "app/terminal/end_of_run.hpp"
#include "formats/trajectory/trajectory.hpp"
#include "vorocl/bounds.hpp"

namespace vorocl::command {

/// A frame's box, else the bounding box of its particles; none if it has neither.
std::optional<Bounds> bounds_of(const Frame& frame);

/// The least bounds that hold those of all frames, or of the first and so many after it: reads the file, with
/// a progress bar, up to the first frame that is bad. None for a pipe, which cannot be read twice. Throws
/// Error if it is interrupted, or the file cannot be read.
std::optional<Bounds> bounds_of_all_frames(const std::string& path, std::optional<int> frames,
                                           const Interruption& interruption);

}  // namespace vorocl::command
