#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <vector>

#include "app/outputs/diagram_files.hpp"
#include "app/outputs/plane_summary.hpp"
#include "formats/files.hpp"
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

}  // namespace

PlaneTables::PlaneTables(const std::string& cells, const std::string& adjacency, std::uint64_t pixels)
    : cells_file_(open_output(cells)), adjacency_file_(open_output(adjacency)), pixels_(pixels) {}

void PlaneTables::open_part(const std::optional<Kept>& kept, bool is_complete) {
  std::error_code ignored;
  is_finished_ = is_complete && !std::filesystem::exists(part_path(), ignored);
  if (is_finished_) {
    for (const auto& file : {cells_file_, adjacency_file_}) {
      if (file) open_to_read(file->path());
    }
    return;
  }
  sums_ = std::make_unique<GrowingFile>(cells_file_ ? *cells_file_ : *adjacency_file_, kept);
  if (kept) read_sums(part_path(), kept->bytes);
}

void PlaneTables::read_sums(const std::string& path, std::size_t bytes) {
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

std::size_t PlaneTables::sync() {
  if (!sums_) return 0;
  const std::vector<char> piece = recent_.take();
  const PieceHead head = {piece.size(), hash_of(piece)};
  sums_->write(&head, sizeof head);
  sums_->write(piece.data(), piece.size());
  cells_.add(piece);
  return sums_->sync();
}

void PlaneTables::finish(const Units& units, const EachSeed& seeds) {
  if (!is_asked_for() || is_finished_) return;
  cells_.add(recent_.take());
  const std::vector<PlaneCellPair> pairs = cells_.pairs();
  if (cells_file_) write_cells(*cells_file_, cells_, pairs, units, seeds, pixels_);
  if (adjacency_file_) write_pairs(*adjacency_file_, pairs, units);
  if (sums_) unlink(part_path().c_str());
}

}  // namespace vorocl::command
