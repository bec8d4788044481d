#include "app/outputs/plane_writer.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <utility>

#include "app/outputs/diagram_files.hpp"
#include "formats/files.hpp"
#include "formats/images/pictures.hpp"
#include "formats/values.hpp"
#include "vorocl/error.hpp"

namespace vorocl::command {

namespace {

/// What a cell shares with others.
struct Shares {
  std::size_t neighbours = 0;
  std::uint64_t perimeter = 0;
};

/// The shares of cells, which are asked for in the order of their ids.
class SharesByCell {
 public:
  explicit SharesByCell(const std::vector<PlaneCellPair>& pairs) {
    lengths_.reserve(2 * pairs.size());
    for (const PlaneCellPair& pair : pairs) {
      lengths_.emplace_back(pair.a, pair.length);
      lengths_.emplace_back(pair.b, pair.length);
    }
    std::sort(lengths_.begin(), lengths_.end());
    next_ = lengths_.begin();
  }

  Shares of(std::uint64_t id) {
    Shares shares;
    for (; next_ != lengths_.end() && next_->first == id; ++next_) {
      ++shares.neighbours;
      shares.perimeter += next_->second;
    }
    return shares;
  }

 private:
  using Lengths = std::vector<std::pair<std::uint32_t, std::uint64_t>>;
  Lengths lengths_;
  Lengths::const_iterator next_;
};

/// Throws Error, and writes nothing, if the cells are not all that the plane's `pixels` make.
void write_cells(const OutputFile& file, const PlaneCells& cells, const std::vector<PlaneCellPair>& pairs,
                 const Units& units, const EachSeed& seeds, std::uint64_t pixels) {
  GrowingFile table(file);
  const std::vector<std::string> names = cell_columns(CellsOf::tiles);
  const std::vector<CellColumn> columns = cell_columns_of(names);
  RowText row("");
  SharesByCell shares_by_cell(pairs);
  std::uint64_t summed = 0;
  const auto begin = [&](const CsvFields& kept) { table << header_of_cells(names, units, kept); };
  const auto add = [&](std::uint64_t id, const Point& place, const CsvFields& kept) {
    const PlaneCell cell = cells.cell(id);
    if (cell.area == 0) return;
    summed += cell.area;
    const Shares shares = shares_by_cell.of(id);
    CellValues values;
    values.id = static_cast<double>(id);
    values.seed = units.position(place);
    values.area = units.area(static_cast<double>(cell.area));
    values.centroid = units.position(cell.centroid);
    values.extent = units.extent({static_cast<double>(cell.left), static_cast<double>(cell.top),
                                  static_cast<double>(cell.right), static_cast<double>(cell.bottom)});
    values.perimeter = units.length(static_cast<double>(shares.perimeter));
    values.neighbours = static_cast<double>(shares.neighbours);
    values.touches_border = cell.touches_border ? 1 : 0;
    row.clear();
    row.begin_row();
    add_cell(row, columns, values, &kept);
    row.end_row();
    table << row.text();
  };
  seeds({begin, add});
  if (summed != pixels && summed > 0) {  // without any seed no pixel has a cell
    throw Error(
        fmt::format("{}: the cells have {} pixels and the plane has {}; what was kept of an earlier "
                    "run is damaged",
                    file.path(), summed, pixels));
  }
  table.finish();
}

/// What stands before each piece of sums in their file.
struct PieceHead {
  std::uint64_t size = 0;
  std::uint64_t hash = 0;
};

std::uint64_t hash_of(const std::vector<char>& bytes) {
  Hash hash;
  hash.add_text(std::string_view(bytes.data(), bytes.size()));
  return hash.value();
}

void write_pairs(const OutputFile& file, const std::vector<PlaneCellPair>& pairs, const Units& units) {
  GrowingFile table(file);
  table << units.header({"a", "b", "length"});
  for (const PlaneCellPair& pair : pairs) {
    table << fmt::format("{},{},{}\n", pair.a, pair.b, units.length(static_cast<double>(pair.length)));
  }
  table.finish();
}

/// Beside the first file that is asked for.
std::string journal_of(const PlaneWriterOptions& options) {
  for (const RequestedFile& file : requested_files(options)) {
    if (!file.path.empty()) return journal_path(file.path);
  }
  return "";
}

std::unique_ptr<TileJournal> open_journal(const PlaneWriterOptions& options, const std::string& run) {
  check_journal(options);
  return options.resume ? std::make_unique<TileJournal>(journal_of(options), run) : nullptr;
}

}  // namespace

/// Tables as those of cells_kind() and adjacency_kind(), with the columns that are known of a plane's cells,
/// and one row per cell that has pixels. What another run is to go on with are the sums of tiles, in pieces
/// that are appended to a file.
class PlaneTables {
 public:
  /// The files' paths, empty: not asked for; and the pixels that all cells have together. Throws Error if no
  /// file can be made there.
  PlaneTables(const std::string& cells, const std::string& adjacency, std::uint64_t pixels)
      : cells_file_(open_output(cells)), adjacency_file_(open_output(adjacency)), pixels_(pixels) {}

  bool is_asked_for() const { return cells_file_ || adjacency_file_; }

  /// Where tiles are summed; null without tables.
  PlaneCells* recent() { return is_asked_for() ? &recent_ : nullptr; }

  /// Begins a file of sums, or goes on behind what was kept of it. If that is complete and there is none, the
  /// tables must be there already. Throws Error if that fails, or it is no such file.
  void open_part(const std::optional<Kept>& kept) {
    std::error_code ignored;
    is_finished_ = kept && kept->is_complete && !std::filesystem::exists(part_path(), ignored);
    if (is_finished_) {
      for (const auto& file : {cells_file_, adjacency_file_}) {
        if (file) open_to_read(file->path());
      }
      return;
    }
    sums_ = std::make_unique<GrowingFile>(cells_file_ ? *cells_file_ : *adjacency_file_, kept);
    if (kept) read_sums(part_path(), kept->bytes);
  }

  std::string part_path() const { return (cells_file_ ? *cells_file_ : *adjacency_file_).part_path(); }

  /// Makes the disk have the sums so far, and returns the bytes of their file; 0 without one.
  std::size_t sync() {
    if (!sums_) return 0;
    const std::vector<char> piece = recent_.take();
    const PieceHead head = {piece.size(), hash_of(piece)};
    sums_->write(&head, sizeof head);
    sums_->write(piece.data(), piece.size());
    cells_.add(piece);
    return sums_->sync();
  }

  /// Writes the tables. Throws Error if the cells' areas do not add up to the pixels.
  void finish(const Units& units, const EachSeed& seeds) {
    if (!is_asked_for() || is_finished_) return;
    cells_.add(recent_.take());
    const std::vector<PlaneCellPair> pairs = cells_.pairs();
    if (cells_file_) write_cells(*cells_file_, cells_, pairs, units, seeds, pixels_);
    if (adjacency_file_) write_pairs(*adjacency_file_, pairs, units);
    if (sums_) unlink(part_path().c_str());
  }

 private:
  void read_sums(const std::string& path, std::size_t bytes) {
    std::ifstream file = open_to_read(path);
    const Error damaged(path + " is damaged");
    std::vector<char> piece;
    while (bytes > 0) {
      PieceHead head;
      file.read(reinterpret_cast<char*>(&head), sizeof head);
      if (!file || bytes < sizeof head || bytes - sizeof head < head.size) throw damaged;
      piece.resize(head.size);
      file.read(piece.data(), static_cast<std::streamsize>(head.size));
      if (!file || hash_of(piece) != head.hash) throw damaged;
      cells_.add(piece);
      bytes -= sizeof head + head.size;
    }
  }

  std::optional<OutputFile> cells_file_, adjacency_file_;
  std::uint64_t pixels_;
  PlaneCells cells_, recent_;  // those of the tiles before the last sync(), and since
  std::unique_ptr<GrowingFile> sums_;
  bool is_finished_ = false;
};

std::vector<RequestedFile> requested_files(const PlaneWriterOptions& options) {
  return {{"--labels", options.labels, plane_extensions},
          {"--distance", options.distances, plane_extensions},
          {"-o", options.picture, picture_extensions},
          {"--cells", options.cells, {".csv"}},
          {"--adjacency", options.adjacency, {".csv"}}};
}

void check_journal(const PlaneWriterOptions& options) {
  if (!options.resume) refuse_journal(journal_of(options));
}

std::vector<std::unique_ptr<PlaneFile>> plane_files(const PlaneWriterOptions& options, const Tiling& tiling,
                                                    const std::optional<Georeference>& georeference) {
  std::vector<std::unique_ptr<PlaneFile>> files;
  if (!options.labels.empty())
    files.push_back(plane_file(options.labels, tiling, PlaneValues::labels, georeference));
  if (!options.distances.empty())
    files.push_back(plane_file(options.distances, tiling, PlaneValues::distances, georeference));
  if (!options.picture.empty()) files.push_back(plane_map(options.picture, tiling));
  return files;
}

PlaneWriter::PlaneWriter(const PlaneWriterOptions& options, const Tiling& tiling,
                         const std::optional<Georeference>& georeference, const std::string& run)
    : tiling_(tiling),
      journal_(open_journal(options, run)),
      files_(plane_files(options, tiling, georeference)),
      tables_(std::make_unique<PlaneTables>(options.cells, options.adjacency, tiling.window().pixels())) {
  if (!journal_) return;
  for (const RequestedFile& file : requested_files(options)) {
    if (!file.path.empty() && extension_of(file.path) == ".csv")
      OutputFile(file.path).require_file("--resume");
  }
}

PlaneWriter::~PlaneWriter() = default;

PlaneCells* PlaneWriter::cells() { return tables_->recent(); }

std::vector<std::string> PlaneWriter::part_paths() const {
  std::vector<std::string> paths;
  for (const auto& file : files_) paths.push_back(file->part_path());
  if (tables_->is_asked_for()) paths.push_back(tables_->part_path());
  return paths;
}

void PlaneWriter::begin(const std::string& seeds) {
  if (!journal_) {
    for (const auto& file : files_) file->open();
    return;
  }
  journal_->begin(part_paths(), seeds);
  for (std::size_t i = 0; i < files_.size(); ++i) {
    const std::optional<KeptTiles> kept = journal_->kept(i);
    journal_->open([&] { files_[i]->open_part(kept); });
  }
  if (tables_->is_asked_for()) {
    journal_->open([&] { tables_->open_part(journal_->kept_sums()); });
  }
  for (const TileJournal::Entry& tile : journal_->tiles()) made_before_.insert(tile.number);
  complete_ = made_before_.size();
}

std::optional<std::uint64_t> PlaneWriter::next() {
  while (made_before_.count(next_) > 0) ++next_;
  return next_ < tiling_.count() ? std::optional(next_++) : std::nullopt;
}

void PlaneWriter::add(const TileLabels& tile) {
  TileJournal::Entry entry;
  entry.number = tile.number;
  for (const auto& file : files_) entry.bytes.push_back(file->write(tile).bytes);
  if (!journal_) return;
  entries_.push_back(std::move(entry));
  if (stopwatch_.seconds() >= next_checkpoint_) checkpoint();
}

void PlaneWriter::add(const std::vector<TileJournal::Entry>& entries, const std::vector<char>& sums) {
  entries_.insert(entries_.end(), entries.begin(), entries.end());
  if (PlaneCells* const cells = tables_->recent()) cells->add(sums);
}

void PlaneWriter::checkpoint() {
  if (!journal_ || entries_.empty()) return;
  const double begin = stopwatch_.seconds();
  for (const auto& file : files_) file->sync();
  journal_->complete(entries_, tables_->sync());
  complete_ += entries_.size();
  entries_.clear();
  const double end = stopwatch_.seconds();
  next_checkpoint_ = end + time_between_checkpoints * (end - begin);
}

std::string PlaneWriter::kept() const {
  if (!journal_) return "nothing stays of the tiles before that; with --resume a run can go on";
  return fmt::format("{} of {} tiles are complete and kept in {} and {}; run the same command again to go on",
                     complete_, tiling_.count(), fmt::join(part_paths(), ", "), journal_->path());
}

void PlaneWriter::finish(const Units& units, const EachSeed& seeds) {
  checkpoint();
  if (journal_) journal_->finish();
  for (const auto& file : files_) file->finish();
  tables_->finish(units, seeds);
  if (journal_) journal_->remove();
}

}  // namespace vorocl::command
