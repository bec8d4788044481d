#include "formats/numbered_files.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <regex>
#include <system_error>

#include "app/terminal/usage_error.hpp"

namespace vorocl::command {

namespace fs = std::filesystem;

NumberedFiles::NumberedFiles(const std::string& pattern) {
  std::smatch parts;
  if (!std::regex_match(pattern, parts, std::regex("([^%]*)%(0([1-9]))?d([^%/]*)"))) {
    throw UsageError(pattern + ": the name must have one place for a number, such as %05d" +
                     extension_of(pattern));
  }
  before_ = parts[1];
  width_ = parts[3].matched ? parts[3].str()[0] - '0' : 1;
  after_ = parts[4];

  const fs::path folder = fs::path(path(0)).parent_path();
  std::error_code ignored;
  if (!folder.empty() && fs::create_directory(folder, ignored)) made_folder_ = folder.string();
  file(0);
}

NumberedFiles::~NumberedFiles() {
  std::error_code ignored;
  if (!made_folder_.empty()) fs::remove(made_folder_, ignored);
}

std::string NumberedFiles::path(int number) const {
  return fmt::format("{}{:0{}d}{}", before_, number, width_, after_);
}

}  // namespace vorocl::command
