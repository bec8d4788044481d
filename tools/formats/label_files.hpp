// Label files, by the extension of their name: .npy, .tif or .tiff, and .vti, which is only written.
#pragma once

#include <string>
#include <vector>

#include "formats/label_image.hpp"

namespace vorocl::command {

/// The extensions of files that labels can be written to.
const std::vector<std::string>& label_extensions();

/// Throws Error if the file cannot be read or holds something else.
LabelImage read_labels(const std::string& path);

/// Throws UsageError if the name is none of those, Error if the file cannot be written.
void write_labels(const std::string& path, const LabelImage& image);

}  // namespace vorocl::command
