#include "formats/numbered_files.hpp"

#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <filesystem>
#include <system_error>

#include "formats/files.hpp"
#include "vorocl/error.hpp"

namespace vorocl::command {

namespace fs = std::filesystem;

NumberedName::NumberedName(const std::string& pattern) {
  const Error error(pattern + ": the name must have one place for a number, such as %05d" +
                    extension_of(pattern));
  const std::size_t place = pattern.find('%');
  if (place == std::string::npos) throw error;
  std::size_t end = place + 1;
  if (pattern.compare(end, 1, "0") == 0) {
    const char digit = end + 1 < pattern.size() ? pattern[end + 1] : '0';
    if (digit < '1' || digit > '9') throw error;
    width = digit - '0';
    end += 2;
  }
  if (pattern.compare(end, 1, "d") != 0) throw error;
  before = pattern.substr(0, place);
  after = pattern.substr(end + 1);
  if (after.find_first_of("%/") != std::string::npos) throw error;
}

std::string NumberedName::with(int number) const {
  return fmt::format("{}{:0{}d}{}", before, number, width, after);
}

MadeFolder::MadeFolder(const std::string& path) : name_(path) { mkdir(path.c_str(), 0777); }

MadeFolder::~MadeFolder() { rmdir(name_.path().c_str()); }

NumberedFiles::NumberedFiles(const std::string& pattern) : name_(pattern) {
  const fs::path folder = fs::path(name_.with(0)).parent_path();
  std::error_code ignored;
  if (!folder.empty() && !fs::exists(folder, ignored)) made_folder_.emplace(folder.string());
  file(0);
}

}  // namespace vorocl::command
