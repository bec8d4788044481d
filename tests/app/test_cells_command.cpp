// vorocl cells: its tables and images against straight host code on the labels it writes.
#define BOOST_TEST_MODULE cells_command
#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <opencv2/imgcodecs.hpp>

#include "formats/raster_files.hpp"
#include "host_measures.hpp"
#include "raw_images.hpp"
#include "run_command.hpp"
#include "trajectory_text.hpp"

using namespace vorocl;
using nlohmann::json;

namespace {

const std::string all_files =
    " --cells c.csv --adjacency a.csv --distance d.npy --border b.npy --labels l.npy";

/// Runs, and checks all files.
json checked(const TemporaryFolder& folder, const std::string& arguments, const SeedsById& seeds,
             Metric metric = Metric::euclidean, Axes axes = Axes::none) {
  json result;
  BOOST_TEST_CONTEXT(arguments) {
    result = json::parse(succeeds(folder, arguments + all_files + " --units px --json"));
    const LabelledGrid image = on_grid(command::read_labels(folder / "l.npy"), axes);
    check_cells_table(folder / "c.csv", image, seeds, metric);
    check_adjacency_table(folder / "a.csv", image);
    const auto distances = read_raw_npy<float>(folder / "d.npy");
    BOOST_TEST(distances.type == "<f4");
    BOOST_TEST((distances.width == static_cast<std::size_t>(image.grid.width()) &&
                distances.height == static_cast<std::size_t>(image.grid.height())));
    BOOST_TEST(wrong_distances(image, distances.values, seeds, metric) == 0u);

    const std::vector<TableRow> cells = cells_on_host(image, seeds, metric);
    double empty = 0, squares = 0;
    const double mean = static_cast<double>(image.grid.pixels()) / static_cast<double>(seeds.size());
    for (const TableRow& row : cells) {
      empty += *row[3] == 0 ? 1 : 0;
      squares += (*row[3] - mean) * (*row[3] - mean);
    }
    BOOST_TEST(result.at("cells") == seeds.size());
    BOOST_TEST(result.at("empty_cells") == empty);
    BOOST_TEST((result.at("seeds") == seeds.size() && result.at("unlabelled_pixels") == 0));
    BOOST_TEST(result.at("mean_area").get<double>() == mean, boost::test_tools::tolerance(1e-12));
    BOOST_TEST(
        result.at("area_deviation").get<double>() == std::sqrt(squares / static_cast<double>(seeds.size())),
        boost::test_tools::tolerance(1e-9));
    BOOST_TEST(result.at("pairs") == pairs_on_host(image).size());
    BOOST_TEST(result.at("milliseconds").get<double>() > 0);
  }
  return result;
}

std::vector<Pixel> random_seeds(const Grid& grid, std::size_t count) {
  std::vector<Pixel> pixels;
  for (const Point& seed : points_of(Seeds::random(test_device(), grid, count, 1))) {
    pixels.push_back({static_cast<int>(seed.x), static_cast<int>(seed.y)});
  }
  return pixels;
}

}  // namespace

BOOST_AUTO_TEST_CASE(random_seeds_have_the_cells_of_a_recount) {
  const TemporaryFolder folder;
  const Grid grid(210, 130);
  const json result = checked(folder, "cells --random 300 --size 210x130", numbered(random_seeds(grid, 300)));
  BOOST_TEST(result.at("method") == "exact");
  BOOST_TEST(result.at("metric") == "euclidean");
  BOOST_TEST(result.at("width") == 210);
  BOOST_TEST(result.at("height") == 130);
  // Where no four cells meet, each pixel corner of three cells is a vertex of a planar graph.
  BOOST_TEST(result.at("vertices").get<int>() > 300);
  checked(folder, "cells --random 300 --size 210x130 --metric manhattan --method jfa+2",
          numbered(random_seeds(grid, 300)), Metric::manhattan);
  checked(folder, "cells --random 1 --size 5x1", numbered(random_seeds(Grid(5, 1), 1)));
}

BOOST_AUTO_TEST_CASE(cells_reach_across_periodic_borders) {
  const TemporaryFolder folder;
  for (const auto& [name, axes] : {std::pair{"x", Axes::x}, std::pair{"xy", Axes::xy}}) {
    const Grid grid(150, 90, axes);
    checked(folder, fmt::format("cells --random 40 --size 150x90 --periodic {}", name),
            numbered(random_seeds(grid, 40)), Metric::euclidean, axes);
  }
}

BOOST_AUTO_TEST_CASE(a_whole_period_is_measured_across_its_ends_wherever_seeds_are) {
  const TemporaryFolder folder;
  // Two of them are above and below the picture, and own pixels.
  const SeedsById seeds =
      numbered({{3, 20}, {57, 11}, {30, 35}, {12, -4}, {50, 44}, {58, 30}, {1, 5}, {22, 18}});
  std::string text = "x,y\n";
  for (const auto& [id, pixel] : seeds) text += fmt::format("{},{}\n", centre(pixel).x, centre(pixel).y);
  folder.file("p.csv", text);
  run(folder,
      "cells --points p.csv --bounds 0,0,60,40 --size 60x40 --periodic x --cells c.csv --adjacency a.csv "
      "--labels l.npy --units px");
  const LabelledGrid image = on_grid(command::read_labels(folder / "l.npy"), Axes::x);
  check_cells_table(folder / "c.csv", image, seeds, Metric::euclidean);
  check_adjacency_table(folder / "a.csv", image);
}

BOOST_AUTO_TEST_CASE(columns_can_be_chosen) {
  const TemporaryFolder folder;
  const std::string cells = "cells --random 30 --size 40x30 --method jfa --cells ";
  succeeds(folder, cells + "all.csv");
  succeeds(folder, cells + "some.csv --cell-columns neighbours,id,largest_distance,centroid_y");
  succeeds(folder,
           "simulate --random 30 --size 40x30 --frames 1 --step-length 1 --method jfa --cells t.csv "
           "--cell-columns area");
  const Table all = read_table(folder / "all.csv"), some = read_table(folder / "some.csv");
  BOOST_TEST(some.header == "neighbours,id,largest_distance,centroid_y");
  BOOST_TEST_REQUIRE(some.rows.size() == all.rows.size());
  for (std::size_t i = 0; i < all.rows.size(); ++i) {
    const TableRow& row = all.rows[i];
    BOOST_TEST((some.rows[i] == TableRow{row[11], row[0], row[12], row[5]}));
  }
  // Alone, a column is made of no more measures than it needs.
  for (const auto& [name, column] :
       {std::pair{"x", 1u}, {"area", 3u}, {"right", 8u}, {"perimeter", 10u}, {"touches_border", 13u}}) {
    succeeds(folder, cells + "one.csv --cell-columns " + name);
    const Table one = read_table(folder / "one.csv");
    BOOST_TEST_REQUIRE(one.rows.size() == all.rows.size());
    for (std::size_t i = 0; i < all.rows.size(); ++i)
      BOOST_TEST((one.rows[i] == TableRow{all.rows[i][column]}), name << " of row " << i);
  }
  const Table frames = read_table(folder / "t.csv");
  BOOST_TEST(frames.header == "frame,timestep,area");
  BOOST_TEST(*frames.rows.at(0).at(2) == *all.rows.at(0).at(3));

  refuses(folder, cells + "a.csv --cell-columns id,neighbors", usage,
          {"did you mean neighbours? there are id, x, y"});
  refuses(folder, cells + "a.csv --cell-columns id,id", usage, {"\"id\" is given twice"});
  refuses(folder, "cells --random 30 --size 40x30 --cell-columns id", usage,
          {"--cell-columns requires --cells"});
}

BOOST_AUTO_TEST_CASE(cities_some_of_which_share_a_pixel) {
  const TemporaryFolder folder;
  const json result = checked(folder,
                              "cells --snap --points '" VOROCL_SAMPLES
                              "/cities-5000.csv' --bounds=-180,-90,180,90 --y-up --width 720",
                              numbered(cities(Grid(720, 360))));
  BOOST_TEST(result.at("empty_cells").get<int>() > 1000);
}

BOOST_AUTO_TEST_CASE(particles_go_by_the_ids_of_the_file) {
  const TemporaryFolder folder;
  const std::string path = VOROCL_SAMPLES "/lj-clusters.lammpstrj";
  std::vector<command::Frame> frames;
  command::read_frames(path, frames);
  const command::Size size(170, 142);
  for (const std::size_t number : {std::size_t{0}, std::size_t{7}}) {
    const command::Frame& frame = frames.at(number);
    SeedsById seeds;
    for (std::size_t i = 0; i < frame.ids.size(); ++i) {
      const command::Box& box = *frame.box;
      const Point& at = frame.positions[i];
      seeds[frame.ids[i]] = {
          static_cast<int>(std::floor((at.x - box.x0) * size.width() / (box.x1 - box.x0))),
          static_cast<int>(std::floor((at.y - box.y0) * size.height() / (box.y1 - box.y0)))};
    }
    BOOST_TEST(seeds.begin()->first == 1u);  // not an index
    const json result = checked(
        folder, fmt::format("cells --snap --trajectory '{}' --y-down --width 170 --frame {}", path, number),
        seeds, Metric::euclidean, Axes::xy);
    BOOST_TEST(result.at("empty_cells").get<int>() > 0);  // particles that share a pixel
  }
}

BOOST_AUTO_TEST_CASE(images_hold_the_same_in_every_format) {
  const TemporaryFolder folder;
  const std::string cells = "cells --random 40 --size 61x47 ";
  succeeds(folder, cells + "--distance d.npy --border b.npy --labels l.npy");
  succeeds(folder, cells + "--distance d.vti --border b.vti --labels l.vti");
  succeeds(folder, cells + "--distance d.tif --border b.png --labels l.tif");
  const auto distances = read_raw_npy<float>(folder / "d.npy");
  const auto borders = read_raw_npy<std::uint8_t>(folder / "b.npy");
  const auto labels = read_raw_npy<std::uint32_t>(folder / "l.npy");
  BOOST_TEST(borders.type == "|u1");
  BOOST_TEST(read_raw_vti<float>(folder / "d.vti").values == distances.values);
  BOOST_TEST(read_raw_vti<float>(folder / "d.vti").type == "Float32");
  BOOST_TEST(read_raw_vti<std::uint8_t>(folder / "b.vti").values == borders.values);
  BOOST_TEST(read_raw_vti<std::uint8_t>(folder / "b.vti").type == "UInt8");
  BOOST_TEST(read_raw_vti<std::uint32_t>(folder / "l.vti").values == labels.values);
  BOOST_TEST(command::read_labels(folder / "l.tif").labels == labels.values);
  const cv::Mat tiff = cv::imread(folder / "d.tif", cv::IMREAD_UNCHANGED);
  BOOST_TEST_REQUIRE(tiff.type() == CV_32F);
  BOOST_TEST((std::vector<float>(tiff.begin<float>(), tiff.end<float>()) == distances.values));
  const cv::Mat mask = cv::imread(folder / "b.png", cv::IMREAD_UNCHANGED);
  BOOST_TEST_REQUIRE(mask.type() == CV_8U);

  const Grid grid(61, 47);
  std::size_t wrong = 0;
  each_pixel(grid, labels.values, [&](std::uint32_t label, const Pixel& pixel) {
    bool border = false;
    for (const Pixel& other : beside(grid, pixel)) border |= label_at(grid, labels.values, other) != label;
    wrong += borders.values[index_of(grid, pixel)] != (border ? 1 : 0) ? 1 : 0;
    const auto at = cv::Point(static_cast<int>(pixel.x), static_cast<int>(pixel.y));
    wrong += mask.at<std::uint8_t>(at) != (border ? 255 : 0) ? 1 : 0;
  });
  BOOST_TEST(wrong == 0u);
}

BOOST_AUTO_TEST_CASE(without_seeds_there_are_no_cells) {
  const TemporaryFolder folder;
  folder.file("none.xyz", "0\n\n");
  const json result = json::parse(succeeds(
      folder,
      "cells --trajectory none.xyz --size 9x5 --cells c.csv --adjacency a.csv --distance d.npy --json"));
  BOOST_TEST(result.at("cells") == 0);
  BOOST_TEST(result.at("mean_area") == 0);
  BOOST_TEST(read_table(folder / "c.csv").rows.empty());
  BOOST_TEST(read_table(folder / "a.csv").rows.empty());
  for (const float d : read_raw_npy<float>(folder / "d.npy").values) BOOST_TEST(std::isinf(d));
}

BOOST_AUTO_TEST_CASE(the_statistics_are_printed) {
  const TemporaryFolder folder;
  const std::string out = succeeds(folder, "cells --random 20 --size 40x30 --cells c.csv --border b.png");
  for (const char* part : {"exact: 20 seeds", "40 x 30", "mean area is 60, with a deviation of", "(px)",
                           "vertices", "pairs", "wrote c.csv\n"}) {
    BOOST_TEST(out.find(part) != std::string::npos, part);
  }
  BOOST_TEST((folder.names() == std::set<std::string>{"c.csv", "b.png"}));
}

BOOST_AUTO_TEST_CASE(bad_outputs_are_refused_before_the_work) {
  const TemporaryFolder folder;
  std::filesystem::create_directory(folder / "folder.csv");
  // A device that does not exist would be the next error: it is not reached.
  const std::string cells = "cells --random 5 --size 10x10 --device none ";
  refuses(folder, cells, usage,
          {"nothing to write", "--cells", "--adjacency", "--distance", "--border", "--labels"});
  refuses(folder, cells + "--cells c.txt", usage, {"c.txt", ".csv"});
  refuses(folder, cells + "--adjacency a.npy", usage, {"a.npy", ".csv"});
  refuses(folder, cells + "--distance d.png", usage, {"d.png", ".npy, .tif, .tiff, .vti"});
  refuses(folder, cells + "--border b.tif", usage, {"b.tif", ".npy, .png, .vti"});
  refuses(folder, cells + "--labels l.csv", usage, {"l.csv", ".npy, .tif, .tiff, .vti"});
  refuses(folder, cells + "--cells missing/c.csv", failure, {"missing/c.csv", "does not exist"});
  refuses(folder, cells + "--cells c.csv --adjacency /proc/a.csv", failure, {"/proc/a.csv", "cannot write"});
  refuses(folder, cells + "--cells folder.csv", failure, {"folder.csv", "folder"});
  refuses(folder, cells + "--cells a.csv --adjacency a.csv", usage, {"a.csv", "--cells and --adjacency"});
  refuses(folder, cells + "--distance a.npy --labels ./a.npy", usage, {"./a.npy", "--distance and --labels"});
  refuses(folder, "cells --size 10x10 --cells c.csv", usage, {"--random", "--points"});
  refuses(folder, "cells --random 5 --cells c.csv", usage, {"--size"});
  refuses(folder, "cells --random 5 --size 9x9 --cells c.csv --method chess", usage, {"chess", "exact"});
  refuses(folder, "cells --random 5 --size 9x9 --cells c.csv --extra-waves 1", usage,
          {"--extra-waves", "djfa"});
  refuses(folder, "cells --random 5 --size 9x9 --cells c.csv --frame 1", usage, {"--frame", "--trajectory"});
}
