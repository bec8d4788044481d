#include "formats/modules.hpp"

#include <dlfcn.h>

#include "vorocl/error.hpp"

namespace vorocl::command {

const void* load_module(const std::string& file, const std::string& advice) {
  // Looked for in the executable's run path: beside it in the build tree, in lib/vorocl in an installed copy.
  void* const library = dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL);
  void* const function = library != nullptr ? dlsym(library, "vorocl_module") : nullptr;
  if (function == nullptr) {
    const char* const reason = dlerror();
    throw Error("a part of vorocl cannot be loaded: " + std::string(reason != nullptr ? reason : file) +
                "; " + advice);
  }
  return reinterpret_cast<const void* (*)()>(function)();
}

const ImageModule& image_module() {
  static const auto& module = *static_cast<const ImageModule*>(load_module(
      "vorocl_images.so", "install vorocl again, with the folder vorocl of its libraries, and OpenCV"));
  return module;
}

FilmOpener film_opener() {
  static const auto& opener = *static_cast<const FilmOpener*>(
      load_module("vorocl_films.so",
                  "films need FFmpeg's libraries, where vorocl is built: install libavcodec-dev, "
                  "libavformat-dev and libswscale-dev and build it again, or write numbered pictures, such "
                  "as frames/%05d.png"));
  return opener;
}

}  // namespace vorocl::command
