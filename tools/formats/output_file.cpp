#include "formats/output_file.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <climits>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <random>
#include <system_error>
#include <utility>

#include "formats/files.hpp"
#include "vorocl/error.hpp"

namespace vorocl::command {

namespace {

namespace fs = std::filesystem;

constexpr std::size_t buffer_bytes = 1 << 16;

Error cannot_write(const std::string& path, const std::string& why) {
  return Error("cannot write " + path + ": " + why);
}

/// Writes all bytes by `call`, which is given what is left of them. False, with errno, if that fails.
template <typename Call>
bool write_by(const Call& call, const char* bytes, std::size_t count) {
  while (count > 0) {
    const ssize_t written = call(bytes, count);
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) return false;
    bytes += written;
    count -= static_cast<std::size_t>(written);
  }
  return true;
}

std::string folder_of(const std::string& path) {
  const fs::path folder = fs::path(path).parent_path();
  return folder.empty() ? "." : folder.string();
}

/// Where a link to a file leads. It is opened first, because the system lets nobody write through links that
/// others put into a folder where all may write.
std::string target_of_link(const std::string& path) {
  const int file = open(path.c_str(), O_WRONLY | O_CLOEXEC);
  if (file < 0) throw cannot_write(path, reason(errno));
  close(file);
  const std::unique_ptr<char, void (*)(void*)> resolved(realpath(path.c_str(), nullptr), std::free);
  if (!resolved) throw cannot_write(path, reason(errno));
  return resolved.get();
}

/// Such a file cannot be replaced: it would lose what standard output has and gets.
bool is_standard_output(const struct stat& file) {
  struct stat output = {};
  return fstat(STDOUT_FILENO, &output) == 0 && output.st_dev == file.st_dev && output.st_ino == file.st_ino;
}

/// Opens a file that will replace another one, with that one's access rights. Negative, with errno, if that
/// fails.
int open_to_replace(const std::string& target, const std::string& path, int flags) {
  struct stat replaced = {};
  const bool replaces = stat(target.c_str(), &replaced) == 0;
  const int file =
      open(path.c_str(), flags | O_RDWR | O_NOFOLLOW | O_CLOEXEC, replaces ? S_IRUSR | S_IWUSR : 0666);
  // Where a file system has no such rights, the file stays its owner's alone.
  if (file >= 0 && replaces) static_cast<void>(fchmod(file, replaced.st_mode & 0777) == 0);
  return file;
}

}  // namespace

std::string random_path_beside(const std::string& target) {
  std::random_device random;
  std::string name = ".vorocl-";
  for (int i = 0; i < 16; ++i) name += "0123456789abcdef"[random() % 16];
  return (fs::path(folder_of(target)) / (name + extension_of(target))).string();
}

bool write_all(int file, const char* bytes, std::size_t count) {
  return write_by([file](const char* rest, std::size_t left) { return write(file, rest, left); }, bytes,
                  count);
}

bool write_all_at(int file, const char* bytes, std::size_t count, std::uint64_t place) {
  const char* const end = bytes + count;
  return write_by(
      [&](const char* rest, std::size_t left) {
        return pwrite(file, rest, left,
                      static_cast<off_t>(place + count - static_cast<std::size_t>(end - rest)));
      },
      bytes, count);
}

// --- OutputFile ---

OutputFile::OutputFile(const std::string& path) : path_(path), target_(path) {
  struct stat link = {}, there = {};
  const bool is_link = lstat(path.c_str(), &link) == 0 && S_ISLNK(link.st_mode);
  if (stat(path.c_str(), &there) == 0) {
    if (S_ISDIR(there.st_mode)) throw cannot_write(path, "it is a folder");
    is_file_ = S_ISREG(there.st_mode);
    if (!is_file_ && !S_ISFIFO(there.st_mode) && !S_ISCHR(there.st_mode)) {
      throw cannot_write(path, "it is neither a file nor a pipe");
    }
    if (is_file_ && is_standard_output(there)) throw cannot_write(path, "standard output goes to this file");
    // A link to standard output that is a pipe or a terminal leads to no name, and is written into as it is.
    if (is_link && is_file_) target_ = target_of_link(path);
  } else {
    const int code = errno;
    if (is_link) throw cannot_write(path, "it is a link that leads nowhere");
    if (!fs::path(path).has_filename()) throw cannot_write(path, "it is a folder");
    std::error_code ignored;
    if (code == ENOENT && !fs::is_directory(folder_of(path), ignored)) {
      throw cannot_write(path, "the folder " + folder_of(path) + " does not exist");
    }
    if (code != ENOENT) throw cannot_write(path, reason(code));
  }
  // Permissions alone do not tell: the file system may be read-only, or full.
  if (is_file_) GrowingFile{*this};
}

void OutputFile::require_file(const std::string& what) const {
  if (!is_file_) throw cannot_write(path_, "it is a pipe or a device, and " + what + " needs a file");
}

// --- GrowingFile ---

GrowingFile::GrowingFile(const OutputFile& file) : path_(file.path_), target_(file.target_) {
  if (!file.is_file_) {
    descriptor_ = open(target_.c_str(), O_WRONLY | O_CLOEXEC | O_NOCTTY);
    if (descriptor_ < 0) throw cannot_write(path_, reason(errno));
    return;
  }
  while (!open_beside(target_)) {
    const int code = errno;
    name_.reset();
    if (code != EEXIST) throw cannot_write(path_, "no file can be made in its folder: " + reason(code));
  }
}

GrowingFile::GrowingFile(const OutputFile& file, const std::optional<Kept>& kept)
    : path_(file.path_), target_(file.target_), part_(file.part_path()) {
  file.require_file("--resume");
  struct stat there = {};
  const Kept begun = kept.value_or(Kept{});
  is_finished_ = begun.is_complete && lstat(part_.c_str(), &there) != 0;  // it ended between two renames
  const std::string name = is_finished_ ? target_ : part_;
  const bool may_begin = begun.bytes == 0 && !is_finished_;
  descriptor_ = open_to_replace(target_, name, (may_begin ? O_CREAT : 0) | (kept ? 0 : O_EXCL));
  if (descriptor_ < 0) throw cannot_write(name, reason(errno));
  if (is_finished_) part_.clear();
  if (fstat(descriptor_, &there) == 0 && static_cast<std::size_t>(there.st_size) >= begun.bytes &&
      (is_finished_ || ftruncate(descriptor_, static_cast<off_t>(begun.bytes)) == 0) &&
      lseek(descriptor_, 0, SEEK_END) >= 0) {
    return;
  }
  close(descriptor_);
  throw cannot_write(name, "it is not the file of " + std::to_string(begun.bytes) + " bytes that was left");
}

GrowingFile::~GrowingFile() {
  if (descriptor_ >= 0) close(descriptor_);
  if (name_) unlink(name_->path().c_str());
}

/// False, with errno, if there is no new file now.
bool GrowingFile::open_beside(const std::string& target) {
  const std::string path = random_path_beside(target);
  if (path.size() >= PATH_MAX) {
    errno = ENAMETOOLONG;
    return false;
  }
  name_.emplace(path);
  descriptor_ = open_to_replace(target, path, O_CREAT | O_EXCL);
  return descriptor_ >= 0;
}

void GrowingFile::write(const void* bytes, std::size_t count) {
  const char* const first = static_cast<const char*>(bytes);
  if (buffer_.size() + count > buffer_bytes) flush();
  if (count > buffer_bytes) {
    write_now(first, count);
  } else {
    buffer_.insert(buffer_.end(), first, first + count);
  }
}

std::size_t GrowingFile::sync() {
  flush();
  const off_t bytes = lseek(descriptor_, 0, SEEK_CUR);
  if (bytes < 0) throw failed("writing", path_);
  if (fsync(descriptor_) != 0 && errno != EINVAL)
    throw failed("writing", path_);  // EINVAL: cannot be asked there
  return static_cast<std::size_t>(bytes);
}

void GrowingFile::finish() {
  const std::string name = name_ ? name_->path() : part_;
  if (marked_ >= 0) {
    buffer_.clear();
    if (ftruncate(descriptor_, marked_) != 0) throw failed("writing", path_);
  }
  // What a disk or a server refuses late, it refuses here: before the file has its name.
  name.empty() ? flush() : static_cast<void>(sync());
  if (close(std::exchange(descriptor_, -1)) != 0) throw failed("writing", path_);
  if (name.empty()) return;
  if (rename(name.c_str(), target_.c_str()) != 0) throw cannot_write(path_, reason(errno));
  name_.reset();
}

void GrowingFile::mark() {
  if (name_) marked_ = lseek(descriptor_, 0, SEEK_CUR);  // a device cannot be cut
}

void GrowingFile::flush() {
  write_now(buffer_.data(), buffer_.size());
  buffer_.clear();
}

void GrowingFile::write_now(const char* bytes, std::size_t count) {
  if (!write_all(descriptor_, bytes, count)) throw failed("writing", path_);
}

void append_to_file(const std::string& path, std::string_view text) {
  const int file = open(path.c_str(), O_WRONLY | O_APPEND | O_CLOEXEC);
  struct stat before = {};
  if (file < 0 || fstat(file, &before) != 0) throw cannot_write(path, reason(errno));
  const bool is_whole = write_all(file, text.data(), text.size()) && fsync(file) == 0;
  const Error error = failed("writing", path);
  if (!is_whole) static_cast<void>(ftruncate(file, before.st_size) == 0);  // the error says enough
  close(file);
  if (!is_whole) throw error;
}

}  // namespace vorocl::command
