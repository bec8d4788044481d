// Runs that are killed at any time, and those that go on with them: the files are those of a run that nothing
// ended.
#pragma once

#include <sys/wait.h>

#include <chrono>
#include <csignal>
#include <functional>
#include <map>
#include <random>
#include <thread>

#include "left_files.hpp"

namespace vorocl {

/// What is compared of a file's content: most often all of it.
using Compared = std::function<std::string(const std::string& file, const std::string& content)>;

inline std::string whole_content(const std::string&, const std::string& content) { return content; }

/// The contents of all files but hidden ones, which only SIGKILL leaves.
inline std::map<std::string, std::string> contents_of(const TemporaryFolder& folder,
                                                      const Compared& compared = whole_content) {
  std::map<std::string, std::string> contents;
  for (const std::string& file : files_of(folder)) {
    if (!is_temporary(file)) contents[file] = compared(file, content_of(folder / file));
  }
  return contents;
}

/// Checks that two folders hold the same.
inline void check_same(const TemporaryFolder& folder, const TemporaryFolder& whole,
                       const Compared& compared = whole_content) {
  const auto there = contents_of(folder, compared), expected = contents_of(whole, compared);
  for (const auto& [file, content] : expected) {
    BOOST_TEST(there.count(file) == 1u, file << " is missing");
    if (there.count(file) == 1) BOOST_TEST((there.at(file) == content), file << " differs");
  }
  for (const auto& [file, content] : there) BOOST_TEST(expected.count(file) == 1u, file << " is left");
}

/// Waits until a journal in the folder says that something is complete, or the process ends.
inline void wait_for_progress(const TemporaryFolder& folder, pid_t process,
                              const std::function<bool(const std::string& journal)>& tells) {
  for (int i = 0; i < 5000; ++i) {
    for (const std::string& file : files_of(folder)) {
      if (ends_with(file, ".journal") && tells(content_of(folder / file))) return;
    }
    siginfo_t ended = {};
    if (waitid(P_PID, static_cast<id_t>(process), &ended, WEXITED | WNOHANG | WNOWAIT) != 0 ||
        ended.si_pid != 0)
      return;
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
}

/// Kills runs of a command so many times over, until one of each row comes to its end: the first time when
/// the journal `tells` of something, then at any time. Checks the files, that runs were killed, and that a
/// run went on with what another one had made.
inline void check_killed_runs(const std::vector<std::string>& subcommands, int times,
                              const std::function<bool(const std::string& journal)>& tells,
                              const Compared& compared = whole_content) {
  std::mt19937 numbers(1);
  int kills = 0, went_on = 0;
  for (const std::string& subcommand : subcommands) {
    const TemporaryFolder whole;
    const std::chrono::microseconds time = time_of_whole_run(whole, subcommand);
    for (int i = 0; i < times; ++i) {
      const TemporaryFolder folder;
      bool is_done = false;
      for (int attempt = 0; attempt < 100 && !is_done; ++attempt) {
        const pid_t process = start(folder, words_of(subcommand + " --resume"));
        if (attempt == 0) {
          wait_for_progress(folder, process, tells);
        } else {
          // Longer and longer: to go on takes time, too.
          const auto most = time.count() * (10 + attempt) / 10;
          std::this_thread::sleep_for(std::chrono::microseconds(numbers() % static_cast<unsigned>(most)));
        }
        kill(process, SIGKILL);
        int status = 0;
        waitpid(process, &status, 0);
        is_done = WIFEXITED(status);
        if (is_done) {
          BOOST_TEST(WEXITSTATUS(status) == 0, subcommand << "\n" << content_of(folder / "streams"));
          went_on += content_of(folder / "streams").find("made before: ") != std::string::npos;
        } else {
          ++kills;
        }
      }
      BOOST_TEST_CONTEXT(subcommand) {
        BOOST_TEST(is_done);
        check_same(folder, whole, compared);
      }
    }
  }
  BOOST_TEST_MESSAGE(kills << " kills");
  BOOST_TEST(kills > times);
  BOOST_TEST(went_on > 0);
}

}  // namespace vorocl
