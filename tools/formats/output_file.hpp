// How files are written, all of them: whole, or not at all. What they are called meanwhile, whatever ends a
// run can remove.
#pragma once

#include <sys/types.h>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

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

/// Removes all files and folders that have such a name, as the last thing before a run ends: a thread that
/// wants another name waits for ever. Safe in a signal handler.
void remove_temporary_files() noexcept;

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

  /// Where it grows if another run can continue it: see GrowingFile.
  std::string part_path() const { return target_ + ".part"; }

 private:
  friend class GrowingFile;
  std::string path_;
  std::string target_;  // where the name leads
  bool is_file_ = true;
};

/// What a run before has left of a file that grows, for another run to continue.
struct Kept {
  std::size_t bytes = 0;     // that are to stay; with none, there may be no file
  bool is_complete = false;  // nothing is to come, and the file may have its final name
};

/// An output while it is written: a file with a name that nobody can foresee, beside its final one, until
/// finish() gives it that. Without finish(), nothing stays.
class GrowingFile {
 public:
  /// Throws Error if it cannot be made there.
  explicit GrowingFile(const OutputFile& file);

  /// One that another run can continue: until finish() it is at the file's part_path(), and stays there.
  /// Without `kept` it begins, else it goes on behind what was kept. One that is complete and has its name
  /// already keeps that, and is_finished(). Throws Error too for a pipe or a device, if less was kept, or if
  /// it begins and there is a file of this name.
  GrowingFile(const OutputFile& file, const std::optional<Kept>& kept);
  ~GrowingFile();
  GrowingFile(const GrowingFile&) = delete;
  GrowingFile& operator=(const GrowingFile&) = delete;

  const std::string& path() const { return path_; }

  /// Whether it had its name before this run: nothing is to be written.
  bool is_finished() const { return is_finished_; }

  /// Appends. Throw Error, with the reason, if that fails.
  void write(const void* bytes, std::size_t count);
  GrowingFile& operator<<(std::string_view text) {
    write(text.data(), text.size());
    return *this;
  }

  /// Hands all that was written to the system. Throws Error if that fails.
  void flush();

  /// After flush(): what was written is of use without what may follow, as the rows of whole frames are.
  /// finish() cuts off what did follow.
  void mark();

  /// Makes the disk have all that was written, and returns how many bytes these are. Throws Error if that
  /// fails.
  std::size_t sync();

  /// For libraries that write files by themselves, instead of write(). No such name: a pipe or a device.
  int descriptor() const { return descriptor_; }
  std::string temporary_path() const { return name_ ? name_->path() : path_; }

  /// Gives the file its name, with the access rights of the file that it replaces. Throws Error if it was not
  /// written whole, or up to the last mark if there is one.
  void finish();

 private:
  bool open_beside(const std::string& target);
  void write_now(const char* bytes, std::size_t count);

  std::string path_;
  std::string target_;
  std::optional<TemporaryName> name_;  // none: a pipe or a device, it has its name, or it stays
  std::string part_;                   // the name under which it stays; empty: it does not, or has its name
  bool is_finished_ = false;
  int descriptor_ = -1;
  std::vector<char> buffer_;
  off_t marked_ = -1;  // bytes; negative: there is no mark, or the file cannot be cut
};

/// ".vorocl-0123456789abcdef.mp4" beside the target: a name that nobody can foresee, short, so that it is
/// possible wherever the output's name is, and with its extension, by which encoders tell the format.
std::string random_path_beside(const std::string& target);

/// Writes all bytes, where the file stands or at a place of it. False, with errno, if that fails.
bool write_all(int file, const char* bytes, std::size_t count);
bool write_all_at(int file, const char* bytes, std::size_t count, std::uint64_t place);

/// Appends a text to a file. Throws Error if that fails, and leaves the file as it was.
void append_to_file(const std::string& path, std::string_view text);

}  // namespace vorocl::command
