// Files of the labels or the distances of a plane, tile by tile, by the extension of their name: .npy, .zarr,
// and .tif or .tiff.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "formats/planes/geotiff.hpp"
#include "vorocl/tiles.hpp"

namespace vorocl::command {

/// What a file has of each pixel of the tiles, in four bytes.
enum class PlaneValues { labels, distances };

/// That of a tile.
inline const void* values_of(const TileLabels& tile, PlaneValues values) {
  return values == PlaneValues::labels ? static_cast<const void*>(tile.labels) : tile.distances;
}

/// A tile that a file holds whole.
struct WrittenTile {
  std::uint64_t number = 0;
  std::uint64_t bytes = 0;  ///< that it takes behind the tiles before it; 0 where its number says its place
};

/// What a run before has left of a file, for another run to continue.
struct KeptTiles {
  std::vector<WrittenTile> tiles;  ///< in the order in which they were written; there may be others
  bool is_complete = false;        ///< nothing is to come, and the file may have its final name
};

/// A file that tiles are written to. It is made in two steps, so that what cannot be written is refused
/// before any work: the constructors of those in plane_files() check, and one of open() and open_part()
/// begins.
class PlaneFile {
 public:
  virtual ~PlaneFile() = default;

  /// Begins a file of which nothing stays without finish(). Throws Error, as the following, if that fails.
  virtual void open() = 0;

  /// Begins one that another run can continue: until finish() it is at part_path(), and stays there. Without
  /// `kept` there may be no such file, else it goes on behind what was kept.
  virtual void open_part(const std::optional<KeptTiles>& kept) = 0;
  virtual std::string part_path() const = 0;

  /// Opens one that another process has begun by open_part(), to write tiles too; that process finishes it.
  /// Throws Error if its tiles cannot come from several processes.
  virtual void join() = 0;

  /// Writes a tile: each once, in any order. What it returns, open_part() must be given.
  virtual WrittenTile write(const TileLabels& tile) = 0;

  /// Makes the disk have all that was written.
  virtual void sync() = 0;

  /// When all tiles are written: gives the file its name.
  virtual void finish() = 0;
};

/// The extensions of these files.
inline const std::vector<std::string> plane_extensions = {".npy", ".zarr", ".tif", ".tiff"};

/// The path that a name says: shells put a slash behind the names of folders, such as that of a .zarr.
std::string plane_path(const std::string& name);

/// The file of a tiling's window. A TIFF file says where it lies. Throws Error if the extension is none of
/// these, for tiles that the format does not have, where no file can be made, where the disk has too little
/// space (the least that is possible of those that are compressed), and if a .zarr folder would replace
/// something that is no such array, or holds other files too. A link leads to what is replaced.
std::unique_ptr<PlaneFile> plane_file(const std::string& path, const Tiling& tiling,
                                      PlaneValues values = PlaneValues::labels,
                                      const std::optional<Georeference>& georeference = std::nullopt);

/// The bytes of the values of a tiling's window.
std::uint64_t bytes_of_values(const Tiling& tiling);

/// The tiles of a file whose tiles are all of one shape.
struct TileShape {
  int width = 0, height = 0;
};

/// Their sides are those of the tiling. A window that is smaller has tiles of its own sides, rounded up to a
/// multiple of `unit`.
TileShape tile_shape(const Tiling& tiling, int unit = 1);

/// The values of a tile in this shape, with no_label or infinity beyond its own.
std::vector<std::uint32_t> padded(const TileLabels& tile, PlaneValues values, const TileShape& shape);

/// Throws Error if the disk of the folder that holds the path has less space.
void require_space(const std::string& path, std::uint64_t bytes);

// Each kind of file, as plane_file() makes it.
std::unique_ptr<PlaneFile> npy_plane(const std::string& path, const Tiling& tiling, PlaneValues values);
std::unique_ptr<PlaneFile> zarr_plane(const std::string& path, const Tiling& tiling, PlaneValues values);
std::unique_ptr<PlaneFile> tiff_plane(const std::string& path, const Tiling& tiling, PlaneValues values,
                                      const std::optional<Georeference>& georeference);

}  // namespace vorocl::command
