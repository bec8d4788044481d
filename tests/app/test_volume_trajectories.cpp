// Volumes of points and trajectories with z: labels against brute force, frame by frame; and what is refused.
#define BOOST_TEST_MODULE volume_trajectories
#include <fmt/format.h>

#include <array>
#include <cmath>
#include <cstring>
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

/// The file of labels: the id of the nearest voxel that has a particle, ties by z, y, x and id. `units` are
/// the sides of a voxel.
std::string labels_of(const Space& space, const std::vector<Particle>& particles,
                      const std::array<int, 3>& sides = cubes, const std::array<int, 3>& units = {1, 1, 1}) {
  std::string bytes =
      command::npy_header<std::uint32_t>(std::vector<std::size_t>(sides.rbegin(), sides.rend()));
  std::array<int, 3> voxel = {};
  const auto key = [&](const Particle& particle) {
    std::array<int, 3> of_seed = {};
    int distance = 0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double length = space.high[axis] - space.low[axis];
      const auto at =
          static_cast<int>(std::floor((particle.at[axis] - space.low[axis]) * sides[axis] / length));
      of_seed[axis] = space.periodic[axis] ? (at % sides[axis] + sides[axis]) % sides[axis]
                                           : std::min(at, sides[axis] - 1);
      int way = std::abs(of_seed[axis] - voxel[axis]);
      if (space.periodic[axis]) way = std::min(way, sides[axis] - way);
      distance += way * way * units[axis] * units[axis];
    }
    return std::make_tuple(distance, of_seed[2], of_seed[1], of_seed[0], particle.id);
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
bool can_be_exact() { return test_device().tuning().shape == Shape::vector; }

}  // namespace

BOOST_AUTO_TEST_CASE(dumps_make_volumes_frame_by_frame) {
  if (!can_be_exact()) return;
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
  BOOST_TEST((result["frames"] == 2 && result["periodic"] == "y" && result["depth"] == 12));
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
  BOOST_TEST(result.error.find("; frames complete before that: 1\n") != std::string::npos);
  BOOST_TEST(content_of(folder / "v.pvd").find("timestep=\"7\" part=\"0\" file=\"v0.vti\"") !=
             std::string::npos);
  folder.file("v%d.vti.journal", "of a run");
  BOOST_TEST(run(folder, run_of_it).error.find("v%d.vti.journal") != std::string::npos);
}

BOOST_AUTO_TEST_CASE(xyz_and_points_make_volumes) {
  if (!can_be_exact()) return;
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
  BOOST_TEST(run(folder, "render --points p.csv " + size).error.find("different scales") !=
             std::string::npos);
  BOOST_TEST((content_of(folder / "a.npy") == labels_of(tight, numbered)));
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

}  // namespace

BOOST_AUTO_TEST_CASE(cells_of_files_have_their_ids_and_units) {
  if (!can_be_exact()) return;
  const TemporaryFolder folder;
  const Space box = {{0, 0, -1}, {10, 20, 5}, {false, false, false}};
  folder.file("a.lammpstrj", dump_frame(6, first, others, false) + dump_frame(7, box, some, false));
  const std::string file = labels_of(box, some), dump = "--trajectory a.lammpstrj --frame 1 ";
  std::vector<std::uint32_t> labels(cubes[0] * cubes[1] * cubes[2]);
  std::memcpy(labels.data(), file.data() + file.size() - labels.size() * 4, labels.size() * 4);
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
      centre[axis] = box.low[axis] + (std::floor((particle.at[axis] - box.low[axis]) / side) + 0.5) * side;
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
  if (!can_be_exact()) return;
  const TemporaryFolder folder;
  Space open = first, moved = second;
  open.periodic = moved.periodic = {false, false, false};
  folder.file("a.lammpstrj", dump_frame(7, open, some, false) + dump_frame(8, moved, others, false));
  folder.file("p.csv", "x,y,z\n1.25,2,-0.75\n9.75,19.5,4.75\n5,5.25,4\n");
  const std::array<int, 3> sides = {20, 20, 3}, units = {1, 2, 4};
  const std::string
      size = " --size 20x20x3 ",
      points = "--points p.csv --bounds=0,0,-1,10,20,5" + size,
      note = "vorocl: note: a voxel is 1 x 2 x 4 units of length in the data: distances count it so\n";
  const auto noted = [&](const std::string& arguments) {
    const auto result = run(folder, arguments);
    BOOST_TEST((result.exit_code == 0 && result.error == note), arguments << "\n" << result.error);
    return result.out;
  };
  noted("simulate --trajectory a.lammpstrj" + size + "--labels f%d.npy");
  BOOST_TEST((content_of(folder / "f0.npy") == labels_of(open, some, sides, units)));
  BOOST_TEST((content_of(folder / "f1.npy") == labels_of(moved, others, sides, units)));
  std::vector<Particle> numbered = some;
  for (std::size_t i = 0; i < numbered.size(); ++i) numbered[i].id = static_cast<std::uint32_t>(i);
  const auto json = nlohmann::json::parse(
      noted("cells " + points + "--labels a.npy --distance d.npy --cells a.csv --adjacency b.csv --json"));
  BOOST_TEST((content_of(folder / "a.npy") == labels_of(open, numbered, sides, units)));
  BOOST_TEST((json["spacing"] == std::vector{1, 2, 4} && json["length_unit"] == "data"));

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
      const double seed = std::floor((some[label].at[axis] - first.low[axis]) / voxel[axis]);
      sum += (at[axis] - seed) * voxel[axis] * (at[axis] - seed) * voxel[axis];
    }
    BOOST_TEST_REQUIRE(std::abs(found - std::sqrt(sum)) < 1e-5);
    farthest[label] = std::max(farthest[label], std::sqrt(sum));
    volumes[label] += voxel[0] * voxel[1] * voxel[2];
  }
  for (std::size_t id = 0; id < 3; ++id) {
    BOOST_TEST((std::abs(table.rows[id][4] - volumes[id]) < 1e-9));
    BOOST_TEST((std::abs(table.rows[id][16] - farthest[id]) < 1e-9));
  }

  // The methods that compare and time take the same distances.
  noted("render " + points + "--method jfa --labels j.npy");
  const std::string compare = "compare j.npy " + points;
  const auto errors = nlohmann::json::parse(noted(compare + "--json"))["errors"];
  const auto bench =
      nlohmann::json::parse(noted("bench " + points + "--methods exact,jfa --repeat 1 --json"))["results"];
  BOOST_TEST((bench[0]["wrong_pixels"] == 0 && bench[1]["wrong_pixels"] == errors["wrong_pixels"]));
  BOOST_TEST(noted(compare).find("units of the spacing") != std::string::npos);
}

BOOST_AUTO_TEST_CASE(image_data_lie_where_the_data_lie) {
  if (!can_be_exact()) return;
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
  BOOST_TEST(values[2 + 4 * 20] == 0);                    // particle 90's voxel
  BOOST_TEST(std::abs(values[3 + 4 * 20] - 0.5) < 1e-6);  // the next one, in data units
}

BOOST_AUTO_TEST_CASE(labels_of_particles_are_compared_with_theirs) {
  if (!can_be_exact()) return;
  const TemporaryFolder folder;
  folder.file("a.lammpstrj", dump_frame(7, first, some, false));
  std::string labels = labels_of(first, some);
  const std::string compare = "compare a.npy --trajectory a.lammpstrj --json";
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

BOOST_AUTO_TEST_CASE(what_volumes_of_files_cannot_be_is_refused) {
  const TemporaryFolder folder;
  folder.file("p.csv", "x,y,z\n1,2,3\n4,5,6\n");
  folder.file("flat.csv", "x,y\n1,2\n");
  folder.file("a.lammpstrj", dump_frame(7, first, some, false));
  folder.file("tilted.xyz", "1\nLattice=\"10 0 0 3 20 0 0 0 6\"\nA 1 2 3\n");
  folder.file("turned.xyz", "1\nLattice=\"10 0 0 0 20 0 1 0 6\"\nA 1 2 3\n");
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
  refuses(folder, "render --trajectory tilted.xyz" + volume, failure, {"tilted.xyz:2", "tilted (xy = 3)"});
  refuses(folder, "render --trajectory turned.xyz" + volume, failure, {"turned.xyz:2", "third along z"});
  refuses(folder, "render --trajectory flat.lammpstrj" + volume, failure, {"no z, which a volume needs"});
  refuses(folder, "simulate --random 3 --size 8x8x8 --step-length 1 --frames 2 --labels a%d.npy", usage,
          {"of a --trajectory"});
  refuses(folder, "simulate --trajectory a.lammpstrj --size 8x8x8 --statistics a.csv", usage,
          {"--statistics is for planes"});
  refuses(folder, "simulate --trajectory a.lammpstrj --size 8x8x8 --method djfa --labels %d.npy", usage,
          {"djfa is for planes"});
  for (const std::string of_volumes : {"--bounds 0,0,0,8,8,8", "--periodic xz", "--columns x,y,z"}) {
    refuses(folder, "render --points p.csv --size 8x8 --labels a.npy " + of_volumes, usage, {"for volumes"});
  }
}
