// Exact diagrams of the points themselves: the command against a search of all points, in 1/4096 pixel.
#define BOOST_TEST_MODULE snap_command
#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <random>
#include <tuple>

#include "app/sources/seed_input.hpp"
#include "formats/raster_files.hpp"
#include "run_command.hpp"
#include "trajectory_text.hpp"

using namespace vorocl;
using command::dump;
using command::walled_box;
using nlohmann::json;

namespace {

constexpr std::int64_t parts = 4096;

/// A position in parts of a pixel.
struct Place {
  std::int64_t x, y;
};

Place place_of(const Point& pixels, bool snaps) {
  const auto along = [snaps](double at) {
    const auto pixel = static_cast<std::int64_t>(std::floor(at));
    const auto part = std::llround((at - std::floor(at)) * parts);
    return pixel * parts + (snaps ? parts / 2 : std::min<std::int64_t>(part, parts - 1));
  };
  return {along(pixels.x), along(pixels.y)};
}

/// Distances by the definition.
class Distances {
 public:
  Distances(const Grid& grid, const std::vector<Point>& pixels, bool snaps, Metric metric = Metric::euclidean)
      : grid_(grid), metric_(metric) {
    for (const Point& point : pixels) places_.push_back(place_of(point, snaps));
  }

  std::int64_t operator()(std::size_t pixel, std::size_t id) const {
    const auto at = static_cast<std::int64_t>(pixel);
    const auto dx = way(places_[id].x, at % grid_.width(), grid_.width(), has_x(grid_.periodic()));
    const auto dy = way(places_[id].y, at / grid_.width(), grid_.height(), has_y(grid_.periodic()));
    return metric_ == Metric::euclidean ? dx * dx + dy * dy : dx + dy;
  }

  /// The least distance, then y, x and the id.
  std::vector<std::uint32_t> nearest() const {
    std::vector<std::uint32_t> labels;
    for (std::size_t pixel = 0; pixel < grid_.pixels(); ++pixel) {
      std::tuple<std::int64_t, std::int64_t, std::int64_t, std::uint32_t> best = {
          std::numeric_limits<std::int64_t>::max(), 0, 0, no_label};
      for (std::uint32_t id = 0; id < places_.size(); ++id)
        best = std::min(best, {(*this)(pixel, id), places_[id].y, places_[id].x, id});
      labels.push_back(std::get<3>(best));
    }
    return labels;
  }

  /// How many of the labels are of a seed that is not at the least distance.
  std::size_t wrong(const std::vector<std::uint32_t>& labels) const {
    const std::vector<std::uint32_t> right = nearest();
    std::size_t count = 0;
    for (std::size_t pixel = 0; pixel < labels.size(); ++pixel)
      count += (*this)(pixel, labels[pixel]) > (*this)(pixel, right[pixel]) ? 1 : 0;
    return count;
  }

 private:
  static std::int64_t way(std::int64_t from, std::int64_t pixel, std::int64_t pixels, bool periodic) {
    const std::int64_t straight = std::abs(from - (pixel * parts + parts / 2));
    return periodic ? std::min(straight, pixels * parts - straight) : straight;
  }

  Grid grid_;
  Metric metric_;
  std::vector<Place> places_;
};

std::vector<std::uint32_t> search_all(const Grid& grid, const std::vector<Point>& pixels, bool snaps,
                                      Metric metric = Metric::euclidean) {
  return Distances(grid, pixels, snaps, metric).nearest();
}

/// Points all over the grid, many of one pixel, some of them at equal distances from pixels.
std::vector<Point> crowd(const Grid& grid, std::size_t count) {
  std::mt19937 bits(5);
  const auto along = [&bits](std::int64_t pixels, bool coarse) {
    const double at = static_cast<double>(bits()) * 0x1p-32 * static_cast<double>(pixels);
    return coarse ? std::floor(at * 4) / 4 : at;
  };
  std::vector<Point> points;
  for (std::size_t i = 0; i < count; ++i) {
    const bool coarse = i % 2 == 0;
    points.push_back({along(grid.width(), coarse), along(grid.height(), coarse)});
    if (i % 9 == 0) points.push_back({points.back().x + 0.001, points.back().y});
  }
  return points;
}

void write_points(const TemporaryFolder& folder, const std::vector<Point>& points) {
  std::string text = "x,y\n";
  for (const Point& point : points) text += fmt::format("{:.17g},{:.17g}\n", point.x, point.y);
  folder.file("p.csv", text);
}

std::vector<std::uint32_t> labels_of(const TemporaryFolder& folder, const std::string& arguments) {
  const Result result = run(folder, arguments + " --labels l.npy");  // a note tells of points outside
  BOOST_TEST(result.exit_code == 0, arguments << "\n" << result.error);
  return command::read_labels(folder / "l.npy").labels;
}

std::size_t differences(const std::vector<std::uint32_t>& a, const std::vector<std::uint32_t>& b) {
  std::size_t count = a.size() == b.size() ? 0 : a.size() + b.size();
  for (std::size_t i = 0; count <= a.size() && i < a.size(); ++i) count += a[i] == b[i] ? 0 : 1;
  return count;
}

std::size_t wrong_pixels(const TemporaryFolder& folder, const std::string& arguments) {
  const Result result = run(folder, arguments + " --json");
  BOOST_TEST(result.exit_code == 0, result.error);
  return json::parse(result.out).at("errors").at("wrong_pixels").get<std::size_t>();
}

}  // namespace

BOOST_AUTO_TEST_CASE(points_are_taken_where_they_are_unless_they_are_snapped) {
  const TemporaryFolder folder;
  const std::string plane = " --points p.csv --bounds 0,0,90,60 --size 90x60";
  for (const auto& [name, axes] : {std::pair{"none", Axes::none}, std::pair{"xy", Axes::xy}}) {
    const Grid grid(90, 60, axes);
    const std::vector<Point> points = crowd(grid, 400);
    write_points(folder, points);
    for (const auto& [metric_name, metric] :
         {std::pair{"euclidean", Metric::euclidean}, std::pair{"manhattan", Metric::manhattan}}) {
      const std::string line = fmt::format("render{} --periodic {} --metric {}", plane, name, metric_name);
      const auto snapped = search_all(grid, points, true, metric),
                 whole = search_all(grid, points, false, metric);
      BOOST_TEST(differences(snapped, whole) > 300u);
      BOOST_TEST(differences(labels_of(folder, line + " --no-snap"), whole) == 0u, line);
      BOOST_TEST(differences(labels_of(folder, line + " --snap"), snapped) == 0u, line);
      BOOST_TEST(differences(labels_of(folder, line), whole) == 0u, line);
    }
  }
}

BOOST_AUTO_TEST_CASE(several_points_of_a_pixel_own_pixels_each) {
  const TemporaryFolder folder;
  folder.file("p.csv", "x,y\n20.125,20.5\n20.875,20.5\n20.5,20.125\n20.5,20.875\n");
  const std::string line = "cells --points p.csv --bounds 0,0,41,41 --size 41x41 --json --cells c.csv";
  BOOST_TEST(json::parse(succeeds(folder, line + " --no-snap")).at("empty_cells") == 0);
  // The table has the points themselves.
  BOOST_TEST(content_of(folder / "c.csv").find("\n1,20.875,20.5,") != std::string::npos,
             content_of(folder / "c.csv"));
  BOOST_TEST(json::parse(succeeds(folder, line + " --snap")).at("empty_cells") == 3);
  BOOST_TEST(content_of(folder / "c.csv").find("\n1,20.5,20.5,") != std::string::npos);
}

BOOST_AUTO_TEST_CASE(bounds_show_a_part_of_the_same_diagram) {
  const TemporaryFolder folder;
  const Grid grid(90, 60);
  write_points(folder, crowd(grid, 500));
  const auto whole = labels_of(folder, "render --no-snap --points p.csv --bounds 0,0,90,60 --size 90x60");
  const auto part = labels_of(folder, "render --no-snap --points p.csv --bounds 20,10,60,45 --size 40x35");
  for (std::size_t y = 0; y < 35; ++y) {
    for (std::size_t x = 0; x < 40; ++x) BOOST_REQUIRE(part[y * 40 + x] == whole[(y + 10) * 90 + x + 20]);
  }
}

BOOST_AUTO_TEST_CASE(the_y_axis_may_point_up) {
  const TemporaryFolder folder;
  const Grid grid(90, 60);
  std::vector<Point> points = crowd(grid, 300);
  write_points(folder, points);
  // 3 pixels are 2 units.
  const auto labels =
      labels_of(folder, "render --no-snap --points p.csv --bounds -10,-5,50,35 --size 90x60 --y-up");
  for (Point& point : points) point = {(point.x + 10) * 1.5, 60 - (point.y + 5) * 1.5};
  // An end of a pixel lies in the other one, seen from above.
  for (Point& point : points) point.y = std::floor(point.y) == point.y ? point.y - 1.0 / parts : point.y;
  BOOST_TEST(differences(labels, search_all(grid, points, false)) == 0u);
}

BOOST_AUTO_TEST_CASE(particles_of_a_pixel_have_cells_by_the_ids_of_the_file) {
  const TemporaryFolder folder;
  const std::string columns = "id x y";
  folder.file("t.lammpstrj",
              dump(walled_box, columns, {"90 5.125 5.5", "7 5.875 5.5", "50 2.5 9.5", "8 5.875 5.5"}) +
                  dump(walled_box, columns, {"8 5.125 5.5", "7 5.125 5.5", "90 5.875 5.5"}));
  const std::string line = " --trajectory t.lammpstrj --size 10x10 --y-down ";
  succeeds(folder, "simulate --no-snap" + line + "--labels l%d.npy");
  const auto first = command::read_labels(folder / "l0.npy").labels;
  BOOST_TEST(first[54] == 90u);
  BOOST_TEST(first[59] == 7u);  // the lower id of those at one point
  BOOST_TEST(first[92] == 50u);
  const auto second = command::read_labels(folder / "l1.npy").labels;
  BOOST_TEST(second[54] == 7u);
  BOOST_TEST(second[59] == 90u);
  const auto frame = labels_of(folder, "render --no-snap --frame 1" + line);
  BOOST_TEST(differences(frame, second) == 0u);
  const auto snapped = labels_of(folder, "render --snap" + line);
  BOOST_TEST(snapped[54] == 7u);
  BOOST_TEST(snapped[59] == 7u);
}

BOOST_AUTO_TEST_CASE(labels_are_judged_by_the_truth_that_is_asked_for) {
  const TemporaryFolder folder;
  const Grid grid(90, 60);
  const std::vector<Point> points = crowd(grid, 400);
  write_points(folder, points);
  const std::string plane = " --points p.csv --bounds 0,0,90,60 --size 90x60";
  succeeds(folder, "render --no-snap --labels true.npy" + plane);
  succeeds(folder, "render --snap --labels snapped.npy" + plane);
  const Distances of_snapped(grid, points, true), of_points(grid, points, false);
  const std::size_t true_by_snapped = of_snapped.wrong(of_points.nearest());
  const std::size_t snapped_by_true = of_points.wrong(of_snapped.nearest());
  BOOST_TEST(std::min(true_by_snapped, snapped_by_true) > 200u);
  for (const std::string snapped : {"", " --snap"}) {
    BOOST_TEST(wrong_pixels(folder, "compare snapped.npy" + plane + snapped) == 0u);
    BOOST_TEST(wrong_pixels(folder, "compare true.npy" + plane + snapped) == true_by_snapped);
  }
  BOOST_TEST(wrong_pixels(folder, "compare true.npy --no-snap" + plane) == 0u);
  BOOST_TEST(wrong_pixels(folder, "compare snapped.npy --no-snap" + plane) == snapped_by_true);

  const auto bench = [&](const std::string& truth) {
    const json results =
        json::parse(succeeds(folder, "bench --json --repeat 1 --methods exact,jfa+2" + plane + truth))
            .at("results");
    return std::pair{results[0].at("wrong_pixels").get<std::size_t>(),
                     results[1].at("wrong_pixels").get<std::size_t>()};
  };
  const auto [exact, flooded] = bench("");
  BOOST_TEST(exact == 0u);
  BOOST_TEST(flooded < true_by_snapped / 4);
  BOOST_TEST((bench(" --snap") == std::pair{exact, flooded}));
  const auto [exact_of_points, flooded_of_points] = bench(" --no-snap");
  BOOST_TEST(exact_of_points == 0u);
  BOOST_TEST(flooded_of_points > snapped_by_true / 2);
}

BOOST_AUTO_TEST_CASE(a_simulation_compares_with_the_truth_that_is_asked_for) {
  const TemporaryFolder folder;
  std::string text;
  std::mt19937 bits(2);
  std::vector<Point> points;
  for (int i = 0; i < 60; ++i)
    points.push_back(
        {static_cast<double>(bits()) * 0x1p-32 * 10, static_cast<double>(bits()) * 0x1p-32 * 10});
  for (int frame = 0; frame < 3; ++frame) {
    std::vector<std::string> rows;
    for (const Point& point : points)
      rows.push_back(fmt::format("{} {}", point.x, std::fmod(point.y + frame * 0.1, 10)));
    text += dump(walled_box, "x y", rows);
  }
  folder.file("t.lammpstrj", text);
  const std::string line =
      "simulate --json --trajectory t.lammpstrj --size 50x50 --method jfa+2 --compare-with exact ";
  const auto wrong = [&](const std::string& truth) {
    return json::parse(succeeds(folder, line + truth)).at("errors").at("wrong_percent_mean").get<double>();
  };
  BOOST_TEST(wrong("") == wrong("--snap"));
  BOOST_TEST(wrong("") < 1);
  BOOST_TEST(wrong("--no-snap") > 2);
  const auto similarity = [&](const std::string& methods) {
    return json::parse(succeeds(folder, "simulate --json --trajectory t.lammpstrj --size 50x50 " + methods))
        .at("similarity")
        .at("mean")
        .get<double>();
  };
  BOOST_TEST(similarity("--method jfa --compare-with exact") > 99);
  BOOST_TEST(similarity("--method exact --compare-with jfa") ==
             similarity("--method jfa --compare-with exact"));
  // Both are exact: one of points, and so is the other.
  const std::string both =
      "simulate --json --trajectory t.lammpstrj --size 50x50 --compare-with exact --no-snap";
  BOOST_TEST(json::parse(succeeds(folder, both)).at("similarity").at("mean") == 100);
}

BOOST_AUTO_TEST_CASE(relaxed_points_lie_within_pixels) {
  const TemporaryFolder folder;
  folder.file("p.csv", "x,y\n0.5,0.5\n1.5,0.5\n");
  const std::string line =
      "relax --points p.csv --bounds 0,0,8,3 --size 8x3 --rounds 50 --relaxed-points r.csv";
  succeeds(folder, line + " --no-snap");
  BOOST_TEST(content_of(folder / "r.csv") == "id,x,y\n0,2,1.5\n1,6,1.5\n");
  succeeds(folder, line + " --snap");
  BOOST_TEST(content_of(folder / "r.csv") != "id,x,y\n0,2,1.5\n1,6,1.5\n");
}

BOOST_AUTO_TEST_CASE(whole_pixels_are_the_same_either_way) {
  const TemporaryFolder folder;
  write_points(folder, {{1.3, 2.2}, {7.9, 1.1}, {4.4, 8.2}});
  // Seeds that move at random are whole pixels from frame 0 on.
  const std::string plane = " --points p.csv --bounds 0,0,10,10 --size 10x10";
  succeeds(folder, "simulate --frames 1 --step-length 0 --labels l%d.npy" + plane);
  const auto snapped = labels_of(folder, "render --snap" + plane);
  for (const char* name : {"l0.npy", "l1.npy"}) {
    BOOST_TEST(differences(command::read_labels(folder / name).labels, snapped) == 0u);
  }
  BOOST_TEST(wrong_pixels(folder, "compare l0.npy --snap" + plane) == 0u);
  succeeds(folder, "render --random 30 --size 20x20 --labels r.npy");
  BOOST_TEST(wrong_pixels(folder, "compare r.npy --random 30 --size 20x20") == 0u);
}

BOOST_AUTO_TEST_CASE(what_cannot_be_is_refused) {
  const TemporaryFolder folder;
  folder.file("p.csv", "x,y\n1,2\n3,4\n");
  const std::string points = " --points p.csv --size 9x9 ";
  for (const std::string command : {"render --labels a.npy", "cells --cells a.csv"}) {
    refuses(folder, command + points + "--method jfa --no-snap", usage,
            {"--no-snap is for exact diagrams; the method jfa takes the centres of the points' pixels"});
    succeeds(folder, command + points + "--method jfa --snap");
    std::filesystem::remove(folder / "a.npy");
    std::filesystem::remove(folder / "a.csv");
    refuses(folder, command + " --random 5 --size 9x9 --no-snap", usage,
            {"--no-snap needs --points or --trajectory"});
    refuses(folder, command + " --random 5 --size 9x9 --snap", usage,
            {"--snap needs --points or --trajectory"});
  }
  const std::string walk = "simulate --frames 1 --step-length 1 --labels a%d.npy" + points;
  refuses(folder, walk + "--no-snap", usage, {"--no-snap", "random motion"});
  refuses(folder, walk + "--method djfa --no-snap", usage, {"--no-snap", "the method djfa"});
  refuses(folder, walk + "--method jfa --compare-with djfa --no-snap", usage,
          {"--no-snap", "the method jfa"});
  refuses(folder, "bench --methods exact --no-snap --random 9 --size 9x9", usage,
          {"--no-snap needs --points"});
  refuses(folder, "compare a.npy --no-snap", usage, {"needs another label file"});
  refuses(folder, "compare a.npy b.npy --no-snap", usage, {"snap", "is for seeds"});
}
