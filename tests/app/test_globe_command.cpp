// vorocl cells and render by great circles: what the library finds, in degrees and kilometres.
#define BOOST_TEST_MODULE globe_command
#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <opencv2/imgcodecs.hpp>
#include <random>

#include "formats/npy.hpp"
#include "formats/raster_files.hpp"
#include "host_measures.hpp"
#include "raw_images.hpp"
#include "run_command.hpp"

using namespace vorocl;
using nlohmann::json;

namespace {

constexpr const char* by = " --metric great-circle";

std::vector<Point> write_places(const TemporaryFolder& folder, std::size_t count) {
  std::mt19937 rng(3);
  std::uniform_real_distribution<double> longitude(-180, 540), latitude(-90, 90);
  std::vector<Point> places;
  std::string text = "lon,lat\n";
  for (std::size_t i = 0; i < count; ++i) {
    places.push_back({longitude(rng), latitude(rng)});
    text += fmt::format("{},{}\n", places.back().x, places.back().y);
  }
  folder.file("p.csv", text);
  return places;
}

void check_cells(const TemporaryFolder& folder, const Grid& grid, const std::string& arguments,
                 const std::vector<Point>& places) {
  Diagram diagram(test_device(), grid);
  exact_diagram(Seeds(test_device(), grid, places), diagram, {Metric::great_circle});
  const json result = json::parse(
      succeeds(folder, "cells --points p.csv" + arguments + by +
                           " --labels l.npy --distance d.npy --cells c.csv --adjacency a.csv --json"));
  BOOST_TEST(result.at("metric") == "great-circle");
  BOOST_TEST(result.at("area_unit") == "km^2");
  BOOST_TEST(result.at("length_unit") == "km");
  const std::vector<std::uint32_t> labels = diagram.read();
  BOOST_TEST(command::read_labels(folder / "l.npy").labels == labels);
  Field<float> field;
  distance_field(diagram, field);
  const std::vector<float> distances = field.read();
  BOOST_TEST(read_raw_npy<float>(folder / "d.npy").values == distances);
  const Table table = read_table(folder / "c.csv"), pairs = read_table(folder / "a.csv");
  BOOST_TEST(table.header == "id,x,y,area,centroid_x,centroid_y,neighbours,largest_distance,touches_border");
  BOOST_TEST(pairs.header == "a,b,length_px");
  BOOST_TEST(result.at("pairs") == pairs.rows.size());
  const std::vector<CellRow> cells = cell_table(diagram);
  double sum = 0;
  for (const TableRow& row : table.rows) {
    const CellRow& cell = cells.at(static_cast<std::size_t>(*row[0]));
    sum += *row[3];
    BOOST_TEST(std::abs(std::remainder(*row[1] - cell.seed.x, 360)) < 1e-9);
    BOOST_TEST(*row[2] == cell.seed.y);
    BOOST_TEST(*row[3] == cell.area, boost::test_tools::tolerance(1e-12));
    BOOST_TEST(*row[6] == cell.neighbours);
    BOOST_TEST(*row[8] == (cell.touches_border ? 1 : 0));
    if (cell.pixels == 0) continue;
    BOOST_TEST(*row[4] == cell.centroid.x, boost::test_tools::tolerance(1e-12));
    double farthest = 0;
    for (std::size_t pixel = 0; pixel < labels.size(); ++pixel) {
      if (labels[pixel] == cell.id) farthest = std::max(farthest, static_cast<double>(distances[pixel]));
    }
    BOOST_TEST(*row[7] == farthest);
  }
  BOOST_TEST(result.at("cells") == table.rows.size());
  BOOST_TEST(result.at("mean_area").get<double>() == sum / static_cast<double>(table.rows.size()),
             boost::test_tools::tolerance(1e-9));
}

}  // namespace

BOOST_AUTO_TEST_CASE(cells_of_the_globe_and_of_a_part_are_the_library_s) {
  const TemporaryFolder folder;
  const std::vector<Point> places = write_places(folder, 60);
  check_cells(folder, Grid(Axis(36, -180, 180).periodic(), Axis(18, -90, 90).closed().reversed()),
              " --width 36", places);
  check_cells(folder, Grid(Axis(30, 170, 200).closed(), Axis(20, -50, -20).closed()),
              " --bounds 170,-50,200,-20 --size 30x20 --y-down", places);
}

BOOST_AUTO_TEST_CASE(pictures_by_great_circles_are_drawn) {
  const TemporaryFolder folder;
  write_places(folder, 30);
  for (const std::string color : {"id", "area", "distance --contours", "neighbours"}) {
    succeeds(folder,
             "render --points p.csv --width 72 -o a.png --edges --points-overlay --color " + color + by);
    BOOST_TEST(cv::imread(folder / "a.png").size() == cv::Size(72, 36));
  }
  const json result = json::parse(succeeds(
      folder,
      "render --points p.csv --width 72 --max-distance 1000 --labels l.npy --json" + std::string(by)));
  const std::vector<std::uint32_t> labels = command::read_labels(folder / "l.npy").labels;
  BOOST_TEST(result.at("beyond_max_distance").get<std::ptrdiff_t>() ==
             std::count(labels.begin(), labels.end(), no_label));
}

BOOST_AUTO_TEST_CASE(what_is_not_of_the_globe_is_refused) {
  const TemporaryFolder folder;
  write_places(folder, 5);
  folder.file("far.csv", "lon,lat\n1,2\n3,-91\n");
  const std::string render = "render -o a.png --width 36" + std::string(by),
                    of_points = render + " --points p.csv";
  for (const std::string option : {"--periodic x", "--domain 0,0,1,1", "--domain 0,0,1,1 --periodic x",
                                   "--outside count", "--units px", "--margin 5"})
    refuses(folder, of_points + " " + option, usage, {option.substr(0, option.find(' ')), "great-circle"});
  refuses(folder, "render -o a.png --random 5 --size 8x8" + std::string(by), usage, {"--points"});
  refuses(folder, of_points + " --method jfa", usage, {"jfa", "great circles"});
  refuses(folder, render + " --points far.csv", failure, {"far.csv:3", "-91", "no latitude"});
  command::write_npy_points(command::OutputFile(folder / "far.npy"), {{1, 2}, {3, -91}});
  refuses(folder, render + " --points far.npy", failure, {"far.npy", "point 1", "-90 to 90"});
  refuses(folder, of_points + " --bounds=170,-50,-170,50", usage, {"date line", "170,-50,190,50"});
  refuses(folder, of_points + " --bounds=1700,-50,-170,50", usage, {"X0 < X1 and Y0 < Y1\n"});
  const std::string with_labels = of_points + " --labels l.tif --crs EPSG:";
  refuses(folder, with_labels + "32632", usage, {"--crs EPSG:32632", "no degrees", "EPSG:4326"});
  succeeds(folder, with_labels + "4326");
  refuses(folder, of_points + " --bounds 0,0,361,90", failure, {"no longer than 360"});
  refuses(folder, "cells --exact --points p.csv --cells c.csv" + std::string(by), usage, {"--metric"});
  refuses(folder,
          "cells --points p.csv --width 8 --cells c.csv --cell-columns id,perimeter" + std::string(by), usage,
          {"perimeter", "the globe"});
  for (const std::string command :
       {"bench --random 5 --size 8x8", "tiles --random 5 --size 8x8 --labels l.npy",
        "compare l.npy --random 5", "simulate --random 5 --size 8x8 -o a.mp4"})
    refuses(folder, command + by, usage,
            {"great-circle", "of render and cells", "two files", "euclidean, manhattan"});
}
