// The names that a run gives to files and folders for a while, so that whatever ends it can remove them.
#pragma once

#include <cstddef>
#include <string>

namespace vorocl::command {

/// Remembers a name in its scope. It removes nothing by itself: what makes the file does.
class TemporaryName {
 public:
  enum class Kind {
    file,   ///< or a folder that goes if it is empty then
    folder  ///< that goes with the files in it
  };

  /// Before anything has the name. Throws Error if it is too long for a path.
  explicit TemporaryName(const std::string& path, Kind kind = Kind::file);
  ~TemporaryName();
  TemporaryName(const TemporaryName&) = delete;
  TemporaryName& operator=(const TemporaryName&) = delete;

  const std::string& path() const { return path_; }

 private:
  std::string path_;
  std::size_t slot_;
};

/// Removes all files and folders that have such a name. Safe in a signal handler.
void remove_temporary_files() noexcept;

}  // namespace vorocl::command
