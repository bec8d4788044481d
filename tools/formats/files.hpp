// Files: reading with clear errors, and writing that leaves the whole file or none.
#pragma once

#include <fstream>
#include <functional>
#include <string>
#include <vector>

namespace vorocl::command {

/// The path's extension in lower case, with its dot: ".npy".
std::string extension_of(const std::string& path);

/// Throws Error unless the path's extension is one of these (with their dots).
void check_extension(const std::string& path, const std::vector<std::string>& extensions);

/// Throws Error, with the reason, if the file is missing, a folder or not readable.
std::ifstream open_to_read(const std::string& path);

/// A file that will be written later.
class OutputFile {
 public:
  /// Throws Error if the folder does not exist or cannot be written: construct it before the work whose
  /// result it is to hold.
  explicit OutputFile(const std::string& path);

  const std::string& path() const { return path_; }

  /// Lets `write` make a file under a temporary name in the same folder, with the same extension, and renames
  /// that to the path. If `write` throws, nothing stays.
  void write(const std::function<void(const std::string& temporary_path)>& write) const;

  /// For a file that grows while the work goes on: the name that it has until commit() gives it its own, or
  /// discard() removes it.
  const std::string& temporary_path() const { return temporary_path_; }
  void commit() const;
  void discard() const;

 private:
  std::string path_;
  std::string temporary_path_;
};

/// A file that grows while the work goes on, under a temporary name until finish(); without it, nothing
/// stays.
class GrowingFile {
 public:
  /// Throws Error if it cannot be made there.
  explicit GrowingFile(const std::string& path);
  ~GrowingFile();
  GrowingFile(const GrowingFile&) = delete;
  GrowingFile& operator=(const GrowingFile&) = delete;

  std::ofstream& stream() { return stream_; }

  /// Gives the file its name. Throws Error if it was not written whole.
  void finish();

 private:
  OutputFile file_;
  std::ofstream stream_;
};

/// Whether two paths lead to one file. Either may be a pattern with a place for a number, such as
/// frames/%05d.png: then whether the files that it gives may include the other's. An empty path leads
/// nowhere.
bool may_be_one_file(const std::string& a, const std::string& b);

/// A stream to a new file, or to the end of one. Throw Error if it cannot be opened; check_written() throws
/// Error if writing failed.
std::ofstream open_to_write(const std::string& path);
std::ofstream open_to_append(const std::string& path);
void check_written(std::ofstream& stream, const std::string& path);

}  // namespace vorocl::command
