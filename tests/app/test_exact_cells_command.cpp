// vorocl cells --exact: its files against each other, and against plain sums over what they hold.
#define BOOST_TEST_MODULE exact_cells_command
#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "host_measures.hpp"
#include "raw_images.hpp"
#include "run_command.hpp"

using namespace vorocl;
using nlohmann::json;

namespace {

constexpr double rounding = 1e-12;

json geojson(const TemporaryFolder& folder, const std::string& name) {
  return json::parse(std::ifstream(folder / name));
}

/// The area within a ring whose last vertex is its first.
double area_of(const std::vector<std::pair<double, double>>& ring) {
  double twice = 0;
  for (std::size_t i = 0; i + 1 < ring.size(); ++i)
    twice += ring[i].first * ring[i + 1].second - ring[i + 1].first * ring[i].second;
  return twice / 2;
}

std::vector<std::pair<double, double>> ring_of(const json& feature) {
  return feature.at("geometry").at("coordinates").at(0).get<std::vector<std::pair<double, double>>>();
}

}  // namespace

BOOST_AUTO_TEST_CASE(cities_fill_the_map) {
  const TemporaryFolder folder;
  const json result = json::parse(succeeds(folder, "cells --exact --points '" VOROCL_SAMPLES
                                                   "/cities-5000.csv' --bounds=-180,-90,180,90 --cells c.csv "
                                                   "--adjacency a.csv --polygons p.geojson --json"));
  BOOST_TEST(result.at("cells") == 5000);
  BOOST_TEST(result.at("area").get<double>() == 64800, boost::test_tools::tolerance(rounding));
  BOOST_TEST(result.at("not_mutual") == 0);
  BOOST_TEST(result.at("uncertified") == 0);
  BOOST_TEST(result.at("rectangle") == json({-180.0, -90.0, 180.0, 90.0}));
  const Table cells = read_table(folder / "c.csv"), pairs = read_table(folder / "a.csv");
  BOOST_TEST(cells.header ==
             "id,x,y,area,centroid_x,centroid_y,left,top,right,bottom,perimeter,neighbours,largest_distance,"
             "touches_border");
  BOOST_TEST(pairs.header == "a,b,length,midpoint_x,midpoint_y");
  BOOST_TEST(result.at("pairs") == pairs.rows.size());
  const json polygons = geojson(folder, "p.geojson").at("features");
  BOOST_TEST_REQUIRE(cells.rows.size() == 5000u);
  BOOST_TEST_REQUIRE(polygons.size() == 5000u);
  std::vector<double> neighbours(5000), lengths(5000);
  for (const TableRow& pair : pairs.rows) {
    BOOST_TEST_REQUIRE(*pair[0] < *pair[1]);
    for (const std::size_t end : {0, 1}) {
      neighbours[static_cast<std::size_t>(*pair[end])] += 1;
      lengths[static_cast<std::size_t>(*pair[end])] += *pair[2];
    }
  }
  std::size_t at_border = 0;
  for (std::size_t id = 0; id < 5000; ++id) {
    const TableRow& row = cells.rows[id];
    BOOST_TEST_REQUIRE(*row[0] == static_cast<double>(id));
    BOOST_TEST(*row[11] == neighbours[id]);
    const auto ring = ring_of(polygons[id]);
    BOOST_TEST((ring.front() == ring.back()));
    BOOST_TEST(std::abs(area_of(ring) - *row[3]) < 1e-9);  // far from the origin a sum loses digits
    constexpr double none = std::numeric_limits<double>::infinity();
    double left = none, top = none, perimeter = 0, farthest = 0;
    for (std::size_t i = 0; i + 1 < ring.size(); ++i) {
      left = std::min(left, ring[i].first);
      top = std::min(top, ring[i].second);  // y down, as points have it
      perimeter += std::hypot(ring[i + 1].first - ring[i].first, ring[i + 1].second - ring[i].second);
      farthest = std::max(farthest, std::hypot(ring[i].first - *row[1], ring[i].second - *row[2]));
    }
    BOOST_TEST(*row[6] == left);
    BOOST_TEST(*row[7] == top);
    BOOST_TEST(std::abs(*row[10] - perimeter) < 1e-10);
    BOOST_TEST(std::abs(*row[12] - farthest) < 1e-10);
    at_border += *row[13] == 1 ? 1 : 0;
    if (*row[13] == 0) BOOST_TEST(std::abs(lengths[id] - *row[10]) < 1e-10);
  }
  BOOST_TEST((at_border > 20 && at_border < 500));
}

BOOST_AUTO_TEST_CASE(four_cells_of_a_square_in_every_format) {
  const TemporaryFolder folder;
  folder.file("p.csv", "x,y\n1,1\n3,1\n1,3\n3,3\n3,3\n");
  const std::string cells = "cells --exact --points p.csv --bounds 0,0,4,4 ";
  const std::string out =
      succeeds(folder, cells + "--polygons p.csv.json --cells c.csv --cell-columns area,id");
  for (const char* part : {"exact cells: 5 seeds in 0,0,4,4", "1 seed", "4 edges", "wrote p.csv.json"})
    BOOST_TEST(out.find(part) != std::string::npos, part);
  const Table table = read_table(folder / "c.csv");
  BOOST_TEST(table.header == "area,id");
  BOOST_TEST((table.rows == std::vector<TableRow>{{4, 0}, {4, 1}, {4, 2}, {4, 3}, {0, 4}}));
  const json features = geojson(folder, "p.csv.json").at("features");
  BOOST_TEST(ring_of(features[0]).size() == 5u);
  BOOST_TEST(features[4].at("geometry").is_null());
  succeeds(folder, cells + "--polygons w.csv --adjacency a.csv");
  const std::string wkt = content_of(folder / "w.csv");
  BOOST_TEST(wkt.find("id,x,y,area,neighbours,wkt\n0,1,1,4,2,\"POLYGON ((") == 0u);
  BOOST_TEST(wkt.find("4,3,3,0,0,POLYGON EMPTY\n") != std::string::npos);
  BOOST_TEST((read_table(folder / "a.csv").rows ==
              std::vector<TableRow>{{0, 1, 2, 2, 1}, {0, 2, 2, 1, 2}, {1, 3, 2, 3, 2}, {2, 3, 2, 2, 3}}));
  succeeds(folder, cells + "--polygons p.vtp");
  const std::string vtp = content_of(folder / "p.vtp");
  BOOST_TEST(vtp.find("NumberOfPoints=\"16\"") != std::string::npos);
  BOOST_TEST(vtp.find("NumberOfPolys=\"4\"") != std::string::npos);
  succeeds(folder, cells + "--periodic xy --adjacency t.csv");
  BOOST_TEST(read_table(folder / "t.csv").rows.size() == 8u);
}

BOOST_AUTO_TEST_CASE(particles_fill_their_periodic_box) {
  const TemporaryFolder folder;
  const json result =
      json::parse(succeeds(folder, "cells --exact --trajectory '" VOROCL_SAMPLES
                                   "/lj-melt.lammpstrj' --frame 3 --cells c.csv --polygons p.json --json"));
  const auto box = result.at("rectangle").get<std::vector<double>>();
  BOOST_TEST(result.at("periodic") == "xy");
  BOOST_TEST(result.at("pairs") == 3 * result.at("cells").get<int>());  // Euler's, on a torus
  BOOST_TEST(result.at("area").get<double>() == (box[2] - box[0]) * (box[3] - box[1]),
             boost::test_tools::tolerance(1e-8));
  const TableRow first = read_table(folder / "c.csv").rows.front();
  BOOST_TEST(*first[0] == 1);         // ids of the file
  BOOST_TEST(*first[7] > *first[9]);  // y up, as trajectories have it
  succeeds(folder, "simulate --exact --trajectory '" VOROCL_SAMPLES
                   "/lj-melt.lammpstrj' --frames 1 --y-down --cells d.csv --cell-columns top,bottom");
  const TableRow down = read_table(folder / "d.csv").rows.front();  // after frame and time step
  BOOST_TEST(*down[2] < *down[3]);
  BOOST_TEST(geojson(folder, "p.json").at("features").front().at("id") == 1);
}

BOOST_AUTO_TEST_CASE(points_count_where_their_cells_lie) {
  const TemporaryFolder folder;
  // The same points of a period from (0, 0) to (6, 4), in it, at its upper ends and beyond.
  folder.file("in.csv", "x,y\n1,1\n3,0\n0,2.5\n4.25,3.5\n1.5,2\n");
  folder.file("out.csv", "x,y\n-11,9\n3,4\n6,2.5\n10.25,-0.5\n7.5,-2\n");
  for (const std::string file : {"in", "out"}) {
    succeeds(folder, "cells --exact --points " + file + ".csv --bounds 0,0,6,4 --periodic xy --cells " +
                         file + "_cells.csv --polygons " + file + ".geojson");
  }
  BOOST_TEST(content_of(folder / "out_cells.csv") == content_of(folder / "in_cells.csv"));
  BOOST_TEST(content_of(folder / "out.geojson") == content_of(folder / "in.geojson"));
  for (const TableRow& row : read_table(folder / "in_cells.csv").rows)
    BOOST_TEST(*row[12] < std::hypot(3, 2));  // no point is farther from all images of one
}

BOOST_AUTO_TEST_CASE(random_seeds_are_centres_of_pixels) {
  const TemporaryFolder folder;
  succeeds(folder, "cells --exact --random 40 --size 60x50 --cells exact.csv");
  succeeds(folder, "cells --random 40 --size 60x50 --cells pixels.csv");
  const Table exact = read_table(folder / "exact.csv"), pixels = read_table(folder / "pixels.csv");
  BOOST_TEST_REQUIRE(exact.rows.size() == pixels.rows.size());
  double sum = 0;
  for (std::size_t i = 0; i < exact.rows.size(); ++i) {
    sum += *exact.rows[i][3];
    BOOST_TEST(*exact.rows[i][1] == *pixels.rows[i][1]);
    BOOST_TEST(std::abs(*exact.rows[i][3] - *pixels.rows[i][3]) < 30);  // about a perimeter's worth
  }
  BOOST_TEST(sum == 3000, boost::test_tools::tolerance(rounding));
}

BOOST_AUTO_TEST_CASE(cells_of_a_tilted_box_are_those_of_its_lattice) {
  // A lattice of triangles with the distance 2, in a box that holds two rows of it: every cell is a hexagon.
  const TemporaryFolder folder;
  folder.file(
      "t.xyz",
      "4\nLattice=\"4 0 0 2 3.4641016151377544 0 0 0 1\" Properties=species:S:1:pos:R:3 pbc=\"T T F\"\n"
      "A 0 0 0\nA 2 0 0\nA 1 1.7320508075688772 0\nA 3 1.7320508075688772 0\n");
  const json result = json::parse(
      succeeds(folder, "cells --exact --trajectory t.xyz --cells c.csv --adjacency a.csv --json"));
  BOOST_TEST(result.at("not_mutual") == 0);
  const Table cells = read_table(folder / "c.csv");
  BOOST_TEST_REQUIRE(cells.rows.size() == 4u);
  constexpr std::size_t area = 3, perimeter = 10;
  for (const TableRow& cell : cells.rows) {
    BOOST_TEST(*cell[area] == 2 * std::sqrt(3.0), boost::test_tools::tolerance(1e-7));
    BOOST_TEST(*cell[perimeter] == 4 * std::sqrt(3.0), boost::test_tools::tolerance(1e-7));
  }
  std::size_t long_edges = 0;
  for (const TableRow& pair : read_table(folder / "a.csv").rows) long_edges += *pair[2] > 1 ? 1 : 0;
  BOOST_TEST(long_edges == 12u);
}

BOOST_AUTO_TEST_CASE(frames_of_a_trajectory_have_the_cells_of_each_frame) {
  const TemporaryFolder folder;
  // The second box is tilted and has another particle; the third has a particle fewer.
  const std::string properties = "Properties=id:I:1:pos:R:2";
  folder.file("t.xyz", "3\nLattice=\"4 0 0 0 3 0 0 0 1\" " + properties +
                           "\n7 0.5 0.5\n2 3 1\n9 1.5 2.25\n4\nLattice=\"5 0 0 1 3 0 0 0 1\" " + properties +
                           "\n7 0.75 0.5\n2 3 1\n9 1.5 2.25\n1 4 2.5\n2\nLattice=\"4 0 0 0 3 0 0 0 1\" " +
                           properties + "\n9 3 1\n1 1.5 2.25\n");
  const std::string simulate = "simulate --exact --trajectory t.xyz ",
                    columns = "--cell-columns id,area,largest_distance,neighbours ";
  const json result = json::parse(succeeds(
      folder, simulate + "--cells all.csv --adjacency a%d.csv --polygons p%d.vtp --json " + columns));
  BOOST_TEST(result.at("frames") == 2);  // after frame 0
  BOOST_TEST(result.at("uncertified") == 0);
  std::string expected;
  for (const int frame : {0, 1, 2}) {
    succeeds(folder,
             fmt::format("cells --exact --trajectory t.xyz --frame {} --cells c.csv --adjacency a.csv "
                         "--polygons p.vtp {}",
                         frame, columns));
    std::istringstream rows(content_of(folder / "c.csv"));
    std::string line;
    std::getline(rows, line);
    if (frame == 0) expected = "frame,timestep," + line + "\n";
    while (std::getline(rows, line)) expected += fmt::format("{0},{0},{1}\n", frame, line);
    BOOST_TEST(content_of(folder / fmt::format("a{}.csv", frame)) == content_of(folder / "a.csv"));
    BOOST_TEST(content_of(folder / fmt::format("p{}.vtp", frame)) == content_of(folder / "p.vtp"));
  }
  BOOST_TEST(content_of(folder / "all.csv") == expected);

  succeeds(folder, simulate + "--cells c%d.csv --frames 2 --every 2 " + columns);
  BOOST_TEST((std::ifstream(folder / "c0.csv").good() && std::ifstream(folder / "c2.csv").good()));
  BOOST_TEST(!std::ifstream(folder / "c1.csv").good());
  succeeds(folder, simulate + "--cells some.csv --frames 1 " + columns);
  BOOST_TEST(read_table(folder / "some.csv").rows.size() == 7u);

  // A bad frame leaves those before it.
  folder.file("cut.xyz",
              content_of(folder / "t.xyz") + "2\nLattice=\"4 0 0 0 3 0 0 0 1\" " + properties + "\n1 1");
  const Result cut = run(folder, "simulate --exact --trajectory cut.xyz --cells kept.csv " + columns);
  BOOST_TEST(cut.exit_code == failure);
  BOOST_TEST(cut.error.find("cut.xyz:18") != std::string::npos, cut.error);
  BOOST_TEST(cut.error.find("frames complete before that: 3") != std::string::npos, cut.error);
  BOOST_TEST(content_of(folder / "kept.csv") == expected);
  // One behind the last frame that is asked for is not read.
  succeeds(folder, "simulate --exact --trajectory cut.xyz --frames 2 --cells kept.csv " + columns);
  BOOST_TEST(content_of(folder / "kept.csv") == expected);
}

BOOST_AUTO_TEST_CASE(without_a_box_the_particles_say_the_bounds) {
  const TemporaryFolder folder;
  folder.file("t.xyz", "2\n\nSi 1 2 3\nSi 4 6 3\n");
  succeeds(folder, "cells --exact --trajectory t.xyz --cells c.csv --cell-columns area");
  BOOST_TEST(content_of(folder / "c.csv") == "area\n6\n6\n");
}

BOOST_AUTO_TEST_CASE(what_exact_frames_cannot_do_is_refused_before_the_work) {
  const TemporaryFolder folder;
  folder.file("t.xyz", "1\nLattice=\"4 0 0 0 4 0 0 0 4\"\nA 1 1 0\n");
  const std::string exact = "simulate --exact --trajectory t.xyz --device none ";
  refuses(folder, exact, usage, {"nothing to write", "--cells", "--adjacency", "--polygons"});
  refuses(folder, "simulate --exact --random 5 --size 9x9 --cells c.csv", usage, {"--exact", "trajectory"});
  for (const char* const option :
       {"--method jfa", "--metric manhattan", "-o f.mp4", "--labels l%d.npy", "--statistics s.csv",
        "--compare-with jfa", "--units px", "--snap", "--size 9x9", "--fit frame"}) {
    const std::string text = option;
    refuses(folder, fmt::format("{}--cells c.csv {}", exact, text), usage,
            {text.substr(0, text.find(' ')), "--exact"});
  }
  refuses(folder, exact + "--polygons p.vtp", usage, {"p.vtp", "%05d"});
  refuses(folder, exact + "--polygons p%d.txt", usage, {"p%d.txt", ".vtp"});
  refuses(folder, "simulate --trajectory t.xyz --size 9x9 --polygons p%d.vtp", usage,
          {"--polygons requires --exact"});
  BOOST_TEST((folder.names() == std::set<std::string>{"t.xyz"}));
}

BOOST_AUTO_TEST_CASE(what_exact_cells_cannot_do_is_refused_before_the_work) {
  const TemporaryFolder folder;
  folder.file("p.csv", "x,y\n1,1\n9,3\n");
  folder.file("tilted.xyz",
              "1\nLattice=\"4 0 0 1 4 0 0 0 4\" Properties=species:S:1:pos:R:3 pbc=\"T T T\"\nA 1 1 0\n");
  // A device that does not exist would be the next error: it is not reached.
  const std::string exact = "cells --exact --points p.csv --device none ";
  refuses(folder, exact, usage, {"nothing to write", "--cells", "--adjacency", "--polygons"});
  refuses(folder, exact + "--cells c.csv --method jfa", usage, {"--method", "--exact"});
  refuses(folder, exact + "--cells c.csv --snap", usage, {"--snap", "--exact"});
  refuses(folder, exact + "--cells c.csv --metric manhattan", usage, {"--metric", "--exact"});
  refuses(folder, exact + "--cells c.csv --extra-waves 1", usage, {"--extra-waves", "--exact"});
  refuses(folder, exact + "--labels l.npy", usage, {"--labels", "--exact"});
  refuses(folder, exact + "--distance l.npy", usage, {"--distance", "--exact"});
  refuses(folder, exact + "--cells c.csv --border l.npy", usage, {"--border", "--exact"});
  refuses(folder, exact + "--cells c.csv --units px", usage, {"--units px", "--exact"});
  refuses(folder, exact + "--polygons p.txt", usage, {"p.txt", ".geojson, .json, .csv, .vtp"});
  refuses(folder, exact + "--polygons p.csv", usage, {"p.csv", "--points"});
  refuses(folder, exact + "--polygons c.csv --cells c.csv", usage, {"--cells and --polygons"});
  refuses(folder, "cells --points p.csv --width 9 --polygons p.vtp", usage, {"--polygons requires --exact"});
  refuses(folder, exact + "--cells c.csv --bounds 0,0,5,5 --outside refuse", failure, {"none"});
  refuses(folder, "cells --exact --points p.csv --cells c.csv --bounds 0,0,5,5 --outside refuse", failure,
          {"p.csv", "point 1", "outside"});
  refuses(folder, exact + "--cells c.csv --periodic x --domain 0,0,10,10 --bounds 0,0,5,10", failure,
          {"p.csv", "whole periods", "0,0,10,10"});
  refuses(folder, "cells --exact --trajectory tilted.xyz --periodic x --cells c.csv --device none", failure,
          {"tilted.xyz", "frame 0", "tilted", "--periodic xy"});
  refuses(folder, "cells --exact --trajectory tilted.xyz --frame 4 --cells c.csv --device none", failure,
          {"tilted.xyz", "no frame 4"});
  BOOST_TEST((folder.names() == std::set<std::string>{"p.csv", "tilted.xyz"}));
}

BOOST_AUTO_TEST_CASE(tables_and_polygons_have_the_ids_and_columns_of_the_input) {
  const TemporaryFolder folder;
  folder.file("p.csv", "id,x,y,city,area,code\n90,3,1,\"Ulm, \"\"a\"\"\",7.5,007\n70,1,1,Bonn,,12\n");
  const std::string cells = "cells --exact --points p.csv --bounds 0,0,4,2 --keep city,area,code ";
  succeeds(folder, cells + "--cells c.csv --cell-columns id,x --adjacency a.csv --polygons p.geojson");
  BOOST_TEST(content_of(folder / "c.csv") ==
             "id,x,city,area,code\n70,1,Bonn,,12\n90,3,\"Ulm, \"\"a\"\"\",7.5,007\n");
  BOOST_TEST(content_of(folder / "a.csv") == "a,b,length,midpoint_x,midpoint_y\n70,90,2,2,1\n");
  const json features = geojson(folder, "p.geojson").at("features");
  BOOST_TEST(features.at(0).at("id") == 70);
  const json first = {{"id", 70},
                      {"x", 1.0},
                      {"y", 1.0},
                      {"area", 4.0},
                      {"neighbours", 1},
                      {"city", "Bonn"},
                      {"input_area", nullptr},
                      {"code", 12}};
  BOOST_TEST(features.at(0).at("properties") == first);
  BOOST_TEST(features.at(1).at("properties").at("city") == "Ulm, \"a\"");
  BOOST_TEST(features.at(1).at("properties").at("input_area") == 7.5);
  BOOST_TEST(features.at(1).at("properties").at("code") == "007");
  succeeds(folder, cells + "--polygons w.csv");
  const std::string wkt = content_of(folder / "w.csv");
  BOOST_TEST(wkt.substr(0, wkt.find('\n')) == "id,x,y,area,neighbours,wkt,city,input_area,code");
  BOOST_TEST(wkt.find("))\",\"Ulm, \"\"a\"\"\",7.5,007\n") != std::string::npos);
  succeeds(folder, cells + "--polygons p.vtp");
  const std::string vtp = content_of(folder / "p.vtp");
  BOOST_TEST(vtp.find("Name=\"input_area\"") != std::string::npos);
  BOOST_TEST(vtp.find("city") == std::string::npos);

  // With pixels the same, and labels by the ids.
  succeeds(folder,
           "cells --points p.csv --bounds 0,0,4,2 --width 4 --keep all --cells r.csv --cell-columns id,area "
           "--labels l.npy");
  BOOST_TEST(content_of(folder / "r.csv") ==
             "id,area,city,input_area,code\n70,4,Bonn,,12\n90,4,\"Ulm, \"\"a\"\"\",7.5,007\n");
  BOOST_TEST(read_raw_npy<std::uint32_t>(folder / "l.npy").values ==
             (std::vector<std::uint32_t>{70, 70, 90, 90, 70, 70, 90, 90}));
  folder.file("v.csv", "id,x,y,z,n\n9,1,1,1,a\n7,3,1,1,b\n");
  succeeds(folder,
           "cells --points v.csv --bounds 0,0,0,4,2,2 --size 8x4x4 --method jfa --keep n --cells v.out.csv");
  const std::string volume = content_of(folder / "v.out.csv");
  BOOST_TEST(volume.substr(0, volume.find('\n')).find("touches_border,n") != std::string::npos);
  BOOST_TEST(volume.find("\n7,3.25,") != std::string::npos);
  BOOST_TEST(volume.find(",b\n") < volume.find(",a\n"));
  refuses(folder, "cells --random 3 --size 9x9 --keep a --cells r.csv", usage, {"--keep", "--points"});
  refuses(folder, cells + "--keep town --cells r.csv", failure, {"p.csv:1", "no column town"});
}

BOOST_AUTO_TEST_CASE(what_is_left_out_of_a_plane_is_said) {
  const TemporaryFolder folder;
  folder.file("p.csv", "x,y\n1,1\n3,3\n5,1\n9,9\n");
  const Result outside = run(folder, "cells --exact --points p.csv --bounds 0,0,4,4 --cells c.csv");
  BOOST_TEST(outside.error.find("2 of 4 points lie outside the bounds 0,0,4,4") != std::string::npos);
  BOOST_TEST(outside.out.find("\n1 seed outside the rectangle without a cell in it\n") != std::string::npos);
  const Result periodic =
      run(folder, "cells --exact --points p.csv --bounds 0,0,4,4 --periodic xy --cells c.csv");
  BOOST_TEST(periodic.error == "");
  // Of points at one place on the end of their bounding box, which holds them, both have rows.
  folder.file("twins.csv", "x,y\n0,0\n4,4\n4,4\n");
  succeeds(folder, "cells --exact --points twins.csv --cells c.csv --cell-columns id,area");
  BOOST_TEST(content_of(folder / "c.csv") == "id,area\n0,8\n1,8\n2,0\n");
  folder.file("t.xyz", "2\nTimestep=500 Lattice=\"9 0 0 0 9 0 0 0 9\" pbc=\"F F F\"\nA 1 1 1\nA 8 8 4\n");
  for (const std::string command : {"cells", "simulate"}) {
    const Result along_z =
        run(folder, command + " --exact --trajectory t.xyz --bounds 0,0,5,5 --cells c.csv");
    BOOST_TEST(along_z.exit_code == 0);
    BOOST_TEST(along_z.error.find("z is left out, along which the particles of frame 0 span 3") !=
               std::string::npos);
    BOOST_TEST(along_z.error.find("1 of 2 points lie outside the bounds 0,0,5,5") != std::string::npos);
  }
  BOOST_TEST(content_of(folder / "c.csv").find("\n0,500,0,1,1,") != std::string::npos);
}

BOOST_AUTO_TEST_CASE(files_say_where_they_lie_in_the_world) {
  const TemporaryFolder folder;
  folder.file("p.csv", "x,y\n401000,5601000\n405000,5603000\n");
  const std::string points = " --points p.csv --bounds 400000,5600000,420000,5615000 ";
  const Result silent = run(folder, "cells --exact" + points + "--polygons c.geojson");
  BOOST_TEST(silent.error.find("c.geojson says no coordinate reference system") != std::string::npos);
  refuses(folder, "cells --exact" + points + "--cells c.csv --crs EPSG:32632", usage, {"--crs", ".geojson"});
  succeeds(folder, "cells" + points + "--width 100 --labels l.vti --cells c.csv");
  const std::string image = content_of(folder / "l.vti").substr(0, 600);
  BOOST_TEST(found_in(image, "Origin=\"([^\"]*)\"") == "400000 5600000 0");
  BOOST_TEST(found_in(image, "Spacing=\"([^\"]*)\"") == "200 200 1");
#ifdef VOROCL_GEOTIFF
  succeeds(folder, "cells --exact" + points + "--polygons c.geojson --crs EPSG:32632");
  BOOST_TEST(geojson(folder, "c.geojson").at("crs").at("properties").at("name") ==
             "urn:ogc:def:crs:EPSG::32632");
  succeeds(folder, "cells --exact" + points + "--polygons c.geojson --crs EPSG:4326");
  BOOST_TEST(!geojson(folder, "c.geojson").contains("crs"));
  succeeds(folder, "cells" + points + "--width 100 --labels l.tif --distance d.tif --crs EPSG:32632 --y-up");
  for (const char* const name : {"l.tif", "d.tif"})
    BOOST_TEST(content_of(folder / name).find("WGS 84 / UTM zone 32N") != std::string::npos);
#endif
}

BOOST_AUTO_TEST_CASE(polygons_of_degrees_are_cut_at_the_date_line) {
  const TemporaryFolder folder;
  std::string points = "x,y\n";
  for (int i = 0; i < 40; ++i)
    points += fmt::format("{},{}\n", (i * 67) % 360 - 180 + 0.25, (i * 41) % 180 - 90 + 0.5);
  folder.file("p.csv", points);
  const std::string cells = "cells --exact --points p.csv --bounds=-180,-90,180,90 --periodic x --polygons ";
  succeeds(folder, cells + "c.geojson");
  double area = 0;
  std::size_t cut = 0;
  const json degrees = geojson(folder, "c.geojson");
  for (const json& feature : degrees.at("features")) {
    const json& geometry = feature.at("geometry");
    const bool is_one = geometry.at("type") == "Polygon";
    cut += is_one ? 0 : 1;
    double of_cell = 0;
    for (const json& polygon : is_one ? json({geometry.at("coordinates")}) : geometry.at("coordinates")) {
      const auto ring = polygon.at(0).get<std::vector<std::pair<double, double>>>();
      for (const auto& [x, y] : ring) BOOST_TEST_REQUIRE((std::abs(x) <= 180 && std::abs(y) <= 90));
      BOOST_TEST((ring.front() == ring.back()));
      of_cell += area_of(ring);
    }
    BOOST_TEST(of_cell == feature.at("properties").at("area").get<double>(),
               boost::test_tools::tolerance(1e-9));
    area += of_cell;
  }
  BOOST_TEST(area == 64800, boost::test_tools::tolerance(1e-9));
  BOOST_TEST(cut >= 4u);
  succeeds(folder, cells + "w.csv");  // whole, as before
  BOOST_TEST(content_of(folder / "w.csv").find("MULTI") == std::string::npos);
}
