#include "formats/point_files.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "formats/files.hpp"
#include "formats/id_order.hpp"
#include "formats/npy.hpp"

namespace vorocl::command {

namespace {

std::vector<std::string> read_npy_blocks(const std::string& path, const Slice& slice, const UseBlock& use) {
  NpyPoints points(path);
  for (std::uint64_t first = 0; first < points.size(); first += block_points) {
    if (!slice.holds(first / block_points)) continue;
    const std::uint64_t count = std::min<std::uint64_t>(block_points, points.size() - first);
    const std::vector<Point> block = points.read(first, static_cast<std::size_t>(count));
    use(first, {block.begin(), block.end()});
  }
  return {};
}

std::vector<std::string> read_csv_blocks(const std::string& path, const CsvOptions& options,
                                         const Slice& slice, const UseBlock& use) {
  CsvReader reader(path, options);
  Block block;
  std::uint64_t first = 0, absent = 0;
  const auto use_block = [&] {
    if (!block.empty() && slice.holds(first / block_points)) use(first, block);
    first += block.size();
    block.clear();
  };
  while (reader.next()) {
    const Point& point = reader.point();
    const bool is_there = !std::isnan(point.x) && !std::isnan(point.y);
    block.push_back(is_there ? std::optional(point) : std::nullopt);
    absent += is_there ? 0 : 1;
    if (block.size() == block_points) use_block();
  }
  use_block();
  std::vector<std::string> notes = reader.notes();
  if (absent == first) throw Error(path + no_coordinates);
  if (absent > 0) notes.push_back(note_of_absent(path, absent, first));
  if (reader.id()) notes.push_back(path + ": labels number the rows from 0; the column id is not read");
  return notes;
}

}  // namespace

std::vector<std::string> read_in_blocks(const std::string& path, const CsvOptions& options,
                                        const Slice& slice, const UseBlock& use) {
  check_extension(path, {".csv", ".npy"});
  const SteadyFile file(path);
  std::vector<std::string> notes = extension_of(path) == ".npy" ? read_npy_blocks(path, slice, use)
                                                                : read_csv_blocks(path, options, slice, use);
  file.check();
  return notes;
}

void write_points(const OutputFile& file, const std::vector<Point>& points,
                  const std::vector<std::uint32_t>& ids) {
  check_extension(file.path(), {".csv", ".npy"});
  std::vector<IdAndRow> rows, spare;
  for (std::size_t i = 0; i < points.size(); ++i)
    rows.push_back(id_and_row(ids.empty() ? static_cast<std::uint32_t>(i) : ids[i], i));
  sort_by_id(rows, spare);
  if (extension_of(file.path()) == ".npy") {
    std::vector<Point> by_id;
    by_id.reserve(rows.size());
    for (const IdAndRow row : rows) by_id.push_back(points[row_of(row)]);
    write_npy_points(file, by_id);
    return;
  }
  GrowingFile table(file);
  table << "id,x,y\n";
  for (const IdAndRow row : rows) {
    const Point& point = points[row_of(row)];
    table << fmt::format("{},{},{}\n", id_of(row), point.x, point.y);
  }
  table.finish();
}

}  // namespace vorocl::command
