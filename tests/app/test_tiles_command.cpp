// vorocl tiles: the same diagrams, tables and pictures as of one grid, and what it refuses.
#define BOOST_TEST_MODULE tiles_command
#include <nlohmann/json.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <sstream>

#include "app/sources/random_seeds.hpp"
#include "app/terminal/console.hpp"
#include "formats/npy.hpp"
#include "formats/raster_files.hpp"
#include "run_command.hpp"

using namespace vorocl;
using namespace vorocl::command;

namespace {

const std::string csv = "x,y\n1,2\n30,4\n-20,-5\n55,66\n55,67\n12.5,9\n";

/// Each with what a tiling can get wrong: sides that tiles do not divide, points outside, periods.
const std::string planes[] = {
    "--random 200 --size 150x100",
    "--random 3 --size 97x203 --rng-seed 18446744073709551615",
    "--random 1 --size 1x130",
    "--random 2000 --size 64x64 --metric manhattan",
    "--random 40 --size 130x70 --periodic x",
    "--random 40 --size 130x70 --periodic xy --metric manhattan",
    "--points p.csv --size 80x60",
    "--points p.csv --size 80x60 --no-snap",
    "--points p.csv --size 90x60 --bounds 3,-7.5,40.7,61 --y-up --no-snap",
    "--points p.csv --size 90x60 --bounds -20,0,60,40 --periodic y --no-snap",
    "--points p.csv --size 90x60 --bounds 0,0,60,40 --y-up",
    "--points p.csv --size 90x60 --bounds -20,0,60,40 --periodic y",
    "--points p.csv --size 90x60 --bounds -10,0,40,40 --periodic y",  // and points outside along x
    "--points p.csv --size 90x60 --bounds 0,0,60,50 --periodic x --metric manhattan",
};

void write_points_file(const TemporaryFolder& folder) { folder.file("p.csv", csv); }

/// The rows of a table, by the names of its columns.
std::vector<std::map<std::string, std::string>> rows_of(const std::string& path) {
  std::istringstream text(content_of(path));
  const auto fields_of = [](const std::string& line) {
    std::vector<std::string> fields;
    std::istringstream rest(line);
    for (std::string field; std::getline(rest, field, ',');) fields.push_back(field);
    return fields;
  };
  std::string line;
  std::getline(text, line);
  const std::vector<std::string> names = fields_of(line);
  std::vector<std::map<std::string, std::string>> rows;
  while (std::getline(text, line)) {
    const std::vector<std::string> fields = fields_of(line);
    rows.emplace_back();
    for (std::size_t i = 0; i < names.size(); ++i) rows.back()[names[i]] = fields.at(i);
  }
  return rows;
}

}  // namespace

BOOST_AUTO_TEST_CASE(labels_are_those_of_one_grid) {
  for (const std::string& plane : planes) {
    const TemporaryFolder folder;
    write_points_file(folder);
    run(folder, "render " + plane + " --labels whole.npy");
    for (const char* const tile : {"16", "33", "64", "4096"}) {
      const Result result = run(folder, "tiles " + plane + " --labels tiles.npy --tile " + std::string(tile));
      BOOST_TEST_CONTEXT(plane << " in tiles of " << tile << "\n" << result.error) {
        BOOST_TEST(result.exit_code == 0);
        BOOST_TEST((content_of(folder / "tiles.npy") == content_of(folder / "whole.npy")));
      }
    }
  }
}

/// A mask of 150 x 100 pixels with a few seeds, a disc of them and a hole in it.
void write_mask(const TemporaryFolder& folder) {
  cv::Mat mask(100, 150, CV_8U, cv::Scalar(0));
  cv::circle(mask, {40, 50}, 30, cv::Scalar(200), cv::FILLED);
  cv::circle(mask, {45, 55}, 12, cv::Scalar(0), cv::FILLED);
  for (const cv::Point seed : {cv::Point(149, 0), {120, 99}, {100, 3}, {100, 5}})
    mask.at<std::uint8_t>(seed) = 1;
  cv::imwrite(folder / "m.png", mask);
  cv::imwrite(folder / "m.tif", mask);
  write_npy(OutputFile(folder / "m.npy"), Size(150, 100),
            std::vector<std::uint8_t>(mask.begin<std::uint8_t>(), mask.end<std::uint8_t>()));
}

BOOST_AUTO_TEST_CASE(labels_of_masks_are_those_of_one_grid) {
  const TemporaryFolder folder;
  write_mask(folder);
  for (const std::string more :
       {"", " --threshold 100", " --periodic xy", " --metric manhattan --periodic y"}) {
    succeeds(folder, "render --mask m.png" + more + " --labels whole.npy");
    const std::string whole = content_of(folder / "whole.npy");
    for (const std::string mask : {"m.png", "m.tif", "m.npy"}) {
      for (const std::string tile : {"16", "33", "4096"}) {
        succeeds(folder, "tiles --mask " + mask + more + " --tile " + tile + " --labels tiles.npy");
        BOOST_TEST((content_of(folder / "tiles.npy") == whole), mask << more << " in tiles of " << tile);
      }
    }
  }
  const Json result = Json::parse(succeeds(folder, "tiles --mask m.npy --labels a.zarr --json"));
  BOOST_TEST(result.at("seeds") == cv::countNonZero(cv::imread(folder / "m.png", cv::IMREAD_UNCHANGED)));
}

BOOST_AUTO_TEST_CASE(masks_may_be_longer_than_a_grid_of_one_diagram) {
  const TemporaryFolder folder;
  constexpr int width = 40000;
  std::string pixels(2 * width, '\0');
  pixels[width + 100] = pixels[width - 1] = 1;
  const std::string header = "{'descr': '|u1', 'fortran_order': False, 'shape': (2, 40000), }";
  folder.file("m.npy", std::string("\x93NUMPY\x01\x00", 8) + static_cast<char>(header.size() + 1) + '\0' +
                           header + '\n' + pixels);
  refuses(folder, "render --mask m.npy --labels a.npy", failure, {"m.npy", "40000"});
  succeeds(folder, "tiles --mask m.npy --tile 1000 --labels a.npy");
  const std::string labels = content_of(folder / "a.npy");
  const std::size_t first = labels.size() - 2 * width * sizeof(std::uint32_t);
  std::size_t wrong = 0;
  for (std::size_t i = 0; i < 2 * width; ++i) {
    const auto x = static_cast<int>(i % width), y = static_cast<int>(i / width);
    const auto squared = [](int dx, int dy) { return static_cast<double>(dx) * dx + dy * dy; };
    const bool is_left = squared(x - 100, y - 1) < squared(x - (width - 1), y);
    wrong += labels[first + i * sizeof(std::uint32_t)] != (is_left ? 1 : 0);
  }
  BOOST_TEST(wrong == 0u);
}

BOOST_AUTO_TEST_CASE(what_masks_in_tiles_cannot_have_is_refused) {
  const TemporaryFolder folder;
  write_mask(folder);
  refuses(folder, "tiles --mask m.npy --labels a.npy --bounds 0,0,1,1", usage, {"--bounds needs --points"});
  refuses(folder, "tiles --mask m.npy --labels a.npy --size 100x150", failure,
          {"m.npy is 150 x 100 pixels and --size says 100 x 150"});
  refuses(folder, "tiles --mask m.npy --labels a.npy --threshold 255", failure,
          {"m.npy has no pixel that is greater than 255"});
  for (const std::string array : {"m.zarr", "m.zarr/"})
    refuses(folder, "tiles --mask " + array + " --labels a.npy", failure, {array, "Zarr", "mask_tiles()"});
  for (const std::string file : {"--labels", "--distance"})
    refuses(folder, "tiles --mask m.npy " + file + " m.npy", usage,
            {"would replace the file that --mask reads"});
  refuses(folder, "tiles --random 5 --size 9x9 --threshold 1 --labels a.npy", usage,
          {"--threshold", "--mask"});
}

BOOST_AUTO_TEST_CASE(distances_are_those_of_one_grid) {
  std::vector<std::string> all(std::begin(planes), std::end(planes));
  for (const std::string more :
       {"", " --threshold 100", " --periodic xy", " --metric manhattan --periodic y"})
    all.push_back("--mask m.npy" + more);
  all.push_back("--points p.csv --size 90x60 --bounds 0,0,90,90");  // in pixels, which are no squares
  for (const std::string& plane : all) {
    const TemporaryFolder folder;
    write_points_file(folder);
    write_mask(folder);
    run(folder, "cells " + plane + " --distance whole.npy");
    for (const std::string tile : {"33", "4096"}) {
      const Result result =
          run(folder, "tiles " + plane + " --tile " + tile + " --distance tiles.npy --labels l.npy -o p.png");
      BOOST_TEST((content_of(folder / "tiles.npy") == content_of(folder / "whole.npy")),
                 plane << " in tiles of " << tile << "\n"
                       << result.error);
    }
  }
  // Alone, in a file that says where it lies, and gone on with.
  const TemporaryFolder folder;
  write_points_file(folder);
  const std::string plane = "--points p.csv --size 80x60 --bounds 0,0,40,30 ";
  const std::string tiles = "tiles " + plane + "--tile 16 --resume --distance ";
  run(folder, "cells " + plane + "--distance whole.tif");
  for (const std::string name : {"d.zarr/", "d.tif"})
    BOOST_TEST(run(folder, tiles + name).out.find("wrote d.") != std::string::npos);
  BOOST_TEST(content_of(folder / "d.tif").find(std::string("inf\0", 4)) != std::string::npos);
  const cv::Mat whole = cv::imread(folder / "whole.tif", cv::IMREAD_UNCHANGED),
                found = cv::imread(folder / "d.tif", cv::IMREAD_UNCHANGED);
  BOOST_REQUIRE((found.size() == whole.size() && found.type() == CV_32F));
  BOOST_TEST(cv::norm(whole, found, cv::NORM_INF) == 0);
}

BOOST_AUTO_TEST_CASE(tables_are_those_of_one_grid) {
  for (const std::string& plane : planes) {
    const TemporaryFolder folder;
    write_points_file(folder);
    run(folder, "cells " + plane + " --cells whole.csv --adjacency pairs_of_whole.csv");
    const Result result =
        run(folder, "tiles " + plane + " --tile 32 --cells tiles.csv --adjacency pairs.csv");
    BOOST_TEST_CONTEXT(plane << "\n" << result.error) {
      BOOST_TEST((content_of(folder / "pairs.csv") == content_of(folder / "pairs_of_whole.csv")));
      auto expected = rows_of(folder / "whole.csv");
      expected.erase(std::remove_if(expected.begin(), expected.end(),
                                    [](const auto& row) { return row.at("area") == "0"; }),
                     expected.end());
      for (auto& row : expected) {
        for (const char* const column : {"largest_distance", "largest_distance_px"}) row.erase(column);
      }
      BOOST_TEST((rows_of(folder / "tiles.csv") == expected));
    }
  }
}

BOOST_AUTO_TEST_CASE(tables_say_where_seeds_are_and_what_their_rows_have) {
  const TemporaryFolder folder;
  write_mask(folder);
  write_npy_points(folder / "p.npy", {{1, 2}, {30, 4}, {-20, -5}, {55, 66}, {12.5, 9}});
  const auto places_by = [&](const std::string& command) {
    BOOST_TEST(run(folder, command + " --cells c.csv").exit_code == 0);
    std::vector<std::string> places;
    for (const auto& row : rows_of(folder / "c.csv")) {
      if (row.at("area") != "0") places.push_back(row.at("id") + ": " + row.at("x") + ", " + row.at("y"));
    }
    return places;
  };
  for (const std::string seeds : {" --mask m.npy", " --points p.npy --size 80x60 --y-up"})
    BOOST_TEST(places_by("tiles" + seeds) == places_by("cells" + seeds), boost::test_tools::per_element());

  folder.file("k.csv", "id,name,x,y,area\n70,\"a, b\",1,2,5\n30,c,7,3,6\n");
  const std::string tiles = "tiles --points k.csv --size 9x9 --bounds 0,0,9,9 --snap ",
                    cells = "--cells k2.csv ";
  BOOST_TEST(run(folder, tiles + cells + "--keep all").exit_code == 0);
  BOOST_TEST(content_of(folder / "k2.csv").find(",touches_border,input_id,name,input_area\n0,1.5,2.5,") !=
             std::string::npos);
  BOOST_TEST(content_of(folder / "k2.csv").find(",1,70,\"a, b\",5\n1,7.5,3.5,") != std::string::npos);
  refuses(folder, tiles + "--labels l.npy --keep name", usage, {"--keep", "--cells"});
  refuses(folder, "tiles --random 5 --size 9x9 --keep name " + cells, usage, {"--keep", "--points"});
}

BOOST_AUTO_TEST_CASE(rows_without_a_coordinate_are_left_out_and_the_others_keep_their_numbers) {
  const TemporaryFolder folder;
  folder.file("p.csv", "x,y,v\nNA,1,a\n1,2,b\n30,4,c\n,,d\n-20,-5,e\n55,66,f\n5,NaN,g\n");
  const std::string seeds = " --points p.csv --size 80x60 --keep v ";
  const auto cells = run(folder, "cells" + seeds + "--labels a.npy --cells a.csv"),
             tiles = run(folder, "tiles" + seeds + "--labels b.npy --cells b.csv");
  BOOST_TEST((cells.exit_code == 0 && tiles.exit_code == 0), tiles.error);
  for (const std::string& said : {cells.error, tiles.error})
    BOOST_TEST(said.find("p.csv: 3 of 7 rows lack a coordinate and are left out") != std::string::npos, said);
  BOOST_TEST((content_of(folder / "a.npy") == content_of(folder / "b.npy")));
  for (const char* const column : {"id", "x", "v", "area"}) {
    BOOST_TEST(transformed(rows_of(folder / "a.csv"), [&](const auto& row) { return row.at(column); }) ==
                   transformed(rows_of(folder / "b.csv"), [&](const auto& row) { return row.at(column); }),
               boost::test_tools::per_element());
  }
  folder.file("none.csv", "x,y\nNA,1\n2,\n");
  refuses(folder, "tiles --points none.csv --size 8x6 --labels a.npy", failure,
          {"none.csv", "all rows lack"});
}

BOOST_AUTO_TEST_CASE(random_pixels_are_those_of_a_device) {
  const Device device = Device::select();
  for (const std::uint64_t rng_seed : {std::uint64_t{1}, std::uint64_t{0xfedcba9876543210}}) {
    const Grid grid(1000, 777);
    const Seeds seeds = Seeds::random(device, grid, 500, rng_seed);
    const auto points = seeds.read();
    for (std::uint32_t id = 0; id < 500; ++id) {
      const Point pixel = random_pixel(grid, id, rng_seed);
      BOOST_TEST((pixel.x == points[id]->x && pixel.y == points[id]->y));
    }
  }
}

BOOST_AUTO_TEST_CASE(points_of_an_array_make_the_same_plane) {
  const TemporaryFolder folder;
  write_points_file(folder);
  write_npy_points(folder / "p.npy", {{1, 2}, {30, 4}, {-20, -5}, {55, 66}, {55, 67}, {12.5, 9}});
  BOOST_TEST(run(folder, "tiles --points p.csv --size 80x60 --labels a.npy").exit_code == 0);
  BOOST_TEST(run(folder, "tiles --points p.npy --size 80x60 --labels b.npy").exit_code == 0);
  BOOST_TEST((content_of(folder / "a.npy") == content_of(folder / "b.npy")));
}

BOOST_AUTO_TEST_CASE(a_part_has_the_labels_of_the_whole) {
  const TemporaryFolder folder;
  const std::string plane = "--random 60 --size 150x100 --periodic x ";
  run(folder, "render " + plane + "--labels whole.npy");
  const LabelImage whole = read_labels(folder / "whole.npy");
  succeeds(folder, "tiles " + plane + "--only 140,13,150,90 --tile 16 --labels part.npy -o part.png");
  const LabelImage part = read_labels(folder / "part.npy");
  BOOST_REQUIRE((part.size == Size(10, 77)));
  std::size_t wrong = 0;
  for (std::size_t y = 0; y < 77; ++y) {
    for (std::size_t x = 0; x < 10; ++x) {
      wrong += part.labels[y * 10 + x] != whole.labels[(y + 13) * 150 + x + 140];
    }
  }
  BOOST_TEST(wrong == 0u);
  BOOST_TEST(cv::imread(folder / "part.png").size() == cv::Size(10, 77));
}

BOOST_AUTO_TEST_CASE(far_parts_of_huge_planes_are_made) {
  const TemporaryFolder folder;
  const std::string out = succeeds(
      folder,
      "tiles --random 1000 --size 2147483647x2147483647 --only 2147483600,2147483600,2147483647,2147483647 "
      "--tile 32 --labels a.npy --cells c.csv --json");
  const auto json = nlohmann::json::parse(out);
  BOOST_TEST(json["width"] == 2147483647);
  BOOST_TEST(json["part"]["width"] == 47);
  BOOST_TEST(json["tiles"] == 4);
  BOOST_TEST(json["seeds"] == 1000);
  BOOST_TEST(read_labels(folder / "a.npy").size.width() == 47);
  BOOST_TEST(rows_of(folder / "c.csv").at(0).at("right") == "2147483646");
}

BOOST_AUTO_TEST_CASE(pictures_are_those_of_render_and_of_larger_planes_samples) {
  const TemporaryFolder folder;
  succeeds(folder, "render --random 60 --size 150x100 -o whole.png");
  succeeds(folder, "tiles --random 60 --size 150x100 --tile 32 -o tiles.png");
  BOOST_TEST((content_of(folder / "tiles.png") == content_of(folder / "whole.png")));
  succeeds(folder, "tiles --random 500 --size 9000x50 --tile 128 -o long.png --labels long.npy");
  const cv::Mat picture = cv::imread(folder / "long.png");
  BOOST_REQUIRE(picture.size() == cv::Size(3000, 17));
  // Every third pixel of every third row, from the second one on; the last row is the last one.
  const LabelImage labels = read_labels(folder / "long.npy");
  std::map<std::uint32_t, cv::Vec3b> colors;
  std::size_t wrong = 0;
  for (int y = 0; y < 17; ++y) {
    for (int x = 0; x < 3000; ++x) {
      const auto row = static_cast<std::size_t>(std::min(3 * y + 1, 49));
      const std::uint32_t label = labels.labels[row * 9000 + static_cast<std::size_t>(3 * x + 1)];
      const auto color = colors.emplace(label, picture.at<cv::Vec3b>(y, x)).first;
      wrong += color->second != picture.at<cv::Vec3b>(y, x);
    }
  }
  BOOST_TEST(wrong == 0u);
  BOOST_TEST(colors.size() > 100u);
}

BOOST_AUTO_TEST_CASE(what_is_said_of_tiles_has_their_size) {
  const TemporaryFolder folder;
  const auto says = [&](const std::string& options, const std::string& part) {
    const std::string out = succeeds(folder, "tiles --random 9 --size 100x70 --labels a.npy " + options);
    BOOST_TEST(out.find(part) != std::string::npos, out);
  };
  says("--tile 4096", ", 1 tile of 100 x 70, on ");
  says("--tile 32", ", 12 tiles of 32 x 32, on ");
  says("--tile 64 --only 0,0,90,10", ", 2 tiles of 64 x 10, on ");
}

BOOST_AUTO_TEST_CASE(names_of_arrays_may_end_in_a_slash) {
  const TemporaryFolder folder;
  const std::string random = "tiles --random 9 --size 40x30 --labels a.zarr";
  succeeds(folder, random);
  const std::string chunk = content_of(folder / "a.zarr/0.0");
  std::filesystem::remove(folder / "a.zarr/0.0");
  succeeds(folder, random + "/");
  BOOST_TEST(content_of(folder / "a.zarr/0.0") == chunk);
  std::filesystem::remove(folder / "a.zarr/0.0");
  succeeds(folder, random + "// --resume");
  BOOST_TEST(content_of(folder / "a.zarr/0.0") == chunk);
  BOOST_TEST((folder.names() == std::set<std::string>{"a.zarr"}));
  refuses(folder, "tiles --random 9 --size 40x30 --labels a.npy/", usage, {"a.npy/: the name must end"});
}

BOOST_AUTO_TEST_CASE(what_makes_no_sense_is_refused) {
  const TemporaryFolder folder;
  write_points_file(folder);
  write_npy_points(folder / "nan.npy", {{1, 2}, {3, NAN}});
  folder.file("empty.csv", "x,y\n");
  folder.file("far.csv", "x,y\n1,2\n1e12,3\n");
  std::filesystem::create_directory(folder / "there.zarr");
  const std::string random = "tiles --random 9 --size 40x30 ", points = "tiles --points p.csv --size 40x30 ";
  refuses(folder, "tiles --random 9 --labels a.npy", usage, {"--size"});
  refuses(folder, "tiles --size 40x30 --labels a.npy", usage, {"--random,--points,--mask"});
  refuses(folder, "tiles p.csv --size 40x30 --labels a.npy", usage, {"for its seeds write --points p.csv"});
  refuses(folder, "tiles m.png --size 40x30 --labels a.npy", usage, {"for its seeds write --mask m.png"});
  refuses(folder, "tiles m.xyz --random 5 --size 40x30 --labels a.npy", usage, {"neither an option"});
  refuses(folder, random, usage, {"nothing to write", "--labels"});
  for (const std::string file : {"--labels", "--distance"})
    refuses(folder, random + file + " a.vti", usage, {"a.vti", ".npy, .zarr, .tif, .tiff"});
  refuses(folder, random + "--labels a.npy -o a.gif", usage, {"a.gif", ".png"});
  refuses(folder, random + "--labels a.npy --distance a.npy", usage,
          {"--labels and --distance cannot write one file"});
  refuses(folder, random + "--labels a.tif -o a.tif", usage, {"--labels and -o cannot write one file"});
  refuses(folder, random + "--labels a.tif --tile 100", failure, {"multiples of 16, not 100"});
  refuses(folder, random + "--labels there.zarr", failure, {"there.zarr", "no Zarr array; remove it"});
  refuses(folder, random + "--labels none/a.zarr", failure, {"none does not exist"});
  refuses(folder, random + "--labels a.npy --tile 0", usage, {"--tile"});
  refuses(folder, random + "--labels a.npy --only 1,2,3", usage, {"--only", "X0,Y0,X1,Y1"});
  refuses(folder, random + "--labels a.npy --only 10,10,50,20", failure, {"40"});
  refuses(folder, random + "--labels a.npy --bounds 0,0,1,1", usage, {"--bounds needs --points"});
  refuses(folder, random + "--labels a.npy --units data", usage, {"--units data needs --points"});
  refuses(folder, "tiles --random 9 --size 2147483648x30 --labels a.npy", usage, {"2147483647"});
  refuses(folder, "tiles --random 4294967295 --size 40x30 --labels a.npy", usage, {"--random", "4294967294"});
  refuses(folder, "tiles --random 9 --size 2000000000x2000000000 --labels a.npy", failure,
          {"238419311524 tiles", "--only", "--tile"});
  refuses(folder, "tiles --random 9 --size 10000000x10000000 --labels a.npy", failure,
          {"a.npy", "of disk space at least"});
  refuses(folder, points + "--labels a.tif --crs 32632 --bounds 0,0,60,40", usage, {"EPSG:n"});
  refuses(folder, points + "--labels a.tif --crs EPSG:9 --bounds 0,0,60,40", usage, {"--crs"});
  refuses(folder, points + "--labels a.npy --crs EPSG:4326 --bounds 0,0,60,40", usage, {"--crs is for"});
  refuses(folder, points + "--labels a.tif --crs EPSG:4326", usage, {"with --bounds"});
  refuses(folder, points + "--labels a.npy --outside refuse --bounds 0,0,60,40", failure,
          {"p.csv: point 2 at (-20, -5) is outside the bounds"});
  refuses(folder, "tiles --points nan.npy --size 40x30 --labels a.npy", failure,
          {"nan.npy: point 1 at (3, nan) is not finite"});
  refuses(folder, "tiles --points far.csv --size 40x30 --bounds 0,0,9,9 --labels a.npy", failure,
          {"far.csv: point 1 at (1000000000000, 3) is 2^31 pixels or more away"});
  refuses(folder, "tiles --points empty.csv --size 40x30 --labels a.npy", failure,
          {"empty.csv", "no points"});
  refuses(folder, "tiles --points none.npy --size 40x30 --labels a.npy", failure,
          {"none.npy", "No such file"});
  refuses(folder, "tiles --points p.txt --size 40x30 --labels a.npy", usage, {"p.txt", ".csv, .npy"});
  refuses(folder, random + "--cells /dev/null --resume", usage, {".csv"});
}
