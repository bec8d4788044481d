// XYZ files: plain ones, and what an extended one's comment says about the box and the columns.
#define BOOST_TEST_MODULE xyz
#include <fmt/format.h>
#include <zlib.h>

#include <cmath>
#include <map>

#include "fixture.hpp"
#include "temporary_folder.hpp"
#include "trajectory_text.hpp"

using namespace vorocl;
using namespace vorocl::command;

namespace {

/// A frame of two particles with this comment.
Frame frame_with(const std::string& comment) {
  return frames_of("2\n" + comment + "\nAr 1 2 3\nAr 11 -3 0\n").at(0);
}

const std::string lattice = "Lattice=\"10 0 0 0 5 0 0 0 1\"";

void check_positions(const Frame& frame, Point first, Point second) {
  BOOST_REQUIRE_EQUAL(frame.positions.size(), 2u);
  BOOST_TEST(frame.positions[0].x == first.x);
  BOOST_TEST(frame.positions[0].y == first.y);
  BOOST_TEST(frame.positions[1].x == second.x);
  BOOST_TEST(frame.positions[1].y == second.y);
}

}  // namespace

BOOST_AUTO_TEST_CASE(plain_files_have_no_box) {
  const auto frames =
      frames_of("2\nAtoms. Timestep: 1000\n1 1.5 2 0\n2 -3e1 4 0 and more\n 1\n\nC 7 8 9\n0\nempty\n\n");
  BOOST_REQUIRE_EQUAL(frames.size(), 3u);
  check_positions(frames[0], {1.5, 2}, {-30, 4});
  BOOST_TEST((frames[1].positions.size() == 1 && frames[1].positions[0].x == 7));
  BOOST_TEST(frames[2].positions.empty());
  for (const Frame& frame : frames) BOOST_TEST((!frame.box && !frame.timestep));
}

BOOST_AUTO_TEST_CASE(a_lattice_is_a_periodic_box) {
  for (const std::string& comment :
       {lattice, "energy=-1 " + lattice + " pbc=\"T T F\"", "pbc=[true,true,false] " + lattice,
        std::string("free text, then lattice = [[10,0,0], [0,5,0], [0,0,1]]")}) {
    BOOST_TEST_CONTEXT(comment) {
      const Frame frame = frame_with(comment);
      check_positions(frame, {1, 2}, {1, 2});
      const Box box = frame.box.value();
      BOOST_TEST(
          (box.x0 == 0 && box.x1 == 10 && box.y0 == 0 && box.y1 == 5 && box.periodic_x && box.periodic_y));
    }
  }
}

BOOST_AUTO_TEST_CASE(axes_that_are_not_periodic_grow) {
  const Frame frame = frame_with(lattice + " pbc=\"F T T\"");
  check_positions(frame, {1, 2}, {11, 2});
  BOOST_TEST((frame.box->x1 == 11 && !frame.box->periodic_x && frame.box->periodic_y));
}

BOOST_AUTO_TEST_CASE(the_origin_is_the_box_s_corner) {
  const Frame frame = frame_with(lattice + " Origin=\"-10 1 0\"");
  check_positions(frame, {-9, 2}, {-9, 2});
  BOOST_TEST((frame.box->x0 == -10 && frame.box->x1 == 0 && frame.box->y0 == 1 && frame.box->y1 == 6));
}

BOOST_AUTO_TEST_CASE(a_tilted_lattice_fills_its_rectangle) {
  const Frame frame = frame_with("Lattice=\"10 0 0 2 5 0 0 0 1\" pbc=\"1 1 0\"");
  check_positions(frame, {1, 2}, {3, 2});  // one cell up, so 2 to the right
  BOOST_TEST(frame.box->tilt == 2);
}

BOOST_AUTO_TEST_CASE(the_time_step_is_that_of_the_comment) {
  BOOST_TEST((frame_with("Timestep=12000 " + lattice).timestep == 12000));
  BOOST_TEST(!frame_with("Timestep=0.5").timestep);
}

BOOST_AUTO_TEST_CASE(boxes_that_are_turned_in_their_plane_are_turned_back) {
  const Frame quarter = frame_with("Lattice=\"0 10 0 -5 0 0 0 0 1\"");
  BOOST_TEST((quarter.box->x1 == 10 && quarter.box->y1 == 5 && quarter.box->tilt == 0));
  BOOST_TEST(quarter.box->turned == 90);
  check_positions(quarter, {2, 4}, {7, 4});  // (1, 2) is at (2, -1) from the corner, (11, -3) at (-3, -11)
  // A left-handed one: its second edge goes down when the first goes right.
  const Frame left = frame_with("Lattice=\"0 10 0 5 0 0 0 0 1\" Origin=\"-1 0 0\"");
  BOOST_TEST((left.box->x0 == 4 && left.box->x1 == 14 && left.box->y0 == 0 && left.box->y1 == 5));
  check_positions(left, {6, 3}, {11, 3});
  // LAMMPS's general triclinic box, with positions and with lengths of the edges.
  const std::string dump =
      "ITEM: TIMESTEP\n0\nITEM: NUMBER OF ATOMS\n2\nITEM: BOX BOUNDS abc origin pp pp pp\n3 4 0 0\n-4 3 0 "
      "0\n0 0 6 0\n";
  const Frame general = frames_of(dump + "ITEM: ATOMS id x y z\n1 1 2 1\n2 -4 3 1\n").at(0);
  BOOST_TEST((general.box->x1 == 5 && general.box->y1 == 5));
  BOOST_TEST(general.positions[0].x == 2.2, boost::test_tools::tolerance(1e-12));
  BOOST_TEST(general.positions[0].y == 0.4, boost::test_tools::tolerance(1e-12));
  check_positions(frames_of(dump + "ITEM: ATOMS id xs ys zs\n1 0.5 0.25 0\n2 0 0.5 0\n").at(0), {2.5, 1.25},
                  {0, 2.5});
  // By any angle, with a tilt: as the box that is not turned has them.
  const double angle = 0.7, c = std::cos(angle), s = std::sin(angle);
  std::string texts[2];
  for (const bool turned : {false, true}) {
    const auto at = [&](double x, double y) {
      return turned ? fmt::format("{} {} ", c * x - s * y, s * x + c * y) : fmt::format("{} {} ", x, y);
    };
    texts[turned] = "3\nLattice=\"" + at(9, 0) + "0 " + at(2, 7) + "0 0 0 1\"\n";
    for (const Point point : {Point{1, 2}, Point{8.5, 6.75}, Point{-30, 40}})
      texts[turned] += "A " + at(point.x, point.y) + "0\n";
  }
  const Frame straight = frames_of(texts[0]).at(0), turned = frames_of(texts[1]).at(0);
  BOOST_TEST(turned.box->turned == angle * 180 / std::acos(-1.0), boost::test_tools::tolerance(1e-12));
  BOOST_TEST(straight.box->turned == 0);
  BOOST_TEST(turned.box->tilt == 2, boost::test_tools::tolerance(1e-12));
  for (std::size_t i = 0; i < 3; ++i) {
    BOOST_TEST(turned.positions[i].x == straight.positions[i].x, boost::test_tools::tolerance(1e-10));
    BOOST_TEST(turned.positions[i].y == straight.positions[i].y, boost::test_tools::tolerance(1e-10));
  }
}

BOOST_AUTO_TEST_CASE(files_that_programs_packed_are_read_as_they_are) {
  const TemporaryFolder folder;
  std::string text;
  for (int frame = 0; frame < 400; ++frame) text += "2\n\nA " + std::to_string(frame) + " 2 0\nA 3 4 0\n";
  gzFile packed = gzopen((folder / "t.xyz.gz").c_str(), "wb");
  gzwrite(packed, text.data(), static_cast<unsigned>(text.size()));
  gzclose(packed);
  const auto count = [&](const std::string& name) {
    const auto reader = open_trajectory(folder / name);
    Frame frame;
    int frames = 0;
    for (; reader->next(frame); ++frames) BOOST_TEST_REQUIRE(frame.positions[0].x == frames);
    BOOST_TEST((reader->bytes_left() == 0u));
    return frames;
  };
  BOOST_TEST(count("t.xyz.gz") == 400);
  const std::string bytes = content_of(folder / "t.xyz.gz");
  folder.file("cut.gz", bytes.substr(0, bytes.size() / 2));
  check_error([&] { count("cut.gz"); }, {"cut.gz", "packed", "cut off"});
  const std::map<std::string, std::string> others = {
      // three frames, packed by the programs of these names
      {"bzip2",
       "425a6839314159265359917b7bce000009db00001040007800080000202000310c081b506460cb3891d919492a38f17724538"
       "5090917b7bce0"},
      {"xz",
       "fd377a585a000004e6d6b4460200210116000000742fe5a3e0002300165d001882aca669100c82622778b83e4703f0e37e802"
       "0a80000000061e1917806878832000132248b05f5f11fb6f37d010000000004595a"},
      {"zstd", "28b52ffd0458dd000098310a0a53692030203220330a3132203220330a0200c0880f2509326129b8"},
  };
  for (const auto& [program, digits] : others) {
    std::string all;
    for (std::size_t i = 0; i < digits.size(); i += 2)
      all += static_cast<char>(std::stoi(digits.substr(i, 2), nullptr, 16));
    folder.file("t.packed", all);
    BOOST_TEST(count("t.packed") == 3, program);
    folder.file("t.packed", all.substr(0, all.size() - 9));
    check_error([&] { count("t.packed"); }, {"t.packed", "packed", "cut off"});
    all[all.size() / 2] ^= 4;
    folder.file("t.packed", all);
    check_error([&] { count("t.packed"); }, {"t.packed", "damaged"});
  }
}

BOOST_AUTO_TEST_CASE(other_words_of_the_comment_do_not_matter) {
  BOOST_TEST(!frame_with("name=\"a \\\" Lattice=\\\"1 2\\\" b\" note={Lattice=2} = alone=").box.has_value());
  BOOST_TEST(!frame_with("Lattice=\"0 0 0 0 0 0 0 0 0\" pbc=\"F F F\"").box.has_value());
}

BOOST_AUTO_TEST_CASE(properties_name_the_columns) {
  const auto frame =
      frames_of("2\nProperties=vel:R:2:id:I:1:pos:R:3:species:S:1\n9 9 40 1 2 3 Ar\n9 9 7 4 5 6 Ar\n").at(0);
  BOOST_TEST(frame.ids == (std::vector<std::uint32_t>{7, 40}), boost::test_tools::per_element());
  check_positions(frame, {4, 5}, {1, 2});
}

BOOST_AUTO_TEST_CASE(bad_xyz_files_are_refused_with_their_line) {
  const struct {
    std::string text;
    std::initializer_list<std::string> parts;
  } cases[] = {
      {"2\ncomment\nAr 1 2 0\n", {":3: ", "1 of the 2 particles", "cut off"}},
      {"1\n", {":1: ", "ends within the frame"}},
      {"2\ncomment\nAr 1 2 0\n2\ncomment\nAr 1 2 0\nAr 1 2 0\n", {":4: ", "1 fields", "line 1"}},
      {"1\ncomment\nAr 1 2 0\nAr 1 2 0\n", {":4: ", "\"Ar 1 2 0\"", "number of particles"}},
      {"1\ncomment\nAr 1 2\n", {":3: ", "3 fields"}},
      {"1\ncomment\nAr 1 abc 0\n", {":3: ", "\"abc\"", "finite y"}},
      {"1\ncomment\nAr inf 2 0\n", {":3: ", "\"inf\"", "finite x"}},
      {"-1\ncomment\n", {":1: ", "\"-1\""}},
      {"99999999999999999999\ncomment\n", {":1: ", "number of particles"}},
      {"1000000000\ncomment\nAr 1 2 0\n", {":1: ", "1000000000 particles cannot be"}},
      {"0\nLattice=\"1 2 3\"\n", {":2: ", "Lattice has 3 values instead of 9"}},
      {"0\nLattice=\"1 0 0 0 x 0 0 0 1\"\n", {":2: ", "\"x\"", "Lattice"}},
      {"0\nLattice=\"1 0 1 0 1 0 0 0 1\"\n", {":2: ", "turned out of its plane"}},
      {"0\nLattice=\"1 0 0 0 1 0 0 1 1\"\n", {":2: ", "tilted in z"}},
      {"0\nLattice=\"1 0 0 0 1 0 1 0 1\"\n", {":2: ", "tilted in z"}},
      {"0\nLattice=\"0 0 0 0 1 0 0 0 1\"\n", {":2: ", "no length"}},
      {"0\nLattice=\"2 0 0 1 2 0 0 0 1\" pbc=\"T F T\"\n", {":2: ", "tilted but not periodic"}},
      {"0\nLattice=\"1 0 0 0 1 0 0 0 1\" pbc=\"T maybe T\"\n", {":2: ", "\"maybe\""}},
      {"0\nProperties=species:S\n", {":2: ", "name:type:count"}},
      {"0\nProperties=species:S:x\n", {":2: ", "number of columns"}},
      {"0\nProperties=species:S:1\n", {":2: ", "pos:R:3"}},
      {"1\nProperties=species:S:1:pos:R:3\nAr 1 2 3 4\n", {":3: ", "5 fields"}},
      {"2\nProperties=id:I:1:pos:R:3\n5 1 2 3\n5 1 2 3\n", {":4: ", "id 5 comes twice"}},
  };
  for (const auto& bad : cases) {
    BOOST_TEST_CONTEXT(bad.text) check_error([&] { frames_of(bad.text); }, bad.parts);
  }
}

BOOST_AUTO_TEST_CASE(a_column_of_values_is_a_property) {
  const std::string text =
      "2\nProperties=species:S:1:pos:R:3:vel:R:2:charge:R:1\nAr 1 2 3 -4 5 0.5\nAr 11 -3 0 6 7 -0.5\n";
  BOOST_TEST((frames_of(text, "charge")[0].values.numbers == std::vector<double>{0.5, -0.5}));
  BOOST_TEST((frames_of(text, "vel[2]")[0].values.numbers == std::vector<double>{5, 7}));
  BOOST_TEST((frames_of("1\n\nAr 1 2 3\n", "z")[0].values.numbers == std::vector<double>{3}));
  check_error([&] { frames_of(text, "vel"); },
              {"trajectory:2", "\"vel\"", "species, pos[1], pos[2], pos[3], vel[1], vel[2], charge"});
  const std::string texts = "2\n\nSi 1 2 3\nO 1 2 3\n";
  BOOST_TEST((frames_of(texts, "species")[0].values.texts == std::vector<std::string>{"O", "Si"}));
  BOOST_TEST((frames_of(texts + "1\n\nNa 1 2 3\n", "species")[1].values.numbers == std::vector<double>{2}));
  check_error([&] { frames_of("2\n\n1 1 2 3\nO 1 2 3\n", "species"); }, {"trajectory:4", "\"O\"", "number"});
  check_error([&] { frames_of("1\n\nAr 1 2 3\n", "vx"); }, {"trajectory:2", "\"vx\"", "species, x, y, z"});
}
