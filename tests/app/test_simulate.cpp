// vorocl simulate on random seeds: labels, similarities, JSON, options; and dJFA in vorocl bench.
#define BOOST_TEST_MODULE simulate
#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <sstream>

#include "brute_force.hpp"
#include "formats/raster_files.hpp"
#include "read_measures.hpp"
#include "run_command.hpp"

using namespace vorocl;
using nlohmann::json;

namespace {

std::vector<std::uint32_t> labels_of(const std::string& path) { return command::read_labels(path).labels; }

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

std::string number(int frame) { return fmt::format("{:05}", frame); }

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
       {Metric::euclidean, {NeighbourhoodMix::von_neumann, 2, 2}, 0}},
      {"--von-neumann-waves 0 --refresh-interval 3",
       Border::reflect,
       {Metric::euclidean, {NeighbourhoodMix::mixed, 0, 0}, 3}},
  };
  for (const auto& run : runs) {
    const TemporaryFolder folder;
    succeeds(folder,
             "simulate --random 80 --rng-seed 7 --size 97x61 --frames 8 --step-length 4 --method djfa "
             "--labels l/%05d.npy " +
                 run.arguments);
    Simulation simulation(Seeds::random(test_device(), grid, 80, 7), [&](Seeds& seeds, Window&, int frame) {
      random_step(seeds, 4, run.border, 7, static_cast<std::uint32_t>(frame));
    });
    simulation.add_engine([&](const Seeds& seeds, Diagram& diagram) {
      return dynamic_jump_flooding(seeds, diagram, run.options);
    });
    for (int frame = 0; frame <= 8; ++frame) {
      simulation.step();
      BOOST_TEST((labels_of(folder / ("l/" + number(frame) + ".npy")) == simulation.diagram().read()),
                 run.arguments << " frame " << frame);
    }
  }
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

// Exact diagrams of two metrics, with the tolerance of the program by the paper's authors: 1e-4 of the side.
BOOST_AUTO_TEST_CASE(similarities_within_a_tolerance) {
  const TemporaryFolder folder;
  const Grid grid(1000, 1000);
  const auto mean = [&](const std::string& more) {
    const json result = json::parse(succeeds(
        folder,
        "simulate --random 10000 --size 1000x1000 --rng-seed 3 --frames 1 --step-length 0 --method exact "
        "--compare-with exact --compare-metric manhattan --json " +
            more));
    return result.at("similarity").at("mean").get<double>();
  };
  const Seeds seeds = Seeds::random(test_device(), grid, 10000, 3);
  Diagram euclidean(test_device(), grid), manhattan(test_device(), grid);
  exact_diagram(seeds, euclidean);
  exact_diagram(seeds, manhattan, {Metric::manhattan});
  BOOST_TEST(mean("") == similarity_of(euclidean, manhattan));
  manhattan.write(manhattan.read(), seeds, Metric::euclidean);  // by which distances are compared
  BOOST_TEST(mean("--tolerance 0.1") == similarity_of(euclidean, manhattan, 0.1));
  BOOST_TEST(mean("--tolerance 0.1 --metric euclidean") > mean("") + 0.2);
  BOOST_TEST(mean("--tolerance 2000") == 100.0);
}

BOOST_AUTO_TEST_CASE(errors_are_told_where_the_other_method_is_the_truth) {
  const TemporaryFolder folder;
  const Grid grid(120, 90);
  const std::string arguments =
      "simulate --random 300 --size 120x90 --frames 6 --step-length 5 --method djfa --neighbourhood "
      "von-neumann "
      "--compare-with exact --similarity s.csv --labels l%d.npy ";
  const json errors = json::parse(succeeds(folder, arguments + "--json")).at("errors");
  std::istringstream text(content_of(folder / "s.csv"));
  std::string line;
  std::getline(text, line);
  BOOST_TEST(line == "frame,similarity,wrong_percent,largest_excess,mean_excess");

  Seeds seeds = Seeds::random(test_device(), grid, 300, 1);
  double wrong_sum = 0, wrong_greatest = 0, largest = 0, mean_sum = 0;
  for (int frame = 1; frame <= 6; ++frame) {
    random_step(seeds, 5, Border::reflect, 1, static_cast<std::uint32_t>(frame));
    const std::vector<Pixel> pixels = pixels_of(points_of(seeds));
    const Verdict verdict =
        judge(grid, pixels, Metric::euclidean, labels_of(folder / fmt::format("l{}.npy", frame)),
              brute_force(grid, pixels, Metric::euclidean));
    const double wrong = 100.0 * static_cast<double>(verdict.wrong) / static_cast<double>(grid.pixels());
    double row[5] = {};
    std::getline(text, line);
    BOOST_TEST_REQUIRE(
        std::sscanf(line.c_str(), "%lf,%lf,%lf,%lf,%lf", row, row + 1, row + 2, row + 3, row + 4) == 5);
    BOOST_TEST(row[0] == frame);
    BOOST_TEST(row[2] == wrong, boost::test_tools::tolerance(1e-12));
    BOOST_TEST(row[2] <= 100 - row[1] + 1e-9);  // a wrong pixel has another label
    BOOST_TEST((row[2] > 0 && row[3] > 0 && row[4] > 0 && row[4] < row[3]));
    wrong_sum += wrong;
    wrong_greatest = std::max(wrong_greatest, wrong);
    largest = std::max(largest, row[3]);
    mean_sum += row[4];
  }
  const auto close = boost::test_tools::tolerance(1e-12);
  BOOST_TEST(errors.at("wrong_percent_mean").get<double>() == wrong_sum / 6, close);
  BOOST_TEST(errors.at("wrong_percent_greatest").get<double>() == wrong_greatest, close);
  BOOST_TEST(errors.at("largest_excess").get<double>() == largest, close);
  BOOST_TEST(errors.at("mean_excess").get<double>() == mean_sum / 6, close);
  BOOST_TEST(succeeds(folder, arguments).find("wrong pixels: mean") != std::string::npos);
  for (const char* other : {"--compare-with jfa", "--compare-with exact --compare-metric manhattan"}) {
    const std::string out = succeeds(
        folder,
        std::string("simulate --random 9 --size 20x20 --frames 2 --step-length 1 --method djfa --json ") +
            other);
    BOOST_TEST(!json::parse(out).contains("errors"));
  }
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
    const auto expected = brute_force(grid, pixels_of(points_of(seeds)), Metric::euclidean);
    BOOST_TEST((labels_of(folder / fmt::format("l{}.npy", frame)) == expected), "frame " << frame);
  }
}

// What is timed and judged is frame 1 of a simulation: its frame 0 has the seeds a step away.
BOOST_AUTO_TEST_CASE(bench_runs_the_plan_that_a_simulation_runs) {
  const TemporaryFolder folder;
  const Grid grid(150, 100);
  const std::pair<const char*, NeighbourhoodMix> mixes[] = {{"mixed", NeighbourhoodMix::mixed},
                                                            {"von-neumann", NeighbourhoodMix::von_neumann}};
  for (const auto& [name, mix] : mixes) {
    const json result = json::parse(succeeds(
        folder, fmt::format("bench --random 1500 --size 150x100 --methods djfa,jfa --neighbourhood {} "
                            "--reach paper --repeat 2 --json",
                            name)));
    const json& djfa = result.at("results").at(0);
    BOOST_TEST(djfa.at("method") == "djfa");
    BOOST_TEST(djfa.at("min_ms").get<double>() > 0);
    Seeds seeds = Seeds::random(test_device(), grid, 1500, 1);
    const std::vector<Pixel> now = pixels_of(points_of(seeds));
    random_step(seeds, 5, Border::reflect, 1, 0);
    Simulation simulation(std::move(seeds), [&](Seeds& moved, Window&, int) { moved.move_to(centres(now)); });
    DynamicJumpFloodingOptions options;
    options.plan.neighbourhood = mix;
    options.reach = Reach::paper;
    simulation.add_engine(
        [=](const Seeds& of, Diagram& diagram) { return dynamic_jump_flooding(of, diagram, options); });
    simulation.step();
    simulation.step();
    const Verdict verdict = judge(grid, now, Metric::euclidean, simulation.diagram().read(),
                                  brute_force(grid, now, Metric::euclidean));
    BOOST_TEST(verdict.wrong > 0u);
    BOOST_TEST(djfa.at("wrong_pixels") == verdict.wrong + verdict.unlabelled);
  }
}

// 300 seeds on a line, which no motion leaves: the paper's waves do not reach the far sides.
BOOST_AUTO_TEST_CASE(the_plans_of_a_run_are_told) {
  const TemporaryFolder folder;
  std::ofstream points(folder / "line.csv");
  points << "x,y\n";
  for (int i = 0; i < 300; ++i) points << i + 0.5 << ",150.5\n";
  points.close();
  const std::string run =
      "simulate --points line.csv --bounds 0,0,300,300 --size 300x300 --frames 4 --step-length 0 --method "
      "djfa ";
  const auto plans_of = [&](const std::string& arguments) {
    return json::parse(succeeds(folder, run + arguments + " --json")).at("plans");
  };
  // 300 pixels per seed: the paper's first step is 64. The line is 150 pixels away: steps 128, 64, ..., 1.
  const json paper = {{"first_step", {{"least", 64.0}, {"greatest", 64.0}}},
                      {"waves", {{"least", 7.0}, {"greatest", 7.0}}},
                      {"max_displacement", {{"least", 0.0}, {"greatest", 0.0}}},
                      {"frames_from_seeds", 0},
                      {"jfa_frames", 0}};
  BOOST_TEST(plans_of("--reach paper") == paper);
  BOOST_TEST(plans_of("--reach authors").at("first_step").at("greatest") == 32);
  const json measured = {{"first_step", {{"least", 128.0}, {"greatest", 128.0}}},
                         {"waves", {{"least", 8.0}, {"greatest", 8.0}}},
                         {"max_displacement", {{"least", 0.0}, {"greatest", 0.0}}},
                         {"frames_from_seeds", 4},
                         {"jfa_frames", 0}};
  BOOST_TEST(plans_of("") == measured);
  BOOST_TEST(plans_of("--refresh-interval 2").at("jfa_frames") == 2);
  const std::string text = succeeds(folder, run);
  BOOST_TEST(text.find("first steps 128 to 128, 8 to 8 waves, d_max 0 to 0 pixels") != std::string::npos);
  BOOST_TEST(text.find("instead of the last labels: 4, of which 0") != std::string::npos);
  BOOST_TEST(!json::parse(succeeds(folder,
                                   "simulate --random 9 --size 20x20 --frames 1 --step-length 1 "
                                   "--method jfa --json"))
                  .contains("plans"));
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
  BOOST_TEST(result.at("waves") == 5);  // no pixel is farther than 31: steps 16, 8, 4, 2, 1
  BOOST_TEST(result.at("milliseconds").get<double>() > 0);
  BOOST_TEST(result.at("host_milliseconds").get<double>() > 0);
  BOOST_TEST(!result.contains("similarity"));
  BOOST_TEST(folder.names().empty());
}

BOOST_AUTO_TEST_CASE(bad_options_are_usage_errors) {
  const TemporaryFolder folder;
  const std::string random = "simulate --random 5 --size 10x10 ",
                    moving = random + "--frames 3 --step-length 1 ", djfa = moving + "--method djfa ";
  refuses(folder, random + "--step-length 1 --method djfa", usage, {"--frames"});
  refuses(folder, random + "--frames 3 --method djfa", usage, {"--step-length"});
  refuses(folder, random + "--frames 0 --step-length 1 --method djfa", usage, {"--frames"});
  refuses(folder, random + "--frames 3 --step-length -1 --method djfa", usage, {"--step-length"});
  refuses(folder, djfa + "--border open", usage, {"open", "reflect, periodic"});
  refuses(folder, djfa + "--extra-waves 3", usage, {"--extra-waves"});
  refuses(folder, moving + "--method jfa --extra-waves 1", usage, {"--extra-waves", "djfa"});
  refuses(folder, moving + "--method jfa --neighbourhood mixed", usage, {"mixed", "djfa"});
  refuses(folder, moving + "--method exact --neighbourhood mixed", usage, {"mixed", "djfa"});
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
  refuses(folder, djfa + "--fps 25 -o p%d.png", usage, {"--fps is for a film", ".mp4"});
  refuses(folder, djfa + "--every 2", usage, {"--every", "--cells"});
  refuses(folder, djfa + "-o a.mp4 --fps 0", usage, {"--fps"});
  refuses(folder, djfa + "-o a.mp4 --fps nan", usage, {"--fps"});
  refuses(folder, djfa + "--bounds 0,0,1,1", usage, {"--bounds", "--trajectory"});
  refuses(folder, djfa + "-o missing/deep/%d.png", failure, {"missing/deep", "does not exist"});
  refuses(folder, djfa + "-o missing/a.mp4", failure, {"missing", "does not exist"});
  run(folder, djfa + "-o new/%d.png --device none");
  BOOST_TEST(folder.names().empty());
}
