// vorocl-study ablation: its table, the seeds that it spreads, and Algorithm 1's waves that scatter in place.
#define BOOST_TEST_MODULE ablation
#include <algorithm>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>

#include "brute_force.hpp"
#include "formats/csv.hpp"
#include "run_command.hpp"
#include "studies/ablation.hpp"

using namespace vorocl;
using namespace vorocl::command;
using nlohmann::json;

namespace {

using Row = std::map<std::string, std::string>;

/// The rows by study and setting.
std::map<std::string, Row> rows_of(const std::string& path) {
  std::istringstream text(content_of(path));
  std::string line;
  std::getline(text, line);
  const CsvFields names = *csv_fields(line);
  std::map<std::string, Row> rows;
  while (std::getline(text, line)) {
    const CsvFields fields = *csv_fields(line);
    BOOST_TEST_REQUIRE(fields.size() == names.size());
    Row row;
    for (std::size_t i = 0; i < names.size(); ++i) row[names[i]] = fields[i];
    rows[row["study"] + ": " + row["setting"]] = row;
  }
  return rows;
}

double number(const Row& row, const std::string& column) { return std::stod(row.at(column)); }

const std::string accuracy[] = {"waves_mean",         "similarity_to_exact_mean", "similarity_to_exact_least",
                                "wrong_percent_mean", "wrong_percent_greatest",   "largest_excess",
                                "mean_excess"};

/// Frames of seeds that move at random, with an engine's diagrams.
struct Frame {
  std::vector<Point> seeds;
  std::vector<std::uint32_t> labels;
};

std::vector<Frame> frames_of(const Grid& grid, std::size_t seeds, Stamping stamping, int frames) {
  Simulation simulation(Seeds::random(test_device(), grid, seeds, 3), [](Seeds& moving, Window&, int frame) {
    random_step(moving, 4, Border::reflect, 3, static_cast<std::uint32_t>(frame));
  });
  const auto record = std::make_shared<ScatterRecord>();
  simulation.add_engine(in_place_scatter(test_device(), stamping, record));
  std::vector<Frame> made;
  for (int frame = 0; frame <= frames; ++frame) {
    simulation.step();
    made.push_back({points_of(simulation.seeds()), simulation.diagram().read()});
  }
  return made;
}

std::int64_t distance_at(const Frame& frame, std::uint32_t label, const Grid& grid, std::size_t i) {
  const auto width = static_cast<std::size_t>(grid.width());
  const Point& seed = frame.seeds.at(label);
  return distance({static_cast<int>(i % width), static_cast<int>(i / width)},
                  {static_cast<int>(seed.x), static_cast<int>(seed.y)}, Metric::euclidean);
}

}  // namespace

BOOST_AUTO_TEST_CASE(the_table_has_every_study_and_its_numbers_are_those_of_simulate) {
  const TemporaryFolder folder;
  const json printed = json::parse(succeeds(
      folder, "vorocl-study ablation --sizes 90 --seeds 1% --frames 10 --timed-frames 2 -o a.csv --json"));
  BOOST_TEST(printed.at("file") == "a.csv");
  BOOST_TEST(printed.at("configurations") == 1);
  const auto rows = rows_of(folder / "a.csv");
  BOOST_TEST(rows.size() == 31u);
  std::map<std::string, int> studies;
  for (const auto& [name, row] : rows) {
    BOOST_TEST_CONTEXT(name) {
      ++studies[row.at("study")];
      BOOST_TEST(row.at("version") == VOROCL_VERSION);
      BOOST_TEST(row.at("n") == "90");
      BOOST_TEST(row.at("seeds") == "81");
      BOOST_TEST(row.at("frames") == "10");
      const double median = number(row, "milliseconds_median");
      BOOST_TEST((0 < number(row, "milliseconds_least") && number(row, "milliseconds_least") <= median &&
                  median <= number(row, "milliseconds_greatest")));
      BOOST_TEST(number(row, "similarity_to_exact_least") <= number(row, "similarity_to_exact_mean") + 1e-9);
      BOOST_TEST(number(row, "wrong_percent_mean") <= 100 - number(row, "similarity_to_exact_mean") + 1e-9);
      if (row.at("setting").find("scatter") == std::string::npos)
        BOOST_TEST(number(row, "differing_between_runs_greatest") == 0);
      // L = 10; the d_max of the other studies is the step length.
      const bool of_lengths = row.at("study") == "d_max";
      BOOST_TEST(row.at("d_max") == (of_lengths ? row.at("setting").substr(0, 1) + "0" : "5"));
    }
  }
  BOOST_TEST((studies == std::map<std::string, int>{{"method", 3},
                                                    {"von Neumann waves", 4},
                                                    {"extra waves", 3},
                                                    {"refresh interval", 3},
                                                    {"d_max", 8},
                                                    {"seeds", 6},
                                                    {"waves", 4}}));
  for (const char* same :
       {"von Neumann waves: 2", "extra waves: 0", "refresh interval: 0", "seeds: uniform, djfa",
        "waves: gather", "waves: gather, one pixel per work-item"}) {
    for (const std::string& column : accuracy)
      BOOST_TEST(rows.at(same).at(column) == rows.at("method: djfa").at(column), same << " " << column);
  }
  BOOST_TEST(number(rows.at("method: exact"), "wrong_percent_greatest") == 0);
  // JFA has 7 waves and dJFA 6, of a first step of 32 >= 2 L.
  BOOST_TEST(number(rows.at("method: jfa"), "waves_mean") == 7);
  BOOST_TEST(number(rows.at("method: djfa"), "waves_mean") == 6);
  BOOST_TEST(number(rows.at("extra waves: 2"), "waves_mean") == 8);
  BOOST_TEST(number(rows.at("refresh interval: 5"), "waves_mean") == (8 * 6 + 2 * 7) / 10.0);

  const auto check = [&](const std::string& name, const std::string& options) {
    const json result = json::parse(succeeds(folder,
                                             "simulate --random 81 --size 90x90 --frames 10 --method djfa "
                                             "--reach paper --compare-with exact --json " +
                                                 options));
    for (const auto& [key, value] : result.at("errors").items())
      BOOST_TEST(number(rows.at(name), key) == value.get<double>(), boost::test_tools::tolerance(1e-12));
  };
  check("extra waves: 1", "--step-length 5 --extra-waves 1");
  check("von Neumann waves: all", "--step-length 5 --neighbourhood von-neumann");
  check("d_max: 3 L, djfa", "--step-length 30");
}

BOOST_AUTO_TEST_CASE(scattering_in_place_only_ever_comes_nearer) {
  const Grid grid(120, 77);
  for (const Stamping stamping : {Stamping::none, Stamping::seeds}) {
    const std::vector<Frame> frames = frames_of(grid, 40, stamping, 8);
    for (std::size_t f = 1; f < frames.size(); ++f) {
      const Frame& frame = frames[f];
      bool all_valid = true, none_farther = true;
      for (std::size_t i = 0; i < frame.labels.size(); ++i) {
        all_valid = all_valid && frame.labels[i] < 40;
        none_farther = none_farther && distance_at(frame, frame.labels[i], grid, i) <=
                                           distance_at(frame, frames[f - 1].labels[i], grid, i);
      }
      BOOST_TEST(all_valid);
      BOOST_TEST(none_farther);
      std::vector<Pixel> pixels;
      for (const Point& point : frame.seeds)
        pixels.push_back({static_cast<int>(point.x), static_cast<int>(point.y)});
      const auto truth = brute_force(grid, pixels, Metric::euclidean);
      std::size_t different = 0;
      for (std::size_t i = 0; i < truth.size(); ++i) different += truth[i] != frame.labels[i] ? 1 : 0;
      BOOST_TEST(different < truth.size() / 10);
      if (stamping == Stamping::none) continue;
      std::set<std::uint32_t> present(frame.labels.begin(), frame.labels.end());
      std::set<Pixel> places(pixels.begin(), pixels.end());
      BOOST_TEST(present.size() == places.size());
    }
  }
}

BOOST_AUTO_TEST_CASE(scattering_one_seed_in_place_is_exact) {
  for (const Grid& grid : {Grid(1, 1), Grid(33, 5), Grid(64, 64)}) {
    for (const Frame& frame : frames_of(grid, 1, Stamping::none, 3))
      BOOST_TEST(std::count(frame.labels.begin(), frame.labels.end(), 0u) ==
                 static_cast<long>(grid.pixels()));
  }
}

BOOST_AUTO_TEST_CASE(seeds_are_spread_as_said) {
  const Grid grid(400, 300);
  const auto spread = [&](Spread how) { return points_of(spread_seeds(test_device(), grid, 20000, how, 1)); };
  const auto blocks = [&](const std::vector<Point>& points) {
    std::set<std::pair<int, int>> held;
    for (const Point& point : points)
      held.insert({static_cast<int>(point.x) / 10, static_cast<int>(point.y) / 10});
    return held.size();
  };
  BOOST_TEST(blocks(spread(Spread::uniform)) == 1200u);
  BOOST_TEST(blocks(spread(Spread::clusters)) < 600u);
  BOOST_TEST(blocks(spread(Spread::clusters)) > 16u);
  double x = 0, y = 0;
  std::size_t left = 0;
  for (const Point& point : spread(Spread::gradient)) {
    x += point.x / 400 / 20000;
    y += point.y / 300 / 20000;
    left += point.x < 200 ? 1 : 0;
  }
  BOOST_TEST(x == 2.0 / 3, boost::test_tools::tolerance(0.01));
  BOOST_TEST(y == 1.0 / 2, boost::test_tools::tolerance(0.02));
  BOOST_TEST(static_cast<double>(left) == 5000, boost::test_tools::tolerance(0.05));
}

BOOST_AUTO_TEST_CASE(bad_options_are_refused) {
  const TemporaryFolder folder;
  refuses(folder, "vorocl-study ablation", usage, {"-o"});
  refuses(folder, "vorocl-study ablation -o a.txt", usage, {"a.txt", ".csv"});
  refuses(folder, "vorocl-study ablation -o missing/a.csv", failure, {"missing", "does not exist"});
  refuses(folder, "vorocl-study ablation -o a.csv --sizes 0", usage, {"--sizes", "1 to 32768"});
  refuses(folder, "vorocl-study ablation -o a.csv --sizes 10 --seeds 0.1%", usage, {"--seeds", "0 seeds"});
}
