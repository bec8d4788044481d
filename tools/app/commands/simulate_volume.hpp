// vorocl simulate of a trajectory in a volume: labels and pictures of slices, frame by frame.
#pragma once

#include "app/commands/simulate_course.hpp"
#include "app/commands/volume_slice.hpp"
#include "app/options/command_line.hpp"

namespace vorocl::command {

/// Makes the volumes of all frames and writes what is asked for. Throws UsageError for what volumes do not
/// have, Error if a frame cannot be made; the files of those before it stay.
void simulate_volume(const Command& command, const SimulateOptions& options,
                     const std::optional<VolumeSlice>& slice);

}  // namespace vorocl::command
