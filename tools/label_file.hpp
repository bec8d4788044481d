// Label files, by the extension of their name: .npy, .tif or .tiff.
#pragma once

#include <string>

#include "label_image.hpp"

namespace vorocl::command {

/// Throws UsageError if the name is none of a label file.
void check_label_path(const std::string& path);

/// Throws Error if the file cannot be read or holds something else.
LabelImage read_labels(const std::string& path);

/// Throws Error if the file cannot be written.
void write_labels(const std::string& path, const LabelImage& image);

}  // namespace vorocl::command
