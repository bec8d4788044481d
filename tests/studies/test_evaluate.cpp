// vorocl-study evaluate: its table, and how it goes on after it was interrupted.
#define BOOST_TEST_MODULE evaluate
#include <fmt/format.h>

#include <chrono>
#include <csignal>
#include <map>
#include <nlohmann/json.hpp>
#include <regex>
#include <set>
#include <sstream>
#include <thread>

#include "formats/csv.hpp"
#include "run_command.hpp"

using namespace vorocl;
using nlohmann::json;

namespace {

const auto to_the_last_digits = boost::test_tools::tolerance(1e-12);
constexpr std::size_t rows_of_configuration = 6;

/// A row of the table, by column.
struct Row : std::map<std::string, std::string> {
  double number(const std::string& column) const { return std::stod(at(column)); }
  std::string configuration() const { return at("n") + " " + at("seeds"); }
  std::string key() const { return configuration() + " " + at("method") + " " + at("metric"); }
};

std::vector<std::string> lines_of(const std::string& path) {
  std::istringstream text(content_of(path));
  std::vector<std::string> lines;
  for (std::string line; std::getline(text, line);) lines.push_back(line);
  return lines;
}

std::vector<Row> rows_of(const std::string& path) {
  const std::vector<std::string> lines = lines_of(path);
  BOOST_TEST_REQUIRE(!lines.empty());
  const command::CsvFields names = *command::csv_fields(lines[0]);
  std::vector<Row> rows;
  for (std::size_t i = 1; i < lines.size(); ++i) {
    const command::CsvFields fields = *command::csv_fields(lines[i]);
    BOOST_TEST_REQUIRE(fields.size() == names.size());
    rows.emplace_back();
    for (std::size_t column = 0; column < names.size(); ++column) rows.back()[names[column]] = fields[column];
  }
  return rows;
}

const Row& find(const std::vector<Row>& rows, const Row& like, const char* method, const char* metric) {
  const auto found = std::find_if(rows.begin(), rows.end(), [&](const Row& row) {
    return row.key() == like.configuration() + " " + method + " " + metric;
  });
  BOOST_TEST_REQUIRE((found != rows.end()));
  return *found;
}

/// What is the same in every run: all but times and dates.
std::vector<std::string> lasting(const Row& row) {
  std::vector<std::string> values;
  for (const auto& [column, value] : row) {
    if (column != "date" && column.find("milliseconds") == std::string::npos &&
        column.find("speedup") == std::string::npos)
      values.push_back(value);
  }
  return values;
}

void check_each_once(const std::vector<Row>& rows, std::size_t configurations) {
  std::set<std::string> keys, found;
  for (const Row& row : rows) {
    keys.insert(row.key());
    found.insert(row.configuration());
  }
  BOOST_TEST(rows.size() == configurations * rows_of_configuration);
  BOOST_TEST(keys.size() == rows.size());
  BOOST_TEST(found.size() == configurations);
}

const std::string tiny =
    "vorocl-study evaluate --sizes 60,97 --seeds 30,2% --frames 5 --timed-frames 3 -o t.csv ";

}  // namespace

BOOST_AUTO_TEST_CASE(the_table_is_complete_and_its_arithmetic_right) {
  const TemporaryFolder folder;
  const json result = json::parse(succeeds(folder, tiny + "--json"));
  BOOST_TEST(result.at("configurations") == 4);
  BOOST_TEST(result.at("made_before") == 0);
  BOOST_TEST(lines_of(folder / "t.csv")[0] ==
             "version,platform,device,driver,rng_seed,step_length,frames,timed_frames,repeats,date,n,seeds,"
             "pixels_per_seed,coincident_seeds,method,metric,waves,milliseconds_median,milliseconds_least,"
             "milliseconds_greatest,host_milliseconds_median,speedup_over_jfa,speedup_over_djfae,"
             "similarity_to_euclidean_jfa_mean,similarity_to_euclidean_jfa_least,similarity_to_jfa_mean,"
             "similarity_to_jfa_least,similarity_to_exact_mean,similarity_to_exact_least,wrong_percent_mean,"
             "wrong_percent_greatest,largest_excess,mean_excess");
  const std::vector<Row> rows = rows_of(folder / "t.csv");
  check_each_once(rows, 4);
  BOOST_TEST(rows.front().configuration() == "60 30");
  BOOST_TEST(rows.back().configuration() == "97 188");
  for (const Row& row : rows) {
    BOOST_TEST_CONTEXT(row.key()) {
      BOOST_TEST(row.at("version") == VOROCL_VERSION);
      BOOST_TEST(row.at("device") == test_device().name());
      BOOST_TEST(row.at("driver") == test_device().driver_version());
      BOOST_TEST(row.at("frames") == "5");
      BOOST_TEST(row.at("timed_frames") == "3");
      BOOST_TEST(row.at("repeats") == "3");
      BOOST_TEST(row.at("step_length") == "5");
      BOOST_TEST(
          std::regex_match(row.at("date"), std::regex("20\\d\\d-\\d\\d-\\d\\dT\\d\\d:\\d\\d:\\d\\dZ")));
      const Grid grid(std::stoi(row.at("n")), std::stoi(row.at("n")));
      const auto seeds = std::stoul(row.at("seeds"));
      BOOST_TEST(
          row.number("pixels_per_seed") == static_cast<double>(grid.pixels()) / static_cast<double>(seeds),
          to_the_last_digits);
      const std::size_t waves = row.at("method") == "jfa" ? jump_flooding_plan(grid).size()
                                : row.at("method") == "djfa"
                                    ? dynamic_jump_flooding_plan(grid, seeds, 5).size()
                                    : 0;
      BOOST_TEST(row.number("waves") == static_cast<double>(waves));

      const double median = row.number("milliseconds_median");
      BOOST_TEST((0 < row.number("milliseconds_least") && row.number("milliseconds_least") <= median &&
                  median <= row.number("milliseconds_greatest")));
      const Row& jfa = find(rows, row, "jfa", "euclidean");
      const Row& djfae = find(rows, row, "djfa", "euclidean");
      BOOST_TEST(row.number("speedup_over_jfa") == jfa.number("milliseconds_median") / median,
                 to_the_last_digits);
      BOOST_TEST(row.number("speedup_over_djfae") == djfae.number("milliseconds_median") / median,
                 to_the_last_digits);
      for (const std::string reference : {"euclidean_jfa", "jfa", "exact"}) {
        const double mean = row.number("similarity_to_" + reference + "_mean");
        const double least = row.number("similarity_to_" + reference + "_least");
        BOOST_TEST((0 <= least && least <= mean && mean <= 100), reference);
      }
      // A wrong pixel has another label than the exact diagram; a tie may have.
      BOOST_TEST(row.number("wrong_percent_mean") <= 100 - row.number("similarity_to_exact_mean") + 1e-9);
      BOOST_TEST(row.number("wrong_percent_mean") <= row.number("wrong_percent_greatest") + 1e-9);
      BOOST_TEST(row.number("mean_excess") <= row.number("largest_excess"));
      if (row.at("method") == "exact") {
        BOOST_TEST(row.number("similarity_to_exact_least") == 100);
        BOOST_TEST(row.number("wrong_percent_greatest") == 0);
      }
      if (row.at("metric") == "manhattan") BOOST_TEST(row.number("similarity_to_euclidean_jfa_mean") < 97);
    }
  }
}

BOOST_AUTO_TEST_CASE(accuracy_is_that_of_simulate) {
  const TemporaryFolder folder;
  succeeds(folder, tiny + "--rng-seed 7 --step-length 4");
  const std::vector<Row> rows = rows_of(folder / "t.csv");
  const std::string simulate =
      "simulate --random 188 --size 97x97 --frames 5 --step-length 4 --rng-seed 7 --json ";
  const auto check = [&](const char* method, const char* metric, const std::string& other,
                         const char* column) {
    const json result = json::parse(succeeds(
        folder, simulate + fmt::format("--method {} --metric {} --compare-with {}", method, metric, other) +
                    (std::string(method) == "djfa" ? " --reach paper" : "")));
    const Row& row = find(rows, rows.back(), method, metric);
    const std::string name = std::string("similarity_to_") + column;
    BOOST_TEST(row.number(name + "_mean") == result.at("similarity").at("mean").get<double>(),
               to_the_last_digits);
    BOOST_TEST(row.number(name + "_least") == result.at("similarity").at("least").get<double>(),
               to_the_last_digits);
    if (other != "exact") return;
    for (const auto& [key, value] : result.at("errors").items())
      BOOST_TEST(row.number(key) == value.get<double>(), to_the_last_digits);
  };
  check("djfa", "euclidean", "jfa", "euclidean_jfa");
  check("djfa", "euclidean", "exact", "exact");
  check("jfa", "euclidean", "exact", "exact");
  check("djfa", "manhattan", "jfa --compare-metric euclidean", "euclidean_jfa");
  check("djfa", "manhattan", "jfa", "jfa");
  check("djfa", "manhattan", "exact", "exact");
}

BOOST_AUTO_TEST_CASE(more_seeds_than_pixels_are_allowed_and_coincident_ones_counted) {
  const TemporaryFolder folder;
  const std::string out = succeeds(
      folder, "vorocl-study evaluate --sizes 8 --seeds 100,200%,100 --frames 2 --timed-frames 1 -o t.csv");
  BOOST_TEST(out.find("2 configurations") != std::string::npos);
  const std::vector<Row> rows = rows_of(folder / "t.csv");
  check_each_once(rows, 2);
  std::set<std::pair<double, double>> places;
  for (const Point& point : points_of(Seeds::random(test_device(), Grid(8, 8), 100, 1)))
    places.insert({point.x, point.y});
  BOOST_TEST(rows[0].number("coincident_seeds") == static_cast<double>(100 - places.size()));
  BOOST_TEST(rows[0].at("seeds") == "100");
  BOOST_TEST(rows[rows_of_configuration].at("seeds") == "128");
}

BOOST_AUTO_TEST_CASE(a_line_that_was_cut_off_is_dropped_and_made_again) {
  const TemporaryFolder folder;
  succeeds(folder, tiny);
  const std::string whole = content_of(folder / "t.csv");
  const std::vector<Row> before = rows_of(folder / "t.csv");
  folder.file("t.csv", whole.substr(0, whole.size() - 30));
  const Result result = run(folder, tiny + "--resume --json");
  BOOST_TEST(result.exit_code == 0);
  BOOST_TEST(result.error.find("note: t.csv: the last line was cut off") != std::string::npos, result.error);
  BOOST_TEST(result.error.find("97 x 97 pixels with 188 seeds have 5 rows of 6") != std::string::npos,
             result.error);
  BOOST_TEST(json::parse(result.out).at("made_before") == 3);
  const std::vector<Row> after = rows_of(folder / "t.csv");
  BOOST_REQUIRE(after.size() == before.size());
  for (std::size_t i = 0; i < after.size(); ++i) {
    BOOST_TEST((lasting(after[i]) == lasting(before[i])), after[i].key());
    if (i < 3 * rows_of_configuration) BOOST_TEST((after[i] == before[i]), after[i].key());
  }

  folder.file("t.csv", whole.substr(0, 20));  // in the header
  BOOST_TEST(run(folder, tiny + "--resume").exit_code == 0);
  check_each_once(rows_of(folder / "t.csv"), 4);

  const std::string more =
      "vorocl-study evaluate --sizes 60,97 --seeds 40,30 --frames 5 --timed-frames 3 -o t.csv --resume "
      "--json";
  BOOST_TEST(json::parse(succeeds(folder, more)).at("made_before") == 2);
  check_each_once(rows_of(folder / "t.csv"), 6);
}

BOOST_AUTO_TEST_CASE(after_ctrl_c_it_goes_on_with_the_rest) {
  const TemporaryFolder folder;
  const std::vector<std::string> arguments = {
      "vorocl-study", "evaluate", "--sizes", "150",   "--seeds", "10,20,30,40,50,60,70,80,90",
      "--frames",     "40",       "-o",      "t.csv", "--resume"};
  const pid_t process = start(folder, arguments);
  const std::size_t some = 1 + 2 * rows_of_configuration;
  for (int i = 0; i < 600 && lines_of(folder / "t.csv").size() < some; ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  }
  kill(process, SIGINT);
  int status = 0;
  waitpid(process, &status, 0);
  BOOST_TEST(WIFEXITED(status));
  BOOST_TEST(WEXITSTATUS(status) == failure);
  const std::string before = content_of(folder / "t.csv");
  const std::size_t complete = rows_of(folder / "t.csv").size() / rows_of_configuration;
  BOOST_TEST((complete >= 2 && complete < 9));
  const std::string said = content_of(folder / "streams");
  BOOST_TEST(
      said.find(fmt::format("vorocl-study: error: interrupted; of 9 configurations {} are complete in t.csv",
                            complete)) != std::string::npos,
      said);
  std::string line;
  for (const std::string& argument : arguments) line += argument + " ";
  BOOST_TEST(json::parse(succeeds(folder, line + "--json")).at("made_before") == complete);
  BOOST_TEST(content_of(folder / "t.csv").rfind(before, 0) == 0u);
  check_each_once(rows_of(folder / "t.csv"), 9);
}

BOOST_AUTO_TEST_CASE(other_tables_are_not_gone_on_with) {
  const TemporaryFolder folder;
  succeeds(folder, tiny);
  const std::string whole = content_of(folder / "t.csv");
  refuses(folder, tiny, failure, {"t.csv exists", "--resume"});
  refuses(folder, tiny + "--resume --repeats 4 --rng-seed 2", failure,
          {"t.csv", "rng_seed is 1 there and 2 here, repeats is 3 there and 4 here"});
  BOOST_TEST(content_of(folder / "t.csv") == whole);

  const auto replaced = [&](const std::string& text, const std::string& by) {
    std::string changed = whole;
    for (std::size_t at = 0; (at = changed.find(text, at)) != std::string::npos; at += by.size())
      changed.replace(at, text.size(), by);
    return changed;
  };
  folder.file("t.csv", replaced("\n" VOROCL_VERSION ",", "\n0.0.1,"));
  refuses(folder, tiny + "--resume", failure,
          {"t.csv", "(version is 0.0.1 there and " VOROCL_VERSION " here)"});
  folder.file("t.csv", replaced("mean_excess", "mean_error"));
  refuses(folder, tiny + "--resume", failure, {"t.csv", "other columns"});
  folder.file("t.csv", replaced(command::to_csv({test_device().name()}), "\"A, \"\"B\"\"\""));
  refuses(folder, tiny + "--resume", failure,
          {"t.csv", "device is A, \"B\" there and " + test_device().name()});
  folder.file("t.csv", replaced(",djfa,", ","));
  refuses(folder, tiny + "--resume", failure, {"t.csv:3: this is no row of an evaluation"});
  for (const char* other : {"x,y\n1,2\n", "a note", "version\n1\n"}) {
    folder.file("t.csv", other);
    refuses(folder, tiny + "--resume", failure, {"t.csv is no evaluation"});
    BOOST_TEST(content_of(folder / "t.csv") == other);
  }
}

BOOST_AUTO_TEST_CASE(every_level_has_help) {
  const TemporaryFolder folder;
  const std::string help = succeeds(folder, "vorocl-study --help");
  for (const std::string subcommand : {"evaluate", "ablation"}) {
    BOOST_TEST(help.find(subcommand) != std::string::npos);
    BOOST_TEST(succeeds(folder, "vorocl-study " + subcommand + " --help").find("--json") !=
               std::string::npos);
  }
  BOOST_TEST(succeeds(folder, "vorocl-study --version") == "vorocl-study " VOROCL_VERSION "\n");
  refuses(folder, "vorocl-study  ", usage, {"no subcommand", "vorocl-study --help"});
  refuses(folder, "vorocl-study render", usage, {"render"});
}

BOOST_AUTO_TEST_CASE(bad_options_are_refused) {
  const TemporaryFolder folder;
  const std::string start = "vorocl-study evaluate -o t.csv ";
  refuses(folder, "vorocl-study evaluate", usage, {"-o"});
  refuses(folder, "vorocl-study evaluate -o t.txt", usage, {"t.txt", ".csv"});
  refuses(folder, "vorocl-study evaluate -o missing/t.csv", failure, {"missing", "does not exist"});
  refuses(folder, "vorocl-study evaluate -o /proc/t.csv", failure, {"cannot write /proc/t.csv"});
  for (const char* sizes : {"0", "-5", "32769", "10x10", "1e3"}) {
    refuses(folder, start + "--sizes " + sizes, usage, {"--sizes", "1 to 32768"});
  }
  for (const char* seeds : {"0", "-5", "0%", "-1%", "nan%", "inf%", "%", "1073741825", "ten"}) {
    refuses(folder, start + "--seeds " + seeds, usage, {"--seeds", seeds, "1 to 1073741824"});
  }
  refuses(folder, start + "--sizes 10 --seeds 0.1%", usage,
          {"--seeds", "0.1% of 10 x 10 pixels are 0 seeds"});
  refuses(folder, start + "--frames 0", usage, {"--frames"});
  refuses(folder, start + "--timed-frames 0", usage, {"--timed-frames"});
  refuses(folder, start + "--repeats 2", usage, {"--repeats", "3"});
  refuses(folder, start + "--step-length -1", usage, {"--step-length"});
  refuses(folder, start + "--device none", failure, {"none"});
}

BOOST_AUTO_TEST_CASE(fields_that_need_it_are_quoted) {
  const command::CsvFields fields = {"a", "b, c", "d \"e\"", ""};
  BOOST_TEST(command::to_csv(fields) == "a,\"b, c\",\"d \"\"e\"\"\",");
  BOOST_TEST((command::csv_fields(command::to_csv(fields)) == fields));
  BOOST_TEST(!command::csv_fields("a,\"b").has_value());
}
