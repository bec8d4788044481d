// vorocl relax: energies, the points it leaves, and what it writes.
#define BOOST_TEST_MODULE relax
#include <fmt/format.h>

#include <array>
#include <chrono>
#include <cmath>
#include <csignal>
#include <nlohmann/json.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/videoio.hpp>
#include <set>
#include <thread>

#include "formats/npy.hpp"
#include "formats/raster_files.hpp"
#include "host_measures.hpp"
#include "raw_images.hpp"
#include "run_command.hpp"
#include "trajectory_text.hpp"
#include "vorocl/picture.hpp"

using namespace vorocl;
using nlohmann::json;

namespace {

command::LabelImage labels_of(const TemporaryFolder& folder, const std::string& name) {
  return command::read_labels(folder / name);
}

/// Checks a table of energies against the JSON object, and that it falls.
void check_energies(const Table& table, const json& result) {
  BOOST_TEST(table.header == "round,energy,moved");
  BOOST_TEST_REQUIRE(table.rows.size() == result.at("rounds").get<std::size_t>() + 1);
  for (std::size_t round = 0; round < table.rows.size(); ++round) {
    const TableRow& row = table.rows[round];
    BOOST_TEST(row.at(0).value() == static_cast<double>(round));
    if (round == 0) continue;
    BOOST_TEST(row.at(1).value() < table.rows[round - 1].at(1).value());
    BOOST_TEST(row.at(2).value() > 0);
  }
  BOOST_TEST(table.rows.front().at(1).value() == result.at("energy_at_start").get<double>());
  BOOST_TEST(table.rows.back().at(1).value() == result.at("energy_at_end").get<double>());
}

}  // namespace

BOOST_AUTO_TEST_CASE(seeds_settle_and_their_points_give_the_same_diagram) {
  const TemporaryFolder folder;
  const json result =
      json::parse(succeeds(folder,
                           "relax --random 150 --size 200x140 --rounds 2000 --relaxed-points p.csv "
                           "--energy e.csv --labels l.npy --json"));
  BOOST_TEST(result.at("settled") == true);
  BOOST_TEST(result.at("seeds") == 150);
  BOOST_TEST(result.at("rounds").get<int>() > 3);
  BOOST_TEST(result.at("rounds").get<int>() < 2000);
  check_energies(read_table(folder / "e.csv"), result);

  const std::string again = " --size 200x140 --bounds 0,0,200,140 ";
  succeeds(folder, "cells --points p.csv --labels back.npy --cells c.csv" + again);
  BOOST_TEST(labels_of(folder, "back.npy").labels == labels_of(folder, "l.npy").labels);
  // No seed is farther from its cell's centroid than where it settles; the energy is that of the labels.
  const std::vector<TableRow> points = read_table(folder / "p.csv").rows;
  constexpr double near = 1.0 / 64 + 1.0 / 4096;
  for (const TableRow& row : read_table(folder / "c.csv").rows) {
    BOOST_TEST(std::abs(*row[1] - *row[4]) <= near);
    BOOST_TEST(std::abs(*row[2] - *row[5]) <= near);
    BOOST_TEST((points.at(static_cast<std::size_t>(*row[0])) == TableRow{row[0], row[1], row[2]}));
  }
  double energy = 0;
  each_pixel(Grid(200, 140), labels_of(folder, "l.npy").labels, [&](std::uint32_t label, const Pixel& pixel) {
    const double dx = centre(pixel).x - *points[label][1], dy = centre(pixel).y - *points[label][2];
    energy += dx * dx + dy * dy;
  });
  BOOST_TEST(result.at("energy_at_end").get<double>() == energy, boost::test_tools::tolerance(1e-6));
  const json nothing_left =
      json::parse(succeeds(folder, "relax --points p.csv --rounds 5 --relaxed-points q.npy --json" + again));
  BOOST_TEST(nothing_left.at("rounds") == 0);
  BOOST_TEST(nothing_left.at("settled") == true);
  succeeds(folder, "cells --points q.npy --labels q_back.npy" + again);
  BOOST_TEST(labels_of(folder, "q_back.npy").labels == labels_of(folder, "l.npy").labels);
  BOOST_TEST(read_raw_npy<double>(folder / "q.npy").type == "<f8");
}

BOOST_AUTO_TEST_CASE(exact_rounds_leave_cells_whose_centroids_are_their_points) {
  const TemporaryFolder folder;
  for (const std::string periodic : {"", " --periodic xy --bounds -3,0,17,14"}) {
    const std::string seeds =
        periodic.empty() ? " --random 40 --rng-seed 3" : " --points first.csv" + periodic;
    const json result = json::parse(succeeds(folder,
                                             "relax --exact --size 40x28 --rounds 500 --json "
                                             "--relaxed-points p.csv" +
                                                 seeds));
    BOOST_TEST(result.at("settled") == true);
    BOOST_TEST(result.at("energy_at_end").get<double>() < result.at("energy_at_start").get<double>());
    const std::string bounds = periodic.empty() ? " --bounds 0,0,40,28" : periodic;
    succeeds(folder,
             "cells --exact --points p.csv --cells c.csv --cell-columns x,y,centroid_x,centroid_y" + bounds);
    const double pixel = periodic.empty() ? 1 : 0.5;
    for (const TableRow& row : read_table(folder / "c.csv").rows) {
      BOOST_TEST(std::abs(*row[0] - *row[2]) < pixel / 64);
      BOOST_TEST(std::abs(*row[1] - *row[3]) < pixel / 64);
    }
    if (periodic.empty()) {
      std::string points = "id,x,y\n";
      for (const TableRow& row : read_table(folder / "p.csv").rows)
        points += fmt::format("{},{},{}\n", *row[0], *row[1] * *row[1] / 80 - 3, *row[2] / 2);
      folder.file("first.csv", points);
    }
  }
  const std::string exact = "relax --exact --points p.csv --size 9x9 --rounds 1 --relaxed-points q.csv ";
  refuses(folder, exact + "--snap", usage, {"--exact", "--snap"});
  refuses(folder, exact + "--density d.png", usage, {"--exact", "--density"});
}

BOOST_AUTO_TEST_CASE(whole_pixels_settle_as_points_and_snapped_ones_on_the_lattice) {
  const TemporaryFolder folder;
  const std::string grid = " --size 200x140 ", relax = "relax --rounds 60 --json --relaxed-points p.csv";
  std::string ascii = "P2\n200 140\n1\n";
  for (int i = 0; i < 200 * 140; ++i) ascii += i % 187 == 0 ? "1\n" : "0\n";
  folder.file("m.pgm", ascii);
  const auto end_of = [&](const std::string& seeds) {
    json result = json::parse(succeeds(folder, relax + seeds));
    result["at_centres"] = true;
    for (const TableRow& row : read_table(folder / "p.csv").rows)
      if (std::fmod(*row[1], 1) != 0.5) result["at_centres"] = false;
    return result;
  };
  const json random = end_of(" --random 150" + grid);
  succeeds(folder, "relax --rounds 0 --relaxed-points q.csv --random 150" + grid);
  const json snapped = end_of(" --snap --points q.csv --bounds 0,0,200,140" + grid);
  BOOST_TEST(random.at("energy_at_start") == snapped.at("energy_at_start"));
  BOOST_TEST(random.at("energy_at_end").get<double>() < snapped.at("energy_at_end").get<double>());
  for (const char* what : {"settled", "at_centres"}) {
    BOOST_TEST(snapped.at(what) == true);
    BOOST_TEST(random.at(what) == false);
    BOOST_TEST(end_of(" --mask m.pgm").at(what) == false);
  }
}

BOOST_AUTO_TEST_CASE(relaxed_points_have_the_units_of_tables) {
  const TemporaryFolder folder;
  folder.file("p.csv", "x,y\n-0.5,101\n-1.25,104.5\n-1.75,100.5\n");
  const std::string grid = " --bounds=-2,100,0,105 --y-up --size 80x200 ";  // 40 pixels per unit
  succeeds(folder, "relax --points p.csv --rounds 3 --relaxed-points data.csv --labels data.npy" + grid);
  succeeds(folder, "relax --points p.csv --rounds 3 --relaxed-points px.csv --units px" + grid);
  const std::vector<TableRow> data = read_table(folder / "data.csv").rows,
                              pixels = read_table(folder / "px.csv").rows;
  BOOST_TEST_REQUIRE(data.size() == 3u);
  for (std::size_t i = 0; i < 3; ++i) {
    BOOST_TEST(*data[i][1] == -2 + *pixels[i][1] / 40, boost::test_tools::tolerance(1e-12));
    BOOST_TEST(*data[i][2] == 105 - *pixels[i][2] / 40, boost::test_tools::tolerance(1e-12));
  }
  const auto labels = labels_of(folder, "data.npy").labels;
  succeeds(folder, "render --points data.csv --labels again.npy" + grid);
  BOOST_TEST(labels_of(folder, "again.npy").labels == labels);
  succeeds(folder, "render --points px.csv --bounds 0,0,80,200 --size 80x200 --labels again.npy");
  BOOST_TEST(labels_of(folder, "again.npy").labels == labels);
}

BOOST_AUTO_TEST_CASE(rounds_are_limited) {
  const TemporaryFolder folder;
  const std::string relax = "relax --random 150 --size 200x140 --energy e.csv ";
  const json one = json::parse(succeeds(folder, relax + "--rounds 1 --json"));
  BOOST_TEST(one.at("rounds") == 1);
  BOOST_TEST(one.at("settled") == false);
  check_energies(read_table(folder / "e.csv"), one);
  const json none = json::parse(succeeds(folder, relax + "--rounds 0 --json"));
  BOOST_TEST(none.at("rounds") == 0);
  BOOST_TEST(none.at("energy_at_end") == one.at("energy_at_start"));
  const std::string out = succeeds(folder, relax + "--rounds 2");
  BOOST_TEST(out.find("2 rounds, as many as allowed") != std::string::npos);
  BOOST_TEST(out.find(fmt::format("energy: {} at the start",
                                  one.at("energy_at_start").get<std::uint64_t>())) != std::string::npos);
}

BOOST_AUTO_TEST_CASE(seeds_without_a_cell_stay_and_particles_keep_their_ids) {
  const TemporaryFolder folder;
  folder.file("t.lammpstrj", command::dump(command::walled_box, "id x y",
                                           {"70 1.5 1.5", "9 1.5 1.5", "8 8.5 8.5", "7 8.5 1.5"}));
  const std::string relax =
      "relax --trajectory t.lammpstrj --y-down --size 10x10 --relaxed-points p.csv --labels l.npy ";
  const auto pixels_of_70 = [&] {
    const auto labels = labels_of(folder, "l.npy").labels;
    for (const std::uint32_t id : {7u, 8u, 9u}) BOOST_TEST(std::count(labels.begin(), labels.end(), id) > 0);
    return std::count(labels.begin(), labels.end(), 70u);
  };
  BOOST_TEST(succeeds(folder, relax + "--rounds 0").find("1 of 4 seeds own no pixel") != std::string::npos);
  BOOST_TEST(pixels_of_70() == 0);  // 9 has the cell
  BOOST_TEST(json::parse(succeeds(folder, relax + "--rounds 0 --json")).at("empty_cells") == 1);
  BOOST_TEST(succeeds(folder, relax + "--rounds 1").find("own no pixel") == std::string::npos);
  BOOST_TEST(pixels_of_70() > 0);  // 9 has gone to the middle of the cell
  const Table table = read_table(folder / "p.csv");
  BOOST_TEST(table.header == "id,x,y");
  BOOST_TEST_REQUIRE(table.rows.size() == 4u);
  BOOST_TEST(table.rows[0].front().value() == 7);
  BOOST_TEST((table.rows[3] == TableRow{70, 1.5, 1.5}));
  succeeds(folder, "relax --trajectory t.lammpstrj --y-down --size 10x10 --rounds 1 --relaxed-points p.npy");
  const std::vector<Point> points = command::read_npy_points(folder / "p.npy");
  BOOST_TEST((points[3].x == 1.5 && points[3].y == 1.5));  // of 70, the last by id
}

BOOST_AUTO_TEST_CASE(the_end_or_all_rounds_are_drawn) {
  const TemporaryFolder folder;
  const std::string relax = "relax --random 40 --size 64x48 --rounds 3 ";
  succeeds(folder, relax + "-o a.png --labels l.npy");
  succeeds(folder, relax + "-o r/%d.png");
  succeeds(folder, relax + "-o f.mp4 --fps 5");
  succeeds(folder, "cells --random 40 --size 64x48 --labels start.npy");
  const Grid grid(64, 48);
  const auto is_picture_of = [&](const std::string& picture, const std::string& labels) {
    return cv::norm(cv::imread(folder / picture), color_by_id(labels_of(folder, labels).labels, grid),
                    cv::NORM_INF) == 0;
  };
  BOOST_TEST(is_picture_of("a.png", "l.npy"));
  BOOST_TEST(is_picture_of("r/0.png", "start.npy"));
  BOOST_TEST(is_picture_of("r/3.png", "l.npy"));
  BOOST_TEST(!std::filesystem::exists(folder / "r/4.png"));
  BOOST_TEST(cv::VideoCapture(folder / "f.mp4").get(cv::CAP_PROP_FRAME_COUNT) == 4);
}

BOOST_AUTO_TEST_CASE(all_rounds_are_coloured_on_the_scale_of_the_first) {
  const TemporaryFolder folder;
  const std::string relax = "relax --random 40 --size 64x48 --rounds 3 --color area --color-bar ";
  succeeds(folder, relax + "-o r/%d.png --labels end.npy");
  succeeds(folder, relax + "-o end.png");
  succeeds(folder, "cells --random 40 --size 64x48 --labels start.npy");
  const Grid grid(64, 48);
  const auto areas_of = [](const std::vector<std::uint32_t>& labels) {
    std::vector<double> areas(40, 0);
    for (const std::uint32_t label : labels) ++areas.at(label);
    return areas;
  };
  const auto start = labels_of(folder, "start.npy").labels, end = labels_of(folder, "end.npy").labels;
  const Scale scale = range_of(start, areas_of(start)).value(), own = range_of(end, areas_of(end)).value();
  const auto is_picture_of = [&](const std::string& picture, const std::vector<std::uint32_t>& labels,
                                 const Scale& shown, bool many) {
    const cv::Mat cells = color_by_value(labels, grid, areas_of(labels), shown, Palette::viridis);
    const cv::Mat expected = with_color_bar(cells, {shown, Palette::viridis, "area (px)", true, many});
    return cv::norm(cv::imread(folder / picture), expected, cv::NORM_INF) == 0;
  };
  BOOST_TEST(is_picture_of("r/0.png", start, scale, true));
  BOOST_TEST(is_picture_of("r/3.png", end, scale, true));
  BOOST_TEST(is_picture_of("end.png", end, own, false));
}

BOOST_AUTO_TEST_CASE(seeds_take_the_values_of_their_column_along) {
  const TemporaryFolder folder;
  folder.file("p.csv", "x,y,mass\n5,5,10\n9,5,30\n5,9,20\n");
  succeeds(folder,
           "relax --points p.csv --bounds 0,0,40,30 --size 40x30 --rounds 5 --labels l.npy -o a.png "
           "--color column:mass");
  const cv::Mat expected = color_by_value(labels_of(folder, "l.npy").labels, Grid(40, 30), {10, 30, 20},
                                          {10, 30}, Palette::viridis);
  BOOST_TEST(cv::norm(cv::imread(folder / "a.png"), expected, cv::NORM_INF) == 0);
}

BOOST_AUTO_TEST_CASE(after_ctrl_c_the_files_show_the_last_round) {
  const TemporaryFolder folder;
  const pid_t process = start(folder, {"relax", "--random", "9000", "--size", "900x800", "--rounds", "100000",
                                       "-o", "r/%d.png", "--relaxed-points", "p.csv", "--energy", "e.csv"});
  for (int i = 0; i < 600 && !std::filesystem::exists(folder / "r/2.png"); ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  }
  kill(process, SIGINT);
  int status = 0;
  waitpid(process, &status, 0);
  BOOST_TEST(WIFEXITED(status));
  BOOST_TEST(WEXITSTATUS(status) == failure);
  BOOST_TEST((folder.names() == std::set<std::string>{"r", "p.csv", "e.csv", "streams"}));
  const std::size_t rounds = read_table(folder / "e.csv").rows.size() - 1;
  BOOST_TEST(rounds >= 2u);
  BOOST_TEST(std::filesystem::exists(folder / fmt::format("r/{}.png", rounds)));
  BOOST_TEST(!std::filesystem::exists(folder / fmt::format("r/{}.png", rounds + 1)));
  BOOST_TEST(
      content_of(folder / "streams") ==
      fmt::format("vorocl: error: interrupted after {} rounds; the files show the last of them\n", rounds));
  succeeds(folder, "cells --points p.csv --bounds 0,0,900,800 --size 900x800 --labels l.npy");
  BOOST_TEST(cv::norm(cv::imread(folder / fmt::format("r/{}.png", rounds)),
                      color_by_id(labels_of(folder, "l.npy").labels, Grid(900, 800)), cv::NORM_INF) == 0);
}

namespace {

/// A picture of 60 x 40 pixels whose left half is white and whose right half is dark, in some type and
/// format.
cv::Mat half_dark(int type, double white, double dark) {
  cv::Mat picture(40, 60, type, cv::Scalar::all(white));
  picture.colRange(30, 60).setTo(cv::Scalar::all(dark));
  return picture;
}

}  // namespace

BOOST_AUTO_TEST_CASE(dark_pixels_of_a_picture_and_great_numbers_are_dense) {
  const TemporaryFolder folder;
  cv::imwrite(folder / "grey.png", half_dark(CV_8UC1, 255, 51));
  cv::imwrite(folder / "deep.png", half_dark(CV_16UC1, 65535, 13107));
  cv::imwrite(folder / "colour.png", half_dark(CV_8UC3, 255, 51));
  std::vector<float> weights;
  for (int i = 0; i < 60 * 40; ++i) weights.push_back(i % 60 < 30 ? 0.0F : 204.0F);
  command::write_pixels(command::OutputFile(folder / "n.npy"), "density", command::Size(60, 40), weights);
  const auto relaxed = [&](const std::string& density, const std::string& size) {
    const json result = json::parse(succeeds(folder,
                                             "relax --random 40 --rounds 3 --relaxed-points p.csv --json "
                                             "--density " +
                                                 density + size));
    BOOST_TEST(result.at("width") == 60);
    BOOST_TEST(result.at("energy_at_end").get<double>() < result.at("energy_at_start").get<double>());
    return content_of(folder / "p.csv");
  };
  const std::string points = relaxed("n.npy", " --size 60x40");
  const auto write_npy = [&](const std::string& name, const std::string& type, const std::string& weight) {
    std::string npy = "\x93NUMPY\x01",
                header = "{'descr': '" + type + "', 'fortran_order': False, 'shape': (40, 60), }\n";
    npy += std::string(1, '\0') + static_cast<char>(header.size()) + '\0' + header;
    for (int i = 0; i < 60 * 40; ++i) npy += i % 60 < 30 ? std::string(weight.size(), '\0') : weight;
    folder.file(name, npy);
  };
  write_npy("half.npy", "<f2", {'\x60', '\x5a'});  // (1024 + 608) * 2^(22 - 25) = 204
  write_npy("bool.npy", "|b1", "\x01");
  BOOST_TEST(relaxed("half.npy", " --size 60x40") == points);
  BOOST_TEST(relaxed("bool.npy", " --size 60x40") == points);
  BOOST_TEST(relaxed("grey.png", "") == points);
  BOOST_TEST(relaxed("deep.png", "") == points);
  BOOST_TEST(relaxed("colour.png", "") == points);
  std::size_t dark = 0;
  for (const TableRow& row : read_table(folder / "p.csv").rows) dark += *row[1] >= 30 ? 1 : 0;
  BOOST_TEST(dark == 40u);
}

BOOST_AUTO_TEST_CASE(random_seeds_are_as_dense_as_the_square_root_of_the_density) {
  const TemporaryFolder folder;
  std::vector<float> weights;
  for (int i = 0; i < 60 * 40; ++i) weights.push_back(i % 60 < 20 ? 0.0F : i % 60 < 40 ? 0.25F : 2.25F);
  command::write_pixels(command::OutputFile(folder / "n.npy"), "density", command::Size(60, 40), weights);
  const auto drawn = [&](const std::string& options) {
    succeeds(folder, "relax --random 4000 --rounds 0 --density n.npy --relaxed-points p.csv" + options);
    return read_table(folder / "p.csv").rows;
  };
  const std::vector<TableRow> points = drawn("");
  std::array<int, 3> counts = {};
  double fractions = 0;
  std::set<std::pair<double, double>> places;
  for (const TableRow& row : points) {
    ++counts.at(static_cast<std::size_t>(*row[1] / 20));
    fractions += std::fmod(*row[1], 1) + std::fmod(*row[2], 1);
    places.emplace(*row[1], *row[2]);
  }
  BOOST_TEST(counts[0] == 0);
  BOOST_TEST(std::abs(counts[1] - 1000) < 110);  // four standard deviations
  BOOST_TEST(std::abs(fractions / 8000 - 0.5) < 0.013);
  BOOST_TEST(places.size() == 4000u);  // not the middles of 1,600 pixels
  BOOST_TEST((drawn("") == points));
  BOOST_TEST((drawn(" --rng-seed 2") != points));
}

BOOST_AUTO_TEST_CASE(densities_that_cannot_be_are_refused) {
  const TemporaryFolder folder;
  const auto write = [&](const std::string& name, float value) {
    std::vector<float> values(200, 1.0F);
    values[73] = value;
    command::write_pixels(command::OutputFile(folder / name), "density", command::Size(10, 20), values);
  };
  write("negative.npy", -2);
  write("nan.npy", std::nanf(""));
  cv::imwrite(folder / "white.png", cv::Mat(20, 10, CV_8UC1, cv::Scalar(255)));
  folder.file("points.npy", "1,2");
  const std::string relax = "relax --random 5 --rounds 3 --labels l.npy --density ";
  refuses(folder, relax + "negative.npy", failure, {"negative.npy", "pixel (3, 7)", "-2", "at least 0"});
  refuses(folder, relax + "nan.npy", failure, {"nan.npy holds", "nan", "pixel (3, 7)"});
  refuses(folder, relax + "white.png", failure, {"white.png weighs nothing anywhere"});
  refuses(folder, relax + "points.npy", failure, {"points.npy", ".npy"});
  refuses(folder, relax + "none.png", failure, {"none.png"});
  refuses(folder, relax + "white.png --size 20x20", failure, {"white.png is 10 x 20", "20 x 20"});
  refuses(folder, "relax --random 5 --rounds 3 --labels nan.npy --density nan.npy", usage,
          {"--labels would replace", "--density reads"});
}

BOOST_AUTO_TEST_CASE(bad_options_are_refused_before_the_work) {
  const TemporaryFolder folder;
  folder.file("p.csv", "1,2\n3,4\n");
  const std::string relax = "relax --random 5 --size 10x10 --rounds 3 --device none ";
  refuses(folder, "relax --random 5 --size 10x10", usage, {"--rounds"});
  refuses(folder, "relax --random 5 --size 10x10 --rounds -1", usage, {"--rounds"});
  refuses(folder, "relax --size 10x10 --rounds 3", usage, {"--random", "--points"});
  refuses(folder, relax + "-o a.gif", usage, {"a.gif", ".png"});
  refuses(folder, relax + "-o a%d%d.png", usage, {"%05d.png"});
  refuses(folder, relax + "-o r/%d.csv", usage, {"r/%d.csv", ".png"});
  refuses(folder, relax + "--labels l.png", usage, {"l.png", ".npy"});
  refuses(folder, relax + "--relaxed-points p.txt", usage, {"p.txt", ".csv, .npy"});
  refuses(folder, relax + "--energy e.npy", usage, {"e.npy", ".csv"});
  refuses(folder, relax + "--energy e.csv --relaxed-points e.csv", usage,
          {"e.csv", "--relaxed-points and --energy"});
  refuses(folder, relax + "--labels a.tif -o a.tif", usage, {"a.tif", "--labels and -o"});
  refuses(folder, relax + "--energy missing/e.csv", failure, {"missing/e.csv", "does not exist"});
  refuses(folder, relax + "--relaxed-points /proc/p.csv", failure, {"/proc/p.csv", "cannot write"});
  refuses(folder, relax + "-o new/%d.png --edges", failure, {"none"});
  refuses(folder, relax + "--edges", usage, {"--edges", "-o"});
}
