// PNG files, written without OpenCV's module of image files, which takes longer to load than a picture to
// write.
#pragma once

#include "formats/output_file.hpp"

namespace cv {
class Mat;
}

namespace vorocl::command {

/// A picture of 8 bits in one channel (grey) or three (BGR). Its rows are stored as differences to the rows
/// above and deflated in strips, each by a thread: quickly rather than densely, and the same bytes with any
/// number of threads. Throws Error if the file cannot be written.
void write_png(const OutputFile& file, const cv::Mat& picture);

}  // namespace vorocl::command
