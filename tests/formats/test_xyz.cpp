// XYZ files: plain ones, and what an extended one's comment says about the box and the columns.
#define BOOST_TEST_MODULE xyz
#include "fixture.hpp"
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
      {"0\nLattice=\"1 1 0 0 1 0 0 0 1\"\n", {":2: ", "turned"}},
      {"0\nLattice=\"1 0 0 0 1 0 0 1 1\"\n", {":2: ", "tilted in z"}},
      {"0\nLattice=\"1 0 0 0 1 0 1 0 1\"\n", {":2: ", "tilted in z"}},
      {"0\nLattice=\"-1 0 0 0 1 0 0 0 1\"\n", {":2: ", "no bounds"}},
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
  BOOST_TEST((frames_of(text, "charge")[0].values == std::vector<double>{0.5, -0.5}));
  BOOST_TEST((frames_of(text, "vel[2]")[0].values == std::vector<double>{5, 7}));
  BOOST_TEST((frames_of("1\n\nAr 1 2 3\n", "z")[0].values == std::vector<double>{3}));
  check_error([&] { frames_of(text, "vel"); },
              {"trajectory:2", "\"vel\"", "species, pos[1], pos[2], pos[3], vel[1], vel[2], charge"});
  check_error([&] { frames_of(text, "species"); }, {"trajectory:3", "\"Ar\"", "number"});
  check_error([&] { frames_of("1\n\nAr 1 2 3\n", "vx"); }, {"trajectory:2", "\"vx\"", "species, x, y, z"});
}
