// Names of files, and reading with clear errors. output_file.hpp has the writing.
#pragma once

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "vorocl/error.hpp"

namespace vorocl::command {

/// The path's extension in lower case, with its dot: ".npy".
std::string extension_of(const std::string& path);

/// Throws Error unless the path's extension is one of these (with their dots).
void check_extension(const std::string& path, const std::vector<std::string>& extensions);

/// Throws Error, with the reason, if the file is missing, a folder or not readable.
std::ifstream open_to_read(const std::string& path);

/// A file that must not change while it is read, as its size and the time of its last change tell.
class SteadyFile {
 public:
  /// Throws Error if there is no such file, and for a pipe or a device.
  explicit SteadyFile(const std::string& path);

  /// Throws Error if it has changed.
  void check() const;

 private:
  struct State {
    std::uintmax_t bytes = 0;
    std::filesystem::file_time_type changed;
  };
  State now() const;

  std::string path_;
  State before_;
};

/// Whether two paths lead to one file. Either may be a pattern with a place for a number, such as
/// frames/%05d.png: then whether the files that it gives may include the other's. An empty path leads
/// nowhere.
bool may_be_one_file(const std::string& a, const std::string& b);

/// The most bytes that Deflate makes of one.
constexpr std::uint64_t greatest_compression = 1032;

/// What the system's error code means: "No space left on device".
std::string reason(int code);

/// For what the last system call said: "writing a.csv failed: No space left on device".
Error failed(const std::string& what, const std::string& path);

}  // namespace vorocl::command
