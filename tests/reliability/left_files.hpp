// What a run that was ended, or failed, may leave: whole files, and nothing temporary.
#pragma once

#include <algorithm>
#include <chrono>
#include <sstream>

#include "run_command.hpp"

namespace vorocl {

inline std::vector<std::string> words_of(const std::string& arguments) {
  std::istringstream text(arguments);
  return {std::istream_iterator<std::string>(text), {}};
}

/// All files in the folder and the folders in it, by their paths from there. Files may come and go meanwhile.
inline std::set<std::string> files_of(const TemporaryFolder& folder) {
  std::set<std::string> files;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder / "")) {
    if (entry.is_regular_file()) files.insert(entry.path().lexically_relative(folder / "").string());
  }
  files.erase("streams");
  return files;
}

inline bool ends_with(const std::string& text, const std::string& end) {
  return text.size() >= end.size() && text.compare(text.size() - end.size(), end.size(), end) == 0;
}

inline bool is_temporary(const std::string& path) {
  return std::filesystem::path(path).filename().string().rfind(".vorocl-", 0) == 0;
}

/// Whether a file is whole that an ended run left: as long as another run's, or of the frames before the end.
inline bool is_whole(const std::string& path, const std::string& expected) {
  const std::string content = content_of(path);
  if (ends_with(path, ".mp4")) return content.find("moov") != std::string::npos;
  if (ends_with(path, ".pvd")) return ends_with(content, "</VTKFile>\n");
  if (ends_with(path, "s.csv") || ends_with(path, "e.csv")) {  // rows of frames
    return ends_with(content, "\n") && expected.compare(0, content.size(), content) == 0;
  }
  if (ends_with(path, ".csv"))
    return std::count(content.begin(), content.end(), '\n') ==
           std::count(expected.begin(), expected.end(), '\n');
  return content.size() == expected.size();  // of the last round before the end
}

/// Makes a subcommand's files in the folder; returns how long that took.
inline std::chrono::microseconds time_of_whole_run(const TemporaryFolder& folder,
                                                   const std::string& subcommand) {
  succeeds(folder, subcommand);  // builds kernels, too
  const auto begin = std::chrono::steady_clock::now();
  succeeds(folder, subcommand);
  return std::chrono::duration_cast<std::chrono::microseconds>(std::chrono::steady_clock::now() - begin);
}

/// Checks what a run that was ended has left, against a run that was not.
inline void check_left(const TemporaryFolder& folder, const TemporaryFolder& whole, bool killed) {
  for (const std::string& file : files_of(folder)) {
    if (is_temporary(file)) {
      BOOST_TEST(killed, file << " is left");
    } else if (const std::string expected = content_of(whole / file); content_of(folder / file) != expected) {
      BOOST_TEST(is_whole(folder / file, expected), file << " is not whole");
    }
  }
  if (killed) return;
  for (const auto& entry : std::filesystem::directory_iterator(folder / "")) {
    BOOST_TEST(!(entry.is_directory() && std::filesystem::is_empty(entry.path())), entry.path()
                                                                                       << " is empty");
  }
}

}  // namespace vorocl
