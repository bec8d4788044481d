// The seeds of a plane that a command line asks for.
#pragma once

#include <functional>
#include <memory>
#include <string>

#include "app/sources/seed_input.hpp"
#include "app/sources/view.hpp"
#include "formats/images/pictures.hpp"
#include "formats/point_files.hpp"
#include "vorocl/tiles.hpp"

namespace vorocl::command {

/// The plane itself, in pixels. Throws UsageError without a size.
Grid plane_of(const SeedOptions& options);

/// Opens the mask, if one is asked for, whose size is the plane's. Throws Error if it cannot be read, and for
/// another size.
std::unique_ptr<MaskRows> open_plane_mask(SeedOptions& options);

/// What no parser can say. Throws UsageError, and Error for bounds that have no scale.
void check_plane_options(const SeedOptions& options);

/// How many points a file has, how many of them are there, and the rectangle that these fill.
struct Survey {
  std::uint64_t rows = 0, points = 0;
  Bounds box;  ///< if there are any
};

/// How seeds are read: by a process alone, or by several that read a slice each, all at once.
struct PlaneReading {
  /// Takes the places, in pixels, of seeds with the ids first, first + 1, ...
  UseBlock add;
  std::function<void(std::uint64_t seeds)> reserve;  ///< says before how many seeds all have
  std::function<bool()> stops;                       ///< asked between two blocks
  Slice slice = {};

  // What is known of a slice becomes what is known of all.
  std::function<Survey(const Survey&)> join = [](const Survey& survey) { return survey; };
  std::function<std::uint64_t(std::uint64_t)> sum = [](std::uint64_t number) { return number; };
};

/// What is known of a plane's seeds besides where they are.
struct PlaneFacts {
  std::uint64_t seeds = 0;
  Units units;
  std::string name;  ///< which tells them from others: how many they are, and a hash of their places
  /// Where a point of the file lies in the plane, in pixels.
  std::function<Point(const Point&)> place = [](const Point& point) { return point; };
};

/// What takes the seeds one by one, as rows of tables of cells: first the names of the columns that are kept.
struct SeedRows {
  std::function<void(const CsvFields& names)> begin;
  /// The seed's place, in pixels, and those columns. Ids ascend.
  std::function<void(std::uint64_t id, const Point& place, const CsvFields& kept)> add;
};
using EachSeed = std::function<void(const SeedRows& rows)>;

/// Reads the seeds' file once more, or makes random ones again. Throws Error if that fails.
void each_seed(const SeedOptions& options, const PlaneFacts& facts, const SeedRows& rows);

/// Reads the seeds, or makes them, in blocks. Throws Error if it is told to stop, and if a file is bad or
/// changes, which names the first point that cannot be a seed; warns on standard error as read_input().
PlaneFacts read_plane_seeds(const SeedOptions& options, const PlaneReading& reading);

/// Reads a mask. Throws Error if it is told to stop, and if the file is damaged or changes.
PlaneFacts read_plane_mask(const std::string& path, MaskRows& rows, const std::function<bool()>& stops,
                           PlaneMask& mask);

}  // namespace vorocl::command
