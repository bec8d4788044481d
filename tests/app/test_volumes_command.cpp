// vorocl render of volumes: files as other programs read them, slices as pictures, and what is refused.
#define BOOST_TEST_MODULE volumes_command
#include <fmt/format.h>

#include <cstring>
#include <nlohmann/json.hpp>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>

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

BOOST_AUTO_TEST_CASE(pictures_show_slices) {
  const TemporaryFolder folder;
  const Labels labels = expected_labels();
  const auto at = [&](int x, int y, int z) {
    return labels[static_cast<std::size_t>((z * height + y) * width + x)];
  };
  struct Axis {
    char name;
    int columns, rows;
  };
  for (const Axis& axis : {Axis{'z', width, height}, Axis{'y', width, depth}, Axis{'x', height, depth}}) {
    Labels slice;
    for (int row = 0; row < axis.rows; ++row) {
      for (int column = 0; column < axis.columns; ++column) {
        slice.push_back(axis.name == 'z'   ? at(column, row, 5)
                        : axis.name == 'y' ? at(column, 5, row)
                                           : at(5, column, row));
      }
    }
    succeeds(folder,
             volume + "--method " + method_of_device() + fmt::format(" --slice {}=5 -o a.png", axis.name));
    const cv::Mat picture = cv::imread(folder / "a.png");
    const cv::Mat expected = color_by_id(slice, Grid(axis.columns, axis.rows));
    BOOST_TEST_REQUIRE((picture.size() == expected.size()), axis.name);
    BOOST_TEST(cv::norm(picture, expected, cv::NORM_INF) == 0, axis.name);
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
  refuses(folder, "render --random 3 --size 8x8x0 --labels a.npy", usage, {"0 pixels"});
  refuses(folder, "render --random 3 --size 4096x4096x4096 --labels a.npy", failure,
          {"4096 x 4096 x 4096 voxels is too large", "2048 x 1024 x 1024"});
  refuses(folder, "cells --random 3 --size 8x8x8 --cells a.csv", usage, {"vorocl render and simulate alone"});
  refuses(folder, "simulate --random 3 --size 8x8x8 --step-length 1 --frames 2 --labels a%d.npy", usage,
          {"of a --trajectory"});
}
