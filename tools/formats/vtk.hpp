// Files of VTK, which ParaView opens: image data (.vti) and collections of such files (.pvd).
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "formats/output_file.hpp"
#include "formats/raster.hpp"

namespace vorocl::command {

/// One value per pixel (uint8, uint32 or float), row-major, as the cell data `name` of an image whose cells
/// are the pixels, with the raster's corner as its origin. The first row is on top as in a picture: where the
/// raster is of pixels alone, what is at (x, y) in pixel units is at (x, height - y) there. The values are
/// raw bytes at the file's end, in the host's byte order. Throws Error if the file cannot be written.
template <typename T>
void write_vti(const OutputFile& file, const std::string& name, const Raster& raster,
               const std::vector<T>& values);

/// A file of a collection and the time that it shows.
struct TimedFile {
  std::int64_t time;
  std::string name;  // relative to the collection's folder
};

/// Throws Error if the file cannot be written.
void write_pvd(const OutputFile& file, const std::vector<TimedFile>& files);

}  // namespace vorocl::command
