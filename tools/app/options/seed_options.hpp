// Which seeds there are, and how they move.
#pragma once

#include "app/options/command_line.hpp"
#include "app/sources/moving_seeds.hpp"
#include "app/sources/plane_input.hpp"
#include "app/sources/seed_input.hpp"

namespace vorocl::command {

/// Adds --random, --points, --mask, --trajectory, of which at least so many and at most one must be given,
/// and what goes with them. Where seeds `move` at random, all of them have a use for the rng seed.
void add_seed_options(Command& command, SeedOptions& options, std::size_t least = 1, bool move = false);

/// Adds --random and --points, of which one must be given, and what goes with them, for planes.
void add_plane_options(Command& command, PlaneInputOptions& options);

/// Adds --frame, for the subcommands that show one frame.
void add_frame_option(Command& command, SeedOptions& options);

/// Adds --units, for the subcommands that measure.
void add_units_option(Command& command, SeedOptions& options);

/// Adds --frames, --step-length, --fit and --border.
void add_motion_options(Command& command, MotionOptions& options);

/// "WxH" to a grid. Throws Error if it is not that, or not possible.
Grid parse_size(const std::string& text);

}  // namespace vorocl::command
