// Files of points, by the extension of their name: .csv or .npy.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "formats/csv.hpp"
#include "formats/output_file.hpp"
#include "vorocl/grid.hpp"

namespace vorocl::command {

/// So many points make a block: of a file, or of random ones.
constexpr std::size_t block_points = 1 << 16;

/// What a process takes of the blocks that several share: every parts-th one.
struct Slice {
  std::uint64_t part = 0, parts = 1;

  bool holds(std::uint64_t block) const { return block % parts == part; }
};

/// A block, in which points of a .csv file that lack a coordinate are absent, and the number of its first
/// one.
using Block = std::vector<std::optional<Point>>;
using UseBlock = std::function<void(std::uint64_t first, const Block& block)>;

/// Reads the points of a file in blocks, so that they are never in memory all at once; `use` is given each
/// block of the slice, in the file's order. Of a .csv file the other blocks are read too. Returns what a user
/// may not expect of the file. Throws Error as the readers of these files, for another extension, if the file
/// changes meanwhile, and if all points are absent.
std::vector<std::string> read_in_blocks(const std::string& path, const CsvOptions& options,
                                        const Slice& slice, const UseBlock& use);

/// Points in the order of their ids, which are their indices if `ids` is empty: a .csv file with the columns
/// id, x and y, or a .npy array of shape (N, 2) without the ids. Throws Error for another extension, or if
/// the file cannot be written.
void write_points(const OutputFile& file, const std::vector<Point>& points,
                  const std::vector<std::uint32_t>& ids);

}  // namespace vorocl::command
