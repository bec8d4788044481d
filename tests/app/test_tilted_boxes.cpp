// The command on trajectories whose boxes are tilted: diagrams and measures against the cells that are cut as
// polygons.
#define BOOST_TEST_MODULE tilted_boxes
#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <random>
#include <set>

#include "formats/raster_files.hpp"
#include "host_measures.hpp"
#include "run_command.hpp"
#include "trajectory_text.hpp"

using namespace vorocl;
using namespace vorocl::command;
using nlohmann::json;

namespace {

/// A frame of a box of 10 x 8 with a tilt: as LAMMPS writes it, or as an extended XYZ. Some particles are
/// given as images.
std::string frame_text(double tilt, const std::vector<Point>& particles, bool as_xyz) {
  std::vector<std::string> rows;
  for (std::size_t i = 0; i < particles.size(); ++i) {
    const int x = static_cast<int>(i % 3) - 1, y = static_cast<int>(i / 3 % 3) - 1;
    rows.push_back(
        fmt::format("{} {} {}", i + 1, particles[i].x + 10 * x + tilt * y, particles[i].y + 8 * y));
  }
  if (!as_xyz) {
    return dump(fmt::format("xy xz yz pp pp pp\n{} {} {}\n0 8 0\n-0.5 0.5 0", std::min(tilt, 0.0),
                            10 + std::max(tilt, 0.0), tilt),
                "id x y", rows);
  }
  std::string text =
      fmt::format("{}\nLattice=\"10 0 0 {} 8 0 0 0 1\" Properties=id:I:1:pos:R:2\n", rows.size(), tilt);
  for (const std::string& row : rows) text += row + "\n";
  return text;
}

/// Particles that keep some distance, as those of a liquid do.
std::vector<Point> liquid(unsigned seed, double tilt) {
  std::mt19937_64 rng(seed);
  const auto below = [&](double end) { return end * static_cast<double>(rng() >> 11) * 0x1p-53; };
  std::vector<Point> points;
  while (points.size() < 60) {
    const Point point = {below(10), below(8)};
    const bool is_near = std::any_of(points.begin(), points.end(), [&](const Point& other) {
      const double dy = point.y - other.y, row = std::round(dy / 8);
      return std::hypot(std::remainder(point.x - other.x - row * tilt, 10), dy - row * 8) < 0.7;
    });
    if (!is_near) points.push_back(point);
  }
  return points;
}

const std::vector<double> tilts = {0, 2.3, -3.7, 5, 4.9};

std::string trajectory(bool as_xyz) {
  std::string text;
  for (std::size_t frame = 0; frame < tilts.size(); ++frame)
    text += frame_text(tilts[frame], liquid(static_cast<unsigned>(frame), tilts[frame]), as_xyz);
  return text;
}

/// The root of the mean squared difference of two columns, to the second one's values.
double rms(const Table& found, const Table& exact, std::size_t column, std::size_t of_exact) {
  BOOST_TEST_REQUIRE(found.rows.size() == exact.rows.size());
  double sum = 0;
  for (std::size_t i = 0; i < found.rows.size(); ++i) {
    BOOST_TEST(*found.rows[i][0] == *exact.rows[i][0]);
    const double ratio = *found.rows[i][column] / *exact.rows[i][of_exact] - 1;
    sum += ratio * ratio;
  }
  return std::sqrt(sum / static_cast<double>(found.rows.size()));
}

using Ids = std::pair<double, double>;

std::set<Ids> pairs_of(const Table& table, double least_length) {
  std::set<Ids> pairs;
  for (const TableRow& row : table.rows) {
    if (*row[2] >= least_length) pairs.emplace(*row[0], *row[1]);
  }
  return pairs;
}

}  // namespace

BOOST_AUTO_TEST_CASE(pixels_have_the_areas_and_neighbours_of_polygons) {
  const TemporaryFolder folder;
  folder.file("t.lammpstrj", trajectory(false));
  folder.file("t.xyz", trajectory(true));
  const std::string columns = "--cell-columns id,area,neighbours";
  succeeds(folder, "simulate --trajectory t.lammpstrj --width 600 --cells r%d.csv " + columns);
  for (std::size_t frame = 0; frame < tilts.size(); ++frame) {
    const std::string input = fmt::format("cells --trajectory t.lammpstrj --frame {} --cells ", frame);
    succeeds(folder, fmt::format("{}exact.csv --exact --adjacency e.csv {}", input, columns));
    const Result result =
        run(folder, fmt::format("{}c.csv --width 600 --adjacency a.csv {}", input, columns));
    BOOST_TEST(result.exit_code == 0);
    BOOST_TEST(result.error.empty(), result.error);  // there is nothing to note
    const Table exact = read_table(folder / "exact.csv"), found = read_table(folder / "c.csv");
    BOOST_TEST(rms(found, exact, 1, 1) < 0.002, "frame " << frame);
    const Table edges = read_table(folder / "e.csv"), borders = read_table(folder / "a.csv");
    // Edges of a few pixels may be missed, or invented.
    const auto all = pairs_of(edges, 0), some = pairs_of(edges, 0.1), touching = pairs_of(borders, 0);
    const auto surely = pairs_of(borders, 0.1);
    BOOST_TEST(std::includes(all.begin(), all.end(), surely.begin(), surely.end()), "frame " << frame);
    BOOST_TEST(std::includes(touching.begin(), touching.end(), some.begin(), some.end()), "frame " << frame);
    // An extended XYZ says the same, and so do all frames of a run.
    const std::string text = content_of(folder / "c.csv");
    succeeds(folder,
             fmt::format("cells --trajectory t.xyz --frame {} --width 600 --cells x.csv {}", frame, columns));
    BOOST_TEST(content_of(folder / "x.csv") == text, "frame " << frame);
    BOOST_TEST(content_of(folder / fmt::format("r{}.csv", frame)) == text, "frame " << frame);
  }
}

BOOST_AUTO_TEST_CASE(windows_of_a_tilted_box_show_a_part_of_it) {
  const TemporaryFolder folder;
  folder.file("t.lammpstrj", trajectory(false));
  const std::string input = "render --trajectory t.lammpstrj --frame 2 ";
  succeeds(folder, input + "--size 200x160 --labels all.npy");
  const LabelImage all = read_labels(folder / "all.npy");
  // Pixels 40 to 140 and, from the top, 20 to 80; and with a margin of 10 pixels all round.
  BOOST_TEST(run(folder, input + "--size 100x60 --bounds 2,4,7,7 --labels part.npy").exit_code == 0);
  succeeds(folder, input + "--size 220x180 --bounds=-0.5,-0.5,10.5,8.5 --labels more.npy -o more.png");
  const LabelImage part = read_labels(folder / "part.npy"), more = read_labels(folder / "more.npy");
  std::size_t wrong = 0;
  for (std::size_t y = 0; y < 60; ++y) {
    for (std::size_t x = 0; x < 100; ++x)
      wrong += part.labels[y * 100 + x] != all.labels[(y + 20) * 200 + x + 40];
  }
  BOOST_TEST(wrong == 0u);
  for (std::size_t y = 0; y < 180; ++y) {
    for (std::size_t x = 0; x < 220; ++x) {
      const bool inside = x >= 10 && x < 210 && y >= 10 && y < 170;
      wrong += more.labels[y * 220 + x] != (inside ? all.labels[(y - 10) * 200 + x - 10] : no_label);
    }
  }
  BOOST_TEST(wrong == 0u);
}

BOOST_AUTO_TEST_CASE(statistics_and_pictures_of_a_sheared_run) {
  const TemporaryFolder folder;
  folder.file("t.lammpstrj", trajectory(false));
  const json result = json::parse(succeeds(folder,
                                           "simulate --trajectory t.lammpstrj --size 100x80 --statistics "
                                           "s.csv --labels l%d.npy --edges -o f%d.png --json"));
  BOOST_TEST(result.at("frames") == 4);
  BOOST_TEST(result.at("periodic") == "xy");
  BOOST_TEST(read_table(folder / "s.csv").rows.size() == tilts.size());
}

BOOST_AUTO_TEST_CASE(what_knows_no_tilt_is_refused_by_name) {
  const TemporaryFolder folder;
  folder.file("t.lammpstrj", trajectory(false));
  folder.file("flat.lammpstrj", frame_text(0, liquid(1, 0), false));
  for (const char* const method : {"jfa", "djfa", "low-resolution", "standard-flooding"}) {
    refuses(folder,
            fmt::format("render --trajectory t.lammpstrj --frame 1 --size 100x80 --labels t.npy --method {}",
                        method),
            failure, {"t.lammpstrj", "frame 1", "tilted", "flooding cannot take", "--periodic x"});
  }
  refuses(folder, "simulate --trajectory t.lammpstrj --size 100x80 --compare-with jfa", failure,
          {"t.lammpstrj", "frame 1", "tilted", "flooding cannot take"});
  refuses(folder, "render --trajectory t.lammpstrj --frame 1 --size 100x80 --labels t.npy --periodic y",
          failure, {"t.lammpstrj", "frame 1", "tilted", "straight along y", "--periodic xy or x"});
  // The rectangle alone has no tilt, and a box without one none either.
  const Result flooded =
      run(folder,
          "render --trajectory t.lammpstrj --frame 1 --size 100x80 --labels t.npy --method jfa --periodic x");
  BOOST_TEST(flooded.exit_code == 0, flooded.error);
  succeeds(folder, "render --trajectory flat.lammpstrj --size 100x80 --labels t.npy --method jfa");
}
