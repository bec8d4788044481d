#include "formats/files.hpp"

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <system_error>

#include "formats/values.hpp"

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

}  // namespace

std::string extension_of(const std::string& path) { return lower(fs::path(path).extension().string()); }

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

SteadyFile::SteadyFile(const std::string& path) : path_(path) {
  open_to_read(path);  // for its reasons
  std::error_code ignored;
  if (!fs::is_regular_file(path, ignored)) {
    throw Error("cannot read " + path + ": it is a pipe or a device, and is read more than once");
  }
  before_ = now();
}

void SteadyFile::check() const {
  const State state = now();
  if (state.bytes == before_.bytes && state.changed == before_.changed) return;
  throw Error(path_ + " changed while it was read; start again when it is complete");
}

SteadyFile::State SteadyFile::now() const {
  std::error_code code;
  const State state{fs::file_size(path_, code), fs::last_write_time(path_, code)};
  if (code) throw Error("cannot read " + path_ + ": " + code.message());
  return state;
}

bool may_be_one_file(const std::string& a, const std::string& b) {
  const std::string whole_a = whole_path(a), whole_b = whole_path(b);
  return !whole_a.empty() && (whole_a == whole_b || gives(whole_a, whole_b) || gives(whole_b, whole_a));
}

Error failed(const std::string& what, const std::string& path) {
  return Error(what + " " + path + " failed: " + reason(errno));
}

std::string reason(int code) { return std::generic_category().message(code); }

}  // namespace vorocl::command
