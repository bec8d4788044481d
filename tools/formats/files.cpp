#include "formats/files.hpp"

#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cctype>
#include <cerrno>
#include <filesystem>
#include <system_error>

#include "vorocl/error.hpp"

namespace vorocl::command {

namespace {

namespace fs = std::filesystem;

/// The pattern without the number's width: %d for %05d.
std::string without_width(std::string path) {
  for (std::size_t at = path.find("%0"); at != std::string::npos; at = path.find("%0", at + 1)) {
    if (at + 3 < path.size() && path[at + 2] >= '1' && path[at + 2] <= '9' && path[at + 3] == 'd') {
      path.erase(at + 1, 2);
    }
  }
  return path;
}

/// Where a path leads from here; empty: nowhere. Patterns that differ in the number's width alone are the
/// same.
std::string whole_path(const std::string& path) {
  if (path.empty()) return path;
  std::error_code ignored;
  return fs::weakly_canonical(fs::absolute(without_width(path)), ignored).string();
}

/// Whether a pattern with %d in place of a number gives the path.
bool gives(const std::string& pattern, const std::string& path) {
  const std::size_t at = pattern.find("%d");
  if (at == std::string::npos) return false;
  const std::string before = pattern.substr(0, at), behind = pattern.substr(at + 2);
  if (path.size() <= before.size() + behind.size() || path.compare(0, before.size(), before) != 0 ||
      path.compare(path.size() - behind.size(), behind.size(), behind) != 0) {
    return false;
  }
  const auto number = path.begin() + static_cast<std::ptrdiff_t>(before.size());
  return std::all_of(number, path.end() - static_cast<std::ptrdiff_t>(behind.size()),
                     [](unsigned char c) { return std::isdigit(c) != 0; });
}

std::string reason(int code) { return std::generic_category().message(code); }

std::ofstream open(const std::string& path, std::ios::openmode mode) {
  errno = 0;
  std::ofstream stream(path, std::ios::binary | mode);
  if (!stream) throw Error("cannot write " + path + ": " + reason(errno));
  return stream;
}

/// Removes a file at the end of a scope, if it is still there.
struct Remover {
  const std::string& path;
  ~Remover() {
    std::error_code ignored;
    fs::remove(path, ignored);
  }
};

}  // namespace

std::string extension_of(const std::string& path) {
  std::string extension = fs::path(path).extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return extension;
}

void check_extension(const std::string& path, const std::vector<std::string>& extensions) {
  if (std::find(extensions.begin(), extensions.end(), extension_of(path)) != extensions.end()) return;
  std::string list;
  for (const std::string& extension : extensions) list += (list.empty() ? "" : ", ") + extension;
  throw Error(path + ": the name must end in one of " + list);
}

std::ifstream open_to_read(const std::string& path) {
  std::error_code ignored;
  if (fs::is_directory(path, ignored)) throw Error("cannot read " + path + ": it is a folder");
  errno = 0;
  std::ifstream stream(path, std::ios::binary);
  if (!stream) throw Error("cannot read " + path + ": " + reason(errno));
  return stream;
}

OutputFile::OutputFile(const std::string& path) : path_(path) {
  const fs::path target(path);
  const fs::path folder = target.has_parent_path() ? target.parent_path() : fs::path(".");
  std::error_code ignored;
  if (!target.has_filename() || fs::is_directory(target, ignored))
    throw Error("cannot write " + path + ": it is a folder");
  if (!fs::is_directory(folder, ignored)) {
    throw Error("cannot write " + path + ": the folder " + folder.string() + " does not exist");
  }
  static std::atomic<unsigned> files{0};  // two outputs of one name must not meet under the temporary one
  temporary_path_ = (folder / (".vorocl-" + std::to_string(getpid()) + "-" + std::to_string(files++) + "-" +
                               target.filename().string()))
                        .string();
  // Permissions alone do not tell: the file system may be read-only, or full.
  const Remover remover{temporary_path_};
  errno = 0;
  if (!std::ofstream(temporary_path_)) {
    throw Error("cannot write " + path + ": no file can be made in its folder: " + reason(errno));
  }
}

void OutputFile::write(const std::function<void(const std::string&)>& write) const {
  const Remover remover{temporary_path_};
  write(temporary_path_);
  commit();
}

void OutputFile::commit() const {
  std::error_code code;
  fs::rename(temporary_path_, path_, code);
  if (code) throw Error("cannot write " + path_ + ": " + code.message());
}

void OutputFile::discard() const {
  std::error_code ignored;
  fs::remove(temporary_path_, ignored);
}

GrowingFile::GrowingFile(const std::string& path)
    : file_(path), stream_(open_to_write(file_.temporary_path())) {}

GrowingFile::~GrowingFile() { file_.discard(); }

void GrowingFile::finish() {
  check_written(stream_, file_.path());
  file_.commit();
}

bool may_be_one_file(const std::string& a, const std::string& b) {
  const std::string whole_a = whole_path(a), whole_b = whole_path(b);
  return !whole_a.empty() && (whole_a == whole_b || gives(whole_a, whole_b) || gives(whole_b, whole_a));
}

std::ofstream open_to_write(const std::string& path) { return open(path, std::ios::trunc); }

std::ofstream open_to_append(const std::string& path) { return open(path, std::ios::app); }

void check_written(std::ofstream& stream, const std::string& path) {
  errno = 0;
  stream.close();
  if (!stream)
    throw Error("writing " + path + " failed: " + (errno != 0 ? reason(errno) : "is the disk full?"));
}

}  // namespace vorocl::command
