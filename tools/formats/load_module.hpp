// Parts of the command that are shared libraries, because what they need takes long to load.
#pragma once

#include <string>

namespace vorocl::command {

/// What the function vorocl_module() of a module returns; the module stays. Throws Error with the loader's
/// reason, and `advice`, if it cannot be loaded.
const void* load_module(const std::string& file, const std::string& advice);

}  // namespace vorocl::command
