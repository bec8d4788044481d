// What vorocl simulate writes while it runs, and how a run ends: films, numbered pictures, Ctrl-C, progress.
#define BOOST_TEST_MODULE simulate_files
#include <fmt/format.h>
#include <pty.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/videoio.hpp>
#include <thread>

#include "app/terminal/progress.hpp"
#include "formats/raster_files.hpp"
#include "run_command.hpp"
#include "vorocl/picture.hpp"

using namespace vorocl;

namespace {

std::vector<std::uint32_t> labels_of(const std::string& path) { return command::read_labels(path).labels; }

std::vector<cv::Mat> pictures_of(const std::string& path) {
  cv::VideoCapture film(path, cv::CAP_FFMPEG);
  std::vector<cv::Mat> pictures;
  for (cv::Mat picture; film.read(picture);) pictures.push_back(picture.clone());
  return pictures;
}

std::string number(int frame) { return fmt::format("{:05}", frame); }

}  // namespace

BOOST_AUTO_TEST_CASE(films_have_every_frame_and_even_sides) {
  for (const cv::Size& size :
       {cv::Size(64, 48), cv::Size(65, 48), cv::Size(64, 49), cv::Size(65, 49), cv::Size(1, 1)}) {
    const TemporaryFolder folder;
    const Result result =
        run(folder,
            fmt::format("simulate --random 9 --size {}x{} --frames 12 --step-length 1 --method jfa -o a.mp4 "
                        "--labels l%d.npy --fps 12.5",
                        size.width, size.height));
    BOOST_TEST(result.exit_code == 0);
    const cv::Size even(size.width + size.width % 2, size.height + size.height % 2);
    BOOST_TEST((result.error.find("note: a.mp4") != std::string::npos) == (even != size));
    cv::VideoCapture film(folder / "a.mp4");
    BOOST_TEST(film.get(cv::CAP_PROP_FPS) == 12.5);
    const std::string content = content_of(folder / "a.mp4");
    BOOST_TEST(content.find("avcC") != std::string::npos);     // H.264's own box of MP4
    const std::size_t settings = content.find("x264 - core");  // as this encoder, if it is there, writes them
    for (const char* const setting : {" cabac=0 ", " 8x8dct=0 ", " bframes=0 ", " crf=21.4 "})
      BOOST_TEST((settings == std::string::npos || content.find(setting, settings) < settings + 1000),
                 setting);
    const std::vector<cv::Mat> pictures = pictures_of(folder / "a.mp4");
    BOOST_REQUIRE(pictures.size() == 13u);
    for (int frame = 0; frame <= 12; ++frame) {
      const cv::Mat& picture = pictures[static_cast<std::size_t>(frame)];
      BOOST_REQUIRE(picture.size() == even);
      const auto labels = labels_of(folder / fmt::format("l{}.npy", frame));
      const cv::Mat expected = color_by_id(labels, Grid(size.width, size.height));
      // Compressed, and with a colour for four pixels: near on average.
      BOOST_TEST(cv::norm(picture(cv::Rect({0, 0}, size)), expected, cv::NORM_L1) / size.area() < 3 * 16);
    }
    BOOST_TEST(folder.names().size() == 14u);
  }
}

BOOST_AUTO_TEST_CASE(every_kth_frame_is_written) {
  const TemporaryFolder folder;
  succeeds(folder,
           "simulate --random 9 --size 40x30 --frames 7 --step-length 2 --method djfa -o p/%05d.png --labels "
           "l_%03d.tif --every 3");
  BOOST_TEST((folder.names() == std::set<std::string>{"p", "l_000.tif", "l_003.tif", "l_006.tif"}));
  for (const int frame : {0, 3, 6}) {
    const cv::Mat picture = cv::imread(folder / ("p/" + number(frame) + ".png"));
    const cv::Mat expected = color_by_id(labels_of(folder / fmt::format("l_{:03}.tif", frame)), Grid(40, 30));
    BOOST_REQUIRE(picture.size() == expected.size());
    BOOST_TEST(cv::norm(picture, expected, cv::NORM_INF) == 0);
  }
  BOOST_TEST(!std::filesystem::exists(folder / "p/00001.png"));
}

BOOST_AUTO_TEST_CASE(where_no_frame_is_written_nothing_is_said_to_be) {
  const TemporaryFolder folder;
  std::string frames;
  for (int i = 0; i < 5; ++i) frames += "3\n\nA 0 0 0\nA 3 1 0\nA 1 2 0\n";
  folder.file("t.xyz", frames);
  for (const std::string how :
       {"--width 9 -o f.mp4", "--width 9 -o p%d.png", "--width 9 --cells c.csv", "--width 9 --labels l%d.vti",
        "--exact --cells c.csv", "--exact --polygons e%d.vtp"}) {
    const std::string simulate = "simulate --trajectory t.xyz " + how;
    refuses(folder, simulate + " --frames 3:4 --every 5", usage, {"--every 5", "from 3 to 4", "0, 5, 10"});
    refuses(folder, simulate + " --frames 3: --every 5", failure, {"--every 5", "from 3 to 4"});
  }
  const Result result = run(
      folder, "simulate --trajectory t.xyz --width 9 --frames 3: --every 5 --cells c.csv --statistics s.csv");
  BOOST_TEST(result.exit_code == failure);
  BOOST_TEST((folder.names() == std::set<std::string>{"t.xyz", "s.csv"}));  // rows of all frames
  // What an earlier run has listed stays.
  succeeds(folder, "simulate --trajectory t.xyz --width 9 --frames 0:2 --every 2 --labels m%d.vti");
  const std::string listed = content_of(folder / "m.pvd");
  refuses(folder, "simulate --trajectory t.xyz --width 9 --frames 3: --every 5 --labels m%d.vti", failure,
          {"--every 5"});
  BOOST_TEST(content_of(folder / "m.pvd") == listed);
  succeeds(folder, "simulate --trajectory t.xyz --width 9 --frames 3:4 --every 2 --cells c.csv");
  BOOST_TEST(content_of(folder / "c.csv").find("\n4,") != std::string::npos);
}

BOOST_AUTO_TEST_CASE(a_second_run_makes_the_same_bytes) {
  const TemporaryFolder a, b;
  const std::string arguments =
      "simulate --random 200 --size 160x121 --frames 9 --step-length 3 --method djfa -o "
      "f.mp4 --labels l%d.npy --compare-with jfa --similarity s.csv --points-overlay --edges";
  run(a, arguments);
  run(b, arguments);
  BOOST_TEST(a.names().size() == 12u);
  for (const std::string& name : a.names()) BOOST_TEST((content_of(a / name) == content_of(b / name)), name);
}

// It is written while a later one is made, which must leave no files.
BOOST_AUTO_TEST_CASE(a_frame_that_cannot_be_written_ends_the_run_behind_those_before) {
  const std::string arguments =
      "simulate --random 50 --size 90x70 --frames 20 --step-length 2 --labels l%d.npy --statistics s.csv ";
  const TemporaryFolder folder;
  std::filesystem::create_directory(folder / "l3.npy");
  const Result result = run(folder, arguments + "-o f.mp4");
  BOOST_TEST(result.exit_code == failure);
  BOOST_TEST(result.error ==
             "vorocl: error: cannot write l3.npy: it is a folder; frames complete before that: 3, written of "
             "them: 3\n");
  BOOST_TEST(
      (folder.names() == std::set<std::string>{"f.mp4", "l0.npy", "l1.npy", "l2.npy", "l3.npy", "s.csv"}));
  BOOST_TEST(pictures_of(folder / "f.mp4").size() == 3u);
  const std::string rows = content_of(folder / "s.csv");
  BOOST_TEST(std::count(rows.begin(), rows.end(), '\n') == 1 + 3);
}

BOOST_AUTO_TEST_CASE(after_ctrl_c_the_frames_so_far_are_complete) {
  for (const int signal : {SIGINT, SIGTERM}) {
    const TemporaryFolder folder;
    const pid_t process =
        start(folder, {"simulate", "--random", "50", "--size", "200x150", "--frames", "1000000",
                       "--step-length", "2", "--method", "djfa", "-o", "f.mp4", "--labels", "l/%05d.npy",
                       "--compare-with", "jfa", "--similarity", "s.csv"});
    for (int i = 0; i < 600 && !std::filesystem::exists(folder / "l/00005.npy"); ++i) {
      std::this_thread::sleep_for(std::chrono::milliseconds(100));
    }
    kill(process, signal);
    int status = 0;
    waitpid(process, &status, 0);
    BOOST_TEST(WIFEXITED(status));
    BOOST_TEST(WEXITSTATUS(status) == failure);
    BOOST_TEST((folder.names() == std::set<std::string>{"f.mp4", "l", "s.csv", "streams"}));
    int frames = 0;
    while (std::filesystem::exists(folder / ("l/" + number(frames) + ".npy"))) {
      BOOST_TEST(labels_of(folder / ("l/" + number(frames++) + ".npy")).size() == 30000u);
    }
    BOOST_TEST(frames > 5);
    BOOST_TEST(pictures_of(folder / "f.mp4").size() == static_cast<std::size_t>(frames));
    const std::string rows = content_of(folder / "s.csv");
    BOOST_TEST(std::count(rows.begin(), rows.end(), '\n') == frames);  // a header, and none for frame 0
    const std::string said = content_of(folder / "streams");
    BOOST_TEST(said ==
               fmt::format("vorocl: error: interrupted; frames complete before that: {0}, written of them: "
                           "{0}\n",
                           frames));
  }
}

BOOST_AUTO_TEST_CASE(a_terminal_gets_a_progress_bar) {
  const TemporaryFolder folder;
  int terminal = -1;
  const pid_t process = forkpty(&terminal, nullptr, nullptr, nullptr);
  BOOST_REQUIRE_MESSAGE(process >= 0, "this machine has no pseudo-terminals (is /dev/pts mounted?)");
  if (process == 0) {
    if (chdir((folder / "").c_str()) == 0) {
      execl(VOROCL_COMMAND, VOROCL_COMMAND, "simulate", "--random", "5", "--size", "50x50", "--frames", "9",
            "--step-length", "1", "--method", "jfa", nullptr);
    }
    _exit(99);
  }
  std::string text;
  char part[512];
  for (ssize_t count; (count = read(terminal, part, sizeof(part))) > 0;) {
    text.append(part, static_cast<std::size_t>(count));
  }
  int status = 0;
  waitpid(process, &status, 0);
  close(terminal);
  BOOST_TEST(WEXITSTATUS(status) == 0);
  BOOST_TEST(text.find("frames/s") != std::string::npos);
  BOOST_TEST(command::progress_line({30, 0.25}, 10) ==
             "[######------------------]  25 %  30 frames  3.0 frames/s  30 s left");
  BOOST_TEST(command::progress_line({2, 0.001}, 10).find("  2 h 46 min left") != std::string::npos);
  BOOST_TEST(command::progress_line({30, std::nullopt}, 10) == "30 frames  3.0 frames/s");
}
