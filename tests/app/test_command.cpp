// The vorocl command, run as its users run it: what it prints and writes.
#define BOOST_TEST_MODULE command
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <opencv2/imgcodecs.hpp>
#include <optional>
#include <random>

#include "brute_force.hpp"
#include "formats/raster_files.hpp"
#include "raw_images.hpp"
#include "run_command.hpp"

using namespace vorocl;
using command::Size;
using nlohmann::json;

namespace {

std::vector<std::uint32_t> labels_of(const TemporaryFolder& folder, const std::string& name) {
  return command::read_labels(folder / name).labels;
}

}  // namespace

BOOST_AUTO_TEST_CASE(every_level_has_help) {
  const TemporaryFolder folder;
  for (const char* subcommand :
       {"devices", "render", "simulate", "cells", "relax", "tiles", "compare", "bench"}) {
    BOOST_TEST(succeeds(folder, "--help").find(subcommand) != std::string::npos);
    const std::string help = succeeds(folder, subcommand + std::string(" --help"));
    BOOST_TEST(help.find("--json") != std::string::npos);
    BOOST_TEST(help.find("[]") == std::string::npos, help);
  }
  BOOST_TEST(succeeds(folder, "--version") == "vorocl " VOROCL_VERSION "\n");
}

BOOST_AUTO_TEST_CASE(help_has_sections_with_the_common_ones_first) {
  const TemporaryFolder folder;
  const std::string help = succeeds(folder, "render --help");
  std::size_t at = 0;
  for (const std::string line :
       {"Seeds, from one of these:", "  --random ", "Files to write:", "  -o ",
        "Grid and units:", "  --size ", "What the seeds' files say:", "  --columns ",
        "Method:", "  --method ", "Pictures:", "  --color ", "Run:", "  -h,--help ", "  --device "}) {
    const std::size_t found = help.find("\n" + line, at);
    BOOST_TEST_REQUIRE(found != std::string::npos, line << " is not behind the others in\n" << help);
    at = found;
  }
}

BOOST_AUTO_TEST_CASE(devices_names_the_one_that_is_picked) {
  const TemporaryFolder folder;
  const json devices = json::parse(succeeds(folder, "devices --json")).at("devices");
  const auto selected =
      std::find_if(devices.begin(), devices.end(), [](const json& d) { return d["selected"]; });
  BOOST_REQUIRE((selected != devices.end()));
  BOOST_TEST((*selected)["name"].get<std::string>() == test_device().name());
  BOOST_TEST((*selected)["reason"].get<std::string>() != "");
  BOOST_TEST(succeeds(folder, "devices").find("selected: ") != std::string::npos);
}

BOOST_AUTO_TEST_CASE(render_draws_the_cities) {
  const TemporaryFolder folder;
  const std::string out = succeeds(
      folder, "render --points '" VOROCL_SAMPLES
              "/cities-5000.csv' --width 360 --bounds=-180,-90,180,90 --y-up --method jfa+1 -o a.png "
              "--labels a.npy --edges --points-overlay --color distance --palette turbo");
  BOOST_TEST(out.substr(out.find_last_of(' ') + 1) == "a.png\n");
  BOOST_TEST((folder.names() == std::set<std::string>{"a.png", "a.npy"}));
  BOOST_TEST(cv::imread(folder / "a.png").size() == cv::Size(360, 180));
  BOOST_TEST(labels_of(folder, "a.npy").size() == 360u * 180u);
}

BOOST_AUTO_TEST_CASE(render_labels_pixels_by_the_nearest_point_of_the_file) {
  const TemporaryFolder folder;
  // Data units of a tenth of a pixel, far from the origin, y up; the last seed is coincident with the first.
  folder.file("p.csv", "y,x\n1000,100\n1000,103.9\n1002.95,102\n1000.05,100.05\n");
  succeeds(
      folder,
      "render --points p.csv --bounds 100,1000,104,1003 --size 40x30 --y-up --method jfa+2 --labels a.tif");
  const std::vector<Pixel> seeds = {{0, 29}, {39, 29}, {20, 0}, {0, 29}};
  BOOST_TEST(labels_of(folder, "a.tif") == brute_force(Grid(40, 30), seeds, Metric::euclidean));
}

BOOST_AUTO_TEST_CASE(bounds_are_a_window_of_the_plane_or_of_a_period) {
  const TemporaryFolder folder;
  std::mt19937 random(3);
  std::uniform_real_distribution<double> longitude(-180, 180), latitude(-90, 90);
  std::vector<Point> points(60);
  std::string text = "x,y\n";
  for (Point& point : points) {
    point = {std::floor(longitude(random)) + 0.5, std::floor(latitude(random)) + 0.5};
    text += fmt::format("{},{}\n", point.x, point.y);
  }
  folder.file("p.csv", text);
  // Windows of 4 pixels per unit, whose labels are those of the host's brute force.
  const auto check = [&](int x0, int y0, int x1, int y1, const std::string& options,
                         std::optional<std::int64_t> begin) {
    // Of a period of 1440 pixels that begins there, counted from the window's first pixel.
    const Size size(std::int64_t{4} * (x1 - x0), std::int64_t{4} * (y1 - y0));
    const Grid grid(begin ? Axis(1440).periodic() : Axis(size.width()), Axis(size.height()));
    const Window window(grid, -begin.value_or(0), 0, size.width(), size.height());
    const auto seeds = transformed(points, [&](const Point& point) {
      return Pixel{std::llround(4 * (point.x - x0)) - begin.value_or(0), std::llround(4 * (point.y - y0))};
    });
    const std::string line =
        fmt::format("render --snap --points p.csv --labels l.npy --size {}x{} --bounds {},{},{},{}{}",
                    size.width(), size.height(), x0, y0, x1, y1, options);
    const Result result = run(folder, line);
    BOOST_TEST(result.exit_code == 0, result.error);
    BOOST_TEST(result.error.find("of 60 points lie outside the bounds") != std::string::npos, result.error);
    BOOST_TEST(labels_of(folder, "l.npy") == brute_force(window, seeds, Metric::euclidean), line);
  };
  const std::string around = " --periodic x --domain -180,-90,180,90";
  check(20, -30, 60, 10, "", std::nullopt);
  check(400, 100, 420, 110, "", std::nullopt);
  check(20, -30, 60, 10, around, -800);
  check(165, -30, 195, 0, around, 0);    // the period begins with the window
  check(-180, -10, 180, 0, around, 0);   // a whole period, but in y a window
  check(-200, -20, 200, 0, around, 80);  // beyond it there are no labels
  // Bounds that are a period but for a rounding error, and the period that begins with them.
  succeeds(folder,
           "render --points p.csv --size 300x150 --labels r.npy --bounds -27.8,-90,332.2,90" + around);
  const auto rounded = labels_of(folder, "r.npy");
  BOOST_TEST(std::count(rounded.begin(), rounded.end(), no_label) == 0);
  // What the grid shows whole is the grid's own period, and flooding takes it.
  succeeds(folder, "render --points p.csv --size 144x72 --method jfa -o a.png" + around);
}

BOOST_AUTO_TEST_CASE(render_reads_masks_and_makes_its_own_points) {
  const TemporaryFolder folder;
  const Grid grid(50, 40);
  cv::Mat mask(40, 50, CV_8U, cv::Scalar(0));
  mask.at<std::uint8_t>(30, 5) = 1;
  mask.at<std::uint8_t>(2, 40) = 255;
  cv::imwrite(folder / "m.png", mask);
  succeeds(folder, "render --mask m.png --method standard-flooding --metric manhattan --labels a.npy");
  BOOST_TEST(labels_of(folder, "a.npy") == brute_force(grid, {{40, 2}, {5, 30}}, Metric::manhattan));

  succeeds(folder, "render --random 9 --rng-seed 4 --size 50x40 --method 1+jfa --labels b.npy");
  const std::vector<Pixel> seeds = pixels_of(points_of(Seeds::random(test_device(), grid, 9, 4)));
  const auto exact = brute_force(grid, seeds, Metric::euclidean);
  const Verdict verdict = judge(grid, seeds, Metric::euclidean, labels_of(folder, "b.npy"), exact);
  BOOST_TEST(verdict.invalid + verdict.unlabelled == 0u);
  BOOST_TEST(verdict.wrong < 20u);
}

BOOST_AUTO_TEST_CASE(render_json_is_one_object) {
  const TemporaryFolder folder;
  const json result = json::parse(succeeds(
      folder,
      "render --random 7 --size 64x32 --method jfa+1 --neighbourhood von-neumann --labels a.npy --json"));
  BOOST_TEST(result.at("method") == "jfa+1");
  BOOST_TEST(result.at("metric") == "euclidean");
  BOOST_TEST(result.at("device") == test_device().name());
  BOOST_TEST(result.at("width") == 64);
  BOOST_TEST(result.at("height") == 32);
  BOOST_TEST(result.at("periodic") == "none");
  BOOST_TEST(result.at("seeds") == 7);
  BOOST_TEST(result.at("frames") == 1);
  BOOST_TEST(result.at("waves") == 7);
  BOOST_TEST(result.at("milliseconds").get<double>() > 0);
  BOOST_TEST(result.at("host_milliseconds").get<double>() > 0);
}

BOOST_AUTO_TEST_CASE(diagrams_are_exact_unless_a_method_is_named) {
  const TemporaryFolder folder;
  const std::string seeds = " --random 40 --size 70x50 --periodic y --labels ";
  const json result = json::parse(succeeds(folder, "render" + seeds + "a.npy --json"));
  BOOST_TEST(result.at("method") == "exact");
  BOOST_TEST(result.at("periodic") == "y");
  const Grid grid(70, 50, Axes::y);
  const std::vector<Pixel> pixels = pixels_of(points_of(Seeds::random(test_device(), grid, 40, 1)));
  BOOST_TEST(labels_of(folder, "a.npy") == brute_force(grid, pixels, Metric::euclidean));
  succeeds(folder, "simulate --frames 1 --step-length 0" + seeds + "s%d.npy");
  BOOST_TEST(labels_of(folder, "s1.npy") == labels_of(folder, "a.npy"));
}

/// Pixels of 0.65, of which seven are 4.55 and no more, however that is rounded.
BOOST_AUTO_TEST_CASE(pixels_beyond_the_greatest_distance_have_no_label) {
  const TemporaryFolder folder;
  folder.file("p.csv", "0.325,0.325\n12.675,12.675\n");
  const std::string render = "render --points p.csv --size 20x20 --bounds 0,0,13,13 --max-distance 4.55 ";
  const std::string said = succeeds(folder, render + "--labels a.npy --enlarge 2 -o a.png");
  const auto labels = labels_of(folder, "a.npy");
  const cv::Mat picture = cv::imread(folder / "a.png");
  for (int i = 0; i < 400; ++i) {
    const int x = i % 20, y = i / 20, to_first = x * x + y * y,
              to_last = (19 - x) * (19 - x) + (19 - y) * (19 - y);
    const std::uint32_t label = to_first <= 49 ? 0 : to_last <= 49 ? 1 : no_label;
    BOOST_TEST_REQUIRE(labels[static_cast<std::size_t>(i)] == label, "pixel " << x << ", " << y);
    if (x == y && label == no_label)
      BOOST_TEST((picture.at<cv::Vec3b>(2 * y + 1, 2 * x + 1) == cv::Vec3b(0, 0, 0)));
  }
  // Cells are measured without them.
  const auto within = std::count(labels.begin(), labels.end(), 0u);
  BOOST_TEST(
      said.find(fmt::format("{} pixels farther than --max-distance", 400 - 2 * within)) != std::string::npos,
      said);
  const std::string cells = "cells --points p.csv --size 20x20 --bounds 0,0,13,13 ";
  const nlohmann::json result = nlohmann::json::parse(
      succeeds(folder, cells + "--json --units px --cells c.csv --cell-columns id,area,right,neighbours "
                               "--distance d.npy --max-distance 7"));
  BOOST_TEST(result.at("beyond_max_distance") == 400 - 2 * within);
  BOOST_TEST(content_of(folder / "c.csv") ==
             fmt::format("id,area,right,neighbours\n0,{0},7,0\n1,{0},19,0\n", within));
  const auto distances = read_raw_npy<float>(folder / "d.npy").values;
  for (std::size_t i = 0; i < distances.size(); ++i)
    BOOST_TEST((std::isinf(distances[i]) == (labels[i] == no_label)), "pixel " << i);
  refuses(folder, "cells --exact --points p.csv --cells e.csv --max-distance 4", usage,
          {"--max-distance", "--exact"});
  succeeds(folder, render + "--units px --labels b.npy");  // beyond no pixel of the first seven
  BOOST_TEST(labels_of(folder, "b.npy")[4] == 0u);
  BOOST_TEST(labels_of(folder, "b.npy")[5] == no_label);
  succeeds(folder, render + "--color distance --contours 2 -o d.png");
  const cv::Mat by_distance = cv::imread(folder / "d.png");
  for (int i = 0; i < 20; ++i) {
    const bool is_far = labels[static_cast<std::size_t>(21 * i)] == no_label;
    BOOST_TEST((by_distance.at<cv::Vec3b>(i, i) == cv::Vec3b(0, 0, 0)) == is_far, "pixel " << i);
  }
  const Result oblong =  // behind the warning of what such pixels are
      run(folder, "render --points p.csv --size 20x30 --bounds 0,0,13,13 --max-distance 4 --labels o.npy");
  BOOST_TEST(oblong.exit_code == usage);
  BOOST_TEST(oblong.error.find("error: --max-distance: pixels are no squares") != std::string::npos);
  refuses(folder, render + "--method jfa --waves w%d.png", usage, {"--max-distance", "--waves"});
  refuses(folder, "render --points p.csv --size 9x9 --max-distance -1 --labels a.npy", usage,
          {"--max-distance"});
}

BOOST_AUTO_TEST_CASE(different_scales_of_the_axes_are_warned_of) {
  const TemporaryFolder folder;
  folder.file("p.csv", "0,0\n4,2\n");
  const Result warned = run(folder, "render --points p.csv --size 40x40 --method jfa -o a.png");
  BOOST_TEST(warned.exit_code == 0);
  BOOST_TEST(warned.error.rfind("vorocl: warning: ", 0) == 0u);
  BOOST_TEST(warned.error.find("--width") != std::string::npos);
  succeeds(folder, "render --points p.csv --size 40x20 --method jfa -o a.png");  // and prints no warning
}

BOOST_AUTO_TEST_CASE(compare_counts_pixels) {
  const TemporaryFolder folder;
  command::write_labels(folder / "a.npy", command::Size(4, 2), {1, 2, 3, 4, 5, 6, 7, 8});
  command::write_labels(folder / "b.tif", command::Size(4, 2), {1, 2, 3, 4, 5, 6, 9, 16777216});
  command::write_labels(folder / "c.npy", command::Size(2, 4), {1, 2, 3, 4, 5, 6, 7, 8});
  const json result = json::parse(succeeds(folder, "compare a.npy b.tif --json"));
  BOOST_TEST(result.at("similarity") == 75);
  BOOST_TEST(result.at("different_pixels") == 2);
  BOOST_TEST(result.at("pixels") == 8);
  BOOST_TEST(succeeds(folder, "compare a.npy a.npy").find("100.0") != std::string::npos);
  refuses(folder, "compare a.npy c.npy", failure, {"4 x 2", "2 x 4"});
  refuses(folder, "compare a.npy missing.npy", failure, {"missing.npy", "No such file"});
  refuses(folder, "compare a.npy", usage, {"another label file"});
  refuses(folder, "compare a.npy b.tif --random 3", usage, {"another label file"});
}

BOOST_AUTO_TEST_CASE(a_period_may_be_as_long_as_a_diagram) {
  const TemporaryFolder folder;
  const std::string seeds = " --random 9 --size 32768x3 --periodic x --labels ";
  succeeds(folder, "render" + seeds + "a.npy");
  const auto pixels = pixels_of(points_of(Seeds::random(test_device(), Grid(32768, 3, Axes::x), 9, 1)));
  BOOST_TEST(labels_of(folder, "a.npy") == brute_force(Grid(32768, 3, Axes::x), pixels, Metric::euclidean));
}

BOOST_AUTO_TEST_CASE(compare_judges_by_the_truth) {
  const TemporaryFolder folder;
  const Grid grid(70, 50);
  const std::vector<Pixel> seeds = pixels_of(points_of(Seeds::random(test_device(), grid, 90, 4)));
  for (const Metric metric : both_metrics) {
    const std::string arguments =
        fmt::format("--random 90 --rng-seed 4 --size 70x50 --metric {} ", name_of(metric));
    succeeds(folder, "render --method jfa --neighbourhood von-neumann --labels a.npy " + arguments);
    const auto labels = labels_of(folder, "a.npy"), exact = brute_force(grid, seeds, metric);
    const json result = json::parse(succeeds(folder, "compare a.npy --json " + arguments));
    BOOST_TEST(result.at("similarity") == similarity(labels, exact));
    BOOST_TEST(result.at("errors").at("wrong_pixels") == judge(grid, seeds, metric, labels, exact).wrong);
    BOOST_TEST(result.at("errors").at("unlabelled_pixels") == 0);
    succeeds(folder, "render --method exact --labels e.tif " + arguments);
    const std::string out = succeeds(folder, "compare e.tif " + arguments);
    BOOST_TEST(out.find("similarity 100.000000 %") != std::string::npos, out);
    BOOST_TEST(out.find("0 pixels are wrong") != std::string::npos, out);
  }
  refuses(folder, "compare a.npy --random 9 --size 50x70", failure, {"70 x 50", "50 x 70"});
  refuses(folder, "compare a.npy --random 9 --points p.csv", usage, {});

  // Labels of a trajectory carry the particles' ids.
  const std::string trajectory = "--trajectory '" VOROCL_SAMPLES "/lj-clusters.lammpstrj' --frame 3 ";
  succeeds(folder, "render --width 160 --method exact --labels t.npy " + trajectory);
  const std::string line = "compare t.npy --width 160 --json " + trajectory;
  const json result = json::parse(succeeds(folder, line + " --no-snap"));
  BOOST_TEST(result.at("similarity") == 100);
  BOOST_TEST(result.at("errors").at("wrong_pixels") == 0);
  // By snapped points, some are wrong, and a note says what else there is.
  const Result snapped = run(folder, line);
  BOOST_TEST(json::parse(snapped.out).at("errors").at("wrong_pixels") > 0);
  BOOST_TEST(snapped.error.find("--no-snap") != std::string::npos, snapped.error);
}

BOOST_AUTO_TEST_CASE(bench_judges_every_method) {
  const TemporaryFolder folder;
  const std::string arguments =
      "bench --size 300x200 --random 500 --methods jfa,jfa+2,standard-flooding,opencv --repeat 3";
  // What only djfa has is no trouble to the others beside it.
  succeeds(folder, "bench --size 90x60 --random 9 --methods jfa,djfa,exact --neighbourhood mixed --repeat 1");
  const json result = json::parse(succeeds(folder, arguments + " --json"));
  BOOST_TEST(result.at("seeds") == 500);
  BOOST_TEST(result.at("repeat") == 3);
  const json& results = result.at("results");
  BOOST_REQUIRE(results.size() == 4u);
  const char* const names[] = {"jfa", "jfa+2", "standard-flooding", "opencv"};
  const Grid grid(300, 200);
  for (std::size_t i = 0; i < 4; ++i) {
    BOOST_TEST(results[i].at("method") == names[i]);
    BOOST_TEST(results[i].at("min_ms").get<double>() > 0);
    BOOST_TEST(results[i].at("median_ms").get<double>() >= results[i].at("min_ms").get<double>());
  }
  // Against the labels that render writes, judged by brute force.
  succeeds(folder, "render --size 300x200 --random 500 --method jfa --labels a.npy");
  const std::vector<Pixel> seeds = pixels_of(points_of(Seeds::random(test_device(), grid, 500, 1)));
  const auto exact = brute_force(grid, seeds, Metric::euclidean);
  const Verdict verdict = judge(grid, seeds, Metric::euclidean, labels_of(folder, "a.npy"), exact);
  BOOST_TEST(results[0].at("wrong_pixels") == verdict.wrong);
  BOOST_TEST(results[3].at("wrong_pixels").get<int>() > 0);  // OpenCV's 5 x 5 mask is approximate
  const std::string table = succeeds(folder, arguments);
  for (const char* name : names) BOOST_TEST(table.find(name) != std::string::npos);
}
