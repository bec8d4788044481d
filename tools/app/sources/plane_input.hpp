// The seeds of a plane that a command line asks for.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "app/sources/seed_input.hpp"
#include "app/sources/units.hpp"
#include "vorocl/tiles.hpp"

namespace vorocl::command {

/// The seeds' options that a plane has (points or random ones), and its size instead of a grid's.
struct PlaneInputOptions {
  SeedOptions seeds;
  std::optional<Plane> size;  // as given: without periodic axes

  /// The plane itself. Throws UsageError without a size.
  Plane plane() const;
};

/// What no parser can say. Throws UsageError, and Error for bounds that have no scale.
void check_plane_options(const PlaneInputOptions& options);

/// Seeds of a plane, in memory.
struct PlaneInput {
  PlaneSeeds seeds;
  Units units;
  std::string name;  ///< which tells them from others: how many they are, and a hash of their pixels
};

/// Reads the seeds in blocks; between two of them it asks `stops`, and throws Error if that is so. Throws
/// Error if a file is bad or changes, that names the first point that cannot be a seed; warns on standard
/// error as read_input().
PlaneInput read_plane_input(const PlaneInputOptions& options, const std::function<bool()>& stops);

}  // namespace vorocl::command
