// Picture files.
#pragma once

#include <opencv2/core/mat.hpp>
#include <string>
#include <vector>

#include "formats/output_file.hpp"

namespace vorocl::command {

/// The extensions of files that a picture can be written to.
const std::vector<std::string>& picture_extensions();

/// Three channels (BGR) of the file's depth, as the file has them: not turned by what it says of the camera.
/// Throws Error if the file cannot be read.
cv::Mat read_picture(const std::string& path);

/// Throws Error if the file cannot be written.
void write_picture(const OutputFile& file, const cv::Mat& picture);

}  // namespace vorocl::command
