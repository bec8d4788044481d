// vorocl tiles: the exact diagram of a plane that may be far larger than a device, tile by tile.
#include <memory>
#include <utility>

#include "app/commands/commands.hpp"
#include "app/commands/tiles_options.hpp"
#include "app/options/option_groups.hpp"
#include "app/terminal/console.hpp"
#include "app/terminal/end_of_run.hpp"
#include "app/terminal/progress.hpp"

namespace vorocl::command {

namespace {

/// Makes the tiles that are still to be made. Throws Error if a signal comes before all are.
TilesCourse make_tiles(const TilesOptions& options, const Device& device, const SeedSource& seeds,
                       const Tiling& tiling, const Units& units, PlaneWriter& writer,
                       const Interruption& interruption) {
  TilesCourse course;
  course.made_before = course.tiles = writer.made_before().size();
  const auto share = [&] { return static_cast<double>(course.tiles) / static_cast<double>(tiling.count()); };
  const double done_before = share();
  Progress progress({"tiles", "megapixels"});
  const Stopwatch stopwatch;
  const auto write = [&](const TileLabels& tile) {
    const Stopwatch writing;
    writer.add(tile);
    course.writing += writing.milliseconds();
    course.pixels += tile.tile.pixels();
    ++course.tiles;
    progress.show({course.tiles, share(), done_before, static_cast<double>(course.pixels) / 1e6});
    if (!interruption.came()) return;
    writer.checkpoint();
    throw Error("interrupted");
  };
  try {
    make_tiles(
        options, device, seeds, tiling, [&] { return writer.next(); }, units, writer.cells(), write);
  } catch (const std::exception& error) {  // ours, or out of memory
    throw Error(message_of(error) + "; " + writer.kept());
  }
  course.milliseconds = stopwatch.milliseconds();
  return course;
}

/// The seeds of a plane, ready to be asked for, and what is known of them.
std::pair<std::unique_ptr<SeedSource>, PlaneFacts> read_seeds(const SeedOptions& options, MaskRows* rows,
                                                              const Grid& plane,
                                                              const Interruption& interruption) {
  const auto stops = [&] { return interruption.came(); };
  if (rows != nullptr) {
    auto mask = std::make_unique<PlaneMask>(plane);
    PlaneFacts facts = read_plane_mask(options.mask, *rows, stops, *mask);
    return {std::move(mask), std::move(facts)};
  }
  auto seeds = std::make_unique<PlaneSeeds>(plane, SeedsOptions{Outside::count, options.snapping()});
  PlaneReading reading;
  reading.add = [&](std::uint64_t, const Block& places) { seeds->add(places); };
  reading.reserve = [&](std::uint64_t count) { seeds->reserve(static_cast<std::size_t>(count)); };
  reading.stops = stops;
  PlaneFacts facts = read_plane_seeds(options, reading);
  seeds->sort();
  return {std::move(seeds), std::move(facts)};
}

void run_tiles(TilesOptions options) {
  const Interruption interruption;  // before there are files
  const Device device = select_device(options.device);
  const FinishAtEnd finish(device);
  const std::unique_ptr<MaskRows> mask = open_plane_mask(options.seeds);
  const Tiling tiling = tiling_of(options, device);
  PlaneWriter writer(options.output, tiling, georeference(options, tiling, mask.get()),
                     run_of(options, tiling));
  const auto [seeds, facts] = read_seeds(options.seeds, mask.get(), tiling.window().grid(), interruption);
  writer.begin(facts.name);
  const TilesCourse course = make_tiles(options, device, *seeds, tiling, facts.units, writer, interruption);
  writer.finish(facts.units,
                [&, &known = facts](const SeedRows& rows) { each_seed(options.seeds, known, rows); });
  print_result(options, device, facts, tiling, course);
}

}  // namespace

void add_tiles(CommandLine& line) { add_tiles(line, run_tiles); }

}  // namespace vorocl::command
