#include "formats/load_module.hpp"

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

}  // namespace vorocl::command
