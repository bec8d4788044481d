// Runs the vorocl command as its users do, and checks how it ends.
#pragma once

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <string>
#include <vector>

#include "fixture.hpp"
#include "temporary_folder.hpp"

namespace vorocl {

constexpr int failure = 1, usage = 2;

struct Result {
  int exit_code;
  std::string out;
  std::string error;
};

/// Runs a line in the folder, with `settings` such as "NAME=value" in its environment and its standard
/// streams as the shell makes them of `redirections`, else kept for the result.
inline Result run(const TemporaryFolder& folder, const std::string& arguments,
                  const std::string& settings = "", const std::string& redirections = "") {
  const TemporaryFolder streams;
  const std::string shell = "cd '" + folder / "" + "' && " + settings + " '" VOROCL_COMMAND "' " + arguments +
                            " > '" + streams / "out" + "' 2> '" + streams / "error" + "' " + redirections;
  const int status = std::system(shell.c_str());
  return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, content_of(streams / "out"),
          content_of(streams / "error")};
}

/// Starts the command with these words in the folder, with both streams in its file "streams"; returns its
/// process.
inline pid_t start(const TemporaryFolder& folder, std::vector<std::string> words) {
  const pid_t process = fork();
  if (process != 0) return process;
  words.insert(words.begin(), VOROCL_COMMAND);
  std::vector<char*> pointers;
  pointers.reserve(words.size() + 1);
  for (std::string& word : words) pointers.push_back(word.data());
  pointers.push_back(nullptr);
  const int streams = open((folder / "streams").c_str(), O_CREAT | O_WRONLY, 0600);
  dup2(streams, STDOUT_FILENO);
  dup2(streams, STDERR_FILENO);
  if (chdir((folder / "").c_str()) == 0) execv(words.front().c_str(), pointers.data());
  _exit(99);
}

inline std::string succeeds(const TemporaryFolder& folder, const std::string& arguments) {
  const Result result = run(folder, arguments);
  BOOST_TEST(result.exit_code == 0, arguments << "\n" << result.error);
  BOOST_TEST(result.error == "", arguments);
  return result.out;
}

/// Runs, and checks the exit code, that standard error holds one line with all of the parts, that standard
/// output is empty and that no file was made.
inline void refuses(const TemporaryFolder& folder, const std::string& arguments, int exit_code,
                    std::initializer_list<std::string> parts, const std::string& settings = "") {
  const auto files_before = folder.names();
  const Result result = run(folder, arguments, settings);
  BOOST_TEST_CONTEXT("vorocl " << arguments << "\nsays: " << result.error) {
    BOOST_TEST(result.exit_code == exit_code);
    BOOST_TEST(result.out == "");
    BOOST_TEST(result.error.rfind("vorocl: error: ", 0) == 0u);
    BOOST_TEST(std::count(result.error.begin(), result.error.end(), '\n') == 1);
    for (const std::string& part : parts) BOOST_TEST(result.error.find(part) != std::string::npos, part);
    BOOST_TEST((folder.names() == files_before));
  }
}

}  // namespace vorocl
