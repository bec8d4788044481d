// How the command writes files: whole or not at all, whatever is there, and whatever is in the way.
#define BOOST_TEST_MODULE written_files
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <filesystem>
#include <opencv2/imgcodecs.hpp>

#include "run_command.hpp"

using namespace vorocl;

namespace {

const std::string render = "render --random 200 --size 256x256 --method jfa ";

/// Settings under which the command runs on a disk of so many pages of 4 KiB; what it leaves there is in
/// left/.
std::string on_disk_of(std::uintmax_t pages) {
  return "mkdir disk && unshare -m sh -c 'mount -t tmpfs -o size=" + std::to_string(4 * pages) +
         "k none disk && cd disk && \"$@\"; code=$?; cp -a . ../left; exit $code' sh";
}

boost::test_tools::assertion_result may_mount(boost::unit_test::test_unit_id) {
  return std::system("unshare -m true 2> /dev/null") == 0 && geteuid() == 0;
}

std::uintmax_t pages_of(const std::string& path) { return (std::filesystem::file_size(path) + 4095) / 4096; }

/// Runs it where the disk is too small: it fails and leaves only whole files, which are those in the other
/// folder.
void fills_the_disk(const std::string& arguments, std::uintmax_t pages, const TemporaryFolder& whole) {
  const TemporaryFolder folder;
  const Result result = run(folder, arguments, on_disk_of(pages));
  BOOST_TEST_CONTEXT(arguments << " on " << pages << " pages\n" << result.error) {
    BOOST_TEST(result.exit_code == failure);
    BOOST_TEST(result.out == "");
    BOOST_TEST(result.error.rfind("vorocl: error: ", 0) == 0u);
    for (const auto& entry : std::filesystem::directory_iterator(folder / "left")) {
      const std::string name = entry.path().filename().string();
      BOOST_TEST((content_of(folder / ("left/" + name)) == content_of(whole / name)), name);
    }
  }
}

mode_t mode_of(const std::string& path) {
  struct stat status = {};
  BOOST_REQUIRE(stat(path.c_str(), &status) == 0);
  return status.st_mode & 0777;
}

}  // namespace

BOOST_AUTO_TEST_CASE(files_that_do_not_fit_on_the_disk_are_errors,
                     *boost::unit_test::precondition(may_mount)) {
  for (const std::string& arguments :
       {render + "-o a.bmp", render + "-o a.png", render + "-o a.tif", render + "-o a.jpg",
        render + "--labels a.npy", render + "--labels a.tif", render + "--labels a.vti",
        std::string("cells --random 200 --size 256x256 --adjacency a.csv"),
        std::string("cells --random 200 --size 256x256 --border a.png"),
        std::string("tiles --random 200 --size 256x256 --tile 64 --labels a.npy"),
        std::string("tiles --random 200 --size 256x256 --tile 64 --labels a.tif"),
        std::string("relax --random 2000 --size 256x256 --rounds 1 --relaxed-points a.csv")}) {
    const TemporaryFolder whole;
    succeeds(whole, arguments);
    const std::uintmax_t pages = pages_of(whole / *whole.names().begin());
    fills_the_disk(arguments, pages - 1, whole);
    const TemporaryFolder folder;
    BOOST_TEST(run(folder, arguments, on_disk_of(pages)).exit_code == 0);
  }
}

BOOST_AUTO_TEST_CASE(tiles_that_do_not_fit_on_the_disk_are_made_later,
                     *boost::unit_test::precondition(may_mount)) {
  const std::string arguments = "tiles --random 2000 --size 256x256 --tile 64 --labels a.zarr";
  const TemporaryFolder whole, folder;
  succeeds(whole, arguments);
  fills_the_disk(arguments, 6, whole);
  const Result result = run(folder, arguments + " --resume", on_disk_of(12));
  BOOST_TEST(result.exit_code == failure);
  for (const char* const part :
       {"No space left", "tiles are complete and kept in a.zarr.part and ", "a.zarr.journal"}) {
    BOOST_TEST(result.error.find(part) != std::string::npos, result.error);
  }
  const Result more = run(folder, arguments + " --resume", "cd left && ");
  BOOST_TEST(more.exit_code == 0, more.error);
  BOOST_TEST(more.out.find("made before: ") != std::string::npos, more.out);
  for (const auto& entry : std::filesystem::directory_iterator(whole / "a.zarr")) {
    const std::string name = "a.zarr/" + entry.path().filename().string();
    BOOST_TEST((content_of(folder / ("left/" + name)) == content_of(whole / name)), name);
  }
}

BOOST_AUTO_TEST_CASE(of_frames_that_do_not_fit_on_the_disk_the_whole_ones_stay,
                     *boost::unit_test::precondition(may_mount)) {
  const std::string simulate =
      "simulate --random 200 --size 256x256 --frames 3 --step-length 1 --method jfa -o ";
  for (const std::string name : {"%d.bmp", "%d.png", "a.mp4"}) {
    const TemporaryFolder whole;
    succeeds(whole, simulate + name);
    std::uintmax_t pages = 0;
    for (const std::string& file : whole.names()) pages += pages_of(whole / file);
    for (std::uintmax_t room = 1; room < pages; room += 1 + pages / 9)
      fills_the_disk(simulate + name, room, whole);
    fills_the_disk(simulate + name, pages - 1, whole);
  }
}

// Each table then has the rows of the frames that the message counts, and of no other.
BOOST_AUTO_TEST_CASE(of_tables_that_do_not_fit_on_the_disk_the_whole_frames_stay,
                     *boost::unit_test::precondition(may_mount)) {
  const std::string at_random = "simulate --random 20 --size 40x30 --frames 400 --step-length 1 --method ";
  const std::string lattice = "Lattice=\"9 0 0 0 9 0 0 0 1\" pbc=\"T T F\"\n";
  std::string frames;
  for (int frame = 0; frame < 90; ++frame) frames += "3\n" + lattice + "A 1 2 0\nA 7 2 0\nA 4 8 0\n";
  struct Case {
    std::string arguments;
    std::vector<std::pair<std::string, int>>
        tables;  // and their rows per frame; 0: one of each but the first
    std::uintmax_t pages;
  };
  for (const Case& c :
       {Case{at_random + "jfa --statistics s.csv", {{"s.csv", 1}}, 4},
        Case{at_random + "jfa --cells c.csv --statistics s.csv", {{"c.csv", 20}, {"s.csv", 1}}, 40},
        Case{at_random + "jfa --compare-with exact --similarity s.csv", {{"s.csv", 0}}, 2},
        Case{"simulate --exact --trajectory ../t.xyz --cells c.csv --adjacency a.csv",
             {{"c.csv", 3}, {"a.csv", 6}},
             3}}) {
    const TemporaryFolder folder;
    folder.file("t.xyz", frames);
    const Result result = run(folder, c.arguments, on_disk_of(c.pages));
    BOOST_TEST_CONTEXT(c.arguments << "\n" << result.error) {
      BOOST_TEST(result.exit_code == failure);
      const std::string says = "No space left on device; frames complete before that: ";
      const std::size_t place = result.error.find(says);
      BOOST_TEST_REQUIRE(place != std::string::npos);
      const int complete = std::stoi(result.error.substr(place + says.size()));
      BOOST_TEST(complete > 10);
      const std::size_t written = result.error.find(", written of them: ");
      if (c.tables.size() == 1) BOOST_TEST(written == std::string::npos);
      if (written != std::string::npos) {
        BOOST_TEST(result.error.substr(written) ==
                   fmt::format(
                       ", written of them: {}; --frames {}:{} makes the others, with other names of tables\n",
                       complete, complete, c.arguments.find("--exact") == std::string::npos ? "400" : ""));
      }
      for (const auto& [name, rows] : c.tables) {
        const std::string table = content_of(folder / ("left/" + name));
        BOOST_TEST_REQUIRE(!table.empty(), name);
        BOOST_TEST(table.back() == '\n');
        const auto lines = std::count(table.begin(), table.end(), '\n');
        BOOST_TEST(lines == 1 + (rows == 0 ? complete - 1 : rows * complete), name);
      }
      BOOST_TEST(std::distance(std::filesystem::directory_iterator(folder / "left"), {}) ==
                 static_cast<std::ptrdiff_t>(c.tables.size()));
    }
  }
}

BOOST_AUTO_TEST_CASE(a_film_that_does_not_fit_on_the_disk_says_so,
                     *boost::unit_test::precondition(may_mount)) {
  const TemporaryFolder folder;
  const Result result = run(
      folder, "simulate --random 200 --size 256x256 --frames 3 --step-length 1 --statistics s.csv -o a.mp4",
      on_disk_of(4));
  BOOST_TEST(result.exit_code == failure);
  BOOST_TEST(result.error.find("writing a.mp4 failed: is the disk full? Nothing stays of the film") !=
                 std::string::npos,
             result.error);
  BOOST_TEST(!std::filesystem::exists(folder / "left/a.mp4"));
  refuses(folder, "simulate --random 5 --size 16386x4 --frames 1 --step-length 1 -o long.mp4", failure,
          {"long.mp4: a film of 16386 x 4", "16384"});
}

// A round that cannot be written ends the relaxation.
BOOST_AUTO_TEST_CASE(of_a_relaxation_all_that_can_be_written_stays,
                     *boost::unit_test::precondition(may_mount)) {
  const std::string relax = "relax --random 200 --size 256x256 --rounds 9 ";
  const auto check_others = [](const TemporaryFolder& folder, int rounds) {
    const std::string energies = content_of(folder / "e.csv"), points = content_of(folder / "p.csv");
    BOOST_TEST(std::count(energies.begin(), energies.end(), '\n') == rounds + 2);
    BOOST_TEST(std::count(points.begin(), points.end(), '\n') == 201);
  };
  for (const std::string pictures : {"a.mp4", "%d.png"}) {
    const TemporaryFolder folder;
    const Result result =
        run(folder, relax + "--energy ../e.csv --relaxed-points ../p.csv -o " + pictures, on_disk_of(4));
    BOOST_TEST(result.exit_code == failure);
    BOOST_TEST(result.error.find("writing ") != std::string::npos, result.error);
    BOOST_TEST(!std::filesystem::exists(folder / "left/a.mp4"));
    // That of a film may be noticed at its end.
    const std::size_t says = result.error.find(" after ");
    BOOST_TEST((says != std::string::npos || pictures == "a.mp4"), result.error);
    check_others(folder, says == std::string::npos ? 9 : std::stoi(result.error.substr(says + 7)));
  }

  const TemporaryFolder folder;
  std::filesystem::create_symlink("/dev/full", folder / "l.npy");
  const Result labels = run(folder, relax + "-o a.png --labels l.npy --energy e.csv --relaxed-points p.csv");
  BOOST_TEST(labels.exit_code == failure);
  BOOST_TEST(labels.error.find("writing l.npy failed: No space left") != std::string::npos, labels.error);
  BOOST_TEST(std::filesystem::exists(folder / "a.png"));
  check_others(folder, 9);
}

BOOST_AUTO_TEST_CASE(a_file_that_is_replaced_keeps_its_mode) {
  const TemporaryFolder folder;
  for (const char* name : {"a.png", "a.npy", "f.mp4"}) {
    for (const mode_t mode : {0600u, 0664u}) {
      chmod(folder.file(name, "old").c_str(), mode);
      succeeds(folder, name == std::string("f.mp4")
                           ? "simulate --random 5 --size 64x64 --frames 2 --step-length 1 "
                             "--method jfa -o f.mp4"
                           : render + (name[2] == 'p' ? "-o " : "--labels ") + name);
      BOOST_TEST(content_of(folder / name).size() > 100u);
      BOOST_TEST(mode_of(folder / name) == mode);
    }
  }
  succeeds(folder, render + "-o new.png");
  const mode_t mask = umask(0);
  umask(mask);
  BOOST_TEST(mode_of(folder / "new.png") == (0666u & ~mask));
}

BOOST_AUTO_TEST_CASE(links_lead_to_what_is_replaced) {
  const TemporaryFolder folder, elsewhere;
  chmod(elsewhere.file("there.png", "old").c_str(), 0640);
  std::filesystem::create_symlink(elsewhere / "there.png", folder / "a.png");
  succeeds(folder, render + "-o a.png");
  BOOST_TEST(std::filesystem::is_symlink(folder / "a.png"));
  BOOST_TEST(cv::imread(elsewhere / "there.png").size() == cv::Size(256, 256));
  BOOST_TEST(mode_of(elsewhere / "there.png") == 0640u);
  BOOST_TEST((elsewhere.names() == std::set<std::string>{"there.png"}));
  std::filesystem::create_symlink(elsewhere / "nowhere.npy", folder / "a.npy");
  refuses(folder, render + "--labels a.npy", failure, {"a.npy", "link that leads nowhere"});
}

BOOST_AUTO_TEST_CASE(pipes_and_devices_are_written_into) {
  const TemporaryFolder folder;
  succeeds(folder, render + "--labels whole.npy -o whole.png");
  for (const std::string name : {"pipe.npy", "pipe.png"}) {
    BOOST_REQUIRE(mkfifo((folder / name).c_str(), 0600) == 0);
    const Result result =
        run(folder, fmt::format("{}{} {}", render, name == "pipe.npy" ? "--labels" : "-o", name),
            fmt::format("{{ cat {} > read & }} ;", name));
    BOOST_TEST(result.exit_code == 0, result.error);
    for (int i = 0; i < 100 && content_of(folder / "read").size() !=
                                   content_of(folder / ("whole" + name.substr(4))).size();
         ++i) {
      usleep(50000);
    }
    BOOST_TEST((content_of(folder / "read") == content_of(folder / ("whole" + name.substr(4)))));
    BOOST_TEST(std::filesystem::is_fifo(folder / name));
  }
  std::filesystem::create_symlink("/dev/null", folder / "null.csv");
  const std::string frames = "simulate --trajectory '" VOROCL_SAMPLES "/lj-melt.lammpstrj' --frames 2 ";
  for (const char* const table : {"--width 60 --statistics", "--width 60 --cells", "--exact --cells"})
    succeeds(folder, frames + table + " null.csv");
  for (const char* name : {"full.npy", "full.png"})
    std::filesystem::create_symlink("/dev/full", folder / name);
  refuses(folder, render + "--labels full.npy", failure, {"writing full.npy failed: No space left"});
  refuses(folder, render + "-o full.png", failure, {"writing full.png failed: No space left"});
  BOOST_TEST(std::filesystem::is_symlink(folder / "full.npy"));
  BOOST_REQUIRE(mkfifo((folder / "pipe.tif").c_str(), 0600) == 0);
  BOOST_REQUIRE(mkfifo((folder / "pipe.mp4").c_str(), 0600) == 0);
  refuses(folder, render + "--labels pipe.tif", failure, {"pipe.tif", "is a pipe", "TIFF"});
  refuses(folder, "simulate --random 5 --size 9x9 --frames 1 --step-length 1 --method jfa -o pipe.mp4",
          failure, {"pipe.mp4", "is a pipe", "film"});
}

BOOST_AUTO_TEST_CASE(names_may_be_as_long_as_the_file_system_takes) {
  const TemporaryFolder folder;
  const std::string longest = std::string(251, 'a');
  succeeds(folder, render + "-o " + longest + ".png --labels " + longest + ".npy");
  BOOST_TEST(folder.names().size() == 2u);
  refuses(folder, render + "-o a" + longest + ".png", failure,
          {"cannot write a" + longest + ".png: File name too long"});
  refuses(folder,
          "simulate --random 5 --size 9x9 --frames 1 --step-length 1 --method jfa -o " +
              std::string(50200, 'a') + "%d.png --labels " + std::string(25100, 'b') + "%d.npy",
          usage, {"--labels", "4095 characters"});
}

// The names that the command gave to its temporary files were ".vorocl-PROCESS-NUMBER-NAME": the shell, which
// becomes the command, plants links of such names to a file that must stay as it is.
BOOST_AUTO_TEST_CASE(planted_links_are_not_followed) {
  const TemporaryFolder folder, elsewhere;
  const std::string victim = elsewhere.file("victim", "precious");
  run(folder, render + "-o a.png",
      "for n in 0 1 2; do ln -s '" + victim + "' .vorocl-$$-$n-a.png; done; exec");
  BOOST_TEST(content_of(victim) == "precious");
  BOOST_TEST(cv::imread(folder / "a.png").size() == cv::Size(256, 256));
}
