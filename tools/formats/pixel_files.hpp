// Files of one value per pixel, by the extension of their name: .npy, .vti and, for values of 32 bits, .tif
// or .tiff.
#pragma once

#include <string>
#include <vector>

#include "formats/output_file.hpp"
#include "formats/raster.hpp"

namespace vorocl::command {

/// Values (uint8, uint32 or float), row-major; a .vti file calls them by the name, and alone knows where the
/// raster lies. Throws Error if the extension is none of these, or the file cannot be written.
template <typename T>
void write_pixels(const OutputFile& file, const std::string& name, const Raster& raster,
                  const std::vector<T>& values);

}  // namespace vorocl::command
