// What the fuzz targets share: each gives a reader the bytes as a file. A file is read, or refused with an
// Error: anything else that comes out of a reader is a finding.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>

#include "temporary_folder.hpp"
#include "vorocl/error.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace vorocl {

/// Writes the bytes to a file with this extension and returns its path.
inline std::string input_file(const std::uint8_t* data, std::size_t size, const std::string& extension) {
  static const TemporaryFolder folder;
  return folder.file("input" + extension, std::string(reinterpret_cast<const char*>(data), size));
}

template <typename Reader>
void read_or_refuse(const Reader& reader) {
  try {
    reader();
  } catch (const Error& error) {
    if (std::string(error.what()).empty()) std::abort();
  }
}

/// What must hold of all that was read.
inline void require(bool holds) {
  if (!holds) std::abort();
}

}  // namespace vorocl
