// Signals at any time: nothing is cut off under a final name, and nothing temporary is left but after
// SIGKILL. VOROCL_LONG_TESTS: 200 random times instead of 24.
#define BOOST_TEST_MODULE signals
#include <fmt/format.h>
#include <poll.h>
#include <sys/inotify.h>

#include <chrono>
#include <csignal>
#include <random>
#include <thread>

#include "left_files.hpp"

using namespace vorocl;

namespace {

/// What writes files, each of another kind. Two runs make the same bytes.
const std::string subcommands[] = {
    "render --random 500 --size 700x600 --method jfa -o a.png --labels a.npy",
    "render --random 500 --size 300x200 --method jfa --waves w/%d.bmp",
    ("simulate --random 500 --size 300x200 --frames 20 --step-length 1 --method djfa -o f.mp4 --labels "
     "l/%05d.tif "
     "--cells c%d.csv --compare-with jfa --similarity s.csv"),
    ("simulate --random 500 --size 300x200 --frames 20 --step-length 1 --method exact -o p/%d.jpg --distance "
     "d%d.vti"),
    ("cells --random 500 --size 700x600 --cells c.csv --adjacency a.csv --distance d.tif --border b.png "
     "--labels l.npy"),
    "relax --random 500 --size 300x200 --rounds 20 -o r.mp4 --relaxed-points p.csv --energy e.csv",
    "relax --random 500 --size 300x200 --rounds 20 -o r/%d.png --labels l.npy",
    "tiles --random 500 --size 300x200 --tile 32 --labels l.tif -o p.png --cells c.csv"};

/// Waits for the end; whether a signal was it, which must be one of these.
bool ended_by_signal(pid_t process, const std::set<int>& signals) {
  int status = 0;
  waitpid(process, &status, 0);
  if (WIFSIGNALED(status)) {
    BOOST_TEST(signals.count(WTERMSIG(status)) == 1, "ended by signal " << WTERMSIG(status));
    return true;
  }
  BOOST_TEST((WEXITSTATUS(status) == 0 || WEXITSTATUS(status) == failure));
  return false;
}

}  // namespace

BOOST_AUTO_TEST_CASE(random_times_leave_whole_files) {
  std::mt19937 random(1);
  const int times = std::getenv("VOROCL_LONG_TESTS") != nullptr ? 200 : 24;
  int ended = 0;
  for (const std::string& subcommand : subcommands) {
    const TemporaryFolder whole;
    const std::chrono::microseconds time = time_of_whole_run(whole, subcommand);
    for (int i = 0; i < times / static_cast<int>(std::size(subcommands)) + 1; ++i) {
      const int signal = std::array{SIGINT, SIGTERM, SIGHUP, SIGKILL}[random() % 4];
      const auto delay = std::chrono::microseconds(random() % static_cast<unsigned>(time.count()));
      const TemporaryFolder folder;
      const pid_t process = start(folder, words_of(subcommand));
      std::this_thread::sleep_for(delay);
      kill(process, signal);
      BOOST_TEST_CONTEXT(subcommand << "\nsignal " << signal << " after " << delay.count() << " us") {
        ended += ended_by_signal(process, {signal});
        check_left(folder, whole, signal == SIGKILL);
      }
    }
  }
  BOOST_TEST(ended > times / 4);
}

// The moments that random times miss: right when a temporary file appears.
BOOST_AUTO_TEST_CASE(signals_find_every_temporary_file) {
  for (const std::string& subcommand : subcommands) {
    const TemporaryFolder whole;
    succeeds(whole, subcommand);
    for (const int at : {1, 2, 3, 5, 8}) {
      const int signal = std::array{SIGINT, SIGTERM, SIGHUP}[static_cast<std::size_t>(at) % 3];
      const TemporaryFolder folder;
      const int events = inotify_init1(IN_CLOEXEC | IN_NONBLOCK);
      inotify_add_watch(events, (folder / "").c_str(), IN_CREATE);
      const pid_t process = start(folder, words_of(subcommand));
      alignas(inotify_event) char buffer[4096];
      int seen = 0;
      for (pollfd ready = {events, POLLIN, 0}; seen < at && poll(&ready, 1, 400) > 0;) {
        const ssize_t size = read(events, buffer, sizeof buffer);
        for (const char* next = buffer; next < buffer + size;) {
          const auto* const event = reinterpret_cast<const inotify_event*>(next);
          seen += is_temporary(event->name);
          next += sizeof(inotify_event) + event->len;
        }
      }
      kill(process, signal);
      close(events);
      BOOST_TEST_CONTEXT(subcommand << "\nsignal " << signal << " at temporary file " << at) {
        ended_by_signal(process, {signal});
        check_left(folder, whole, false);
      }
    }
  }
}

BOOST_AUTO_TEST_CASE(a_second_signal_ends_at_once_and_leaves_nothing_temporary) {
  for (const std::string& subcommand :
       {std::string(
            "simulate --random 50 --size 200x150 --frames 1000000 --step-length 2 --method djfa -o f.mp4 "
            "--labels l/%05d.npy --compare-with jfa --similarity s.csv"),
        std::string("relax --random 50000 --size 2000x2000 --rounds 1000000 -o f.mp4 --energy e.csv")}) {
    const TemporaryFolder folder;
    const pid_t process = start(folder, words_of(subcommand));
    for (int i = 0; i < 600 && files_of(folder).empty(); ++i)
      std::this_thread::sleep_for(std::chrono::milliseconds(50));
    std::this_thread::sleep_for(std::chrono::milliseconds(300));
    // Both wait while it is stopped, so it cannot end by the first before the second is sent.
    kill(process, SIGSTOP);
    kill(process, SIGINT);  // two of one kind might come as one
    kill(process, SIGHUP);
    kill(process, SIGCONT);
    BOOST_TEST(ended_by_signal(process, {SIGINT, SIGHUP}));  // of two that wait, the system chooses the first
    for (const std::string& file : files_of(folder)) BOOST_TEST(!is_temporary(file), file);
  }
}

// As nohup starts it.
BOOST_AUTO_TEST_CASE(an_ignored_signal_stays_ignored) {
  const TemporaryFolder folder;
  const Result result = run(folder, subcommands[0] + " & kill -HUP $!; wait $!; exit $?; #", "trap '' HUP;");
  BOOST_TEST(result.exit_code == 0, result.error);
  BOOST_TEST((files_of(folder) == std::set<std::string>{"a.png", "a.npy"}));
}
