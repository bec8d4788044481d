// What vorocl tiles is told, and what it says at the end.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>

#include "app/options/command_line.hpp"
#include "app/outputs/plane_writer.hpp"
#include "app/sources/plane_input.hpp"
#include "vorocl/device.hpp"

namespace vorocl::command {

/// A rectangle of the plane's pixels.
struct PlanePart {
  std::int64_t x = 0, y = 0, width = 0, height = 0;
};

struct TilesOptions {
  SeedOptions seeds;
  int side = 0;                   // of tiles; 0: the device's
  std::optional<PlanePart> part;  // else all of it
  Metric metric = Metric::euclidean;
  PlaneWriterOptions output;
  std::optional<Crs> crs;
  std::string device;
  bool json = false;
  std::string run;  // in lines, what a run must share with the one that it goes on with
};

/// Adds the subcommand, which checks its options and gives them to a function.
void add_tiles(CommandLine& line, const std::function<void(const TilesOptions&)>& run);

/// Whether a file of this name is written as a TIFF file.
bool is_tiff_name(const std::string& path);

/// The tiles that are asked for, on a device that is to make them. Throws Error if they are too many, or some
/// are not in the plane.
Tiling tiling_of(const TilesOptions& options, const Device& device);

/// Where the part lies in the coordinates of the bounds or of the mask; none without these.
std::optional<Georeference> georeference(const TilesOptions& options, const Tiling& tiling,
                                         const MaskRows* mask = nullptr);

/// What tells a run from others, in lines.
std::string run_of(const TilesOptions& options, const Tiling& tiling);

/// How far a run has come.
struct TilesCourse {
  std::uint64_t made_before = 0;  // tiles of the run that this one goes on with
  std::uint64_t tiles = 0;        // that are complete, these too
  std::uint64_t pixels = 0;       // of those that this run has made
  double milliseconds = 0;        // of the tiles that this run has made, with the time to write them ...
  double writing = 0;             // ... which is this, for each process
  int processes = 1;
};

/// Makes tiles by exact_tiles(), whose distances are in these units.
void make_tiles(const TilesOptions& options, const Device& device, const SeedSource& seeds,
                const Tiling& tiling, const NextTile& next, const Units& units, PlaneCells* cells,
                const std::function<void(const TileLabels&)>& write);

void print_result(const TilesOptions& options, const Device& device, const PlaneFacts& seeds,
                  const Tiling& tiling, const TilesCourse& course);

}  // namespace vorocl::command
