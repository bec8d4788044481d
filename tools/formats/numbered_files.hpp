// Files of a frame or a wave each, whose names are numbered.
#pragma once

#include <string>

#include "formats/files.hpp"

namespace vorocl::command {

class NumberedFiles {
 public:
  /// The pattern has one place for the number, %d or, with zeros to a width, %05d. Makes the folder, if only
  /// that is missing. Throws UsageError for another pattern, Error if no file can be made there.
  explicit NumberedFiles(const std::string& pattern);

  /// Removes the folder it made, if that is empty.
  ~NumberedFiles();
  NumberedFiles(const NumberedFiles&) = delete;
  NumberedFiles& operator=(const NumberedFiles&) = delete;

  OutputFile file(int number) const { return OutputFile(path(number)); }

 private:
  std::string path(int number) const;

  std::string before_;
  int width_ = 0;
  std::string after_;
  std::string made_folder_;  // empty: none
};

}  // namespace vorocl::command
