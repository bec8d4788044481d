// Parts of the command that are shared libraries, loaded when they are first needed, because what they need
// takes long to load. OpenCV's libraries for images and films load some 220 others, in a tenth of a second.
#pragma once

#include <cstdint>
#include <memory>
#include <opencv2/core/mat.hpp>
#include <string>
#include <vector>

namespace vorocl::command {

/// What image_module.cpp does, in memory: files are read and written elsewhere. Functions print nothing, and
/// throw std::bad_alloc alone.
class ImageModule {
 public:
  /// An image file's content in its depth: three channels (BGR), or if it `is_plain` one where it is grey and
  /// four where it has an alpha channel; not turned by what it says of the camera. An empty image if it
  /// cannot be decoded.
  virtual cv::Mat decode(const std::vector<std::uint8_t>& bytes, bool is_plain) const = 0;

  /// The content of an image file with this extension (".png"); empty if there can be none.
  virtual std::vector<std::uint8_t> encode(const std::string& extension, const cv::Mat& picture) const = 0;

 protected:
  ~ImageModule() = default;
};

/// What film_module.cpp makes: a film that pictures are appended to. No function throws or prints.
class FilmEncoder {
 public:
  virtual ~FilmEncoder() = default;
  /// Whether all has gone well so far.
  virtual bool add(const cv::Mat& picture) = 0;
  /// Writes the end. Whether the file is whole.
  virtual bool finish() = 0;
};

/// An H.264 film of pictures of this size; null if this machine cannot make it.
using FilmOpener = std::unique_ptr<FilmEncoder> (*)(const std::string& path, double frames_per_second,
                                                    const cv::Size& size);

/// Load the module at the first call. Throw Error, which says why, if that fails.
const ImageModule& image_module();
FilmOpener film_opener();

/// What the function vorocl_module() of a module returns; the module stays. Throws Error with the loader's
/// reason, and `advice`, if it cannot be loaded.
const void* load_module(const std::string& file, const std::string& advice);

}  // namespace vorocl::command
