// simulate --resume: whatever ends a run, the same command goes on, and the files are those of a run that
// nothing ended. VOROCL_LONG_TESTS: many more ends.
#define BOOST_TEST_MODULE resume
#include <sys/stat.h>

#include <chrono>
#include <csignal>
#include <map>
#include <random>
#include <thread>

#include "killed_runs.hpp"

using namespace vorocl;

namespace {

const std::string at_random = "simulate --random 300 --size 160x120 --frames 30 --step-length 2 ";
const std::string melt = "simulate --trajectory " VOROCL_SAMPLES "/lj-melt.lammpstrj --width 120 ";

/// Each with something else that a frame needs of those before it.
const std::string subcommands[] = {
    at_random +
        "--method exact --labels l/%05d.vti --cells cells.csv --adjacency a%d.csv --statistics "
        "statistics.csv",
    at_random + "--method exact -o p/%d.png --color area --color-bar --contours --every 3",
    at_random +
        "--method djfa --refresh-interval 7 --labels l%d.npy --compare-with exact --similarity "
        "similarity.csv",
    "simulate --trajectory " VOROCL_SAMPLES
    "/lj-melt-3d.lammpstrj --size 40x40x40 --method jfa --labels l%d.vti --cells cells.csv --adjacency "
    "a%d.csv "
    "-o p%d.png --slice z=3 --statistics statistics.csv",
    melt + "--frames 12 --method djfa -o %02d.png --color distance --cells c%d.csv --adjacency adjacency.csv",
};

constexpr int milliseconds_column = 6;  // of the statistics, counted from 0

/// The statistics without the times.
std::string without_times(const std::string& file, const std::string& content) {
  if (file != "statistics.csv") return content;
  std::istringstream lines(content);
  std::string kept;
  for (std::string line; std::getline(lines, line);) {
    std::size_t begin = 0;
    for (int column = 0; column < milliseconds_column; ++column) begin = line.find(',', begin) + 1;
    kept += line.erase(begin, line.find(',', begin) - begin) + "\n";
  }
  return kept;
}

/// Three frames of three particles, as extended XYZ; `third` is where one of them is in frame 2.
std::string trajectory(const std::string& third) {
  std::string text;
  for (const char* const x : {"1", "2", third.c_str()}) {
    text +=
        "3\nLattice=\"9 0 0 0 9 0 0 0 1\" pbc=\"F F F\"\nA " + std::string(x) + " 1 0\nA 7 2 0\nA 4 8 0\n";
  }
  return text;
}

const std::string three =
    "simulate --trajectory t.xyz --size 30x30 --labels l%d.npy --cells cells.csv --resume ";

/// What to do where it cannot go on.
const std::string start_again = "remove l%d.npy.journal and the .part files of its outputs to start again\n";

/// The same in a periodic box, of which the tilt grows from frame to frame by `step`.
std::string sheared(const std::string& third, int step) {
  std::string text;
  int tilt = 0;
  for (const char* const x : {"1", "2", third.c_str()}) {
    text += "3\nLattice=\"9 0 0 " + std::to_string(tilt) + " 9 0 0 0 1\" pbc=\"T T F\"\nA " + std::string(x) +
            " 1 0\nA 7 2 0\nA 4 8 0\n";
    tilt += step;
  }
  return text;
}

/// A run that stops before frame 2, which is bad.
void begin_three(const TemporaryFolder& folder, const std::string& bad = trajectory("nothing")) {
  folder.file("t.xyz", bad);
  const Result result = run(folder, three);
  BOOST_TEST(result.exit_code == failure);
  BOOST_TEST(
      result.error.find("frames complete before that: 2; the same command goes on") != std::string::npos,
      result.error);
  BOOST_TEST((folder.names() ==
              std::set<std::string>{"t.xyz", "l0.npy", "l1.npy", "cells.csv.part", "l%d.npy.journal"}));
}

}  // namespace

BOOST_AUTO_TEST_CASE(a_run_that_is_killed_at_any_time_is_completed) {
  const int times = std::getenv("VOROCL_LONG_TESTS") != nullptr ? 30 : 1;
  const auto tells = [](const std::string& journal) {
    const std::size_t end = journal.find("\nsteps ");
    return end != std::string::npos && journal.find('\n', end + 1) + 1 < journal.size();
  };
  check_killed_runs({std::begin(subcommands), std::end(subcommands)}, times, tells, without_times);
}

BOOST_AUTO_TEST_CASE(so_is_one_that_is_interrupted) {
  const TemporaryFolder whole, folder;
  succeeds(whole, subcommands[0]);
  const pid_t process = start(folder, words_of(subcommands[0] + " --resume"));
  for (int i = 0; i < 2000 && !std::filesystem::exists(folder / "l/00004.vti"); ++i)
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  kill(process, SIGINT);
  int status = 0;
  waitpid(process, &status, 0);
  BOOST_TEST(WEXITSTATUS(status) == failure);
  BOOST_TEST(content_of(folder / "streams").find("interrupted; frames complete before that: ") !=
             std::string::npos);
  for (const std::string& file : files_of(folder)) BOOST_TEST(!is_temporary(file), file);
  const Result result = run(folder, subcommands[0] + " --resume");
  BOOST_TEST(result.exit_code == 0, result.error);
  check_same(folder, whole, without_times);
}

#ifdef VOROCL_FAULTS
BOOST_AUTO_TEST_CASE(so_is_one_whose_files_could_not_be_written) {
  const std::string subcommand =
      "simulate --random 9 --size 40x30 --frames 3 --step-length 1 --labels l%d.vti --cells cells.csv "
      "--adjacency "
      "adjacency.csv --compare-with jfa --similarity s.csv --resume";
  const TemporaryFolder whole;
  run(whole, subcommand, "LD_PRELOAD='" VOROCL_FAULTS "' VOROCL_FAULT_COUNTS=counts");
  std::map<std::string, int> calls;
  std::ifstream counts(whole / "counts");
  std::string kind;
  for (int number = 0; counts >> kind >> number;) calls[kind] = number;
  std::filesystem::remove(whole / "counts");
  const int step = std::getenv("VOROCL_LONG_TESTS") != nullptr ? 1 : 12;
  for (const char* const call : {"open", "write", "fsync", "rename"}) {
    BOOST_TEST(calls[call] > 5);
    for (int number = call == std::string("rename") ? calls[call] - 3 : 1; number <= calls[call];
         number += step) {
      const TemporaryFolder folder;
      const std::string fault = call + (" " + std::to_string(number));
      const Result failed =
          run(folder, subcommand, "LD_PRELOAD='" VOROCL_FAULTS "' VOROCL_FAULT='" + fault + " on'");
      BOOST_TEST_CONTEXT(fault << "\n" << failed.error) {
        BOOST_TEST(failed.exit_code == failure);
        const Result result = run(folder, subcommand);
        BOOST_TEST(result.exit_code == 0, result.error);
        check_same(folder, whole, without_times);
      }
    }
  }
}
#endif

BOOST_AUTO_TEST_CASE(a_trajectory_that_has_grown_whole_is_gone_on_with) {
  const TemporaryFolder whole, folder;
  whole.file("t.xyz", trajectory("3"));
  run(whole, three);
  begin_three(folder);
  folder.file("t.xyz", trajectory("3"));
  BOOST_TEST(run(folder, three).exit_code == 0);
  check_same(folder, whole, without_times);
}

BOOST_AUTO_TEST_CASE(a_box_goes_on_with_the_tilts_that_it_had) {
  const TemporaryFolder whole, folder;
  whole.file("t.xyz", sheared("3", 2));
  run(whole, three);
  begin_three(folder, sheared("nothing", 2));
  folder.file("t.xyz", sheared("3", 1));  // the particles are where they were
  const auto before = contents_of(folder);
  refuses(folder, three, failure,
          {"the seeds of frames 0 to 1 are others than those that l%d.npy.journal is of", start_again});
  BOOST_TEST((contents_of(folder) == before));
  folder.file("t.xyz", sheared("3", 2));
  BOOST_TEST(run(folder, three).exit_code == 0);
  check_same(folder, whole, without_times);
  // The tilt is seen.
  folder.file("t.xyz", sheared("3", 1));
  for (const char* const name : {"l0.npy", "l1.npy", "l2.npy"}) std::filesystem::remove(folder / name);
  BOOST_TEST(run(folder, three).exit_code == 0);
  BOOST_TEST(content_of(folder / "l0.npy") == content_of(whole / "l0.npy"));
  BOOST_TEST(content_of(folder / "l1.npy") != content_of(whole / "l1.npy"));
}

BOOST_AUTO_TEST_CASE(what_does_not_fit_is_refused) {
  const TemporaryFolder folder;
  begin_three(folder);
  folder.file("t.xyz", trajectory("3"));
  const auto before = contents_of(folder);
  refuses(folder, three + "--metric manhattan", failure,
          {"l%d.npy.journal is of another run: there nothing, here \"--metric manhattan\"", start_again});
  refuses(folder, "simulate --trajectory t.xyz --size 31x30 --labels l%d.npy --cells cells.csv --resume",
          failure, {"there \"--size 30x30\", here \"--size 31x30\"; give its options, or " + start_again});
  refuses(folder, "simulate --trajectory t.xyz --size 30x30 --labels l%d.npy --resume", failure,
          {"there \"--cells cells.csv\", here nothing"});
  refuses(folder, "simulate --trajectory t.xyz --size 30x30 --labels l%d.npy", failure,
          {"l%d.npy.journal says", "give --resume, or " + start_again});
  folder.file("t.xyz", trajectory("3").replace(trajectory("3").find("A 1 1"), 5, "A 6 1"));
  refuses(folder, three, failure,
          {"the seeds of frames 0 to 1 are others than those that l%d.npy.journal is of", start_again});
  folder.file("t.xyz", trajectory("3").substr(0, trajectory("3").size() / 3));
  refuses(folder, three, failure, {"the seeds of frames 0 to 1 are others"});
  folder.file("t.xyz", trajectory("3"));

  std::filesystem::rename(folder / "l1.npy", folder / "other.npy");
  refuses(folder, three, failure, {"l1.npy is missing", start_again});
  std::filesystem::rename(folder / "other.npy", folder / "l1.npy");
  std::filesystem::rename(folder / "cells.csv.part", folder / "other");
  refuses(folder, three, failure, {"cells.csv.part: No such file", "; " + start_again});
  folder.file("cells.csv.part", "id");
  refuses(folder, three, failure, {"cells.csv.part", "bytes that was left; " + start_again});
  std::filesystem::remove(folder / "cells.csv.part");
  std::filesystem::create_symlink("other", folder / "cells.csv.part");
  refuses(folder, three, failure, {"cells.csv.part"});
  std::filesystem::rename(folder / "other", folder / "cells.csv.part");
  BOOST_TEST((contents_of(folder) == before));
  BOOST_TEST(run(folder, three).exit_code == 0);

  folder.file("cells.csv.part", "mine");
  refuses(folder, three, failure,
          {"cells.csv.part is there, and no l%d.npy.journal", "; remove cells.csv.part to start again\n"});
  BOOST_TEST(content_of(folder / "cells.csv.part") == "mine");
}

BOOST_AUTO_TEST_CASE(damaged_journals_are_refused) {
  const TemporaryFolder folder;
  begin_three(folder);
  const std::string journal = content_of(folder / "l%d.npy.journal");
  for (const char* const end :
       {"1 2 more\n", "1 x more 3\n", "-1 2 more 3\n", "\n", "1 2 more 99999999999999999999999\n"}) {
    folder.file("l%d.npy.journal", journal + end);
    refuses(folder, three, failure, {"l%d.npy.journal is damaged", start_again});
  }
  folder.file("l%d.npy.journal", "id,x,y\n");
  refuses(folder, three, failure, {"l%d.npy.journal is no journal of a run; " + start_again});
  folder.file("l%d.npy.journal", journal + "2 5");  // cut off: the frame counts as not made
  folder.file("t.xyz", trajectory("3"));
  const Result result = run(folder, three);
  BOOST_TEST(result.exit_code == 0, result.error);
}

BOOST_AUTO_TEST_CASE(journals_with_other_lines_are_refused) {
  const TemporaryFolder folder;
  begin_three(folder);
  const std::string journal = content_of(folder / "l%d.npy.journal");
  const std::size_t last = journal.rfind('\n', journal.size() - 2) + 1;
  const std::size_t before = journal.rfind('\n', last - 2) + 1;
  const std::string line = journal.substr(last), other = journal.substr(before, last - before);
  const std::string without_other = journal.substr(0, before) + line;
  for (const std::string& damaged : {journal + line, without_other + other, without_other}) {
    folder.file("l%d.npy.journal", damaged);
    refuses(folder, three, failure, {"l%d.npy.journal is damaged", start_again});
  }
  std::filesystem::remove(folder / "l%d.npy.journal");
  mkfifo((folder / "l%d.npy.journal").c_str(), 0600);
  refuses(folder, three, failure, {"l%d.npy.journal is no journal"}, "timeout -s KILL 20");
}

BOOST_AUTO_TEST_CASE(two_runs_at_once_are_refused) {
  const TemporaryFolder folder, whole;
  const std::string subcommand = at_random + "--labels l%d.npy --cells cells.csv";
  succeeds(whole, subcommand);
  for (int i = 0; i < 2; ++i) {  // a run that begins, and one that goes on
    const pid_t process = start(folder, words_of(subcommand + " --resume"));
    const std::string path = folder / ("l" + std::to_string(8 * (i + 1)) + ".npy");
    for (int tries = 0; tries < 4000 && !std::filesystem::exists(path); ++tries)
      std::this_thread::sleep_for(std::chrono::milliseconds(2));
    kill(process, SIGSTOP);
    int status = 0;
    waitpid(process, &status, WUNTRACED);  // until it writes no more
    BOOST_TEST_REQUIRE(WIFSTOPPED(status));
    const auto before = contents_of(folder);
    const Result result = run(folder, subcommand + " --resume");
    BOOST_TEST(result.exit_code == failure);
    BOOST_TEST(result.error.find("another run is writing l%d.npy.journal") != std::string::npos,
               result.error);
    BOOST_TEST((contents_of(folder) == before));
    kill(process, SIGKILL);
    waitpid(process, &status, 0);
    BOOST_TEST(WIFSIGNALED(status));
  }
  BOOST_TEST(run(folder, subcommand + " --resume").exit_code == 0);
  check_same(folder, whole);
}

#ifdef VOROCL_FAULTS
// The tables get their names one after the other.
BOOST_AUTO_TEST_CASE(complete_tables_keep_their_names) {
  const TemporaryFolder folder;
  const std::string subcommand =
      "simulate --random 9 --size 40x30 --frames 2 --step-length 1 --cells c.csv --adjacency p.csv --resume";
  const Result failed = run(folder, subcommand, "LD_PRELOAD='" VOROCL_FAULTS "' VOROCL_FAULT='rename 3 on'");
  BOOST_TEST(failed.exit_code == failure, failed.error);
  BOOST_TEST((files_of(folder) == std::set<std::string>{"c.csv", "p.csv.part", "c.csv.journal"}));
  std::filesystem::rename(folder / "p.csv.part", folder / "other");
  refuses(folder, subcommand, failure, {"p.csv"});
  std::filesystem::rename(folder / "other", folder / "p.csv.part");
  BOOST_TEST(run(folder, subcommand).exit_code == 0);
  BOOST_TEST((files_of(folder) == std::set<std::string>{"c.csv", "p.csv"}));
}
#endif

BOOST_AUTO_TEST_CASE(films_and_runs_without_files_cannot_be_resumed) {
  const TemporaryFolder folder;
  refuses(folder, at_random + "-o f.mp4 --labels l%d.npy --resume", usage,
          {"--resume cannot go on with a film", "-o frames/%05d.png"});
  refuses(folder, at_random + "--resume", usage, {"--resume needs files"});
  refuses(folder, at_random + "--cells /dev/null --resume", usage, {".csv"});
  std::filesystem::create_symlink("/dev/null", folder / "null.csv");
  refuses(folder, at_random + "--cells null.csv --resume", failure, {"null.csv", "--resume needs a file"});
}
