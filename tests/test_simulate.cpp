// vorocl simulate on random seeds: films, pictures, labels, similarities, and how a run ends.
#define BOOST_TEST_MODULE simulate
#include <fcntl.h>
#include <fmt/format.h>
#include <pty.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <nlohmann/json.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/videoio.hpp>
#include <sstream>
#include <thread>

#include "brute_force.hpp"
#include "label_file.hpp"
#include "progress.hpp"
#include "run_command.hpp"
#include "vorocl/picture.hpp"

using namespace vorocl;
using nlohmann::json;

namespace {

std::vector<std::uint32_t> labels_of(const std::string& path) { return command::read_labels(path).labels; }

std::vector<cv::Mat> pictures_of(const std::string& path) {
  cv::VideoCapture film(path, cv::CAP_FFMPEG);
  std::vector<cv::Mat> pictures;
  for (cv::Mat picture; film.read(picture);) pictures.push_back(picture.clone());
  return pictures;
}

struct Row {
  int frame;
  double similarity;
};

std::vector<Row> rows_of(const std::string& path) {
  std::istringstream text(content_of(path));
  std::string line;
  std::getline(text, line);
  BOOST_TEST(line == "frame,similarity");
  std::vector<Row> rows;
  while (std::getline(text, line)) {
    rows.push_back({std::stoi(line), std::stod(line.substr(line.find(',') + 1))});
  }
  return rows;
}

std::vector<Pixel> pixels_of(const Seeds& seeds) {
  std::vector<Pixel> pixels;
  for (const Point& seed : seeds.read()) {
    pixels.push_back({static_cast<int>(seed.x), static_cast<int>(seed.y)});
  }
  return pixels;
}

std::string number(int frame) { return fmt::format("{:05}", frame); }

/// Starts the command in the folder, with both streams in its file "streams"; returns its process.
pid_t start(const TemporaryFolder& folder, std::vector<std::string> arguments) {
  const pid_t process = fork();
  if (process != 0) return process;
  std::vector<char*> pointers;
  arguments.insert(arguments.begin(), VOROCL_COMMAND);
  for (std::string& argument : arguments) pointers.push_back(argument.data());
  pointers.push_back(nullptr);
  const int streams = open((folder / "streams").c_str(), O_CREAT | O_WRONLY, 0600);
  dup2(streams, STDOUT_FILENO);
  dup2(streams, STDERR_FILENO);
  if (chdir((folder / "").c_str()) == 0) execv(VOROCL_COMMAND, pointers.data());
  _exit(99);
}

}  // namespace

BOOST_AUTO_TEST_CASE(labels_equal_those_of_the_library) {
  const Grid grid(97, 61);
  const struct {
    std::string arguments;
    Border border;
    DynamicJumpFloodingOptions options;
  } runs[] = {
      {"", Border::reflect, {}},
      {"--border periodic --metric manhattan", Border::periodic, {Metric::manhattan, {}, 0}},
      {"--neighbourhood von-neumann --extra-waves 2",
       Border::reflect,
       {Metric::euclidean, {0, NeighbourhoodMix::von_neumann, 2, 2}, 0}},
      {"--von-neumann-waves 0 --refresh-interval 3",
       Border::reflect,
       {Metric::euclidean, {0, NeighbourhoodMix::mixed, 0, 0}, 3}},
  };
  for (const auto& run : runs) {
    const TemporaryFolder folder;
    succeeds(folder,
             "simulate --random 80 --rng-seed 7 --size 97x61 --frames 8 --step-length 4 --method djfa "
             "--labels l/%05d.npy " +
                 run.arguments);
    Simulation simulation(Seeds::random(test_device(), grid, 80, 7), [&](Seeds& seeds, int frame) {
      random_step(seeds, 4, run.border, 7, static_cast<std::uint32_t>(frame));
      return 4.0;
    });
    simulation.add_engine([&](const Seeds& seeds, Diagram& diagram, double d_max) {
      DynamicJumpFloodingOptions options = run.options;
      options.plan.max_step = d_max;
      return dynamic_jump_flooding(seeds, diagram, options);
    });
    for (int frame = 0; frame <= 8; ++frame) {
      simulation.step();
      BOOST_TEST((labels_of(folder / ("l/" + number(frame) + ".npy")) == simulation.diagram().read()),
                 run.arguments << " frame " << frame);
    }
  }
}

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
    BOOST_TEST(film.get(cv::CAP_PROP_FOURCC) == cv::VideoWriter::fourcc('a', 'v', 'c', '1'));
    BOOST_TEST(content_of(folder / "a.mp4").find("avcC") != std::string::npos);  // H.264
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

BOOST_AUTO_TEST_CASE(similarities_are_those_of_the_label_files) {
  const TemporaryFolder folder;
  const std::string seeds = "simulate --random 300 --size 120x90 --frames 6 --step-length 5 ";
  const json result = json::parse(succeeds(
      folder,
      seeds + "--method djfa --metric manhattan --compare-with jfa --compare-metric euclidean --similarity "
              "s.csv --labels a/%05d.npy --json"));
  succeeds(folder, seeds + "--method jfa --labels b/%05d.npy");
  const std::vector<Row> rows = rows_of(folder / "s.csv");
  BOOST_REQUIRE(rows.size() == 6u);
  double sum = 0, least = 100;
  for (int frame = 1; frame <= 6; ++frame) {
    const Row& row = rows[static_cast<std::size_t>(frame - 1)];
    const std::string name = "/" + number(frame) + ".npy";
    BOOST_TEST(row.frame == frame);
    BOOST_TEST(row.similarity ==
               similarity(labels_of(folder / ("a" + name)), labels_of(folder / ("b" + name))));
    BOOST_TEST(row.similarity < 97);  // of different metrics
    sum += row.similarity;
    least = std::min(least, row.similarity);
  }
  BOOST_TEST(result.at("similarity").at("mean").get<double>() == sum / 6,
             boost::test_tools::tolerance(1e-12));
  BOOST_TEST(result.at("similarity").at("least") == least);
}

BOOST_AUTO_TEST_CASE(the_exact_method_is_the_truth) {
  const TemporaryFolder folder;
  const Grid grid(70, 50);
  const json result = json::parse(
      succeeds(folder,
               "simulate --random 90 --size 70x50 --frames 3 --step-length 6 --method exact --labels l%d.npy "
               "--compare-with jfa+2 --json"));
  BOOST_TEST(result.at("similarity").at("least").get<double>() > 99);
  Seeds seeds = Seeds::random(test_device(), grid, 90, 1);
  for (int frame = 0; frame <= 3; ++frame) {
    if (frame > 0) random_step(seeds, 6, Border::reflect, 1, static_cast<std::uint32_t>(frame));
    const auto expected = brute_force(grid, pixels_of(seeds), Metric::euclidean);
    BOOST_TEST((labels_of(folder / fmt::format("l{}.npy", frame)) == expected), "frame " << frame);
  }
}

BOOST_AUTO_TEST_CASE(bench_starts_djfa_one_step_before) {
  const TemporaryFolder folder;
  const Grid grid(150, 100);
  const json result = json::parse(succeeds(
      folder,
      "bench --random 1500 --size 150x100 --methods djfa,jfa --neighbourhood von-neumann --repeat 2 --json"));
  const json& djfa = result.at("results").at(0);
  BOOST_TEST(djfa.at("method") == "djfa");
  BOOST_TEST(djfa.at("min_ms").get<double>() > 0);
  Seeds seeds = Seeds::random(test_device(), grid, 1500, 1);
  const std::vector<Pixel> now = pixels_of(seeds);
  std::vector<std::optional<Point>> points;
  for (const Pixel& pixel : now) points.emplace_back(centre(pixel));
  random_step(seeds, 5, Border::reflect, 1, 0);
  Diagram diagram(test_device(), grid);
  jump_flooding(seeds, diagram);
  seeds.move_to(points);
  dynamic_jump_flooding(seeds, diagram, {Metric::euclidean, {5, NeighbourhoodMix::von_neumann}, 0});
  const Verdict verdict =
      judge(grid, now, Metric::euclidean, diagram.read(), brute_force(grid, now, Metric::euclidean));
  BOOST_TEST(verdict.wrong > 0u);
  BOOST_TEST(djfa.at("wrong_pixels") == verdict.wrong + verdict.unlabelled);
}

BOOST_AUTO_TEST_CASE(json_is_one_object) {
  const TemporaryFolder folder;
  const json result = json::parse(succeeds(
      folder, "simulate --random 100 --size 100x64 --frames 5 --step-length 3 --method djfa --json"));
  BOOST_TEST(result.at("method") == "djfa");
  BOOST_TEST(result.at("metric") == "euclidean");
  BOOST_TEST(result.at("device") == test_device().name());
  BOOST_TEST(result.at("width") == 100);
  BOOST_TEST(result.at("height") == 64);
  BOOST_TEST(result.at("seeds") == 100);
  BOOST_TEST(result.at("frames") == 5);
  BOOST_TEST(result.at("waves") == 5);  // a seed has 64 pixels: steps 16, 8, 4, 2, 1
  BOOST_TEST(result.at("milliseconds").get<double>() > 0);
  BOOST_TEST(result.at("host_milliseconds").get<double>() > 0);
  BOOST_TEST(!result.contains("similarity"));
  BOOST_TEST(folder.names().empty());
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
    BOOST_TEST(rows_of(folder / "s.csv").size() == static_cast<std::size_t>(frames - 1));
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
  BOOST_TEST(command::progress_line(30, 0.25, 10) ==
             "[######------------------]  25 %  30 frames  3.0 frames/s  30 s left");
  BOOST_TEST(command::progress_line(2, 0.001, 10).find("  2 h 46 min left") != std::string::npos);
  BOOST_TEST(command::progress_line(30, std::nullopt, 10) == "30 frames  3.0 frames/s");
}

BOOST_AUTO_TEST_CASE(bad_options_are_usage_errors) {
  const TemporaryFolder folder;
  const std::string random = "simulate --random 5 --size 10x10 ",
                    moving = random + "--frames 3 --step-length 1 ", djfa = moving + "--method djfa ";
  refuses(folder, moving, usage, {"--method"});
  refuses(folder, random + "--step-length 1 --method djfa", usage, {"--frames"});
  refuses(folder, random + "--frames 3 --method djfa", usage, {"--step-length"});
  refuses(folder, random + "--frames 0 --step-length 1 --method djfa", usage, {"--frames"});
  refuses(folder, random + "--frames 3 --step-length -1 --method djfa", usage, {"--step-length"});
  refuses(folder, djfa + "--border open", usage, {"open", "reflect, periodic"});
  refuses(folder, djfa + "--extra-waves 3", usage, {"--extra-waves"});
  refuses(folder, moving + "--method jfa --extra-waves 1", usage, {"--extra-waves", "djfa"});
  refuses(folder, moving + "--method jfa --neighbourhood mixed", usage, {"mixed", "djfa"});
  refuses(folder, djfa + "-o a.gif", usage, {"a.gif", ".mp4"});
  refuses(folder, djfa + "-o a.png", usage, {"a.png", "%05d.png"});
  refuses(folder, djfa + "-o a%05x.png", usage, {"%05d.png"});
  refuses(folder, djfa + "-o a%d%d.png", usage, {"%05d.png"});
  refuses(folder, djfa + "--labels a.npy", usage, {"a.npy", "%05d.npy"});
  refuses(folder, djfa + "--labels a%d.png", usage, {".npy"});
  refuses(folder, djfa + "--similarity s.csv", usage, {"--compare-with"});
  refuses(folder, djfa + "--compare-with jfa --similarity s.txt", usage, {"s.txt", ".csv"});
  refuses(folder, djfa + "--every 0", usage, {"--every"});
  refuses(folder, djfa + "--fps 25", usage, {"-o"});
  refuses(folder, djfa + "-o a.mp4 --fps 0", usage, {"--fps"});
  refuses(folder, djfa + "--bounds 0,0,1,1", usage, {"--bounds", "--trajectory"});
  refuses(folder, djfa + "-o missing/deep/%d.png", failure, {"missing/deep", "does not exist"});
  refuses(folder, djfa + "-o missing/a.mp4", failure, {"missing", "does not exist"});
  run(folder, djfa + "-o new/%d.png --device none");
  BOOST_TEST(folder.names().empty());
}
