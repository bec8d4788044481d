#include "formats/point_files.hpp"

#include <fmt/format.h>

#include "formats/files.hpp"
#include "formats/npy.hpp"

namespace vorocl::command {

void write_points(const std::string& path, const std::vector<Point>& points,
                  const std::vector<std::uint32_t>& ids) {
  check_extension(path, {".csv", ".npy"});
  if (extension_of(path) == ".npy") {
    write_npy_points(path, points);
    return;
  }
  std::ofstream file = open_to_write(path);
  file << "id,x,y\n";
  for (std::size_t i = 0; i < points.size(); ++i) {
    file << fmt::format("{},{},{}\n", ids.empty() ? i : ids[i], points[i].x, points[i].y);
  }
  check_written(file, path);
}

}  // namespace vorocl::command
