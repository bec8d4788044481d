// Files with numbered names, one per frame, round or wave.
#pragma once

#include <optional>
#include <string>

#include "formats/output_file.hpp"

namespace vorocl::command {

/// A name with one place for a number: %d or, with zeros to a width, %05d.
struct NumberedName {
  std::string before;
  int width = 1;
  std::string after;

  /// Throws Error if the pattern has no such place or more than one, or one that is not in the last part of
  /// the path.
  explicit NumberedName(const std::string& pattern);

  std::string with(int number) const;
};

/// A folder that goes at the end of the scope if it is empty then.
class MadeFolder {
 public:
  /// Makes it, if that is possible.
  explicit MadeFolder(const std::string& path);
  ~MadeFolder();
  MadeFolder(const MadeFolder&) = delete;
  MadeFolder& operator=(const MadeFolder&) = delete;

 private:
  TemporaryName name_;
};

/// The folder of the files is made, if only that is missing, and removed if it stays empty.
class NumberedFiles {
 public:
  /// Throws Error for a pattern that is no NumberedName, and if no
  /// file can be made there.
  explicit NumberedFiles(const std::string& pattern);

  std::string path(int number) const { return name_.with(number); }
  OutputFile file(int number) const { return OutputFile(path(number)); }

 private:
  NumberedName name_;
  std::optional<MadeFolder> made_folder_;
};

}  // namespace vorocl::command
