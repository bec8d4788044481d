// The kernels' sources, embedded at build time.
#pragma once

#include <map>
#include <string>

namespace vorocl {

/// File name ("flooding/wave.cl") to source text.
const std::map<std::string, std::string>& kernel_sources();

}  // namespace vorocl
