// The cells of a plane, summed over its tiles.
#pragma once

#include <algorithm>
#include <cstdint>
#include <map>
#include <tuple>
#include <vector>

#include "tiles/plane_distance.hpp"
#include "vorocl/adjacency.hpp"
#include "vorocl/cells.hpp"
#include "vorocl/tiles.hpp"

namespace vorocl {

/// Records that come in any order, several of one key, summed by their keys. Memory: twice the records.
template <typename Record>
class SummedRecords {
 public:
  void add(const Record& record) {
    records_.push_back(record);
    if (records_.size() > 2 * summed_ + 1024) sum();
  }

  const std::vector<Record>& sorted() {
    if (records_.size() > summed_) sum();
    return records_;
  }

 private:
  void sum() {
    const auto by_key = [](const Record& a, const Record& b) { return a.key() < b.key(); };
    const auto first_new = records_.begin() + static_cast<std::ptrdiff_t>(summed_);
    std::sort(first_new, records_.end(), by_key);
    std::inplace_merge(records_.begin(), first_new, records_.end(), by_key);
    std::size_t kept = 0;
    for (std::size_t i = 0; i < records_.size(); ++i) {
      if (kept > 0 && records_[kept - 1].key() == records_[i].key()) {
        records_[kept - 1].add(records_[i]);
      } else {
        records_[kept++] = records_[i];
      }
    }
    records_.resize(kept);
    summed_ = kept;
  }

  std::vector<Record> records_;
  std::size_t summed_ = 0;  // so many are in order, each key once
};

/// What tiles know of a cell.
struct CellRecord {
  std::uint32_t id = 0;
  bool touches_border = false;
  std::uint64_t area = 0;
  Int128 sum_x = 0, sum_y = 0;  // of the pixels' columns and rows
  std::int64_t left = 0, top = 0, right = 0, bottom = 0;

  std::uint32_t key() const { return id; }
  void add(const CellRecord& other) {
    touches_border = touches_border || other.touches_border;
    area += other.area;
    sum_x += other.sum_x;
    sum_y += other.sum_y;
    left = std::min(left, other.left);
    top = std::min(top, other.top);
    right = std::max(right, other.right);
    bottom = std::max(bottom, other.bottom);
  }
};

struct PairRecord {
  std::uint32_t a = 0, b = 0;
  std::uint64_t length = 0;

  std::uint64_t key() const { return std::uint64_t{a} << 32 | b; }
  void add(const PairRecord& other) { length += other.length; }
};

/// What was measured of a tile: by places in the list of its seeds.
struct TileMeasures {
  std::vector<PlaneSeed> seeds;
  std::vector<CellSums> sums;
  std::vector<CellShape> shapes;
  std::vector<CellPair> pairs;
};

struct PlaneCellsState {
  /// Forgets everything, for the tiles of a plane with so many seeds.
  void begin(std::uint64_t ids, const Tiling& tiling);

  /// As PlaneCells::take() and add().
  std::vector<char> take();
  void add(const std::vector<char>& taken);

  /// Adds a tile with its labels.
  void add(const TileLabels& tile, const TileMeasures& measures);

  std::uint64_t ids = 0;
  SummedRecords<CellRecord> cells;
  SummedRecords<PairRecord> pairs;

 private:
  /// The line between two tiles: the row and the column of the first one, and whether it is at its right.
  using Seam = std::tuple<std::uint64_t, std::uint64_t, bool>;

  void add_cell(const TileLabels& tile, const PlaneSeed& seed, const CellSums& sums, const CellShape& shape);
  void add_pair(std::uint32_t a, std::uint32_t b, std::uint64_t length);
  void add_rims(const TileLabels& tile);
  void meet(const Seam& seam, std::vector<std::uint32_t> rim);

  std::vector<Tiling> tiling_;                       // one, once it has begun
  std::map<Seam, std::vector<std::uint32_t>> rims_;  // of tiles whose neighbour is still to come
};

}  // namespace vorocl
