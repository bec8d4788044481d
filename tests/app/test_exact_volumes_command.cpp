// Cells of volumes by --exact: lattices whose cells are known, pyramids over faces, voxels.
#define BOOST_TEST_MODULE exact_volumes_command
#include <fmt/format.h>

#include <array>
#include <cmath>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <numeric>
#include <random>

#include "formats/npy.hpp"
#include "host_measures.hpp"
#include "raw_images.hpp"
#include "run_command.hpp"

using namespace vorocl;
using nlohmann::json;

namespace {

using Vector = std::array<double, 3>;

const std::string box_header = "ITEM: BOX BOUNDS pp pp pp\n";

/// A frame of a dump in a periodic cube.
std::string dump_of(const std::vector<Vector>& points, double side, int timestep = 0) {
  std::string text = fmt::format(
      "ITEM: TIMESTEP\n{0}\nITEM: NUMBER OF ATOMS\n{1}\n{2}0 {3}\n0 {3}\n0 {3}\nITEM: ATOMS id x y z\n",
      timestep, points.size(), box_header, side);
  for (std::size_t i = 0; i < points.size(); ++i)
    text += fmt::format("{} {} {} {}\n", i + 1, points[i][0], points[i][1], points[i][2]);
  return text;
}

/// So many cubes of side 1 along each axis, with a point at each of these places in each.
std::vector<Vector> lattice(const std::vector<Vector>& places, int cubes) {
  std::vector<Vector> points;
  for (int i = 0; i < cubes * cubes * cubes; ++i) {
    for (const Vector& place : places)
      points.push_back({i % cubes + place[0], i / cubes % cubes + place[1], i / cubes / cubes + place[2]});
  }
  return points;
}

std::vector<Vector> random_points(std::size_t count, double side) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> uniform(0, side);
  std::vector<Vector> points(count);
  for (Vector& point : points) point = {uniform(random), uniform(random), uniform(random)};
  return points;
}

std::string csv_of(const std::vector<Vector>& points) {
  std::string text = "id,x,y,z\n";
  for (std::size_t i = 0; i < points.size(); ++i)
    text += fmt::format("{},{},{},{}\n", points.size() - i, points[i][0], points[i][1], points[i][2]);
  return text;
}

}  // namespace

BOOST_AUTO_TEST_CASE(cells_of_cubic_lattices_have_known_faces) {
  struct Lattice {
    std::vector<Vector> places;
    double surface;
    std::map<std::size_t, double> faces;  // by their number for each point, their areas
  };
  const double hexagon = 3 * std::sqrt(3.0) / 16, rhombus = std::sqrt(2.0) / 8;
  const Lattice lattices[] = {
      {{{0, 0, 0}}, 6, {{3, 1}}},
      {{{0, 0, 0}, {0.5, 0.5, 0.5}}, 6.0 / 8 + 8 * hexagon, {{3, 1.0 / 8}, {4, hexagon}}},
      {{{0, 0, 0}, {0.5, 0.5, 0}, {0.5, 0, 0.5}, {0, 0.5, 0.5}}, 12 * rhombus, {{6, rhombus}}}};
  for (const Lattice& known : lattices) {
    const TemporaryFolder folder;
    const std::vector<Vector> points = lattice(known.places, 3);
    folder.file("t.dump", dump_of(points, 3));
    const json result = json::parse(succeeds(
        folder,
        "cells --exact --trajectory t.dump --cells c.csv --cell-columns id,volume,surface,neighbours "
        "--adjacency a.csv --json"));
    BOOST_TEST(result.at("box") == json({0.0, 0.0, 0.0, 3.0, 3.0, 3.0}));
    BOOST_TEST(result.at("periodic") == "xyz");
    BOOST_TEST(result.at("volume") == 27.0, boost::test_tools::tolerance(1e-12));
    BOOST_TEST((result.at("not_mutual") == 0 && result.at("uncertified") == 0));
    std::size_t coordination = 0;
    for (const auto& [number, area] : known.faces) coordination += 2 * number;
    for (const TableRow& cell : read_table(folder / "c.csv").rows) {
      BOOST_TEST(*cell[1] == 1 / static_cast<double>(known.places.size()),
                 boost::test_tools::tolerance(1e-12));
      BOOST_TEST(*cell[2] == known.surface, boost::test_tools::tolerance(1e-12));
      BOOST_TEST(*cell[3] == static_cast<double>(coordination));
    }
    const Table pairs = read_table(folder / "a.csv");
    BOOST_TEST(pairs.header == "a,b,area,image_x,image_y,image_z");
    std::size_t faces = 0;
    for (const auto& [number, area] : known.faces) {
      for (const TableRow& pair : pairs.rows) faces += std::abs(*pair[2] - area) < 1e-12 ? 1 : 0;
      BOOST_TEST(faces == number * points.size());
      faces = 0;
    }
    BOOST_TEST(pairs.rows.size() == coordination / 2 * points.size());
  }
}

BOOST_AUTO_TEST_CASE(pyramids_over_faces_fill_the_cells) {
  const TemporaryFolder folder;
  std::vector<Vector> points = random_points(300, 4);
  folder.file("in.csv", csv_of(points));
  for (std::size_t i = 0; i < points.size(); i += 3) {  // the same points, told by others of their images
    for (std::size_t axis = 0; axis < 3; ++axis)
      points[i][axis] += 4 * (static_cast<int>(i / 3 + axis) % 5 - 2);
  }
  folder.file("out.csv", csv_of(points));
  const std::string options =
      " --columns x,y,z --bounds 0,0,0,4,4,4 --periodic xyz --cells c.csv --adjacency a.csv --json";
  std::map<std::size_t, std::size_t> numbers;
  for (const std::string file : {"in", "out"}) {
    const json result = json::parse(run(folder, "cells --exact --points " + file + ".csv" + options).out);
    BOOST_TEST(result.at("volume") == 64.0, boost::test_tools::tolerance(1e-12));
    const Table cells = read_table(folder / "c.csv");
    BOOST_TEST(cells.header ==
               "id,x,y,z,volume,centroid_x,centroid_y,centroid_z,left,top,front,right,bottom,back,surface,"
               "neighbours,largest_distance,touches_border");
    BOOST_TEST_REQUIRE(cells.rows.size() == points.size());
    std::vector<double> pyramids(points.size() + 1), surfaces(points.size() + 1), faces(points.size() + 1);
    for (const TableRow& pair : read_table(folder / "a.csv").rows) {
      BOOST_TEST_REQUIRE(*pair[0] <= *pair[1]);
      const TableRow &a = cells.rows[static_cast<std::size_t>(*pair[0]) - 1],
                     &b = cells.rows[static_cast<std::size_t>(*pair[1]) - 1];
      double squares = 0;
      for (const std::size_t axis : {1, 2, 3})
        squares += std::pow(*b[axis] + 4 * *pair[axis + 2] - *a[axis], 2);
      for (const std::size_t end : {0, 1}) {
        const auto cell = static_cast<std::size_t>(*pair[end]);
        pyramids[cell] += *pair[2] * std::sqrt(squares) / 6;  // whose height is half of the way
        surfaces[cell] += *pair[2];
        ++faces[cell];
      }
    }
    for (const TableRow& cell : cells.rows) {
      const auto id = static_cast<std::size_t>(*cell[0]);
      BOOST_TEST(pyramids[id] == *cell[4], boost::test_tools::tolerance(1e-9));
      BOOST_TEST(surfaces[id] == *cell[14], boost::test_tools::tolerance(1e-9));
      BOOST_TEST(faces[id] == *cell[15]);
      for (const std::size_t axis : {0, 1, 2}) {
        const double seed = *cell[1 + axis], low = *cell[8 + axis], high = *cell[11 + axis];
        BOOST_TEST((low < seed && seed < high));
        BOOST_TEST((low < *cell[5 + axis] && *cell[5 + axis] < high));
        BOOST_TEST((seed - low <= *cell[16] && high - seed <= *cell[16]));
      }
    }
    if (file == "in") folder.file("kept.csv", content_of(folder / "c.csv"));
  }
  const Table in = read_table(folder / "kept.csv"), out = read_table(folder / "c.csv");
  for (std::size_t i = 0; i < in.rows.size(); ++i) {
    for (std::size_t column = 0; column < in.rows[i].size(); ++column)
      BOOST_TEST(std::abs(*in.rows[i][column] - *out.rows[i][column]) < 1e-9);
  }
}

BOOST_AUTO_TEST_CASE(voxels_have_nearly_the_same_volumes) {
  const TemporaryFolder folder;
  folder.file("p.csv", csv_of(random_points(60, 8)));
  const std::string input = "cells --points p.csv --columns x,y,z --bounds 0,0,0,8,8,8 --method exact ",
                    columns = "--cell-columns id,volume,centroid_z,back ";
  succeeds(folder, input + "--size 128x128x128 --cells voxels.csv " + columns);
  succeeds(folder,
           "cells --exact --points p.csv --columns x,y,z --bounds 0,0,0,8,8,8 --cells exact.csv " + columns);
  const Table voxels = read_table(folder / "voxels.csv"), exact = read_table(folder / "exact.csv");
  BOOST_TEST(voxels.header == exact.header);
  BOOST_TEST_REQUIRE(voxels.rows.size() == exact.rows.size());
  for (std::size_t i = 0; i < exact.rows.size(); ++i) {
    BOOST_TEST(*exact.rows[i][0] == *voxels.rows[i][0]);
    BOOST_TEST(std::abs(*exact.rows[i][1] - *voxels.rows[i][1]) < 0.8);  // of 8.5 in the mean
    BOOST_TEST(std::abs(*exact.rows[i][2] - *voxels.rows[i][2]) < 0.2);
    BOOST_TEST(std::abs(*exact.rows[i][3] - *voxels.rows[i][3]) < 0.3);
  }
  // Seeds at random are the centres of voxels.
  const json result =
      json::parse(succeeds(folder, "cells --exact --random 50 --size 16x12x9 --cells r.csv --json"));
  BOOST_TEST(result.at("volume") == 16.0 * 12 * 9, boost::test_tools::tolerance(1e-12));
  BOOST_TEST(result.at("cells") == 50);
}

BOOST_AUTO_TEST_CASE(frames_of_a_volume_have_the_cells_of_each_frame) {
  const TemporaryFolder folder;
  std::vector<Vector> points = random_points(40, 3);
  std::string text = dump_of(points, 3, 5);
  for (Vector& point : points) point[2] /= 2;
  text += dump_of(points, 3, 10);
  points.resize(30);
  folder.file("t.dump", text + dump_of(points, 3.5, 15));
  succeeds(folder,
           "simulate --exact --trajectory t.dump --cells all.csv --adjacency a%d.csv --polygons p%d.vtu");
  std::string expected;
  for (const int frame : {0, 1, 2}) {
    succeeds(folder,
             fmt::format("cells --exact --trajectory t.dump --frame {} --cells c.csv --adjacency a.csv "
                         "--polygons p.vtu",
                         frame));
    std::istringstream rows(content_of(folder / "c.csv"));
    std::string line;
    std::getline(rows, line);
    if (frame == 0) expected = "frame,timestep," + line + "\n";
    while (std::getline(rows, line)) expected += fmt::format("{},{},{}\n", frame, 5 * frame + 5, line);
    BOOST_TEST(content_of(folder / fmt::format("a{}.csv", frame)) == content_of(folder / "a.csv"));
    BOOST_TEST(content_of(folder / fmt::format("p{}.vtu", frame)) == content_of(folder / "p.vtu"));
  }
  BOOST_TEST(content_of(folder / "all.csv") == expected);
  const std::string collection = content_of(folder / "p.pvd");
  for (const char* const entry : {"timestep=\"5\"", "file=\"p0.vtu\"", "timestep=\"15\"", "file=\"p2.vtu\""})
    BOOST_TEST(collection.find(entry) != std::string::npos, collection);
  std::filesystem::remove(folder / "p.pvd");
  succeeds(folder, "simulate --exact --trajectory t.dump --frames 1:2 --polygons p%d.vtu");  // goes on
  BOOST_TEST(content_of(folder / "p.pvd") == collection);
  const std::string polyhedra = content_of(folder / "p.vtu");
  BOOST_TEST(found_in(polyhedra, "NumberOfCells=\"([^\"]*)\"") == "30");
}

BOOST_AUTO_TEST_CASE(weights_and_radii_come_from_a_column) {
  const TemporaryFolder folder;
  // Along x the bisectors are at 1 + (4 + w - w') / 4, and the last point has no cell.
  const std::string rows = "1,1,1,1,1\n3,1,1,0.25,0.5\n2,1,1,-9,0\n";
  const std::string header = "x,y,z,w,r\n", cells = " --cells c.csv --cell-columns ";
  folder.file("p.csv", header + rows);
  const std::string points = "cells --exact --points p.csv --columns x,y,z --bounds 0,0,0,4,2,2 ";
  for (const std::string column : {"--weights w", "--radius r"}) {
    succeeds(folder, points + column + cells + "id,volume,centroid_x,neighbours");
    const bool has_third = column == "--radius r";  // its weight is 0
    const std::string expected =
        has_third ? "id,volume,centroid_x,neighbours\n0,8,1,1\n1,6.5,3.1875,1\n2,1.5,2.1875,2\n"
                  : "id,volume,centroid_x,neighbours\n0,8.75,1.09375,1\n1,7.25,3.09375,1\n2,0,,0\n";
    BOOST_TEST(content_of(folder / "c.csv") == expected);
  }
  BOOST_TEST(run(folder, points + "--weights w --cells c.csv").out.find("1 seed without a cell") !=
             std::string::npos);
  succeeds(folder,
           "cells --exact --points p.csv --columns x,y --bounds 0,0,4,2 --weights w" + cells + "id,area");
  BOOST_TEST(content_of(folder / "c.csv") == "id,area\n0,4.375\n1,3.625\n2,0\n");
  std::string dump = dump_of({{1, 1, 1}, {3, 1, 1}}, 4), with_radius = dump;
  const auto add = [&](const std::string& after, const std::string& text) {
    with_radius.replace(with_radius.find(after), after.size(), text);
  };
  add("id x y z\n", "id x y z radius\n");
  add("1 1 1 1\n", "1 1 1 1 1\n");
  add("2 3 1 1\n", "2 3 1 1 0.5\n");
  folder.file("t.dump", with_radius + with_radius);
  succeeds(folder,
           "simulate --exact --trajectory t.dump --periodic xyz --radius radius" + cells + "id,volume");
  BOOST_TEST(content_of(folder / "c.csv") ==
             "frame,timestep,id,volume\n0,0,1,38\n0,0,2,26\n1,0,1,38\n1,0,2,26\n");
  const std::string small = std::string(with_radius).replace(with_radius.find(" 0.5\n"), 5, " -9\n");
  folder.file("small.dump", with_radius + small);  // whose column is of weights
  const json some = json::parse(
      succeeds(folder, "simulate --exact --trajectory small.dump --weights radius --json" + cells + "id"));
  BOOST_TEST((some.at("most_empty_cells") == 1 && some.at("uncertified") == 0));
  succeeds(folder, "cells --exact --trajectory t.dump --bounds 0,0,4,4 --radius radius" + cells + "id,area");
  BOOST_TEST(content_of(folder / "c.csv") == "id,area\n1,9.5\n2,6.5\n");

  folder.file("bad.csv", header + "1,1,1,,-1\n3,1,1,0,0\n");
  const std::string bad = "cells --exact --points bad.csv --columns x,y,z --cells c.csv --device none ";
  refuses(folder, bad + "--weights w", failure, {"bad.csv", "weight of seed 0", "column w", "finite"});
  refuses(folder, bad + "--radius r", failure, {"bad.csv", "radius of seed 0", "-1", "not negative"});
  refuses(folder, bad + "--radius r --weights w", usage, {"--radius", "--weights"});
  refuses(folder, bad + "--weights none", failure, {"no column none"});
  folder.file("text.csv", "x,y,z,kind\n1,1,1,A\n");
  refuses(folder, "cells --exact --points text.csv --columns x,y,z --weights kind --cells c.csv", failure,
          {"text.csv", "kind", "\"A\""});
  refuses(folder, "cells --exact --random 9 --size 8x8 --weights w --cells c.csv", usage,
          {"--weights", "--points"});
  // The same of diagrams, whose voxels at a bisector are of the first seed.
  const std::string three = "cells --points p.csv --columns x,y,z --bounds 0,0,0,4,2,2 --size 32x16x16 ";
  succeeds(folder, three + "--weights w" + cells + "id,volume");
  BOOST_TEST(content_of(folder / "c.csv") == "id,volume\n0,9\n1,7\n2,0\n");
  const std::string two = "--points p.csv --columns x,y --bounds 0,0,4,2 --width 32 ";
  succeeds(folder, "cells " + two + "--radius r" + cells + "id,area");
  BOOST_TEST(content_of(folder / "c.csv") == "id,area\n0,4\n1,3.25\n2,0.75\n");
  succeeds(folder, "simulate --trajectory t.dump --size 16x16x16 --periodic xyz --radius radius" + cells +
                       "id,volume");
  BOOST_TEST(content_of(folder / "c.csv") ==
             "frame,timestep,id,volume\n0,0,1,40\n0,0,2,24\n1,0,1,40\n1,0,2,24\n");
  const std::string flat = "simulate --trajectory t.dump --bounds 0,0,4,4 --width 16 --periodic none ";
  BOOST_TEST(run(folder, flat + "--radius radius" + cells + "id,area").exit_code == 0);  // z is left out
  BOOST_TEST(content_of(folder / "c.csv") == "frame,timestep,id,area\n0,0,1,9\n0,0,2,7\n1,0,1,9\n1,0,2,7\n");
  for (const std::string weights : {"--weights w ", "--radius r "}) {
    const std::string name = weights.substr(0, weights.find(' '));
    refuses(folder, "cells " + two + weights + "--method jfa --cells c.csv", usage, {"jfa", name});
    refuses(folder, "cells " + two + weights + "--metric great-circle --cells c.csv", usage,
            {"great-circle", name});
    refuses(folder, "render " + two + weights + "--color column:x -o p.png", usage, {"--color", name});
    refuses(folder, "cells " + two + weights + "--metric manhattan --cells c.csv", usage,
            {"manhattan", name});
    refuses(folder, "cells " + two + weights + "--snap --cells c.csv", usage, {"--snap", name});
    refuses(folder, "simulate " + two + weights + "--frames 3 --step-length 1 --cells c.csv", usage,
            {"--trajectory", name});
  }
  refuses(folder, "cells --points p.csv --columns x,y --bounds 0,0,4,2 --size 9x9 --weights w --cells c.csv",
          failure, {"p.csv", "squares", "--width"});
  refuses(folder,
          "cells --points p.csv --columns x,y,z --bounds 0,0,0,4,2,2 --size 8x8x8 --weights w --cells c.csv",
          failure, {"cubes"});
  refuses(folder, "simulate --random 9 --size 9x9 --radius r --frames 1 --step-length 1 --labels l%d.npy",
          usage, {"--radius", "--trajectory"});
}

BOOST_AUTO_TEST_CASE(a_plane_is_cut_where_the_line_says_so) {
  const TemporaryFolder folder;
  folder.file("t.dump", dump_of({{1, 1, 1}, {2, 2, 3}}, 4));
  const Result plane = run(folder, "cells --exact --trajectory t.dump --bounds 0,0,4,4 --cells c.csv");
  BOOST_TEST(plane.exit_code == 0);
  BOOST_TEST(plane.error.find("z is left out, along which the particles of frame 0 span 2") !=
             std::string::npos);
  BOOST_TEST(content_of(folder / "c.csv").find("area") != std::string::npos);
  folder.file("flat.dump", dump_of({{1, 1, 1}, {2, 2, 1}}, 4));
  succeeds(folder, "cells --exact --trajectory flat.dump --cells c.csv --cell-columns area");
  succeeds(folder, "cells --exact --trajectory flat.dump --periodic xyz --cells c.csv --cell-columns volume");
  BOOST_TEST(content_of(folder / "c.csv") == "volume\n32\n32\n");
  // Three columns of an array are a volume, and those of a table if they are asked for.
  const double coordinates[] = {1, 1, 1, 1, 1, 3};
  folder.file("p.npy", command::npy_header<double>({2, 3}) +
                           std::string(reinterpret_cast<const char*>(coordinates), sizeof coordinates));
  const Result periods =
      run(folder, "cells --exact --points p.npy --periodic x --bounds 0,0,0,2,2,4 --cells c.csv");
  BOOST_TEST(periods.exit_code == 0);
  folder.file("p.csv", "x,y,z,kind\n0,0,0,5\n2,2,4,6\n");
  succeeds(folder,
           "cells --exact --points p.csv --columns x,y,z --keep kind --cells c.csv --polygons p.vtu "
           "--cell-columns id,volume,neighbours,touches_border");
  BOOST_TEST(content_of(folder / "c.csv") ==
             "id,volume,neighbours,touches_border,kind\n0,8,1,1,5\n1,8,1,1,6\n");
  BOOST_TEST(content_of(folder / "p.vtu").find("Name=\"kind\"") != std::string::npos);
}

BOOST_AUTO_TEST_CASE(cells_of_tilted_boxes_are_those_of_what_repeats) {
  // Edges of a box, and particles at shares of them; some are written whole edges away.
  const std::array<Vector, 3> edges = {Vector{4, 0, 0}, Vector{1.5, 3, 0}, Vector{-1.25, 0.75, 3.5}};
  const std::vector<Vector> shares = random_points(60, 1);
  const auto place = [&](const Vector& share, const Vector& periods) {
    Vector at = {1, 2, -1};
    for (std::size_t edge = 0; edge < 3; ++edge) {
      for (std::size_t axis = 0; axis < 3; ++axis)
        at[axis] += (share[edge] + periods[edge]) * edges[edge][axis];
    }
    return at;
  };
  const auto beyond = [](std::size_t i) {
    return i % 4 == 0 ? Vector{1, -1, 2} : Vector{0, 0, i % 4 == 1 ? -1.0 : 0};
  };
  const auto head = [](const std::string& box, const char* columns) {
    return "ITEM: TIMESTEP\n0\nITEM: NUMBER OF ATOMS\n60\nITEM: BOX BOUNDS " + box + "\nITEM: ATOMS id " +
           columns;
  };
  const std::string tilts = "xy xz yz pp pp pp\n-0.25 6.5 1.5\n2 5.75 -1.25\n-1 2.5 0.75",
                    general = "abc origin pp pp pp\n4 0 0 1\n1.5 3 0 2\n-1.25 0.75 3.5 -1";
  std::string
      dump = head(tilts, "x y z\n"),
      scaled = head(tilts, "xs ys zs\n"), by_edges = head(general, "x y z\n"),
      xyz = "60\nLattice=\"4 0 0 1.5 3 0 -1.25 0.75 3.5\" Origin=\"1 2 -1\" Properties=id:I:1:pos:R:3\n",
      copies = "n,x,y,z\n";
  for (std::size_t i = 0; i < shares.size(); ++i) {
    const Vector far = beyond(i), at = place(shares[i], far);
    const std::string row = fmt::format("{} {} {} {}\n", i + 1, at[0], at[1], at[2]);
    dump += row;
    by_edges += row;
    xyz += row;
    scaled += fmt::format("{} {} {} {}\n", i + 1, shares[i][0] + far[0], shares[i][1] + far[1],
                          shares[i][2] + far[2]);
    for (int image = 0; image < 125; ++image) {
      const Vector copy = place(shares[i], {image % 5 - 2.0, image / 5 % 5 - 2.0, image / 25 - 2.0});
      copies += fmt::format("{},{},{},{}\n", image == 62 ? i + 1 : 100 + i, copy[0], copy[1], copy[2]);
    }
  }
  const TemporaryFolder folder;
  for (const auto& [name, text] : {std::pair{"t.dump", dump},
                                   {"s.dump", scaled},
                                   {"e.dump", by_edges},
                                   {"t.xyz", xyz},
                                   {"copies.csv", copies}})
    folder.file(name, text);
  const std::string columns = "--cell-columns id,volume,surface,neighbours,x,y,z ";
  // Without periods: a box with all of the copies.
  succeeds(folder,
           "cells --exact --points copies.csv --columns x,y,z --keep n --cells copies_c.csv " + columns);
  std::map<double, TableRow> expected;
  for (const TableRow& row : read_table(folder / "copies_c.csv").rows)
    if (*row.back() <= 60) expected[*row.back()] = row;
  BOOST_TEST_REQUIRE(expected.size() == 60u);
  for (const std::string name : {"t.dump", "s.dump", "e.dump", "t.xyz"}) {
    const json result = json::parse(succeeds(
        folder, "cells --exact --trajectory " + name + " --cells c.csv --adjacency a.csv --json " + columns));
    BOOST_TEST(result.at("not_mutual") == 0);
    BOOST_TEST(result.at("uncertified") == 0);
    const Table cells = read_table(folder / "c.csv");
    BOOST_TEST_REQUIRE(cells.rows.size() == 60u);
    double volume = 0;
    std::vector<Vector> places(61), sums(61);
    for (const TableRow& row : cells.rows) {
      places[static_cast<std::size_t>(*row[0])] = {*row[4], *row[5], *row[6]};
      const TableRow& other = expected.at(*row[0]);
      volume += *row[1];
      BOOST_TEST(*row[1] == *other[1], boost::test_tools::tolerance(1e-8));
      BOOST_TEST(*row[2] == *other[2], boost::test_tools::tolerance(1e-8));
      BOOST_TEST(*row[3] == *other[3]);
    }
    BOOST_TEST(volume == 42, boost::test_tools::tolerance(1e-12));
    // Faces are normal to the ways to the images behind them: on a closed surface these sum to 0.
    for (const TableRow& row : read_table(folder / "a.csv").rows) {
      const auto a = static_cast<std::size_t>(*row[0]), b = static_cast<std::size_t>(*row[1]);
      const Vector& from = places[a];
      Vector to = places[b];
      for (std::size_t edge = 0; edge < 3; ++edge) {
        for (std::size_t axis = 0; axis < 3; ++axis) to[axis] += *row[3 + edge] * edges[edge][axis];
      }
      double square = 0;
      for (std::size_t axis = 0; axis < 3; ++axis) square += std::pow(to[axis] - from[axis], 2);
      for (std::size_t axis = 0; axis < 3; ++axis) {
        sums[a][axis] += *row[2] * (to[axis] - from[axis]) / std::sqrt(square);
        sums[b][axis] -= *row[2] * (to[axis] - from[axis]) / std::sqrt(square);
      }
    }
    for (const Vector& sum : sums)
      for (const double component : sum) BOOST_TEST(std::abs(component) < 1e-7);
  }
  // Voxels have these volumes, too, by the cells of all images, and so do those of each frame.
  for (const std::string name : {"t.dump", "s.dump", "e.dump", "t.xyz"}) {
    const std::string size = " --size 160x120x140 ";
    succeeds(folder, "cells --trajectory " + name + size + "--cells v.csv " + columns);
    succeeds(folder, "simulate --trajectory " + name + size + "--cells v%d.csv " + columns);
    BOOST_TEST(content_of(folder / "v0.csv") == content_of(folder / "v.csv"));
    double volume = 0, squares = 0;
    for (const TableRow& row : read_table(folder / "v.csv").rows) {
      volume += *row[1];
      squares += std::pow(*row[1] / *expected.at(*row[0])[1] - 1, 2);
    }
    BOOST_TEST(volume == 42, boost::test_tools::tolerance(1e-9));
    BOOST_TEST(std::sqrt(squares / 60) < 0.002);
  }
  succeeds(folder, "simulate --exact --trajectory t.dump --cells f.csv --polygons p%d.vtu " + columns);
  BOOST_TEST(read_table(folder / "f.csv").rows.size() == 60u);
}

BOOST_AUTO_TEST_CASE(seeds_of_flat_tilted_boxes_are_the_images_that_their_cells_lie_around) {
  // Many slices of images lie nearer to a centroid than the nearest one of the nearest slice.
  const double width = 8, height = 8, depth = 0.5, xy = 3, xz = 2.5, yz = -2;
  std::string text = fmt::format(
      "ITEM: TIMESTEP\n0\nITEM: NUMBER OF ATOMS\n30\nITEM: BOX BOUNDS xy xz yz pp pp pp\n"
      "0 {} {}\n{} {} {}\n0 {} {}\nITEM: ATOMS id x y z\n",
      width + xy + xz, xy, yz, height, xz, depth, yz);
  int id = 0;
  for (const Vector& share : random_points(30, 1))
    text += fmt::format("{} {} {} {}\n", ++id, share[0] * width + share[1] * xy + share[2] * xz,
                        share[1] * height + share[2] * yz, share[2] * depth);
  const TemporaryFolder folder;
  folder.file("flat.dump", text);
  succeeds(folder,
           "cells --exact --trajectory flat.dump --cells c.csv --cell-columns "
           "x,y,z,centroid_x,centroid_y,centroid_z");
  std::size_t nearer = 0;
  for (const TableRow& row : read_table(folder / "c.csv").rows) {
    const auto square_of = [&](int i, int j, int k) {
      const double x = *row[0] - *row[3] + i * width + j * xy + k * xz,
                   y = *row[1] - *row[4] + j * height + k * yz, z = *row[2] - *row[5] + k * depth;
      return x * x + y * y + z * z;
    };
    for (int k = -24; k <= 24; ++k) {
      for (int j = -8; j <= 8; ++j) {
        for (int i = -12; i <= 12; ++i) nearer += square_of(i, j, k) < square_of(0, 0, 0) - 1e-9 ? 1 : 0;
      }
    }
  }
  BOOST_TEST(nearer == 0u);
}

BOOST_AUTO_TEST_CASE(one_particle_in_a_box_that_is_tilted_in_z_and_a_size_say_that_there_is_a_volume) {
  const TemporaryFolder folder;
  const std::string frame = "ITEM: TIMESTEP\n0\nITEM: NUMBER OF ATOMS\n1\nITEM: BOX BOUNDS ",
                    atom = "\nITEM: ATOMS id x y z\n1 1 1 1\n";
  folder.file("sheared.dump", frame + "xy xz yz pp pp pp\n0 4 0\n0 5 0\n0 4 1" + atom);
  folder.file("flat.dump", frame + "pp pp pp\n0 4\n0 4\n0 4" + atom);
  for (const std::string input : {"simulate sheared", "cells sheared", "cells sheared.dump --size 9x8x7",
                                  "cells flat.dump --size 9x8x7", "cells flat.dump --size 4x4x4"}) {
    const std::size_t file = input.find(' ');
    const bool has_size = input.find("--size") != std::string::npos;
    succeeds(folder, input.substr(0, file) + " --exact --cells c.csv --cell-columns volume,neighbours" +
                         " --trajectory" + input.substr(file) + (has_size ? "" : ".dump"));
    const TableRow cell = read_table(folder / "c.csv").rows.at(0);
    BOOST_TEST(*cell[cell.size() - 2] == 64);
    // Its images along the third edge lie a quarter of a side beside it: two of six faces become four.
    BOOST_TEST(*cell.back() == (input.find("flat") == std::string::npos ? 8 : 6));
  }
  succeeds(folder,
           "cells --trajectory sheared.dump --size 8x8x8 --cells v.csv --cell-columns volume,neighbours");
  BOOST_TEST(content_of(folder / "v.csv") == "volume,neighbours\n64,0\n");
}

BOOST_AUTO_TEST_CASE(what_exact_volumes_cannot_be_is_refused_before_the_work) {
  const TemporaryFolder folder;
  folder.file("t.dump", dump_of({{1, 1, 1}, {2, 2, 3}}, 4));
  folder.file("flat.dump", dump_of({{1, 1, 1}, {2, 2, 1}}, 4));
  folder.file("p.csv", "x,y,z\n1,2,3\n4,5,6\n");
  folder.file("flat.csv", "x,y\n1,2\n4,5\n");
  folder.file(
      "tilted.xyz",
      "2\nLattice=\"4 0 0 1 4 0 0 0 4\" Properties=species:S:1:pos:R:3 pbc=\"T T T\"\nA 1 1 0\nA 1 1 2\n");
  folder.file(
      "walls.xyz",
      "2\nLattice=\"4 0 0 0 4 0 1 0 4\" Properties=species:S:1:pos:R:3 pbc=\"F T T\"\nA 1 1 0\nA 1 1 2\n");
  folder.file(
      "sheared.dump",
      "ITEM: TIMESTEP\n0\nITEM: NUMBER OF ATOMS\n1\nITEM: BOX BOUNDS xy xz yz pp pp pp\n0 5 0\n0 4 1\n"
      "0 4 0\nITEM: ATOMS id x y z\n1 1 1 1\n");
  for (const std::string command : {"cells", "simulate"}) {
    const std::string files = command == "cells" ? "p" : "p%d",
                      exact = command + " --exact --trajectory t.dump --device none ";
    refuses(folder, exact + "--polygons " + files + ".vtp", usage, {".vtp", "polyhedra", ".vtu"});
    const std::string flat = command + " --exact --trajectory flat.dump --device none ";
    refuses(folder, flat + "--polygons " + files + ".vtu", usage, {".vtu", "polygons"});
    refuses(folder, exact + "--cells c.csv --cell-columns id,area", usage,
            {"area", "volumes have no", "surface"});
    refuses(folder, flat + "--cells c.csv --cell-columns volume", usage,
            {"volume", "planes have no", "perimeter"});
    refuses(folder, exact + "--cells c.csv --y-down", usage, {"--y-down is for planes"});
    refuses(folder, exact + "--cells c.csv --outside count", usage, {"--outside is for planes"});
    refuses(folder, exact + "--cells c.csv --bounds 0,0,4,4 --periodic xz", usage, {"six numbers"});
    refuses(folder, exact + "--cells c.csv --bounds 0,0,0,4,4,3", failure,
            {"frame 0", "whole periods", "in z"});
    refuses(folder, exact + "--cells c.csv --periodic none --bounds 0,0,0,4,4,2", failure,
            {"frame 0", "particle 2", "outside the bounds, in z"});
    refuses(folder, command + " --exact --trajectory tilted.xyz --periodic xz --cells c.csv --device none",
            failure, {"tilted.xyz", "frame 0", "tilted", "leave --periodic out"});
    refuses(folder, command + " --exact --trajectory walls.xyz --cells c.csv", failure,
            {"walls.xyz:2", "tilted in z (xz = 1, yz = 0)", "not periodic"});
    refuses(folder, command + " --exact --trajectory sheared.dump --bounds 0,0,4,4 --cells c.csv", failure,
            {"sheared.dump:9", "tilted in z (xz, yz)"});
  }
  refuses(folder, "cells --exact --points flat.csv --columns x,y,z --cells c.csv", failure, {"no column z"});
  refuses(folder, "cells --exact --points p.csv --columns x,y,z --bounds 0,0,0,4,4,4 --cells c.csv", failure,
          {"point 1 at (4, 5, 6)", "outside the bounds"});
  refuses(folder, "cells --exact --mask m.png --size 8x8x8 --cells c.csv", usage, {"--mask is for planes"});
  BOOST_TEST((folder.names() == std::set<std::string>{"t.dump", "flat.dump", "p.csv", "flat.csv",
                                                      "tilted.xyz", "walls.xyz", "sheared.dump"}));
}
