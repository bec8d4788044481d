// How files are written, all of them: whole, or not at all.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "formats/temporary_names.hpp"

namespace vorocl::command {

/// A file that will be written, under this name or, where the name is a link, under the one that it leads to.
/// A pipe or a device (not a disk) is written into; anything else is replaced.
class OutputFile {
 public:
  /// Throws Error if the folder does not exist or cannot be written, for a folder, and for a link that leads
  /// nowhere: construct it before the work whose result it is to hold.
  OutputFile(const std::string& path);

  /// As the caller names it.
  const std::string& path() const { return path_; }

  /// Throws Error for a pipe or a device: `what` ("a film") can only be a file.
  void require_file(const std::string& what) const;

 private:
  friend class GrowingFile;
  std::string path_;
  std::string target_;  // where the name leads
  bool is_file_ = true;
};

/// An output while it is written: a file with a name that nobody can foresee, beside its final one, until
/// finish() gives it that. Without finish(), nothing stays.
class GrowingFile {
 public:
  /// Throws Error if it cannot be made there.
  explicit GrowingFile(const OutputFile& file);
  ~GrowingFile();
  GrowingFile(const GrowingFile&) = delete;
  GrowingFile& operator=(const GrowingFile&) = delete;

  const std::string& path() const { return path_; }

  /// Appends. Throw Error, with the reason, if that fails.
  void write(const void* bytes, std::size_t count);
  GrowingFile& operator<<(std::string_view text) {
    write(text.data(), text.size());
    return *this;
  }

  /// For libraries that write files by themselves, instead of write(). No such name: a pipe or a device.
  int descriptor() const { return descriptor_; }
  std::string temporary_path() const { return name_ ? name_->path() : path_; }

  /// Gives the file its name, with the access rights of the file that it replaces. Throws Error if it was not
  /// written whole.
  void finish();

 private:
  bool open_beside(const std::string& target);
  void flush();
  void write_now(const char* bytes, std::size_t count);

  std::string path_;
  std::string target_;
  std::optional<TemporaryName> name_;  // none: a pipe or a device, or it has its name
  int descriptor_ = -1;
  std::vector<char> buffer_;
};

/// Appends a text to a file. Throws Error if that fails, and leaves the file as it was.
void append_to_file(const std::string& path, std::string_view text);

}  // namespace vorocl::command
