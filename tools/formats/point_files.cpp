#include "formats/point_files.hpp"

#include <fmt/format.h>

#include "formats/files.hpp"
#include "formats/npy.hpp"

namespace vorocl::command {

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
