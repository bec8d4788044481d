#include "tiles/plane_cells.hpp"

#include <cstring>
#include <limits>
#include <utility>

#include "runtime/internal.hpp"
#include "vorocl/error.hpp"

namespace vorocl {

namespace {

/// An axis of a plane, along which pixels of a cell count the shorter way round from its seed.
struct Unwrapping {
  std::int64_t period;  // in pixels; 0: none
  std::int64_t seed;    // in fractions of a pixel

  /// What is added to a coordinate: periods, or nothing. Half a period away it lies behind the seed.
  /// A window that crosses the period's end shows pixels behind it.
  std::int64_t shift_at(std::int64_t at) const {
    const std::int64_t way = centre_of(at) - seed;
    return (shorter_way(way, in_fractions(period)) - way) / fractions_of_pixel;
  }
};

/// Whether both have the same pixels, whatever units the grids have.
bool is_same(const Tiling& a, const Tiling& b) {
  const auto key = [](const Tiling& tiling) {
    const Window& window = tiling.window();
    const Grid& grid = window.grid();
    return std::make_tuple(grid.width(), grid.height(), grid.periodic(), window.x(), window.y(),
                           window.width(), window.height(), tiling.side());
  };
  return key(a) == key(b);
}

/// What stands before the records that are given away.
struct TakenHead {
  std::uint64_t ids;
  std::int64_t width, height;
  std::int64_t periodic;
  std::int64_t window_x, window_y, window_width, window_height;
  std::int64_t side;
  std::uint64_t cells, pairs, rims;
};

struct TakenRim {
  std::uint64_t row, column, is_right, labels;
};

class TakenWriter {
 public:
  template <typename T>
  void add(const T* values, std::size_t count) {
    const char* const first = reinterpret_cast<const char*>(values);
    bytes_.insert(bytes_.end(), first, first + count * sizeof(T));
  }
  std::vector<char> bytes() && { return std::move(bytes_); }

 private:
  std::vector<char> bytes_;
};

class TakenReader {
 public:
  explicit TakenReader(const std::vector<char>& bytes) : at_(bytes.data()), end_(at_ + bytes.size()) {}

  template <typename T>
  std::vector<T> next(std::uint64_t count) {
    if (static_cast<std::size_t>(end_ - at_) / sizeof(T) < count) refuse();
    std::vector<T> values(count);
    if (count > 0) std::memcpy(static_cast<void*>(values.data()), at_, count * sizeof(T));
    at_ += count * sizeof(T);
    return values;
  }

  bool at_end() const { return at_ == end_; }
  [[noreturn]] static void refuse() {
    throw Error("these are not the sums of a plane's cells that were given away");
  }

 private:
  const char* at_;
  const char* end_;
};

}  // namespace

void PlaneCellsState::begin(std::uint64_t ids_of_seeds, const Tiling& tiling) {
  *this = PlaneCellsState();
  ids = ids_of_seeds;
  tiling_.assign(1, tiling);
}

std::vector<char> PlaneCellsState::take() {
  if (tiling_.empty()) return {};
  const Tiling tiling = tiling_.front();
  const Window& window = tiling.window();
  const Grid& grid = window.grid();
  const std::vector<CellRecord>& cell_records = cells.sorted();
  const std::vector<PairRecord>& pair_records = pairs.sorted();
  const TakenHead head = {
      ids,           grid.width(),        grid.height(),       static_cast<std::int64_t>(grid.periodic()),
      window.x(),    window.y(),          window.width(),      window.height(),
      tiling.side(), cell_records.size(), pair_records.size(), rims_.size()};
  TakenWriter taken;
  taken.add(&head, 1);
  taken.add(cell_records.data(), cell_records.size());
  taken.add(pair_records.data(), pair_records.size());
  for (const auto& [seam, labels] : rims_) {
    const auto& [row, column, is_right] = seam;
    const TakenRim rim = {row, column, is_right ? 1u : 0u, labels.size()};
    taken.add(&rim, 1);
    taken.add(labels.data(), labels.size());
  }
  begin(ids, tiling);
  return std::move(taken).bytes();
}

void PlaneCellsState::add(const std::vector<char>& taken) {
  if (taken.empty()) return;
  TakenReader reader(taken);
  const TakenHead head = reader.next<TakenHead>(1).front();
  const Grid grid(head.width, head.height, static_cast<Axes>(head.periodic));
  const Tiling tiling(Window(grid, head.window_x, head.window_y, head.window_width, head.window_height),
                      head.side);
  if (!tiling_.empty() && (head.ids != ids || !is_same(tiling, tiling_.front()))) {
    throw Error("these sums are of the cells of another plane, or of other tiles");
  }
  // All is read before anything is added.
  const auto added_cells = reader.next<CellRecord>(head.cells);
  const auto added_pairs = reader.next<PairRecord>(head.pairs);
  std::vector<std::pair<Seam, std::vector<std::uint32_t>>> rims;
  for (std::uint64_t i = 0; i < head.rims; ++i) {
    const TakenRim rim = reader.next<TakenRim>(1).front();
    if (rim.row >= tiling.rows() || rim.column >= tiling.columns()) reader.refuse();
    const Window tile = tiling.tile(rim.row * tiling.columns() + rim.column);
    const auto side = static_cast<std::uint64_t>(rim.is_right != 0 ? tile.height() : tile.width());
    if (rim.labels != side) reader.refuse();
    rims.emplace_back(Seam(rim.row, rim.column, rim.is_right != 0), reader.next<std::uint32_t>(rim.labels));
  }
  if (!reader.at_end()) reader.refuse();
  if (tiling_.empty()) begin(head.ids, tiling);
  for (const CellRecord& record : added_cells) cells.add(record);
  for (const PairRecord& record : added_pairs) pairs.add(record);
  for (auto& [seam, labels] : rims) meet(seam, std::move(labels));
}

void PlaneCellsState::add(const TileLabels& tile, const TileMeasures& measures) {
  for (std::size_t i = 0; i < measures.seeds.size(); ++i) {
    if (measures.sums[i].area > 0) add_cell(tile, measures.seeds[i], measures.sums[i], measures.shapes[i]);
  }
  for (const CellPair& pair : measures.pairs) {
    add_pair(measures.seeds[pair.a].id, measures.seeds[pair.b].id, pair.length);
  }
  add_rims(tile);
}

void PlaneCellsState::add_cell(const TileLabels& labels, const PlaneSeed& seed, const CellSums& sums,
                               const CellShape& shape) {
  const std::int64_t tile_x = labels.tile.x(), tile_y = labels.tile.y();
  const Grid& grid = labels.tile.grid();
  const bool periodic_x = has_x(grid.periodic()), periodic_y = has_y(grid.periodic());
  const Place place = place_of(seed);
  const Unwrapping x = {periodic_x ? grid.width() : 0, place.x};
  const Unwrapping y = {periodic_y ? grid.height() : 0, place.y};
  const std::int64_t left = tile_x + shape.left, right = tile_x + shape.right;
  const std::int64_t top = tile_y + shape.top, bottom = tile_y + shape.bottom;
  CellRecord record;
  record.id = seed.id;
  record.touches_border = (!periodic_x && (left == 0 || right == grid.width() - 1)) ||
                          (!periodic_y && (top == 0 || bottom == grid.height() - 1));

  const std::int64_t shift_x = x.shift_at(left), shift_y = y.shift_at(top);
  if (x.shift_at(right) == shift_x && y.shift_at(bottom) == shift_y) {
    record.area = sums.area;
    record.sum_x = sums.sum_x + Int128{tile_x + shift_x} * sums.area;
    record.sum_y = sums.sum_y + Int128{tile_y + shift_y} * sums.area;
    record.left = left + shift_x;
    record.right = right + shift_x;
    record.top = top + shift_y;
    record.bottom = bottom + shift_y;
    cells.add(record);
    return;
  }
  // Half a period from the seed runs through this part of the cell: each pixel for itself.
  for (int row = shape.top; row <= shape.bottom; ++row) {
    for (int column = shape.left; column <= shape.right; ++column) {
      if (labels.labels[static_cast<std::size_t>(row) * static_cast<std::size_t>(labels.tile.width()) +
                        static_cast<std::size_t>(column)] != seed.id) {
        continue;
      }
      CellRecord pixel = record;
      pixel.area = 1;
      pixel.left = pixel.right = tile_x + column + x.shift_at(tile_x + column);
      pixel.top = pixel.bottom = tile_y + row + y.shift_at(tile_y + row);
      pixel.sum_x = pixel.left;
      pixel.sum_y = pixel.top;
      cells.add(pixel);
    }
  }
}

void PlaneCellsState::add_pair(std::uint32_t a, std::uint32_t b, std::uint64_t length) {
  pairs.add({std::min(a, b), std::max(a, b), length});
}

// The pixel edges between two tiles are counted when the second one comes.
void PlaneCellsState::add_rims(const TileLabels& labels) {
  const Tiling& tiling = tiling_.front();
  const std::uint64_t column = labels.number % tiling.columns(), row = labels.number / tiling.columns();
  const auto width = static_cast<std::size_t>(labels.tile.width());
  const auto height = static_cast<std::size_t>(labels.tile.height());
  const auto column_of_labels = [&](std::size_t x) {
    std::vector<std::uint32_t> rim(height);
    for (std::size_t y = 0; y < height; ++y) rim[y] = labels.labels[y * width + x];
    return rim;
  };
  const auto row_of_labels = [&](std::size_t y) {
    return std::vector<std::uint32_t>(labels.labels + y * width, labels.labels + (y + 1) * width);
  };
  const bool round_x = has_x(tiling.window().periodic()), round_y = has_y(tiling.window().periodic());
  const std::uint64_t last_column = tiling.columns() - 1, last_row = tiling.rows() - 1;
  if (column < last_column || round_x) meet({row, column, true}, column_of_labels(width - 1));
  if (column > 0 || round_x) meet({row, column > 0 ? column - 1 : last_column, true}, column_of_labels(0));
  if (row < last_row || round_y) meet({row, column, false}, row_of_labels(height - 1));
  if (row > 0 || round_y) meet({row > 0 ? row - 1 : last_row, column, false}, row_of_labels(0));
}

void PlaneCellsState::meet(const Seam& seam, std::vector<std::uint32_t> rim) {
  const auto waiting = rims_.find(seam);
  if (waiting == rims_.end()) {
    rims_.emplace(seam, std::move(rim));
    return;
  }
  const std::vector<std::uint32_t>& other = waiting->second;
  for (std::size_t i = 0, end = 0; i < rim.size(); i = end) {
    while (end < rim.size() && rim[end] == rim[i] && other[end] == other[i]) ++end;
    if (rim[i] != other[i] && rim[i] != no_label && other[i] != no_label) add_pair(rim[i], other[i], end - i);
  }
  rims_.erase(waiting);
}

PlaneCells::PlaneCells() : state_(make_state<PlaneCellsState>()) {}

std::uint64_t PlaneCells::size() const { return state_ ? state_->ids : 0; }

PlaneCell PlaneCells::cell(std::uint64_t id) const {
  const double none = std::numeric_limits<double>::quiet_NaN();
  PlaneCell cell;
  cell.centroid = {none, none};
  if (!state_) return cell;
  const std::vector<CellRecord>& records = state_->cells.sorted();
  const auto found =
      std::lower_bound(records.begin(), records.end(), id,
                       [](const CellRecord& record, std::uint64_t key) { return record.id < key; });
  if (found == records.end() || found->id != id) return cell;
  const auto mean = [&](Int128 sum) {
    return static_cast<double>(sum) / static_cast<double>(found->area) + 0.5;
  };
  return {found->area,          {mean(found->sum_x), mean(found->sum_y)},
          found->left,          found->top,
          found->right,         found->bottom,
          found->touches_border};
}

std::vector<char> PlaneCells::take() { return state_ ? state_->take() : std::vector<char>(); }

void PlaneCells::add(const std::vector<char>& taken) {
  if (!state_) state_ = make_state<PlaneCellsState>();
  state_->add(taken);
}

std::vector<PlaneCellPair> PlaneCells::pairs() const {
  std::vector<PlaneCellPair> pairs;
  if (!state_) return pairs;
  for (const PairRecord& record : state_->pairs.sorted())
    pairs.push_back({record.a, record.b, record.length});
  return pairs;
}

}  // namespace vorocl
