// tiles --resume: whatever ends a run, the same command goes on, and the files are those of a run that
// nothing ended. VOROCL_LONG_TESTS: many more ends.
#define BOOST_TEST_MODULE resume_tiles
#include <sys/stat.h>

#include <chrono>
#include <csignal>
#include <map>
#include <random>
#include <thread>

#include "killed_runs.hpp"

using namespace vorocl;

namespace {

const std::string plane = "tiles --random 3000 --size 700x500 --tile 64 ";

const std::string subcommands[] = {
    plane + "--labels a.npy --cells c.csv --adjacency p.csv",
    plane + "--labels a.zarr --distance d.npy -o a.png --periodic xy",
    plane + "--labels a.tif --adjacency p.csv --only 100,30,699,499",
};

/// Starts a run, and sends it a signal when the journal tells of a tile that it has made. Returns its
/// process.
pid_t start_and_signal(const TemporaryFolder& folder, const std::string& subcommand,
                       const std::string& journal, int signal) {
  const auto last_tile = [&] {  // in the journal, with what stands before it; empty: none
    const std::string text = content_of(folder / journal);
    const std::size_t place = text.rfind("\ntile ");
    return place == std::string::npos ? "" : text.substr(0, text.find('\n', place + 1));
  };
  const std::string before = last_tile();
  const pid_t process = start(folder, words_of(subcommand));
  for (int i = 0; i < 4000; ++i) {
    if (last_tile().size() > before.size()) break;
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
  kill(process, signal);
  return process;
}

int status_of(pid_t process) {
  int status = 0;
  waitpid(process, &status, 0);
  return status;
}

/// The same, until the run has ended. Returns its status.
int interrupt(const TemporaryFolder& folder, const std::string& subcommand, const std::string& journal,
              int signal) {
  return status_of(start_and_signal(folder, subcommand, journal, signal));
}

}  // namespace

BOOST_AUTO_TEST_CASE(a_run_that_is_killed_at_any_time_is_completed) {
  const int times = std::getenv("VOROCL_LONG_TESTS") != nullptr ? 15 : 1;
  // Tiles count from the line on that says how long their sums are.
  const auto tells = [](const std::string& journal) { return journal.find("\nsums ") != std::string::npos; };
  check_killed_runs({std::begin(subcommands), std::end(subcommands)}, times, tells);
}

BOOST_AUTO_TEST_CASE(signals_keep_what_is_complete_and_name_it) {
  for (const int signal : {SIGINT, SIGTERM}) {
    const TemporaryFolder whole, folder;
    succeeds(whole, subcommands[0]);
    const int status = interrupt(folder, subcommands[0] + " --resume", "a.npy.journal", signal);
    const std::string said = content_of(folder / "streams");
    BOOST_TEST_CONTEXT(said) {
      BOOST_TEST(WEXITSTATUS(status) == failure);
      for (const char* const part : {"interrupted; ",
                                     " of 88 tiles are complete and kept in a.npy.part, c.csv.part and "
                                     "a.npy.journal; run the same command again to go on\n"}) {
        BOOST_TEST(said.find(part) != std::string::npos, part);
      }
      BOOST_TEST((files_of(folder) == std::set<std::string>{"a.npy.journal", "a.npy.part", "c.csv.part"}));
    }
    const Result result = run(folder, subcommands[0] + " --resume");
    BOOST_TEST(result.exit_code == 0, result.error);
    BOOST_TEST(result.out.find("made before: ") != std::string::npos);
    check_same(folder, whole);
  }
}

BOOST_AUTO_TEST_CASE(without_resume_nothing_stays) {
  succeeds({}, "tiles --random 300 --size 200x200 --tile 64 -o a.png");  // builds kernels
  const std::string large = "tiles --random 300000 --size 6000x6000 --tile 64 -o a.png --labels a";
  for (const std::string end : {".npy", ".zarr", ".tif"}) {
    for (const int signals : {1, 2}) {
      const TemporaryFolder folder;
      const pid_t process = start(folder, words_of(large + end));
      const auto begun = [&] {
        const auto names = folder.names();
        return std::any_of(names.begin(), names.end(), is_temporary);
      };
      for (int i = 0; i < 4000 && !begun(); ++i) std::this_thread::sleep_for(std::chrono::milliseconds(2));
      std::this_thread::sleep_for(std::chrono::milliseconds(300));
      for (int i = 0; i < signals; ++i) kill(process, i == 0 ? SIGINT : SIGTERM);
      int status = 0;
      waitpid(process, &status, 0);
      BOOST_TEST_CONTEXT(end << ", " << signals << " signals: " << content_of(folder / "streams")) {
        if (signals == 1) {
          BOOST_TEST(WEXITSTATUS(status) == failure);
          BOOST_TEST(content_of(folder / "streams").find("interrupted; nothing stays") != std::string::npos);
        }
        BOOST_TEST((folder.names() == std::set<std::string>{"streams"}));
      }
    }
  }
}

#ifdef VOROCL_FAULTS
BOOST_AUTO_TEST_CASE(a_run_whose_files_could_not_be_written_is_completed) {
  const int step = std::getenv("VOROCL_LONG_TESTS") != nullptr ? 1 : 23;
  for (const std::string end : {".npy -o a.png", ".zarr", ".tif --cells c.csv"}) {
    const std::string subcommand = "tiles --random 9 --size 90x70 --tile 32 --resume --labels a" + end;
    const TemporaryFolder whole;
    run(whole, subcommand, "LD_PRELOAD='" VOROCL_FAULTS "' VOROCL_FAULT_COUNTS=counts");
    std::map<std::string, int> calls;
    std::ifstream counts(whole / "counts");
    std::string kind;
    for (int number = 0; counts >> kind >> number;) calls[kind] = number;
    std::filesystem::remove(whole / "counts");
    for (const char* const call : {"open", "write", "pwrite", "fallocate", "fsync", "rename"}) {
      for (int number = 1; number <= calls[call]; number += number < 4 ? 1 : step) {
        const TemporaryFolder folder;
        const std::string fault = call + (" " + std::to_string(number));
        const Result failed =
            run(folder, subcommand, "LD_PRELOAD='" VOROCL_FAULTS "' VOROCL_FAULT='" + fault + " on'");
        BOOST_TEST_CONTEXT(subcommand << " " << fault << "\n" << failed.error) {
          // How often the outputs are synced goes by the clock: this run may have made fewer calls.
          BOOST_TEST((failed.exit_code == failure || number > 3));
          if (failed.exit_code != 0) {
            const Result result = run(folder, subcommand);
            BOOST_TEST(result.exit_code == 0, result.error);
          }
          check_same(folder, whole);
        }
      }
    }
  }
}
#endif

BOOST_AUTO_TEST_CASE(what_does_not_fit_is_refused) {
  const TemporaryFolder folder;
  const std::string large = "tiles --random 3000 --size 700x500 --tile 64 --labels a.npy --cells c.csv ";
  const int status = interrupt(folder, large + "--resume", "a.npy.journal", SIGKILL);
  BOOST_REQUIRE(WIFSIGNALED(status));
  const auto before = contents_of(folder);
  const std::string start_again = "remove a.npy.journal and the .part files of its outputs to start again\n";
  refuses(folder, large + "--resume --metric manhattan", failure,
          {"a.npy.journal is of another run: there nothing, here \"--metric manhattan\""});
  refuses(folder, "tiles --random 3001 --size 700x500 --tile 64 --labels a.npy --cells c.csv --resume",
          failure, {"there \"seeds 3000 ", "here \"seeds 3001 ", "remove a.npy.journal and the .part files"});
  refuses(folder, "tiles --random 3000 --size 700x500 --tile 32 --labels a.npy --cells c.csv --resume",
          failure, {"there \"tiles of 64\", here \"tiles of 32\""});
  refuses(folder, large, failure, {"a.npy.journal", "give --resume, or remove a.npy.journal"});
  std::filesystem::rename(folder / "a.npy.part", folder / "other");
  refuses(folder, large + "--resume", failure, {"a.npy.part: No such file or directory; " + start_again});
  folder.file("a.npy.part", "short");
  refuses(folder, large + "--resume", failure, {"a.npy.part: it is not the file of ", "; " + start_again});
  std::filesystem::rename(folder / "other", folder / "a.npy.part");
  std::filesystem::rename(folder / "c.csv.part", folder / "other");
  refuses(folder, large + "--resume", failure, {"c.csv.part: No such file or directory; " + start_again});
  folder.file("c.csv.part", std::string(content_of(folder / "other").size(), 'x'));
  refuses(folder, large + "--resume", failure, {"c.csv.part is damaged; " + start_again});
  std::filesystem::rename(folder / "other", folder / "c.csv.part");
  BOOST_TEST((contents_of(folder) == before));
  BOOST_TEST(run(folder, large + "--resume").exit_code == 0);

  folder.file("a.npy.part", "mine");
  refuses(folder, large + "--resume", failure, {"a.npy.part is there", "remove a.npy.part"});
  BOOST_TEST(content_of(folder / "a.npy.part") == "mine");
}

BOOST_AUTO_TEST_CASE(two_runs_at_once_are_refused) {
  const TemporaryFolder folder, whole;
  succeeds(whole, subcommands[0]);
  const std::string subcommand = subcommands[0] + " --resume";
  for (int i = 0; i < 2; ++i) {  // a run that begins, and one that goes on
    const pid_t process = start_and_signal(folder, subcommand, "a.npy.journal", SIGSTOP);
    refuses(folder, subcommand, failure, {"another run is writing a.npy.journal"});
    kill(process, SIGKILL);
    BOOST_TEST(WIFSIGNALED(status_of(process)));
  }
  BOOST_TEST(run(folder, subcommand).exit_code == 0);
  check_same(folder, whole);
}

BOOST_AUTO_TEST_CASE(other_seeds_are_refused) {
  const TemporaryFolder folder;
  std::mt19937 numbers(1);
  std::string points = "x,y\n";
  for (int i = 0; i < 3000; ++i)
    points += std::to_string(numbers() % 700) + "," + std::to_string(numbers() % 500) + "\n";
  folder.file("p.csv", points);
  const std::string subcommand =
      "tiles --points p.csv --bounds 0,0,700,500 --size 700x500 --tile 64 --labels a.zarr --resume";
  BOOST_REQUIRE(WIFSIGNALED(interrupt(folder, subcommand, "a.zarr.journal", SIGKILL)));
  folder.file("p.csv", points + "1,1\n");
  refuses(folder, subcommand, failure,
          {"a.zarr.journal is of another run: there \"seeds 3000 ", "here \"seeds 3001 "});
  folder.file("p.csv", points.replace(4, 1, points[4] == '1' ? "2" : "1"));
  refuses(folder, subcommand, failure, {"there \"seeds 3000 ", "here \"seeds 3000 "});
}

// Whatever is done to the lines of a journal, or to one bit: the run refuses, or makes what a whole one
// makes.
BOOST_AUTO_TEST_CASE(no_damaged_journal_gives_wrong_files) {
  const int flips = std::getenv("VOROCL_LONG_TESTS") != nullptr ? 400 : 12;
  for (const std::string& subcommand : {subcommands[0], subcommands[2]}) {
    const TemporaryFolder whole, left;
    succeeds(whole, subcommand);
    const std::string name = subcommand == subcommands[0] ? "a.npy.journal" : "a.tif.journal";
    BOOST_REQUIRE(WIFSIGNALED(interrupt(left, subcommand + " --resume", name, SIGKILL)));
    for (const std::string& file : files_of(left)) {
      if (is_temporary(file)) std::filesystem::remove(left / file);
    }
    const std::string journal = content_of(left / name);
    std::vector<std::string> lines;
    std::istringstream text(journal);
    for (std::string line; std::getline(text, line);) lines.push_back(line + "\n");
    const auto of_kind = [&](const std::string& word) {
      std::vector<std::size_t> found;
      for (std::size_t i = 0; i < lines.size(); ++i) {
        if (lines[i].rfind(word + " ", 0) == 0) found.push_back(i);
      }
      return found;
    };
    const std::vector<std::size_t> tiles = of_kind("tile"), sums = of_kind("sums");
    BOOST_REQUIRE(!tiles.empty());
    BOOST_REQUIRE(!sums.empty());
    const std::size_t first = tiles.front(), last = tiles.back(), sum = sums.back();
    std::map<std::string, std::string> damaged;
    const auto damage = [&](const std::string& what,
                            const std::function<void(std::vector<std::string>&)>& to) {
      std::vector<std::string> changed = lines;
      to(changed);
      for (const std::string& line : changed) damaged[what] += line;
    };
    using Lines = std::vector<std::string>;
    const auto at = [](Lines& all, std::size_t i) { return all.begin() + static_cast<std::ptrdiff_t>(i); };
    damage("a tile is deleted", [&](Lines& all) { all.erase(at(all, first)); });
    damage("a tile is there twice", [&](Lines& all) { all.insert(at(all, first), all[first]); });
    damage("two lines are swapped",
           [&](Lines& all) { std::swap(all[first], all[last > first ? last : sum]); });
    damage("no bytes of sums", [&](Lines& all) { all[sum].replace(0, all[sum].rfind(' '), "sums 0"); });
    std::mt19937 numbers(1);
    for (int i = 0; i < flips; ++i) {
      const std::size_t place = numbers() % journal.size();
      std::string flipped = journal;
      flipped[place] = static_cast<char>(flipped[place] ^ (1 << numbers() % 8));
      damaged["byte " + std::to_string(place) + " is " + std::to_string(flipped[place])] = flipped;
    }
    for (const auto& [what, content] : damaged) {
      const TemporaryFolder folder;
      std::filesystem::copy(
          left / "", folder / "",
          std::filesystem::copy_options::recursive | std::filesystem::copy_options::overwrite_existing);
      folder.file(name, content);
      const auto before = contents_of(folder);
      const Result result = run(folder, subcommand + " --resume");
      BOOST_TEST_CONTEXT(what << " in " << name << ": " << result.error) {
        if (result.exit_code == 0) {
          check_same(folder, whole);
        } else {
          BOOST_TEST(result.exit_code == failure);
          BOOST_TEST(result.error.find("remove " + name) != std::string::npos);
          BOOST_TEST((contents_of(folder) == before));
        }
      }
    }
  }
}

// As a run leaves its journal that is killed while it notes tiles; the next one is killed, too.
BOOST_AUTO_TEST_CASE(tiles_that_no_sums_hold_are_made_again) {
  const TemporaryFolder whole, folder;
  succeeds(whole, subcommands[0]);
  const std::string subcommand = subcommands[0] + " --resume", name = "a.npy.journal";
  BOOST_REQUIRE(WIFSIGNALED(interrupt(folder, subcommand, name, SIGKILL)));
  const std::string journal = content_of(folder / name);
  folder.file(name, journal.substr(0, journal.rfind("\nsums ") + 1));
  interrupt(folder, subcommand, name, SIGKILL);
  BOOST_TEST(run(folder, subcommand).exit_code == 0);
  check_same(folder, whole);
}

BOOST_AUTO_TEST_CASE(a_pipe_is_no_journal) {
  const TemporaryFolder folder;
  mkfifo((folder / "a.npy.journal").c_str(), 0600);
  refuses(folder, subcommands[0] + " --resume", failure, {"a.npy.journal is no journal"},
          "timeout -s KILL 20");
}

#ifdef VOROCL_FAULTS
// The outputs get their names one after the other, after the journal. A run that ends in between has some
// that are complete: one that refuses to go on leaves them their names.
BOOST_AUTO_TEST_CASE(complete_outputs_keep_their_names) {
  for (const std::string labels : {"a.npy", "a.zarr", "a.tif"}) {
    const TemporaryFolder whole, folder;
    const std::string subcommand = "tiles --random 9 --size 90x70 --tile 32 --cells c.csv --labels " + labels;
    succeeds(whole, subcommand);
    const Result failed =
        run(folder, subcommand + " --resume", "LD_PRELOAD='" VOROCL_FAULTS "' VOROCL_FAULT='rename 3 on'");
    BOOST_TEST(failed.exit_code == failure, failed.error);
    const std::string sums = content_of(folder / "c.csv.part");
    BOOST_TEST((files_of(folder).count(labels) == 1 || labels == "a.zarr"));
    BOOST_TEST(std::filesystem::exists(folder / labels));
    folder.file("c.csv.part", std::string(sums.size(), 'x'));
    refuses(folder, subcommand + " --resume", failure, {"c.csv.part is damaged"});
    std::string flipped = sums;
    flipped[sums.size() / 2] = static_cast<char>(flipped[sums.size() / 2] ^ 1);
    folder.file("c.csv.part", flipped);
    refuses(folder, subcommand + " --resume", failure, {"c.csv.part is damaged"});
    std::filesystem::remove(folder / "c.csv.part");
    refuses(folder, subcommand + " --resume", failure, {"c.csv: No such file"});
    folder.file("c.csv.part", sums);
    BOOST_TEST(run(folder, subcommand + " --resume").exit_code == 0);
    check_same(folder, whole);
  }
}
#endif

BOOST_AUTO_TEST_CASE(damaged_journals_are_refused) {
  const TemporaryFolder folder;
  BOOST_REQUIRE(WIFSIGNALED(interrupt(folder, subcommands[2] + " --resume", "a.tif.journal", SIGKILL)));
  const std::string journal = content_of(folder / "a.tif.journal");
  for (const char* const end : {"tile x 3\nsums 0\n", "tile 3\nsums 0\n", "sums\n", "\n", "tiles 3\n"}) {
    folder.file("a.tif.journal", journal + end);
    refuses(folder, subcommands[2] + " --resume", failure, {"a.tif.journal is damaged"});
  }
  folder.file("a.tif.journal", journal + "tile 87 5");  // cut off: the tile counts as not made
  const Result result = run(folder, subcommands[2] + " --resume");
  BOOST_TEST(result.exit_code == 0, result.error);
  const TemporaryFolder whole;
  succeeds(whole, subcommands[2]);
  check_same(folder, whole);
}
