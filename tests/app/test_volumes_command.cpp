// vorocl render of volumes: files as other programs read them, slices as pictures, and what is refused.
#define BOOST_TEST_MODULE volumes_command
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <map>
#include <nlohmann/json.hpp>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <set>
#include <sstream>

#include "formats/npy.hpp"
#include "run_command.hpp"
#include "vorocl/picture.hpp"

using namespace vorocl;

namespace {

using Labels = std::vector<std::uint32_t>;

constexpr int width = 24, height = 20, depth = 16;
const std::string volume = "render --random 12 --rng-seed 3 --size 24x20x16 ";

/// Exact diagrams of volumes are for CPUs.
std::string method_of_device() { return test_device().tuning().shape == Shape::vector ? "exact" : "jfa"; }

/// The labels of the seeds that the command makes.
Labels expected_labels() {
  const Grid grid(width, height, depth);
  Diagram diagram(test_device(), grid);
  method(method_of_device()).run(Seeds::random(test_device(), grid, 12, 3), diagram, {});
  return diagram.read();
}

std::string bytes_of(const Labels& labels) {
  std::string bytes(labels.size() * sizeof labels[0], '\0');
  std::memcpy(bytes.data(), labels.data(), bytes.size());
  return bytes;
}

}  // namespace

/// The sides are 3 / 61, 2 / 37 and 1 / 23: 28 : 31 : 25 of 0.001756, 0.001744 and 0.001739.
BOOST_AUTO_TEST_CASE(a_note_says_how_exact_the_sides_of_voxels_are) {
  const TemporaryFolder folder;
  folder.file("p.csv", "x,y,z\n0.5,0.5,0.5\n2,1,0.25\n");
  const auto said = [&](const std::string& size, const std::string& bounds) {
    return run(folder, "render --points p.csv --size " + size + " --bounds=" + bounds + " --labels a.npy")
        .error;
  };
  BOOST_TEST(said("61x37x23", "0,0,0,3,2,1").find("as 28 : 31 : 25 in the data to 1 %,") !=
             std::string::npos);
  BOOST_TEST(said("60x40x21", "0,0,0,3,2,1.045").find("as 1 : 1 : 1 in the data to 0.5 %") !=
             std::string::npos);
  BOOST_TEST(said("60x40x20", "0,0,0,3,2,2").find("as 1 : 1 : 2 in the data, and") != std::string::npos);
  BOOST_TEST(said("60x40x20", "0,0,0,3,2,1").find("sides of a voxel") == std::string::npos);
}

BOOST_AUTO_TEST_CASE(labels_are_written_slice_after_slice) {
  const TemporaryFolder folder;
  const std::string method = "--method " + method_of_device();
  const std::string bytes = bytes_of(expected_labels());
  succeeds(folder, volume + method + " --labels a.npy");
  BOOST_TEST(
      (content_of(folder / "a.npy") == command::npy_header<std::uint32_t>({depth, height, width}) + bytes));
  succeeds(folder, volume + method + " --labels a.vti");
  const std::string image = content_of(folder / "a.vti");
  BOOST_TEST(image.find("WholeExtent=\"0 24 0 20 0 16\" Origin=\"0 0 0\" Spacing=\"1 1 1\"") !=
             std::string::npos);
  BOOST_TEST(image.find(bytes + "\n  </AppendedData>") != std::string::npos);
  const auto result = nlohmann::json::parse(succeeds(folder, volume + method + " --labels a.npy --json"));
  BOOST_TEST((result["width"] == width && result["height"] == height && result["depth"] == depth));
  BOOST_TEST((result["seeds"] == 12 && result["method"] == method_of_device()));
}

namespace {

/// A table's rows below its header, as numbers; NAN where there is none.
std::vector<std::vector<double>> rows_of(const std::string& table) {
  std::vector<std::vector<double>> rows;
  std::istringstream lines(table);
  std::string line, value;
  std::getline(lines, line);
  while (std::getline(lines, line)) {
    std::vector<double>& row = rows.emplace_back();
    std::istringstream values(line + ",");
    while (std::getline(values, value, ',')) row.push_back(value.empty() ? NAN : std::stod(value));
  }
  return rows;
}

/// How many faces two cells share, by their ids.
using Faces = std::map<std::pair<double, double>, double>;
Faces faces_of(const Labels& labels, bool periodic) {
  Faces faces;
  const int sides[] = {width, height, depth}, strides[] = {1, width, width * height};
  for (std::size_t i = 0; i < labels.size(); ++i) {
    for (int axis = 0; axis < 3; ++axis) {
      const int at = static_cast<int>(i) / strides[axis] % sides[axis];
      if (!periodic && at + 1 == sides[axis]) continue;
      const int step = ((at + 1) % sides[axis] - at) * strides[axis];
      const std::uint32_t a = labels[i], b = labels[static_cast<std::size_t>(static_cast<int>(i) + step)];
      if (a != b) ++faces[std::minmax(double(a), double(b))];
    }
  }
  return faces;
}

}  // namespace

BOOST_AUTO_TEST_CASE(tables_of_cells_are_those_of_the_labels) {
  const TemporaryFolder folder;
  const Labels labels = expected_labels();
  const auto result = nlohmann::json::parse(
      succeeds(folder,
               "cells --random 12 --rng-seed 3 --size 24x20x16 --cells a.csv --adjacency b.csv --labels "
               "a.npy --json --method " +
                   method_of_device()));
  const std::string cells = content_of(folder / "a.csv"), pairs = content_of(folder / "b.csv");
  BOOST_TEST(cells.rfind("id,x,y,z,volume,centroid_x,centroid_y,centroid_z,left,top,front,right,bottom,back,"
                         "surface,neighbours,largest_distance,touches_border\n",
                         0) == 0u);
  BOOST_TEST(pairs.rfind("a,b,area\n", 0) == 0u);
  BOOST_TEST((content_of(folder / "a.npy") ==
              command::npy_header<std::uint32_t>({depth, height, width}) + bytes_of(labels)));

  Faces faces = faces_of(labels, false);
  const auto found_pairs = rows_of(pairs);
  BOOST_TEST_REQUIRE(found_pairs.size() == faces.size());
  for (const auto& row : found_pairs) BOOST_TEST((faces[{row[0], row[1]}] == row[2]));
  const auto found = rows_of(cells);
  BOOST_TEST_REQUIRE(found.size() == 12u);
  double volumes = 0;
  for (std::size_t id = 0; id < 12; ++id) {
    const auto& row = found[id];
    double count = 0, sum_z = 0, front = 1e9, back = -1, surface = 0, farthest = -1;
    for (std::size_t i = 0; i < labels.size(); ++i) {
      if (labels[i] != id) continue;
      const double x = static_cast<double>(i % 24) + 0.5, y = static_cast<double>(i / 24 % 20) + 0.5,
                   z = static_cast<double>(i / 480) + 0.5;
      ++count;
      sum_z += z;
      front = std::min(front, z - 0.5);
      back = std::max(back, z - 0.5);
      farthest = std::max(farthest, std::hypot(x - row[1], y - row[2], z - row[3]));
    }
    for (const auto& [ids, area] : faces) surface += ids.first == row[0] || ids.second == row[0] ? area : 0;
    volumes += count;
    BOOST_TEST((row[0] == static_cast<double>(id) && row[4] == count && row[10] == front && row[13] == back));
    BOOST_TEST((row[14] == surface && std::abs(row[7] - sum_z / count) < 1e-9));
    BOOST_TEST(std::abs(row[16] - farthest) < 1e-9);
  }
  BOOST_TEST((result["cells"] == 12 && result["empty_cells"] == 0 && result["unlabelled_voxels"] == 0));
  BOOST_TEST((result["pairs"] == faces.size() && result["mean_volume"] == volumes / 12));
}

BOOST_AUTO_TEST_CASE(tables_of_periodic_cells_go_round) {
  const TemporaryFolder folder;
  const Grid grid(Axis(width).periodic(), Axis(height).periodic(), Axis(depth).periodic());
  Diagram diagram(test_device(), grid);
  method(method_of_device()).run(Seeds::random(test_device(), grid, 12, 3), diagram, {});
  Faces faces = faces_of(diagram.read(), true);
  succeeds(folder,
           "cells --random 12 --rng-seed 3 --size 24x20x16 --periodic xyz --cells a.csv --adjacency b.csv "
           "--method " +
               method_of_device());
  const auto pairs = rows_of(content_of(folder / "b.csv")), cells = rows_of(content_of(folder / "a.csv"));
  BOOST_TEST_REQUIRE(pairs.size() == faces.size());
  for (const auto& row : pairs) BOOST_TEST((faces[{row[0], row[1]}] == row[2]));
  double least = 0;
  for (const auto& row : cells) {
    BOOST_TEST(row.back() == 0);  // no border
    least = std::min({least, row[8], row[9], row[10]});
  }
  BOOST_TEST(least < 0);
}

BOOST_AUTO_TEST_CASE(seeds_without_a_voxel_and_voxels_without_a_label_are_told) {
  const TemporaryFolder folder;
  const std::string crowded = "render --random 40 --size 3x2x2 --method jfa --labels a.npy";
  const Grid grid(3, 2, 2);
  std::set<std::size_t> taken;
  for (const auto& voxel : Seeds::random(test_device(), grid, 40, 1).read_pixels()) {
    taken.insert(static_cast<std::size_t>(voxel->x) + 3 * static_cast<std::size_t>(voxel->y) +
                 6 * static_cast<std::size_t>(voxel->z));
  }
  const std::size_t empty = 40 - taken.size();
  BOOST_TEST(succeeds(folder, crowded).find(fmt::format("{} of 40 seeds own no voxel", empty)) !=
             std::string::npos);
  const auto result = nlohmann::json::parse(succeeds(folder, crowded + " --json"));
  BOOST_TEST((result["empty_cells"] == empty && result["unlabelled_voxels"] == 0));

  folder.file("none.lammpstrj",
              "ITEM: TIMESTEP\n0\nITEM: NUMBER OF ATOMS\n0\nITEM: BOX BOUNDS ff ff ff\n0 8\n0 8\n0 8\n"
              "ITEM: ATOMS id x y z\n");
  BOOST_TEST(succeeds(folder, "render --trajectory none.lammpstrj --size 8x8x8 --method jfa --labels a.npy")
                 .find("512 voxels without a label: there are no seeds") != std::string::npos);
}

BOOST_AUTO_TEST_CASE(pictures_show_slices) {
  const TemporaryFolder folder;
  const Labels labels = expected_labels();
  const auto label_at = [&](int x, int y, int z) {
    return labels[static_cast<std::size_t>((z * height + y) * width + x)];
  };
  const auto seeds = Seeds::random(test_device(), Grid(width, height, depth), 12, 3).read_pixels();
  const auto coordinate = [](const Point& seed, char axis) {
    return axis == 'x' ? seed.x : axis == 'y' ? seed.y : seed.z;
  };
  struct Axis {
    char name, across, down;
    int columns, rows;
  };
  for (const Axis& axis : {Axis{'z', 'x', 'y', width, height}, Axis{'y', 'x', 'z', width, depth},
                           Axis{'x', 'y', 'z', height, depth}}) {
    const double centre = coordinate(*seeds[0], axis.name);  // a slice with a seed
    const int at = static_cast<int>(centre);
    Labels slice;
    for (int row = 0; row < axis.rows; ++row) {
      for (int column = 0; column < axis.columns; ++column) {
        slice.push_back(axis.name == 'z'   ? label_at(column, row, at)
                        : axis.name == 'y' ? label_at(column, at, row)
                                           : label_at(at, column, row));
      }
    }
    std::vector<Point> seeds_there;
    for (const auto& seed : seeds) {
      if (coordinate(*seed, axis.name) != centre) continue;
      seeds_there.push_back({coordinate(*seed, axis.across), coordinate(*seed, axis.down)});
    }
    cv::Mat expected = color_by_id(slice, Grid(axis.columns, axis.rows));
    for (const std::string overlay : {"", " --points-overlay"}) {
      if (!overlay.empty()) draw_points(expected, seeds_there);
      succeeds(folder, volume + "--method " + method_of_device() +
                           fmt::format(" --slice {}={} -o a.png", axis.name, at) + overlay);
      const cv::Mat picture = cv::imread(folder / "a.png");
      BOOST_TEST_REQUIRE((picture.size() == expected.size()), axis.name);
      BOOST_TEST(cv::norm(picture, expected, cv::NORM_INF) == 0, axis.name << overlay);
    }
  }
}

BOOST_AUTO_TEST_CASE(what_volumes_do_not_have_is_refused) {
  const TemporaryFolder folder;
  folder.file("points.csv", "x,y\n1,2\n");
  const std::string labels = volume + "--labels a.npy ", picture = volume + "-o a.png ";
  refuses(folder, volume, usage, {"nothing to write", "--slice z=K"});
  refuses(folder, picture, usage, {"-o needs --slice z=K"});
  refuses(folder, picture + "--slice z=16", usage, {"--slice z=16", "from 0 to 15"});
  refuses(folder, picture + "--slice 5", usage, {"--slice", "must be z=K"});
  refuses(folder, labels + "--slice z=5", usage, {"give -o PICTURE"});
  refuses(folder, picture + "--slice z=5 --color distance", usage, {"--color is for planes"});
  refuses(folder, picture + "--slice z=5 --contours", usage, {"--contours is for planes"});
  refuses(folder, labels + "--edges", usage, {"--edges requires"});
  refuses(folder, labels + "--method djfa", usage, {"djfa is for planes", "jfa, jfa+1, jfa+2, 1+jfa, exact"});
  refuses(folder, labels + "--waves w%d.png", usage, {"--waves is for planes"});
  refuses(folder, labels + "--bounds 0,0,1,1", usage, {"--bounds needs --points"});
  refuses(folder, volume + "--labels a.tif", usage, {"a.tif", ".npy, .vti"});
  refuses(folder, "render --points points.csv --size 8x8x8 --labels a.npy", failure, {"no column z"});
  refuses(folder, "render --random 3 --size 8x8 --slice z=1 -o a.png", usage, {"--slice is for volumes"});
  refuses(folder, "render --random 3 --size 8x8x --labels a.npy", usage, {"WxHxD, such as 256x256x256"});
  for (const std::string depth : {"0", "1"}) {
    refuses(folder, "render --random 3 --size 8x8x" + depth + " --labels a.npy", usage,
            {"the depth is " + depth, "from 2 to 16384 voxels", "--size WxH makes a plane"});
  }
  refuses(folder, "render --random 3 --size 4096x4096x4096 --labels a.npy", failure,
          {"4096 x 4096 x 4096 voxels is too large", "2048 x 1024 x 1024"});
  refuses(folder, "cells --random 3 --size 8x8x8", usage,
          {"nothing to write", "--cells, --adjacency, --distance, --labels"});
  refuses(folder, "cells --random 3 --size 8x8x8 --cells a.csv --border b.npy", usage,
          {"--border is for planes"});
  refuses(folder, "cells --random 3 --size 8x8x8 --cells a.csv --method djfa", usage, {"djfa is for planes"});
  refuses(folder, "cells --random 3 --size 8x8x16385 --cells a.csv", usage,
          {"16385", "from 2 to 16384 voxels"});
  refuses(folder, "cells --points points.csv --size 8x8x8 --cells a.csv", failure, {"no column z"});
  refuses(folder, "cells --random 3 --size 8x8x8 --cells a.csv --units data", usage,
          {"--units data needs --points"});
  for (const std::string option : {"--color-bar", "--scale 0,1", "--log"}) {
    refuses(folder, picture + "--slice z=5 " + option, usage,
            {option.substr(0, option.find(' ')) + " is for planes"});
  }
  const std::string bench = "bench --random 3 --size 8x8x8 --methods ";
  refuses(folder, bench + "jfa,opencv", usage, {"opencv is for planes; volumes have"});
  refuses(folder, bench + "jfa,exact --metric manhattan", usage,
          {"are Euclidean", "jump flooding takes --metric"});
  refuses(folder, bench + "jfa --no-snap", usage, {"--no-snap needs --points or --trajectory"});
  folder.file("points.npy", command::npy_header<std::uint32_t>({1, 3}) + std::string(12, '\1'));
  refuses(folder, "render --points points.npy --size 8x8 --labels a.npy", failure,
          {"(1, 3)", "those of a volume, which --size WxHxD or --exact asks for, (N, 3)"});
  // One sentence, whatever makes planes alone.
  const std::string makers =
      "WxHxD asks for a volume, which vorocl render, cells, simulate, compare and bench make";
  refuses(folder, "relax --random 3 --size 8x8x8 --rounds 1 -o a.png", usage, {makers});
  refuses(folder, "tiles --random 3 --size 8x8x8 --tile 8 --labels a.npy", usage, {makers});
  refuses(folder, "simulate --random 3 --size 8x8x8 --step-length 1 --frames 2 --labels a%d.npy", usage,
          {"of a --trajectory"});
}

namespace {

/// Voxels whose label is not at the least distance from a search of all seeds.
std::size_t wrong_voxels(const Grid& grid, const std::vector<std::optional<Point>>& seeds,
                         const Labels& labels) {
  const auto squared = [&](std::size_t voxel, const Point& seed) {
    const double at[] = {static_cast<double>(voxel % width), static_cast<double>(voxel / width % height),
                         static_cast<double>(voxel / (width * height))};
    const double of_seed[] = {seed.x, seed.y, seed.z};
    const Axis* const axes[] = {&grid.x(), &grid.y(), &grid.z()};
    double sum = 0;
    for (int axis = 0; axis < 3; ++axis) {
      double way = std::abs(at[axis] + 0.5 - of_seed[axis]);
      if (axes[axis]->is_periodic()) way = std::min(way, static_cast<double>(axes[axis]->pixels()) - way);
      sum += way * way;
    }
    return sum;
  };
  std::size_t wrong = 0;
  for (std::size_t voxel = 0; voxel < labels.size(); ++voxel) {
    double least = 1e9;
    for (const auto& seed : seeds) least = std::min(least, squared(voxel, *seed));
    wrong += squared(voxel, *seeds.at(labels[voxel])) > least ? 1 : 0;
  }
  return wrong;
}

}  // namespace

BOOST_AUTO_TEST_CASE(volumes_are_compared_and_benched) {
  if (method_of_device() != "exact") return;
  const TemporaryFolder folder;
  const std::string seeds = "--random 200 --rng-seed 3 --size 24x20x16 ";
  for (const bool periodic : {false, true}) {
    const auto axis = [periodic](int side) { return periodic ? Axis(side).periodic() : Axis(side); };
    const Grid grid(axis(width), axis(height), axis(depth));
    const Seeds placed = Seeds::random(test_device(), grid, 200, 3);
    Diagram exact(test_device(), grid), flooded(test_device(), grid);
    MethodOptions options;
    options.neighbourhood = NeighbourhoodMix::von_neumann;  // which goes wrong more often
    method("exact").run(placed, exact, {});
    method("jfa").run(placed, flooded, options);
    const Labels right = exact.read(), labels = flooded.read();
    const std::size_t wrong = wrong_voxels(grid, placed.read_pixels(), labels);
    BOOST_TEST((wrong > 0 && wrong_voxels(grid, placed.read_pixels(), right) == 0));
    std::size_t different = 0;
    for (std::size_t i = 0; i < labels.size(); ++i) different += labels[i] != right[i] ? 1 : 0;

    const std::string axes = periodic ? "--periodic xyz " : "";
    folder.file("a.npy", command::npy_header<std::uint32_t>({depth, height, width}) + bytes_of(labels));
    folder.file("b.npy", command::npy_header<std::uint32_t>({depth, height, width}) + bytes_of(right));
    const auto files = nlohmann::json::parse(succeeds(folder, "compare a.npy b.npy --json"));
    BOOST_TEST((files["different_pixels"] == different && files["pixels"] == labels.size()));
    for (const std::string& given : {std::string("--random 200 --rng-seed 3 "), seeds}) {
      const auto judged = nlohmann::json::parse(succeeds(folder, "compare a.npy " + given + axes + "--json"));
      BOOST_TEST((judged["errors"]["wrong_pixels"] == wrong && judged["different_pixels"] == different));
      BOOST_TEST(judged["errors"]["unlabelled_pixels"] == 0u);
    }
    BOOST_TEST(succeeds(folder, "compare a.npy " + seeds + axes)
                   .find(fmt::format("{} of 7680 voxels differ\n{} voxels are wrong", different, wrong)) !=
               std::string::npos);

    const auto bench = nlohmann::json::parse(succeeds(
        folder, "bench --methods jfa,exact --repeat 1 --neighbourhood von-neumann --json " + seeds + axes));
    BOOST_TEST((bench["depth"] == depth && bench["periodic"] == (periodic ? "xyz" : "none")));
    BOOST_TEST((bench["results"][0]["wrong_pixels"] == wrong && bench["results"][1]["wrong_pixels"] == 0u));
  }
  folder.file("plane.npy", command::npy_header<std::uint32_t>({height, width}) + std::string(4 * 480, '\0'));
  refuses(folder, "compare a.npy plane.npy", failure, {"24 x 20 x 16 voxels", "24 x 20;"});
  folder.file("p.csv", "x,y,z\n1,2,3\n");
  refuses(folder, "compare a.npy --points p.csv --width 9", usage, {"--width is for planes"});
  refuses(folder, "compare a.npy " + seeds + "--no-snap", usage,
          {"--no-snap needs --points or --trajectory"});
  refuses(folder, "compare a.npy --random 3 --size 24x20x8", failure, {"24 x 20 x 16", "24 x 20 x 8"});
  refuses(folder, "compare a.npy --random 3 --metric manhattan", usage, {"are Euclidean"});
}
