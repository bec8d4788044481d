// Volumes of points and trajectories with z: labels against brute force, frame by frame; and what is refused.
#define BOOST_TEST_MODULE volume_trajectories
#include <fmt/format.h>

#include <array>
#include <cmath>
#include <cstring>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>
#include <tuple>

#include "formats/npy.hpp"
#include "run_command.hpp"

using namespace vorocl;

namespace {

struct Particle {
  std::uint32_t id;
  std::array<double, 3> at;
};

/// A box of a frame, and along which axes it repeats.
struct Space {
  std::array<double, 3> low, high;
  std::array<bool, 3> periodic;
};

constexpr std::array<int, 3> cubes = {20, 40, 12};

/// Where a particle is along an axis, in whole numbers of 1/4096 voxel; within its voxel.
std::int64_t place_of(const Space& space, const Particle& particle, std::size_t axis, int voxels) {
  const double length = space.high[axis] - space.low[axis];
  const double at = (particle.at[axis] - space.low[axis]) * voxels / length;
  const double voxel = space.periodic[axis] ? std::floor(at) : std::min(std::floor(at), voxels - 1.0);
  const std::int64_t part = std::min(std::llround((at - voxel) * 4096), 4095LL),
                     whole = static_cast<std::int64_t>(voxel);
  return (space.periodic[axis] ? (whole % voxels + voxels) % voxels : whole) * 4096 + part;
}

/// The file of labels: the id of the particle that is nearest to each voxel's centre, ties by z, y, x and id.
/// `units` are the sides of a voxel.
std::string labels_of(const Space& space, const std::vector<Particle>& particles,
                      const std::array<int, 3>& sides = cubes, const std::array<int, 3>& units = {1, 1, 1}) {
  std::string bytes =
      command::npy_header<std::uint32_t>(std::vector<std::size_t>(sides.rbegin(), sides.rend()));
  std::array<int, 3> voxel = {};
  const auto key = [&](const Particle& particle) {
    std::array<std::int64_t, 3> places = {};
    std::int64_t distance = 0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      places[axis] = place_of(space, particle, axis, sides[axis]);
      std::int64_t way = std::abs(places[axis] - voxel[axis] * 4096 - 2048);
      if (space.periodic[axis]) way = std::min(way, sides[axis] * std::int64_t{4096} - way);
      distance += way * way * units[axis] * units[axis];
    }
    return std::make_tuple(distance, places[2], places[1], places[0], particle.id);
  };
  for (voxel[2] = 0; voxel[2] < sides[2]; ++voxel[2]) {
    for (voxel[1] = 0; voxel[1] < sides[1]; ++voxel[1]) {
      for (voxel[0] = 0; voxel[0] < sides[0]; ++voxel[0]) {
        const Particle* nearest = &particles.front();
        for (const Particle& particle : particles) {
          if (key(particle) < key(*nearest)) nearest = &particle;
        }
        char label[sizeof nearest->id];
        std::memcpy(label, &nearest->id, sizeof label);
        bytes.append(label, sizeof label);
      }
    }
  }
  return bytes;
}

std::string flags(const Space& space) {
  std::string text;
  for (const bool periodic : space.periodic) text += periodic ? " pp" : " ff";
  return text;
}

std::string dump_frame(int step, const Space& space, const std::vector<Particle>& particles, bool scaled) {
  std::string text = fmt::format("ITEM: TIMESTEP\n{}\nITEM: NUMBER OF ATOMS\n{}\nITEM: BOX BOUNDS{}\n", step,
                                 particles.size(), flags(space));
  for (std::size_t axis = 0; axis < 3; ++axis)
    text += fmt::format("{} {}\n", space.low[axis], space.high[axis]);
  text += scaled ? "ITEM: ATOMS id xs ys zs\n" : "ITEM: ATOMS id x y z\n";
  for (const Particle& particle : particles) {
    text += std::to_string(particle.id);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double at = particle.at[axis], length = space.high[axis] - space.low[axis];
      text += fmt::format(" {}", scaled ? (at - space.low[axis]) / length : at);
    }
    text += "\n";
  }
  return text;
}

const Space first = {{0, 0, -1}, {10, 20, 5}, {true, true, true}},
            second = {{0, 2, -1}, {10, 22, 5}, {false, true, false}};
const std::vector<Particle> some = {{90, {1.25, 2, -0.75}}, {4, {9.75, 19.5, 4.75}}, {5, {5, 5.25, 4}}},
                            others = {{5, {5.25, 21, 4.25}}, {90, {1.25, 2, -0.25}}};

/// Exact diagrams of volumes are for CPUs.
}  // namespace

BOOST_AUTO_TEST_CASE(dumps_make_volumes_frame_by_frame) {
  const TemporaryFolder folder;
  folder.file("a.lammpstrj", dump_frame(7, first, some, false) + dump_frame(8, second, others, true));
  const std::string of_file = "--trajectory a.lammpstrj --size 20x40x12 ";
  succeeds(folder, "simulate " + of_file + "--labels f/%02d.npy -o f/%02d.png --slice z=3");
  BOOST_TEST((content_of(folder / "f/00.npy") == labels_of(first, some)));
  BOOST_TEST((content_of(folder / "f/01.npy") == labels_of(second, others)));
  BOOST_TEST(!content_of(folder / "f/01.png").empty());
  succeeds(folder, "render " + of_file + "--frame 1 --labels a.npy");
  BOOST_TEST((content_of(folder / "a.npy") == labels_of(second, others)));
  const auto noted =
      run(folder, "simulate " + of_file + "--frames 1 --labels g/%d.npy --periodic y --every 2 --json");
  BOOST_TEST(noted.error ==
             "vorocl: note: the periodic axes of the file's box are xyz; --periodic y counts instead\n");
  const auto result = nlohmann::json::parse(noted.out);
  BOOST_TEST((result["frames"] == 1 && result["periodic"] == "y" && result["depth"] == 12));
  Space told = first;
  told.periodic = {false, true, false};
  BOOST_TEST((content_of(folder / "g/0.npy") == labels_of(told, some)));
  BOOST_TEST((run(folder, "render " + of_file + "--frame 2 --labels a.npy").exit_code == failure));
}

BOOST_AUTO_TEST_CASE(what_is_complete_of_a_run_stays) {
  const TemporaryFolder folder;
  const std::string whole = dump_frame(8, second, others, true);
  folder.file("cut.lammpstrj", dump_frame(7, first, some, false) + whole.substr(0, whole.size() - 10));
  const std::string run_of_it =
      "simulate --trajectory cut.lammpstrj --size 20x40x12 --method jfa --labels v%d.vti -o a.mp4 --slice "
      "z=3";
  const auto result = run(folder, run_of_it);
  BOOST_TEST((result.exit_code == failure && !content_of(folder / "a.mp4").empty()));
  BOOST_TEST(result.error.find("; frames complete before that: 1, written of them: 1\n") !=
             std::string::npos);
  BOOST_TEST(content_of(folder / "v.pvd").find("timestep=\"7\" part=\"0\" file=\"v0.vti\"") !=
             std::string::npos);
}

BOOST_AUTO_TEST_CASE(xyz_and_points_make_volumes) {
  const TemporaryFolder folder;
  std::string
      xyz = "3\nLattice=\"10 0 0 0 20 0 0 0 6\" Origin=\"0 0 -1\" pbc=\"T T T\" Properties=id:I:1:pos:R:3\n",
      csv = "z,x,y\n";
  for (const Particle& particle : some) {
    const auto& [x, y, z] = particle.at;
    xyz += fmt::format("{} {} {} {}\n", particle.id, x, y, z);
    csv += fmt::format("{},{},{}\n", z, x, y);
  }
  folder.file("a.xyz", xyz);
  succeeds(folder, "render --trajectory a.xyz --size 20x40x12 --labels a.npy");
  BOOST_TEST((content_of(folder / "a.npy") == labels_of(first, some)));
  folder.file("p.csv", csv);
  std::vector<Particle> numbered = some;
  for (std::size_t i = 0; i < numbered.size(); ++i) numbered[i].id = static_cast<std::uint32_t>(i);
  const std::string size = "--size 20x40x12 --labels a.npy ", bounds = "--bounds=0,0,-1,10,20,5 ";
  for (const bool periodic : {false, true}) {
    Space space = first;
    space.periodic = {false, periodic, false};
    succeeds(folder, "render --points p.csv " + size + bounds + (periodic ? "--periodic y" : ""));
    BOOST_TEST((content_of(folder / "a.npy") == labels_of(space, numbered)));
  }
  const std::string labels = content_of(folder / "a.npy");
  folder.file("numbers.csv", csv.substr(csv.find('\n') + 1));
  succeeds(folder, "render --points numbers.csv --columns 1,2,0 " + size + bounds + "--periodic y");
  BOOST_TEST((content_of(folder / "a.npy") == labels));
  const Space tight = {{1.25, 2, -0.75}, {9.75, 19.5, 4.75}, {false, false, false}};
  BOOST_TEST(run(folder, "render --points p.csv " + size).error.find("as 34 : 35 : 37 in the data") !=
             std::string::npos);
  BOOST_TEST((content_of(folder / "a.npy") == labels_of(tight, numbered, cubes, {34, 35, 37})));
  // A microscope's voxels of 0.065 x 0.065 x 0.2; and one with sides too far apart.
  const std::string of_bounds = "render --points p.csv --size 20x40x12 --labels a.npy --bounds=0,0,-1,";
  const Space deep = {{0, 0, -1}, {13, 26, 23}, {false, false, false}},
              deeper = {{0, 0, -1}, {13, 26, 599}, deep.periodic};
  BOOST_TEST(run(folder, of_bounds + "13,26,23").error.find("as 13 : 13 : 40 in the data") !=
             std::string::npos);
  BOOST_TEST((content_of(folder / "a.npy") == labels_of(deep, numbered, cubes, {13, 13, 40})));
  BOOST_TEST(run(folder, of_bounds + "13,26,599").error.find("different scales") != std::string::npos);
  BOOST_TEST((content_of(folder / "a.npy") == labels_of(deeper, numbered)));
}

namespace {

/// A table's header, and its rows as numbers; NAN where there is none.
struct Table {
  explicit Table(const std::string& text) {
    std::istringstream lines(text);
    std::string line, value;
    std::getline(lines, header);
    while (std::getline(lines, line)) {
      std::vector<double>& row = rows.emplace_back();
      std::istringstream values(line + ",");
      while (std::getline(values, value, ',')) row.push_back(value.empty() ? NAN : std::stod(value));
    }
  }

  std::string header;
  std::vector<std::vector<double>> rows;
};

std::vector<std::uint32_t> labels_in(const std::string& file) {
  const std::size_t header = command::npy_header<std::uint32_t>({cubes[2], cubes[1], cubes[0]}).size();
  std::vector<std::uint32_t> labels((file.size() - header) / sizeof(std::uint32_t));
  std::memcpy(labels.data(), file.data() + header, labels.size() * sizeof(std::uint32_t));
  return labels;
}

}  // namespace

BOOST_AUTO_TEST_CASE(cells_of_files_have_their_ids_and_units) {
  const TemporaryFolder folder;
  const Space box = {{0, 0, -1}, {10, 20, 5}, {false, false, false}};
  folder.file("a.lammpstrj", dump_frame(6, first, others, false) + dump_frame(7, box, some, false));
  const std::string file = labels_of(box, some), dump = "--trajectory a.lammpstrj --frame 1 ";
  const std::vector<std::uint32_t> labels = labels_in(file);
  const auto json = nlohmann::json::parse(
      succeeds(folder, "cells " + dump +
                           "--size 20x40x12 --cells a.csv --adjacency b.csv --labels a.npy --distance d.npy "
                           "--json"));
  BOOST_TEST((content_of(folder / "a.npy") == file));
  BOOST_TEST((json["volume_unit"] == "data" && json["length_unit"] == "data" && json["mean_volume"] == 400));

  const double side = 0.5;  // of a voxel, in data units
  const Table cells(content_of(folder / "a.csv")), pairs(content_of(folder / "b.csv"));
  BOOST_TEST_REQUIRE(cells.rows.size() == 3u);
  double surfaces = 0, areas = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto& row = cells.rows[i];
    const Particle& particle = some[i == 2 ? 0 : i + 1];  // by id
    BOOST_TEST(row[0] == particle.id);
    std::array<double, 3> low = {99, 99, 99}, high = {-99, -99, -99}, sum = {}, centre = {};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      centre[axis] =
          box.low[axis] + static_cast<double>(place_of(box, particle, axis, cubes[axis])) / 4096 * side;
    }
    double count = 0, farthest = 0;
    for (std::size_t voxel = 0; voxel < labels.size(); ++voxel) {
      if (labels[voxel] != particle.id) continue;
      const std::size_t at[] = {voxel % 20, voxel / 20 % 40, voxel / 800};
      double distance = 0;
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const double place = box.low[axis] + (static_cast<double>(at[axis]) + 0.5) * side;
        low[axis] = std::min(low[axis], place - side / 2);
        high[axis] = std::max(high[axis], place + side / 2);
        sum[axis] += place;
        distance += (place - centre[axis]) * (place - centre[axis]);
      }
      farthest = std::max(farthest, distance);
      ++count;
    }
    BOOST_TEST(std::abs(row[4] - count * side * side * side) < 1e-9);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      BOOST_TEST(std::abs(row[1 + axis] - centre[axis]) < 1e-9);
      BOOST_TEST(std::abs(row[5 + axis] - sum[axis] / count) < 1e-9);
      BOOST_TEST((row[8 + axis] == low[axis] && row[11 + axis] == high[axis]));
    }
    BOOST_TEST(std::abs(row[16] - std::sqrt(farthest)) < 1e-9);
    surfaces += row[14];
  }
  const auto faces = [&] {  // between different labels
    std::size_t count = 0;
    const std::size_t steps[] = {1, 20, 800};
    for (std::size_t voxel = 0; voxel < labels.size(); ++voxel) {
      const std::size_t at[] = {voxel % 20, voxel / 20 % 40, voxel / 800};
      for (std::size_t axis = 0; axis < 3; ++axis) {
        if (at[axis] > 0 && labels[voxel] != labels[voxel - steps[axis]]) ++count;
      }
    }
    return static_cast<double>(count);
  }();
  for (const auto& pair : pairs.rows) {
    BOOST_TEST(pair[0] < pair[1]);
    areas += pair[2];
  }
  BOOST_TEST((std::abs(areas - faces * side * side) < 1e-9 && std::abs(surfaces - 2 * areas) < 1e-9));

  // In voxels, and where distances have no scale, lengths and areas alone.
  succeeds(folder, "cells " + dump + "--size 20x40x12 --units px --cells px.csv --labels px.vti");
  const Table in_voxels(content_of(folder / "px.csv"));
  BOOST_TEST(in_voxels.header == cells.header);
  for (std::size_t i = 0; i < 3; ++i)
    BOOST_TEST(std::abs(in_voxels.rows[i][4] / 8 - cells.rows[i][4]) < 1e-9);
  BOOST_TEST(content_of(folder / "px.vti").find("Origin=\"0 0 0\" Spacing=\"1 1 1\"") != std::string::npos);
  const auto warned = run(folder, "cells " + dump + "--size 41x40x12 --cells a.csv --adjacency b.csv");
  BOOST_TEST((warned.exit_code == 0 && warned.error.find("different scales") != std::string::npos));
  const Table flat(content_of(folder / "a.csv"));
  BOOST_TEST((flat.header.find(",surface_px,neighbours,largest_distance_px,") != std::string::npos));
  BOOST_TEST(Table(content_of(folder / "b.csv")).header == "a,b,area_px");
  BOOST_TEST(std::abs(flat.rows[0][4] + flat.rows[1][4] + flat.rows[2][4] - 1200) < 1e-9);
}

BOOST_AUTO_TEST_CASE(voxels_that_are_no_cubes_count_as_they_are_long) {
  const TemporaryFolder folder;
  Space open = first, moved = second;
  open.periodic = moved.periodic = {false, false, false};
  folder.file("a.lammpstrj", dump_frame(7, open, some, false) + dump_frame(8, moved, others, false));
  folder.file("p.csv", "x,y,z\n1.25,2,-0.75\n9.75,19.5,4.75\n5,5.25,4\n");
  const std::array<int, 3> sides = {20, 20, 3}, units = {1, 2, 4};
  const std::string
      size = " --size 20x20x3 ",
      points = "--points p.csv --bounds=0,0,-1,10,20,5" + size,
      note = "vorocl: note: the sides of a voxel are as 1 : 2 : 4 in the data, and distances count them so\n";
  const auto noted = [&](const std::string& arguments) {
    const auto result = run(folder, arguments);
    BOOST_TEST((result.exit_code == 0 && result.error == note), arguments << "\n" << result.error);
    return result.out;
  };
  noted("simulate --trajectory a.lammpstrj" + size + "--fit frame --labels f%d.npy");
  BOOST_TEST((content_of(folder / "f0.npy") == labels_of(open, some, sides, units)));
  BOOST_TEST((content_of(folder / "f1.npy") == labels_of(moved, others, sides, units)));
  std::vector<Particle> numbered = some;
  for (std::size_t i = 0; i < numbered.size(); ++i) numbered[i].id = static_cast<std::uint32_t>(i);
  const auto json = nlohmann::json::parse(
      noted("cells " + points + "--labels a.npy --distance d.npy --cells a.csv --adjacency b.csv --json"));
  BOOST_TEST((content_of(folder / "a.npy") == labels_of(open, numbered, sides, units)));
  BOOST_TEST((json["spacing"] == std::vector{1, 2, 4} && json["length_unit"] == "data"));

  BOOST_TEST(nlohmann::json::parse(noted(
                 "cells " + points + "--units px --cells u.csv --json"))["length_unit"] == "spacing 1:2:4");

  // Of each label the farthest voxel, in data units, and its volume; faces stay a number.
  const Table table(content_of(folder / "a.csv"));
  BOOST_TEST((table.header.find(",surface_px,neighbours,largest_distance,") != std::string::npos));
  BOOST_TEST(Table(content_of(folder / "b.csv")).header == "a,b,area_px");
  const std::string labels = content_of(folder / "a.npy"), distances = content_of(folder / "d.npy");
  const double voxel[] = {0.5, 1, 2};
  std::array<double, 3> farthest = {}, volumes = {};
  for (int i = 0; i < 20 * 20 * 3; ++i) {
    const int at[] = {i % 20, i / 20 % 20, i / 400};
    std::uint32_t label = 0;
    float found = 0;
    std::memcpy(&label, labels.data() + labels.size() - 4 * (20 * 20 * 3 - i), 4);
    std::memcpy(&found, distances.data() + distances.size() - 4 * (20 * 20 * 3 - i), 4);
    double sum = 0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double place = static_cast<double>(place_of(open, some[label], axis, sides[axis])) / 4096;
      sum += std::pow((at[axis] + 0.5 - place) * voxel[axis], 2);
    }
    BOOST_TEST_REQUIRE(std::abs(found - std::sqrt(sum)) < 1e-5);
    farthest[label] = std::max(farthest[label], std::sqrt(sum));
    volumes[label] += voxel[0] * voxel[1] * voxel[2];
  }
  for (std::size_t id = 0; id < 3; ++id) {
    BOOST_TEST((std::abs(table.rows[id][4] - volumes[id]) < 1e-9));
    BOOST_TEST((std::abs(table.rows[id][16] - farthest[id]) < 1e-9));
  }

  // Few slices, a scale that differs by less than 1/1000, and a side that would have too many units.
  const auto told = [&](const std::string& grid) {
    return run(folder, "render --points p.csv --method jfa --labels k.npy " + grid).error;
  };
  BOOST_TEST(told("--size 50x100x2 --bounds=0,0,-1,10,20,5").find("as 1 : 1 : 15 in the data") !=
             std::string::npos);
  BOOST_TEST(told("--size 1000x20x6 --bounds=0,0,-1,1000.9,20,5").empty());
  BOOST_TEST(
      told("--size 1300x20x6 --bounds=0,0,-1,1386.6667,20,5").find("different scales on 1300 x 20 x 6") !=
      std::string::npos);

  // The methods that compare and time take the same distances.
  noted("render " + points + "--method jfa --labels j.npy");
  const std::string compare = "compare j.npy " + points;
  const auto errors = nlohmann::json::parse(noted(compare + "--json"))["errors"];
  const auto bench =
      nlohmann::json::parse(noted("bench " + points + "--methods exact,jfa --repeat 1 --json"))["results"];
  BOOST_TEST((bench[0]["wrong_pixels"] == 0 && bench[1]["wrong_pixels"] == errors["wrong_pixels"]));
  BOOST_TEST(noted(compare).find("units of the spacing") != std::string::npos);
}

namespace {

/// How many voxels have each label.
std::map<std::uint32_t, double> counts_of(const std::vector<std::uint32_t>& labels) {
  std::map<std::uint32_t, double> counts;
  for (const std::uint32_t label : labels) ++counts[label];
  return counts;
}

double differences(const std::vector<std::uint32_t>& a, const std::vector<std::uint32_t>& b) {
  std::size_t equal = 0;
  for (std::size_t i = 0; i < a.size(); ++i) equal += a[i] == b[i] ? 1 : 0;
  return static_cast<double>(a.size() - equal);
}

/// A table of all frames as the tables of each make it: the first lines differ by two columns.
std::string with_frames(const std::vector<std::pair<std::string, std::string>>& tables) {
  std::string text;
  for (const auto& [frame, table] : tables) {
    std::istringstream lines(table);
    std::string line;
    std::getline(lines, line);
    if (text.empty()) text = "frame,timestep," + line + "\n";
    while (std::getline(lines, line)) text += frame + line + "\n";
  }
  return text;
}

}  // namespace

BOOST_AUTO_TEST_CASE(tables_of_all_frames_are_those_of_each) {
  const TemporaryFolder folder;
  folder.file("a.lammpstrj", dump_frame(7, first, some, false) + dump_frame(9, first, others, true));
  const std::string dump = " --trajectory a.lammpstrj --size 20x40x12 ";
  succeeds(folder, "simulate" + dump +
                       "--labels l%d.npy --cells c%d.csv --adjacency a%d.csv --distance d%d.npy --statistics "
                       "s.csv");
  succeeds(folder, "simulate" + dump + "--cells c.csv --adjacency a.csv");
  const std::string cells_of_frame = "cells" + dump + "--frame ";
  for (const std::string frame : {"0", "1"}) {
    succeeds(folder, cells_of_frame + frame +
                         " --cells one.csv --adjacency two.csv --distance one.npy --labels two.npy");
    BOOST_TEST((content_of(folder / ("c" + frame + ".csv")) == content_of(folder / "one.csv")));
    BOOST_TEST((content_of(folder / ("a" + frame + ".csv")) == content_of(folder / "two.csv")));
    BOOST_TEST((content_of(folder / ("d" + frame + ".npy")) == content_of(folder / "one.npy")));
    BOOST_TEST((content_of(folder / ("l" + frame + ".npy")) == content_of(folder / "two.npy")));
  }
  for (const std::string kind : {"c", "a"}) {
    BOOST_TEST(content_of(folder / (kind + ".csv")) ==
               with_frames({{"0,7,", content_of(folder / (kind + "0.csv"))},
                            {"1,9,", content_of(folder / (kind + "1.csv"))}}));
  }
  // By brute force.
  const std::vector<std::uint32_t> before = labels_in(labels_of(first, some)),
                                   after = labels_in(labels_of(first, others));
  const double of_voxel = 0.5 * 0.5 * 0.5;
  const Table cells(content_of(folder / "c.csv")), statistics(content_of(folder / "s.csv"));
  BOOST_TEST_REQUIRE((cells.rows.size() == 5u && statistics.rows.size() == 2u));
  for (const auto& row : cells.rows) {
    const auto counts = counts_of(row[0] == 0 ? before : after);
    BOOST_TEST(std::abs(row[6] - counts.at(static_cast<std::uint32_t>(row[2])) * of_voxel) < 1e-9);
  }
  BOOST_TEST(statistics.header ==
             "frame,cells,empty_cells,mean_volume,volume_deviation,changed_voxels,milliseconds,box_x0,box_y0,"
             "box_z0,box_x1,box_y1,box_z1,timestep,neighbours_8,neighbours_9,neighbours_10,neighbours_11,"
             "neighbours_12,neighbours_13,neighbours_14,neighbours_15,neighbours_16,neighbours_17,neighbours_"
             "18,neighbours_19,neighbours_20,neighbours_21,neighbours_22");
  for (std::size_t frame = 0; frame < 2; ++frame) {
    const auto counts = counts_of(frame == 0 ? before : after);
    const double mean = 1200 / static_cast<double>(counts.size());
    double squares = 0;
    for (const auto& [id, count] : counts) squares += std::pow(count * of_voxel - mean, 2);
    const auto& row = statistics.rows[frame];
    BOOST_TEST((static_cast<std::size_t>(row[0]) == frame && row[2] == 0));
    BOOST_TEST(static_cast<std::size_t>(row[1]) == counts.size());
    BOOST_TEST(std::abs(row[3] - mean) < 1e-9);
    BOOST_TEST(std::abs(row[4] - std::sqrt(squares / static_cast<double>(counts.size()))) < 1e-9);
    BOOST_TEST(
        (row[7] == 0 && row[8] == 0 && row[9] == -1 && row[10] == 10 && row[11] == 20 && row[12] == 5));
  }
  BOOST_TEST((std::isnan(statistics.rows[0][5]) && statistics.rows[1][5] == differences(before, after)));
}

BOOST_AUTO_TEST_CASE(frames_share_what_does_not_repeat) {
  const TemporaryFolder folder;
  // Along y the periods are those of each frame; x and z are what both fill, by walls and by particles.
  Space low = {{0, 0, -1}, {8, 20, 4}, {false, true, false}}, high = {{2, 2, 0}, {10, 23, 5}, low.periodic};
  const std::vector<Particle> a = {{7, {0.2, 3, 0}}, {8, {7.5, 12, 3}}, {9, {3, 19, 3.5}}},
                              b = {{7, {2.5, 3, 0.5}}, {9, {9.5, 22, 4.5}}, {8, {4, 12, 3}}};
  folder.file("a.lammpstrj", dump_frame(1, low, a, false) + dump_frame(2, high, b, true));
  const std::string simulate = "simulate --trajectory a.lammpstrj --size 20x40x12 ";
  const auto runs = [&](const std::string& line) {  // scales may differ, of which it warns
    return run(folder, line).exit_code == 0;
  };
  BOOST_TEST(runs(simulate + "--labels own%d.npy --fit frame"));
  BOOST_TEST((content_of(folder / "own0.npy") == labels_of(low, a)));
  BOOST_TEST((content_of(folder / "own1.npy") == labels_of(high, b)));
  BOOST_TEST(runs(simulate + "--labels all%d.npy --cells c%d.csv"));
  for (Space* const space : {&low, &high}) {
    space->low = {0, space->low[1], -1};
    space->high = {10, space->high[1], 5};
  }
  BOOST_TEST((content_of(folder / "all0.npy") == labels_of(low, a)));
  BOOST_TEST((content_of(folder / "all1.npy") == labels_of(high, b)));
  // Sides that give way hold the particles of all frames.
  std::string open = dump_frame(1, low, a, false) + dump_frame(2, low, b, false);
  for (const auto& [closed, given] :
       {std::pair(" ff pp ff", " ff pp ss"), std::pair("\n-1 5\n", "\n0 4.1\n")}) {
    const std::size_t size = std::string(closed).size();
    for (std::size_t at = 0; (at = open.find(closed, at)) != std::string::npos;)
      open.replace(at, size, given);
  }
  folder.file("open.lammpstrj", open);
  BOOST_TEST(runs("simulate --trajectory open.lammpstrj --size 20x40x12 --labels open%d.npy"));
  low.low[2] = 0;
  low.high[2] = 4.5;
  BOOST_TEST((content_of(folder / "open0.npy") == labels_of(low, a, cubes, {4, 4, 3})));
  BOOST_TEST((content_of(folder / "open1.npy") == labels_of(low, b, cubes, {4, 4, 3})));

  // Voxels are cubes in the first frame alone: two units cannot share a table.
  const auto refused = run(folder, simulate + "--cells c.csv");
  BOOST_TEST(
      (refused.exit_code == failure && content_of(folder / "c.csv").find("\n1,") == std::string::npos));
  BOOST_TEST(refused.error.find("frame 1 is measured in other units than the frames before") !=
             std::string::npos);
  BOOST_TEST(refused.error.find("--units px where the spacing stays the same") != std::string::npos);
  const std::string first_line =
      content_of(folder / "c1.csv").substr(0, content_of(folder / "c1.csv").find('\n'));
  BOOST_TEST(first_line.find("largest_distance_px") != std::string::npos);
  BOOST_TEST(runs(simulate + "--cells c.csv --units px"));

  // Where voxels are spaced otherwise distances alone have other units, which pairs of cells do not have.
  Space flat = {{0, 0, 0}, {20, 40, 24}, low.periodic}, deep = {{0, 0, 0}, {20, 40, 48}, low.periodic};
  folder.file("a.lammpstrj", dump_frame(1, flat, a, false) + dump_frame(2, deep, a, false));
  const std::string spaced = simulate + "--fit frame --units px ";
  BOOST_TEST(runs(spaced + "--adjacency pairs.csv"));
  BOOST_TEST(content_of(folder / "pairs.csv").find("\n1,") != std::string::npos);
  BOOST_TEST(run(folder, spaced + "--cells c.csv").error.find("other units") != std::string::npos);
}

BOOST_AUTO_TEST_CASE(flooding_is_compared_with_exact_labels) {
  const TemporaryFolder folder;
  constexpr std::size_t side = 48;
  const std::string melt =
      "simulate --trajectory " VOROCL_SAMPLES "/lj-melt-3d.lammpstrj --frames 1 --size 48x48x48 ";
  const auto json = nlohmann::json::parse(succeeds(
      folder, melt + "--method jfa --compare-with exact --labels f%d.npy --similarity s.csv --json"));
  succeeds(folder, melt + "--snap --labels e%d.npy --cells c%d.csv --units px");  // as flooding takes them
  const std::vector<std::uint32_t> flooded = labels_in(content_of(folder / "f1.npy")),
                                   exact = labels_in(content_of(folder / "e1.npy"));
  std::map<std::uint32_t, std::array<int, 3>> seeds;
  for (const auto& row : Table(content_of(folder / "c1.csv")).rows) {
    seeds[static_cast<std::uint32_t>(row[0])] = {static_cast<int>(row[1]), static_cast<int>(row[2]),
                                                 static_cast<int>(row[3])};
  }
  const auto distance = [&](std::size_t voxel, std::uint32_t label) {
    const std::size_t at[] = {voxel % side, voxel / side % side, voxel / side / side};
    int squares = 0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const int straight = std::abs(static_cast<int>(at[axis]) - seeds.at(label)[axis]),
                way = std::min(straight, static_cast<int>(side) - straight);
      squares += way * way;
    }
    return std::sqrt(squares);
  };
  double wrong = 0, largest = 0;
  BOOST_TEST_REQUIRE((flooded.size() == side * side * side && exact.size() == flooded.size()));
  for (std::size_t voxel = 0; voxel < exact.size(); ++voxel) {
    const double excess = distance(voxel, flooded[voxel]) - distance(voxel, exact[voxel]);
    BOOST_TEST(excess >= 0);
    wrong += excess > 0 ? 1 : 0;
    largest = std::max(largest, excess);
  }
  const Table table(content_of(folder / "s.csv"));
  BOOST_TEST(table.header == "frame,similarity,wrong_percent,largest_excess,mean_excess");
  BOOST_TEST_REQUIRE(table.rows.size() == 1u);
  const auto& row = table.rows[0];
  const double all = static_cast<double>(exact.size());
  BOOST_TEST((wrong > 0 && row[0] == 1));
  BOOST_TEST(std::abs(row[1] - 100 * (1 - differences(flooded, exact) / all)) < 1e-9);
  BOOST_TEST(std::abs(row[2] - 100 * wrong / all) < 1e-9);
  BOOST_TEST(std::abs(row[3] - largest) < 1e-5);
  BOOST_TEST((json["errors"]["wrong_percent_mean"] == row[2] && json["compare_with"]["method"] == "exact"));
}

BOOST_AUTO_TEST_CASE(image_data_lie_where_the_data_lie) {
  const TemporaryFolder folder;
  folder.file("a.lammpstrj", dump_frame(7, first, some, false));
  const std::string dump = "--trajectory a.lammpstrj --size 20x40x12 ";
  const std::string place = "Origin=\"0 0 -1\" Spacing=\"0.5 0.5 0.5\"";
  succeeds(folder, "cells " + dump + "--labels a.vti --distance d.vti");
  succeeds(folder, "render " + dump + "--labels b.vti");
  succeeds(folder, "simulate " + dump + "--labels c%d.vti");
  const std::string labels = content_of(folder / "a.vti"), distances = content_of(folder / "d.vti");
  BOOST_TEST((labels.find(place) != std::string::npos && distances.find(place) != std::string::npos));
  BOOST_TEST((content_of(folder / "b.vti") == labels && content_of(folder / "c0.vti") == labels));
  const std::size_t bytes = 4 * 20 * 40 * 12,
                    end = distances.find("\n  </AppendedData>", distances.size() - 60);
  BOOST_TEST(distances.find("type=\"Float32\" Name=\"distance\"") != std::string::npos);
  std::vector<float> values(bytes / 4);
  std::memcpy(values.data(), distances.data() + end - bytes, bytes);
  // Particle 90 is at the centre of its voxel along x and z, and on its side along y; in data units.
  BOOST_TEST(std::abs(values[2 + 4 * 20] - 0.25) < 1e-6);
  BOOST_TEST(std::abs(values[3 + 4 * 20] - std::sqrt(0.5 * 0.5 + 0.25 * 0.25)) < 1e-6);
}

BOOST_AUTO_TEST_CASE(labels_of_particles_are_compared_with_theirs) {
  const TemporaryFolder folder;
  folder.file("a.lammpstrj", dump_frame(7, first, some, false));
  std::string labels = labels_of(first, some);
  const std::string compare = "compare a.npy --trajectory a.lammpstrj --no-snap --json";
  folder.file("a.npy", labels);
  BOOST_TEST(nlohmann::json::parse(succeeds(folder, compare))["errors"]["wrong_pixels"] == 0u);
  labels.replace(labels.size() - 8, 8, std::string("\x03\0\0\0\xff\xff\xff\xff", 8));  // none of the file's
  folder.file("a.npy", labels);
  const auto compared = run(folder, compare);
  BOOST_TEST(compared.error ==
             "vorocl: note: 1 of 9600 labels in a.npy name none of the seeds: it may be of others\n");
  const auto judged = nlohmann::json::parse(compared.out);
  BOOST_TEST((judged["errors"]["wrong_pixels"] == 2u && judged["errors"]["unlabelled_pixels"] == 2u));
}

BOOST_AUTO_TEST_CASE(planes_tell_that_they_leave_out_z) {
  const TemporaryFolder folder;
  folder.file("p.csv", "x,Y,Z\n1,2,3\n4,5,6\n");
  const std::string render = "render --points p.csv --size 8x8 ";
  const std::string note =
      "vorocl: note: p.csv: z is left out; volumes have it, with --size WxHxD, or with --exact --columns "
      "X,Y,Z\n";
  BOOST_TEST(run(folder, render + "--labels a.npy").error == note);
  BOOST_TEST(run(folder, "cells --exact --points p.csv --cells c.csv").error == note);
  succeeds(folder, render + "--labels a.npy --columns x,Y");  // which says it
  succeeds(folder, render + "-o a.png --color column:Z");     // which shows it
}

BOOST_AUTO_TEST_CASE(what_volumes_of_files_cannot_be_is_refused) {
  const TemporaryFolder folder;
  folder.file("p.csv", "x,y,z\n1,2,3\n4,5,6\n");
  folder.file("flat.csv", "x,y\n1,2\n");
  folder.file("a.lammpstrj", dump_frame(7, first, some, false));
  folder.file("tilted.xyz", "1\nLattice=\"10 0 0 3 20 0 0 0 6\"\nA 1 2 3\n");
  folder.file("sheared.xyz", "1\nLattice=\"10 0 0 0 20 0 1 0 6\"\nA 1 2 3\n");
  folder.file("turned.xyz", "1\nLattice=\"10 0 1 0 20 0 0 0 6\"\nA 1 2 3\n");
  folder.file("flat.lammpstrj",
              "ITEM: TIMESTEP\n0\nITEM: NUMBER OF ATOMS\n1\nITEM: BOX BOUNDS pp pp pp\n0 1\n0 1\n"
              "0 1\nITEM: ATOMS id x y\n1 0 0\n");
  const std::string volume = " --size 8x8x8 --labels a.npy ", points = "render --points p.csv" + volume,
                    dump = "render --trajectory a.lammpstrj" + volume;
  refuses(folder, points + "--bounds 0,0,8,8", usage, {"six numbers: X0,Y0,Z0,X1,Y1,Z1"});
  refuses(folder, points + "--bounds 0,0,8,8,8,8", usage, {"Z0 < Z1"});
  refuses(folder, points + "--bounds 0,0,0,8,8", usage, {"X0,Y0,X1,Y1 or, of a volume, X0,Y0,Z0,X1,Y1,Z1"});
  for (const std::string domain : {"0,0,9,9", "0,0,0,9,9,9"}) {
    refuses(folder, points + "--periodic x --domain " + domain, usage,
            {"the periods of a volume are its --bounds"});
  }
  refuses(folder, points + "--bounds 0,0,0,8,8,4", failure, {"point 1 at (4, 5, 6)", "in z from 0 to 4"});
  refuses(folder, points + "--columns x,y", usage, {"three: X,Y,Z"});
  refuses(folder, points + "--outside count", usage, {"--outside is for planes"});
  refuses(folder, "render --points flat.csv" + volume, failure, {"no column z", "choose three"});
  refuses(folder, dump + "--y-up", usage, {"--y-up is for planes"});
  refuses(folder, dump + "--bounds=0,0,-1,10,20,4", failure,
          {"frame 0", "whole periods: in z", "from -1 to 5"});
  for (const std::string name : {"tilted.xyz", "sheared.xyz"}) {
    refuses(folder, "render --trajectory " + name + volume + "--periodic x", failure,
            {name, "frame 0", "tilted", "leave --periodic out"});
    refuses(folder, "render --method jfa --trajectory " + name + volume, failure,
            {name, "frame 0", "tilted", "flooding cannot take"});
  }
  refuses(folder, "render --trajectory turned.xyz" + volume, failure,
          {"turned.xyz:2", "turned out of its plane"});
  refuses(folder, "render --trajectory flat.lammpstrj" + volume, failure, {"no z, which a volume needs"});
  refuses(folder, "simulate --random 3 --size 8x8x8 --step-length 1 --frames 2 --labels a%d.npy", usage,
          {"of a --trajectory"});
  const std::string simulate = "simulate --trajectory a.lammpstrj --size 8x8x8 --labels %d.npy ";
  refuses(folder, simulate + "--method jfa --no-snap", usage, {"--no-snap is for exact diagrams"});
  refuses(folder, simulate + "--tolerance 1 --compare-with exact", usage, {"--tolerance is for planes"});
  for (const std::string option : {"--method djfa", "--compare-with djfa"}) {
    refuses(folder, simulate + option, usage, {"djfa is for planes; volumes have"});
  }
  refuses(folder, simulate + "-o %d.png", usage, {"-o needs --slice z=K"});
  for (const std::string of_volumes : {"--bounds 0,0,0,8,8,8", "--periodic xz", "--columns x,y,z"}) {
    refuses(folder, "render --points p.csv --size 8x8 --labels a.npy " + of_volumes, usage, {"for volumes"});
  }
}
