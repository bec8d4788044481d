#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstring>
#include <limits>

#include "app/commands/tiles_options.hpp"
#include "app/mpi/ranks.hpp"
#include "app/outputs/plane_writer.hpp"
#include "app/terminal/console.hpp"
#include "app/terminal/end_of_run.hpp"
#include "app/terminal/progress.hpp"
#include "app/terminal/samples.hpp"
#include "vorocl/error.hpp"
#include "vorocl/mpi.hpp"

namespace vorocl::command {

namespace {

constexpr int written = 1, all_written = 2;  // tags of messages to rank 0

void put(std::vector<char>& message, std::uint64_t number) {
  const char* const bytes = reinterpret_cast<const char*>(&number);
  message.insert(message.end(), bytes, bytes + sizeof number);
}

std::uint64_t get(const std::vector<char>& message, std::size_t& place) {
  std::uint64_t number = 0;
  std::memcpy(&number, message.data() + place, sizeof number);
  place += sizeof number;
  return number;
}

/// Every rank writes its tiles to the same files. Rank 0 makes the files, keeps the journal, sums the cells
/// and gives the files their names; the others tell it what they have written. A journal is always kept, for
/// files that several processes write need a name that all know.
class SharedPlaneWriter {
 public:
  /// Throws Error as PlaneWriter.
  SharedPlaneWriter(const Ranks& ranks, PlaneWriterOptions options, const Tiling& tiling,
                    const std::optional<Georeference>& georeference, const std::string& run)
      : ranks_(ranks),
        tiles_(tiling.count()),
        has_tables_(!options.cells.empty() || !options.adjacency.empty()) {
    if (ranks_.rank == 0) {
      check_journal(options);
      options.resume = true;
      writer_ = std::make_unique<PlaneWriter>(options, tiling, georeference, run);
    } else {
      files_ = plane_files(options, tiling, georeference);
    }
  }

  /// Collective.
  void begin(const std::string& seeds) {
    std::vector<std::uint64_t> made;
    if (ranks_.rank == 0) {
      writer_->begin(seeds);
      made.assign(writer_->made_before().begin(), writer_->made_before().end());
    }
    std::uint64_t count = made.size();
    MPI_Bcast(&count, 1, MPI_UINT64_T, 0, ranks_.communicator);  // the files are there from here on
    made.resize(count);
    MPI_Bcast(made.data(), static_cast<int>(count), MPI_UINT64_T, 0, ranks_.communicator);
    made_before_.insert(made.begin(), made.end());
    known_ = made.size();
    if (made.size() == tiles_) files_.clear();  // nothing is to be written: they may have their names already
    for (const auto& file : files_) file->join();
  }

  /// The tiles that an earlier run has completed, on all ranks.
  const std::set<std::uint64_t>& made_before() const { return made_before_; }

  /// Where this rank's tiles are summed; null: nowhere.
  PlaneCells* cells() {
    if (ranks_.rank == 0) return writer_->cells();
    return has_tables_ ? &cells_ : nullptr;
  }

  /// Writes a tile.
  void add(const TileLabels& tile) {
    if (ranks_.rank == 0) {
      writer_->add(tile);
      ++known_;
      for (;;) {
        int there = 0;
        MPI_Status status;
        MPI_Iprobe(MPI_ANY_SOURCE, written, ranks_.communicator, &there, &status);  // ends are for end()
        if (there == 0) return;
        receive(status);
      }
    }
    TileJournal::Entry entry;
    entry.number = tile.number;
    for (const auto& file : files_) entry.bytes.push_back(file->write(tile).bytes);
    entries_.push_back(std::move(entry));
    int is_sent = 0;  // the last message: a rank 0 that makes a tile takes none
    MPI_Test(&sending_, &is_sent, MPI_STATUS_IGNORE);
    if (is_sent != 0 && stopwatch_.seconds() >= next_checkpoint_) checkpoint();
  }

  /// Notes what this rank has written: after add() alone.
  void checkpoint() {
    if (ranks_.rank == 0) {
      writer_->checkpoint();
      return;
    }
    if (entries_.empty()) return;
    const double begin = stopwatch_.seconds();
    send(written);
    const double end = stopwatch_.seconds();
    next_checkpoint_ = end + time_between_checkpoints * (end - begin);
  }

  /// The tiles that rank 0 knows to be written.
  std::uint64_t known() const { return known_; }

  /// Of a run that ends before all tiles are made: what stays of it, for an error.
  std::string kept() const {
    return ranks_.rank == 0 ? writer_->kept()
                            : "with --resume the same command goes on with the tiles that are not complete";
  }

  /// When this rank has written its tiles. Rank 0 waits until all have, and the disk has them.
  // Before anything that ranks do together: the others' messages end when rank 0 takes them.
  void end() {
    if (ranks_.rank > 0) {
      send(all_written);
      wait_for_message();
      return;
    }
    writer_->checkpoint();
    for (int ended = 1; ended < ranks_.count;) {
      MPI_Status status;
      MPI_Probe(MPI_ANY_SOURCE, MPI_ANY_TAG, ranks_.communicator, &status);
      receive(status);
      writer_->checkpoint();
      ended += status.MPI_TAG == all_written ? 1 : 0;
    }
  }

  /// On all ranks, after end(): gives the files their names.
  void finish(const Units& units, const EachSeed& seeds) {
    if (ranks_.rank == 0) writer_->finish(units, seeds);
    MPI_Barrier(ranks_.communicator);
  }

 private:
  /// Tells rank 0 of the tiles that it does not know yet, when the disk has them.
  void send(int tag) {
    for (const auto& file : files_) file->sync();
    wait_for_message();
    message_.clear();
    put(message_, entries_.size());
    for (const TileJournal::Entry& entry : entries_) {
      put(message_, entry.number);
      put(message_, entry.bytes.size());
      for (const std::uint64_t bytes : entry.bytes) put(message_, bytes);
    }
    entries_.clear();
    if (has_tables_) {
      const std::vector<char> sums = cells_.take();
      message_.insert(message_.end(), sums.begin(), sums.end());
    }
    if (message_.size() > static_cast<std::size_t>(std::numeric_limits<int>::max())) {
      throw Error(
          "the cells of the tiles since the last checkpoint take more than 2 GiB; take smaller tiles");
    }
    MPI_Isend(message_.data(), static_cast<int>(message_.size()), MPI_BYTE, 0, tag, ranks_.communicator,
              &sending_);
  }

  void wait_for_message() {
    // NOLINTNEXTLINE(clang-analyzer-optin.mpi.MPI-Checker): the last call of send() began it
    MPI_Wait(&sending_, MPI_STATUS_IGNORE);
  }

  void receive(const MPI_Status& status) {
    int size = 0;
    MPI_Get_count(&status, MPI_BYTE, &size);
    std::vector<char> message(static_cast<std::size_t>(size));
    MPI_Recv(message.data(), size, MPI_BYTE, status.MPI_SOURCE, status.MPI_TAG, ranks_.communicator,
             MPI_STATUS_IGNORE);
    std::size_t place = 0;
    std::vector<TileJournal::Entry> entries(get(message, place));
    for (TileJournal::Entry& entry : entries) {
      entry.number = get(message, place);
      entry.bytes.resize(get(message, place));
      for (std::uint64_t& bytes : entry.bytes) bytes = get(message, place);
    }
    known_ += entries.size();
    writer_->add(entries, {message.begin() + static_cast<std::ptrdiff_t>(place), message.end()});
  }

  Ranks ranks_;
  std::uint64_t tiles_;
  bool has_tables_;
  std::unique_ptr<PlaneWriter> writer_;  // on rank 0
  std::set<std::uint64_t> made_before_;
  std::uint64_t known_ = 0;

  // On the others:
  std::vector<std::unique_ptr<PlaneFile>> files_;
  PlaneCells cells_;
  std::vector<TileJournal::Entry> entries_;  // that rank 0 does not know yet
  std::vector<char> message_;                // on its way
  MPI_Request sending_ = MPI_REQUEST_NULL;
  Stopwatch stopwatch_;
  double next_checkpoint_ = 0;  // in seconds
};

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
  if (ranks.rank == 0 && !numbers.empty() && !idle.empty()) {
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
