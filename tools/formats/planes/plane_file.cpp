#include "formats/planes/plane_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <iterator>

#include "formats/files.hpp"
#include "vorocl/error.hpp"

namespace vorocl::command {

namespace {

/// "58.5 GB".
std::string amount_of(std::uint64_t bytes) {
  auto amount = static_cast<double>(bytes);
  const char* const units[] = {"bytes", "kB", "MB", "GB", "TB", "PB", "EB"};
  std::size_t unit = 0;
  for (; amount >= 1000 && unit + 1 < std::size(units); ++unit) amount /= 1000;
  return fmt::format("{:.4g} {}", amount, units[unit]);
}

}  // namespace

std::string plane_path(const std::string& name) {
  const std::string path = name.substr(0, name.find_last_not_of('/') + 1);
  return extension_of(path) == ".zarr" ? path : name;
}

std::unique_ptr<PlaneFile> plane_file(const std::string& path, const Tiling& tiling, PlaneValues values,
                                      const std::optional<Georeference>& georeference) {
  check_extension(path, plane_extensions);
  const std::string extension = extension_of(path);
  if (extension == ".npy") return npy_plane(path, tiling, values);
  if (extension == ".zarr") return zarr_plane(path, tiling, values);
  return tiff_plane(path, tiling, values, georeference);
}

std::uint64_t bytes_of_values(const Tiling& tiling) { return tiling.window().pixels() * sizeof no_label; }

TileShape tile_shape(const Tiling& tiling, int unit) {
  const auto side_of = [&](std::int64_t pixels) {
    return static_cast<int>(std::min<std::int64_t>(tiling.side(), (pixels + unit - 1) / unit * unit));
  };
  return {side_of(tiling.window().width()), side_of(tiling.window().height())};
}

std::vector<std::uint32_t> padded(const TileLabels& tile, PlaneValues values, const TileShape& shape) {
  const auto width = static_cast<std::size_t>(tile.tile.width()),
             length = static_cast<std::size_t>(shape.width);
  constexpr std::uint32_t infinity = 0x7f800000;  // as a float
  std::vector<std::uint32_t> padded(length * static_cast<std::size_t>(shape.height),
                                    values == PlaneValues::labels ? no_label : infinity);
  const char* const first = static_cast<const char*>(values_of(tile, values));
  const std::size_t bytes = width * sizeof no_label;
  for (std::size_t row = 0; row < static_cast<std::size_t>(tile.tile.height()); ++row)
    std::memcpy(padded.data() + row * length, first + row * bytes, bytes);
  return padded;
}

void require_space(const std::string& path, std::uint64_t bytes) {
  namespace fs = std::filesystem;
  const fs::path folder = fs::path(path).parent_path();
  std::error_code code;
  const fs::space_info space = fs::space(folder.empty() ? "." : folder, code);
  if (code || space.available >= bytes) return;  // writing will say what is wrong with the disk
  throw Error(fmt::format("{} needs {} of disk space at least, and there are {}", path, amount_of(bytes),
                          amount_of(space.available)));
}

}  // namespace vorocl::command
