#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <limits>

#include "app/commands/tiles_options.hpp"
#include "app/mpi/ranks.hpp"
#include "app/mpi/shared_plane_writer.hpp"
#include "app/terminal/console.hpp"
#include "app/terminal/end_of_run.hpp"
#include "app/terminal/progress.hpp"
#include "formats/files.hpp"
#include "vorocl/mpi.hpp"

namespace vorocl::command {

namespace {

/// One of the machine's devices of the kind that is asked for: the ranks of a machine take them in turn.
Device device_of_rank(const Ranks& ranks, const std::string& request) {
  MPI_Comm machine = MPI_COMM_NULL;
  MPI_Comm_split_type(ranks.communicator, MPI_COMM_TYPE_SHARED, ranks.rank, MPI_INFO_NULL, &machine);
  const Ranks here(machine);
  MPI_Comm_free(&machine);
  const std::vector<DeviceDescription> all = Device::list(request);
  const auto selected =
      std::find_if(all.begin(), all.end(), [](const DeviceDescription& device) { return device.selected; });
  if (selected == all.end()) return Device::select(request);  // which says what there is
  std::vector<std::string> alike;
  for (const DeviceDescription& device : all) {
    if (device.platform_index == selected->platform_index && device.name == selected->name &&
        device.why_not.empty())
      alike.push_back(fmt::format("{}:{}", device.platform_index, device.device_index));
  }
  return Device::select(alike[static_cast<std::size_t>(here.rank) % alike.size()]);
}

/// All ranks make the same tiles.
TilesOptions with_one_side(TilesOptions options, const Ranks& ranks, const Device& device) {
  if (options.side == 0) options.side = ranks.reduced(default_tile_side(device), MPI_INT, MPI_MIN);
  return options;
}

void check_files(const TilesOptions& options, const Ranks& ranks) {
  if (!options.seeds.mask.empty())
    throw UsageError("--mask is for vorocl tiles, one process that holds a bit for each pixel");
  for (const std::string& path : {options.output.labels, options.output.distances}) {
    if (ranks.count > 1 && is_tiff_name(path))
      throw UsageError(path + ": one process alone can write a TIFF file; take .zarr or .npy");
  }
}

/// Reads this rank's slice of the seeds.
PlaneFacts read_slice(const TilesOptions& options, const Ranks& ranks, const Interruption& interruption,
                      SharedSeeds& seeds) {
  PlaneReading reading;
  reading.add = [&](std::uint64_t first, const Block& places) { seeds.add(places, first); };
  reading.reserve = [&](std::uint64_t count) {
    const auto blocks = (count / block_points + 1) / static_cast<std::uint64_t>(ranks.count) + 1;
    seeds.reserve(static_cast<std::size_t>(std::min(blocks * block_points, count)));
  };
  reading.stops = [&] { return interruption.came(); };
  reading.slice = {static_cast<std::uint64_t>(ranks.rank), static_cast<std::uint64_t>(ranks.count)};
  reading.sum = [&](std::uint64_t number) { return ranks.sum(number); };
  reading.join = [&](const Survey& survey) {
    const double none = std::numeric_limits<double>::infinity();
    const bool any = survey.points > 0;
    const Bounds& box = survey.box;
    const auto least = [&](double at) { return ranks.reduced(any ? at : none, MPI_DOUBLE, MPI_MIN); };
    const auto greatest = [&](double at) { return ranks.reduced(any ? at : -none, MPI_DOUBLE, MPI_MAX); };
    return Survey{ranks.sum(survey.rows),
                  ranks.sum(survey.points),
                  {least(box.x0), least(box.y0), greatest(box.x1), greatest(box.y1)}};
  };
  return read_plane_seeds(options.seeds, reading);
}

/// Makes this rank's tiles. Throws Error if a signal comes before all are.
TilesCourse make_tiles(const TilesOptions& options, const Ranks& ranks, const Device& device,
                       const SharedSeeds& seeds, const Tiling& tiling, const Units& units,
                       SharedPlaneWriter& writer, const Interruption& interruption) {
  std::vector<std::uint64_t> numbers;
  for (std::uint64_t number = 0; number < tiling.count(); ++number) {
    if (writer.made_before().count(number) == 0) numbers.push_back(number);
  }
  TileCounter counter(ranks.communicator, seeds, tiling, numbers);
  TilesCourse course;
  course.made_before = writer.made_before().size();
  course.tiles = tiling.count();
  course.processes = ranks.count;
  const auto share = [&](std::uint64_t tiles) {
    return static_cast<double>(tiles) / static_cast<double>(tiling.count());
  };
  std::optional<Progress> progress;
  if (ranks.rank == 0) progress.emplace(ProgressUnits{"tiles"});
  const Stopwatch stopwatch;
  std::optional<std::uint64_t> last;  // tile that was begun: it or the one before is the present one
  std::optional<std::uint64_t> writing_tile;
  std::uint64_t made = 0;
  const auto next = [&] {
    const std::optional<std::uint64_t> number = counter.next();
    if (number) last = number;
    return number;
  };
  const auto write = [&](const TileLabels& tile) {
    const Stopwatch writing;
    writing_tile = tile.number;
    writer.add(tile);
    course.writing += writing.milliseconds();
    course.pixels += tile.tile.pixels();
    ++made;
    if (progress) progress->show({writer.known(), share(writer.known()), share(course.made_before)});
    writing_tile.reset();
    if (!interruption.came()) return;
    writer.checkpoint();
    throw Error("interrupted");
  };
  try {
    make_tiles(options, device, seeds, tiling, next, units, writer.cells(), write);
    writer.end();
  } catch (const std::exception& error) {  // ours, or out of memory
    const std::string tile = writing_tile ? fmt::format(", writing tile {}", *writing_tile)
                             : last       ? fmt::format(", making tile {} or the one before", *last)
                                          : "";
    throw Error(fmt::format("rank {}{}: {}; {}", ranks.rank, tile, message_of(error), writer.kept()));
  }
  MPI_Barrier(ranks.communicator);
  course.milliseconds = stopwatch.milliseconds();
  course.pixels = ranks.sum(course.pixels);
  course.writing = ranks.reduced(course.writing, MPI_DOUBLE, MPI_SUM) / ranks.count;
  std::vector<std::uint64_t> of_ranks(static_cast<std::size_t>(ranks.count));
  MPI_Gather(&made, 1, MPI_UINT64_T, of_ranks.data(), 1, MPI_UINT64_T, 0, ranks.communicator);
  std::vector<std::size_t> idle;
  for (std::size_t rank = 0; rank < of_ranks.size(); ++rank) {
    if (of_ranks[rank] == 0) idle.push_back(rank);
  }
  if (ranks.rank == 0 && !idle.empty()) {
    print_note(fmt::format("there were {} tiles to make; these ranks made none: {}", numbers.size(),
                           fmt::join(idle, ", ")));
  }
  return course;
}

void run(const TilesOptions& given) {
  const Ranks ranks(MPI_COMM_WORLD);
  const Interruption interruption;  // before there are files
  check_files(given, ranks);
  const Device device = device_of_rank(ranks, given.device);
  const FinishAtEnd finish(device);
  const TilesOptions options = with_one_side(given, ranks, device);
  const Tiling tiling = tiling_of(options, device);
  SharedPlaneWriter writer(ranks, options.output, tiling, georeference(options, tiling),
                           run_of(options, tiling));
  SharedSeeds seeds(ranks.communicator, tiling.window().grid(), options.seeds.snapping());
  const PlaneFacts facts = read_slice(options, ranks, interruption, seeds);
  seeds.share();
  writer.begin(facts.name);
  const TilesCourse course =
      make_tiles(options, ranks, device, seeds, tiling, facts.units, writer, interruption);
  writer.finish(facts.units, [&](const SeedRows& rows) { each_seed(options.seeds, facts, rows); });
  if (ranks.rank == 0) print_result(options, device, facts, tiling, course);
}

}  // namespace

void add_shared_tiles(CommandLine& line, const std::function<void()>& before) {
  add_tiles(line, [before](const TilesOptions& options) {
    before();
    run(options);
  });
}

}  // namespace vorocl::command
