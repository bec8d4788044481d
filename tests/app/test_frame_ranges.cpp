// simulate --frames K:L: frames K to L are those of a run from frame 0 on, to the byte, whatever a frame
// needs of those before it; so numbered files continue a run that was ended.
#define BOOST_TEST_MODULE frame_ranges
#include <sstream>

#include "run_command.hpp"

using namespace vorocl;

namespace {

const std::string at_random = "simulate --random 300 --size 160x120 --step-length 2 ";
const std::string melt = "simulate --trajectory " VOROCL_SAMPLES "/lj-melt.lammpstrj --width 120 ";
const std::string volumes =
    "simulate --trajectory " VOROCL_SAMPLES "/lj-melt-3d.lammpstrj --size 40x40x40 --method jfa ";

/// Each with something else that a frame needs of those before it.
struct Case {
  std::string subcommand;
  int first, last;
};
const Case cases[] = {
    {at_random + "--labels l/%05d.vti --cells cells.csv --adjacency a%d.csv --statistics statistics.csv", 7,
     12},
    {at_random + "-o p/%d.png --color area --color-bar --contours --every 3", 4, 12},
    {at_random +
         "--method djfa --refresh-interval 7 --labels l%d.npy --compare-with exact --similarity s.csv",
     5, 12},
    {volumes + "--labels l%d.vti --cells cells.csv --adjacency a%d.csv -o p%d.png --slice z=3 --statistics "
               "statistics.csv",
     1, 2},
    {melt + "--method djfa -o %02d.png --color distance --cells c%d.csv --adjacency adjacency.csv", 12, 12},
};

constexpr std::size_t milliseconds_column = 6;  // of the statistics

/// The rows of a table from a frame on, below the header; those of statistics without the times.
std::string rows_from(const std::string& table, int first) {
  std::istringstream lines(table);
  std::string header, kept;
  std::getline(lines, header);
  const bool has_times = header.find(",milliseconds") != std::string::npos;
  for (std::string line; std::getline(lines, line);) {
    if (std::stoi(line) < first) continue;
    std::size_t begin = 0;
    for (std::size_t column = 0; has_times && column < milliseconds_column; ++column)
      begin = line.find(',', begin) + 1;
    if (has_times) line.erase(begin, line.find(',', begin) - begin);
    kept += line + "\n";
  }
  return header + "\n" + kept;
}

std::string frames(int first, int last) {
  return " --frames " + std::to_string(first) + ":" + std::to_string(last);
}

/// All files of a folder, those of its folders too.
std::set<std::string> files_of(const TemporaryFolder& folder) {
  std::set<std::string> files;
  const std::filesystem::path root = folder / "";
  for (const auto& entry : std::filesystem::recursive_directory_iterator(root)) {
    const std::string name = entry.path().lexically_relative(root).string();
    if (!entry.is_directory() && name != "streams") files.insert(name);
  }
  return files;
}

bool is_table_of_frames(const std::string& content) { return content.rfind("frame,", 0) == 0; }

}  // namespace

BOOST_AUTO_TEST_CASE(later_frames_are_those_of_a_whole_run) {
  for (const Case& made : cases) {
    BOOST_TEST_CONTEXT(made.subcommand) {
      const TemporaryFolder whole, parts;
      succeeds(whole, made.subcommand + frames(0, made.last));
      succeeds(parts, made.subcommand + frames(0, made.first - 1));
      std::map<std::string, std::string> begun;
      for (const std::string& file : files_of(parts)) begun[file] = content_of(parts / file);
      succeeds(parts, made.subcommand + frames(made.first, made.last));
      BOOST_TEST((files_of(parts) == files_of(whole)));
      for (const std::string& file : files_of(whole)) {
        const std::string expected = content_of(whole / file), content = content_of(parts / file);
        if (is_table_of_frames(expected)) {
          BOOST_TEST((rows_from(content, 0) == rows_from(expected, made.first)), file);
          BOOST_TEST((rows_from(begun.at(file), made.first) == rows_from(expected, made.last + 1)), file);
        } else {
          BOOST_TEST((content == expected), file);  // also those of the first part, and the list of all files
        }
      }
    }
  }
}

BOOST_AUTO_TEST_CASE(so_are_exact_cells) {
  const TemporaryFolder whole, later;
  const std::string subcommand = "simulate --exact --trajectory " VOROCL_SAMPLES
                                 "/lj-melt.lammpstrj --cells cells.csv --polygons p%d.vtp --every 2";
  succeeds(whole, subcommand + " --frames 9");
  succeeds(later, subcommand + frames(5, 9));
  BOOST_TEST((files_of(later) == std::set<std::string>{"cells.csv", "p.pvd", "p6.vtp", "p8.vtp"}));
  for (const char* const file : {"p6.vtp", "p8.vtp"})
    BOOST_TEST((content_of(later / file) == content_of(whole / file)));
  BOOST_TEST((content_of(later / "cells.csv") == rows_from(content_of(whole / "cells.csv"), 5)));
  // The list is of all files that are there.
  BOOST_TEST(content_of(later / "p.pvd").find("p4.vtp") == std::string::npos);
  const std::string list = content_of(whole / "p.pvd");
  succeeds(whole, subcommand + frames(5, 9));
  BOOST_TEST(content_of(whole / "p.pvd") == list);
}

BOOST_AUTO_TEST_CASE(a_run_that_ends_early_says_which_frames_are_left) {
  const TemporaryFolder folder;
  std::filesystem::create_directory(folder / "l3.npy");
  const auto error = [&](const std::string& options) { return run(folder, at_random + options).error; };
  const std::string begin =
      "vorocl: error: cannot write l3.npy: it is a folder; frames complete before that: 2, written of them: "
      "2";
  BOOST_TEST(error("--labels l%d.npy --frames 1:9") == begin + "; --frames 3:9 makes the others\n");
  BOOST_TEST(error("--labels l%d.npy --cells c.csv --frames 1:9") ==
             begin + "; --frames 3:9 makes the others, with other names of tables\n");
  BOOST_TEST(error("--labels l%d.npy -o f.mp4 --frames 1:9") == begin + "\n");
  const std::string frame = "1\nLattice=\"6 0 0 0 5 0 0 0 4\"\nA 1 2 0\n";
  folder.file("cut.xyz", frame + frame + "2\n");
  for (const std::string how : {"--width 30 --labels c%d.npy", "--exact --cells c%d.csv"}) {
    const std::string cut = run(folder, "simulate --trajectory cut.xyz " + how).error;
    BOOST_TEST(cut.find("cut off") != std::string::npos, cut);
    BOOST_TEST(cut.find("; frames complete before that: 2, written of them: 2\n") != std::string::npos, cut);
  }
}

BOOST_AUTO_TEST_CASE(frames_that_are_not_there_are_refused) {
  const TemporaryFolder folder;
  const std::string labels = " --labels l%d.npy --frames ";
  for (const char* const bad : {"0", "-1", "x", ":", ":4", "4:3", "1:2:3", "1.5", "2147483647", "-1:4"})
    refuses(folder, at_random + labels + "'" + bad + "'", usage, {"--frames", "the last frame, at least 1"});
  refuses(folder, at_random + labels + "3:", usage, {"--frames", "K:L is required"});
  const std::string exact =
      "simulate --exact --trajectory " VOROCL_SAMPLES "/lj-melt.lammpstrj --cells c.csv --frames ";
  for (const std::string& subcommand : {melt + labels, exact})
    refuses(folder, subcommand + "1000000:", failure, {"lj-melt.lammpstrj", "there is no frame 1000000"});
  BOOST_TEST(folder.names().empty());
  const TemporaryFolder last;
  succeeds(last, melt + labels + "14:");
  BOOST_TEST(last.names().count("l14.npy") == 1u);
  BOOST_TEST(last.names().count("l13.npy") == 0u);
  for (const std::string& subcommand : {melt + labels, exact}) {
    const Result result = run(last, subcommand + "14:99");
    BOOST_TEST(result.exit_code == 0);
    BOOST_TEST(
        result.error.find("lj-melt.lammpstrj: frame 14 is the last one, and --frames asks for frames up to "
                          "99\n") != std::string::npos,
        result.error);
  }
}
