#include "formats/point_files.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "formats/files.hpp"
#include "formats/npy.hpp"

namespace vorocl::command {

namespace {

using UseBlock = std::function<void(const std::vector<Point>& block)>;

constexpr std::size_t block_points = 1 << 16;

void read_npy_blocks(const std::string& path, const UseBlock& use) {
  NpyPoints points(path);
  for (std::uint64_t first = 0; first < points.size(); first += block_points) {
    use(points.read(first,
                    static_cast<std::size_t>(std::min<std::uint64_t>(block_points, points.size() - first))));
  }
}

void read_csv_blocks(const std::string& path, const std::optional<Columns>& columns, const UseBlock& use) {
  CsvReader reader(path, columns);
  std::vector<Point> block;
  while (reader.next()) {
    block.push_back(reader.point());
    if (block.size() < block_points) continue;
    use(block);
    block.clear();
  }
  if (!block.empty()) use(block);
}

}  // namespace

void read_in_blocks(const std::string& path, const std::optional<Columns>& columns, const UseBlock& use) {
  check_extension(path, {".csv", ".npy"});
  const SteadyFile file(path);
  extension_of(path) == ".npy" ? read_npy_blocks(path, use) : read_csv_blocks(path, columns, use);
  file.check();
}

void write_points(const OutputFile& file, const std::vector<Point>& points,
                  const std::vector<std::uint32_t>& ids) {
  check_extension(file.path(), {".csv", ".npy"});
  if (extension_of(file.path()) == ".npy") {
    write_npy_points(file, points);
    return;
  }
  GrowingFile table(file);
  table << "id,x,y\n";
  for (std::size_t i = 0; i < points.size(); ++i) {
    table << fmt::format("{},{},{}\n", ids.empty() ? i : ids[i], points[i].x, points[i].y);
  }
  table.finish();
}

}  // namespace vorocl::command
