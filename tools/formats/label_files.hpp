// Label files, by the extension of their name: .npy, .tif or .tiff, and .vti, which is only written.
#pragma once

#include <string>
#include <vector>

#include "formats/label_image.hpp"
#include "formats/output_file.hpp"
#include "formats/raster.hpp"

namespace vorocl::command {

/// The extensions of files that labels can be read from, and written to.
const std::vector<std::string>& readable_label_extensions();
const std::vector<std::string>& label_extensions();

/// Throws Error if the file cannot be read or holds something else, or its name ends in no such extension.
LabelImage read_labels(const std::string& path);

/// Throws Error if the name ends in no such extension, or the file cannot be written.
void write_labels(const OutputFile& file, const Raster& raster, const std::vector<std::uint32_t>& labels);

}  // namespace vorocl::command
