// Trajectories that cannot be trusted: each is refused with its file and line, after the frames before it.
#define BOOST_TEST_MODULE trajectory_errors
#include <sys/stat.h>

#include <algorithm>
#include <fstream>
#include <thread>

#include "fixture.hpp"
#include "trajectory_text.hpp"

using namespace vorocl;
using namespace vorocl::command;

namespace {

bool same(const Frame& a, const Frame& b) {
  const auto equal = [](const Point& p, const Point& q) { return p.x == q.x && p.y == q.y; };
  return a.timestep == b.timestep && a.ids == b.ids &&
         std::equal(a.positions.begin(), a.positions.end(), b.positions.begin(), b.positions.end(), equal);
}

std::string box_of(const std::string& title, const std::string& x, const std::string& y) {
  return title + "\n" + x + "\n" + y + "\n-1 1";
}

const std::string header = "ITEM: TIMESTEP\n0\nITEM: NUMBER OF ATOMS\n";
const std::string box = "ITEM: BOX BOUNDS pp pp pp\n0 10\n0 10\n-1 1\n";

}  // namespace

BOOST_AUTO_TEST_CASE(a_cut_at_any_byte_gives_the_whole_frames_and_then_an_error) {
  // The last column does not matter: a cut within the last field of a frame is the one that cannot be seen.
  std::string text;
  std::vector<std::size_t> ends;  // of the frames, without the last line feed
  for (int step = 0; step < 3; ++step) {
    text += dump(periodic_box, "id x y element", {"12 1.25 2.5 Ar", "7 3.125 4 Ar"},
                 "ITEM: TIME\n1\nITEM: TIMESTEP\n" + std::to_string(step) + "\n");
    ends.push_back(text.size() - 1);
  }
  const std::vector<Frame> whole = frames_of(text);
  BOOST_REQUIRE_EQUAL(whole.size(), 3u);
  const TemporaryFolder folder;
  for (std::size_t length = 1; length < text.size(); ++length) {
    const std::string path = folder.file("cut", text.substr(0, length));
    std::vector<Frame> frames;
    std::string message;
    try {
      read_frames(path, frames);
    } catch (const Error& error) {
      message = error.what();
    }
    std::size_t complete = 0;
    bool between = false;
    for (const std::size_t end : ends) {
      if (length + 1 >= end) ++complete;  // "A" is as good an element as "Ar"
      between = between || (length + 1 >= end && length <= end + 1);
    }
    BOOST_TEST_CONTEXT("cut after " << length << " bytes: " << message) {
      BOOST_TEST(frames.size() == complete);
      for (std::size_t i = 0; i < frames.size(); ++i) BOOST_TEST(same(frames[i], whole[i]));
      BOOST_TEST(message.empty() == between);
      if (!between) BOOST_TEST(message.find(path + ":") == 0u);
    }
  }
}

BOOST_AUTO_TEST_CASE(bad_dumps_are_refused_with_their_line) {
  const struct {
    std::string text;
    std::initializer_list<std::string> parts;
  } cases[] = {
      // not a trajectory
      {"", {":1: ", "empty", "give a LAMMPS text dump"}},
      {" \n\n", {":2: ", "empty"}},
      {"x,y\n1,2\n", {":1: ", "neither a LAMMPS text dump", "nor an XYZ"}},
      {"\x1f\x8b\x08\n", {":1: ", "packed"}},
      {std::string(3 << 20, 'x'), {":1: ", "longer than a mebibyte"}},
      {"ITEM: TIMESTEP\n0\nITEM: NUMBER OF ENTRIES\n3\n",
       {":3: ", "NUMBER OF ENTRIES", "style atom or custom"}},
      // the header
      {"ITEM: TIMESTEP\nsoon\n", {":2: ", "\"soon\"", "time step"}},
      {"ITEM: TIMESTEP\n1 2\n", {":2: ", "\"2\"", "more than belongs"}},
      {"ITEM: TIMESTEP\n0\nITEM: TIMESTEP\n1\n", {":3: ", "line 1", "no \"ITEM: ATOMS\""}},
      {header + "1\nITEM: ATOMS x y\n1 2\n", {":5: ", "no \"ITEM: BOX BOUNDS\""}},
      {"ITEM: TIMESTEP\n0\nITEM: ATOMS x y\n1 2\n", {":3: ", "no \"ITEM: NUMBER OF ATOMS\""}},
      {"ITEM: NUMBER OF ATOMS\n1\n" + box + "ITEM: ATOMS x y\n1 2\n", {":7: ", "no \"ITEM: TIMESTEP\""}},
      {header + "many\n", {":4: ", "\"many\"", "number of particles"}},
      {header + "-3\n", {":4: ", "\"-3\""}},
      {header + "4294967295\n", {":4: ", "\"4294967295\""}},
      {header + "1000000000\n" + box + "ITEM: ATOMS id x y\n1 2 3\n",
       {":4: ", "1000000000 particles cannot be in the 6 bytes"}},
      // the box
      {dump(box_of("pp pp", "0 1", "0 1"), "x y", {}), {":5: ", "2 boundary flags"}},
      {dump(box_of("pp pf pp", "0 1", "0 1"), "x y", {}), {":5: ", "\"pf\""}},
      {dump(box_of("pp xx pp", "0 1", "0 1"), "x y", {}), {":5: ", "\"xx\""}},
      {dump(box_of("pp pp pp", "0 wide", "0 1"), "x y", {}), {":6: ", "\"wide\""}},
      {dump(box_of("pp pp pp", "0 1", "nan 1"), "x y", {}), {":7: ", "\"nan\""}},
      {dump(box_of("pp pp pp", "0", "0 1"), "x y", {}), {":6: ", "missing"}},
      {dump(box_of("pp pp pp", "0 1 2", "0 1"), "x y", {}), {":6: ", "\"2\"", "more than belongs"}},
      {dump(box_of("ss ss pp", "0 1", "1 0"), "x y", {}), {":8: ", "from 1 to 0 in y"}},
      {dump(box_of("pp pp pp", "3 3", "0 1"), "x y", {}), {":8: ", "periodic in x", "no length"}},
      {dump(box_of("pp pp pp", "-1e308 1e308", "0 1"), "x y", {}), {":8: ", "no bounds"}},
      {dump("xy xz yz ff pp pp\n0 10 5\n0 10 0\n-1 1 0", "x y", {}), {":8: ", "tilted but not periodic"}},
      {dump("xy xz yz pp pp pp\n0 10 5\n0 10 1\n-1 1 0", "x y", {}), {":9: ", "tilted in z"}},
      {dump("abc origin pp pp pp\n3 4 1 0\n-4 3 0 0\n0 0 1 0", "x y", {}), {":8: ", "turned out of"}},
      {dump("abc origin pp pp pp\n3 0 0 0\n0 3 0 0\n1 0 1 0", "x y", {}), {":9: ", "tilted in z"}},
      {dump("abc origin pp pp pp\n3 0 0 0\n0 3 0 0\n0 1 1 0", "x y", {}), {":9: ", "tilted in z"}},
      // the rows
      {dump(periodic_box, "id type vx", {"1 1 1"}), {":9: ", "no position", "xsu ysu"}},
      {dump(periodic_box, "id x ys", {"1 1 1"}), {":9: ", "no position"}},
      {dump(periodic_box, "id x y", {"1 1 1", "2 1"}), {":11: ", "2 fields where a particle has 3"}},
      {dump(periodic_box, "id x y", {"1 1 1", "2 1 1 1"}), {":11: ", "4 fields where a particle has 3"}},
      {dump(periodic_box, "id x y", {"1 1 1", "", "2 1 1"}), {":11: ", "0 fields"}},
      {dump(periodic_box, "id x y", {"1 1 1", "2 1 1.0.0"}), {":11: ", "\"1.0.0\"", "finite y"}},
      {dump(periodic_box, "id x y", {"1 1 nan"}), {":10: ", "\"nan\"", "finite y"}},
      {dump(periodic_box, "id xs ys", {"1 -inf 0"}), {":10: ", "\"-inf\"", "finite x"}},
      {dump(periodic_box, "id xs ys", {"1 1e308 0"}), {":10: ", "too far"}},
      {dump(periodic_box, "id x y", {"one 1 1"}), {":10: ", "\"one\" is no id"}},
      {dump(periodic_box, "id x y", {"-1 1 1"}), {":10: ", "\"-1\" is no id"}},
      {dump(periodic_box, "id x y", {"1 1 1", "4294967295 1 1"}),
       {":11: ", "\"4294967295\" is no id", "4294967294"}},
      {dump(periodic_box, "id x y", {"7 1 1", "8 1 1", "7 2 2"}), {":12: ", "id 7 comes twice", "line 10"}},
      {dump(walled_box, "id x y", {"7 1 1", "8 1 10.5"}), {":11: ", "particle 8 is at y = 10.5", "y = 10"}},
      {dump(walled_box, "id xs ys", {"7 -0.01 1"}), {":10: ", "particle 7 is at x = -0.1", "x = 0"}},
      {dump(walled_box, "id xu yu", {"7 1 -1"}), {":10: ", "particle 7 is at y = -1", "y = 0"}},
      // more and fewer rows than announced
      {header + "2\n" + box + "ITEM: ATOMS x y\n1 2\n" + dump(periodic_box, "x y", {}),
       {":11: ", "1 of the 2 particles that line 4"}},
      {header + "1\n" + box + "ITEM: ATOMS x y\n1 2\n3 4\n", {":11: ", "\"3 4\"", "more atoms"}},
      {header + "3\n" + box + "ITEM: ATOMS x y\n1.000000 2.000000\n3 4\n",
       {":11: ", "2 of the 3 particles", "cut off"}},
  };
  for (const auto& bad : cases) {
    BOOST_TEST_CONTEXT(bad.text.substr(0, 300)) check_error([&] { frames_of(bad.text); }, bad.parts);
  }
}

BOOST_AUTO_TEST_CASE(frames_before_a_bad_one_are_given) {
  const TemporaryFolder folder;
  const std::string path =
      folder.file("bad", dump(periodic_box, "x y", {"1 2"}) + dump(periodic_box, "x y", {"1 x"}));
  std::vector<Frame> frames;
  check_error([&] { read_frames(path, frames); }, {path + ":20: ", "\"x\""});
  BOOST_TEST(frames.size() == 1u);
}

BOOST_AUTO_TEST_CASE(a_file_that_cannot_be_read_is_refused) {
  check_error([] { open_trajectory("no/such.lammpstrj"); }, {"no/such.lammpstrj"});
  check_error([] { open_trajectory("."); }, {".", "folder"});
}

BOOST_AUTO_TEST_CASE(a_pipe_is_read_though_its_size_is_not_known) {
  const TemporaryFolder folder;
  const std::string path = folder / "pipe";
  BOOST_REQUIRE(mkfifo(path.c_str(), 0600) == 0);
  std::thread writer([&] { std::ofstream(path) << dump(periodic_box, "x y", {"1 2", "3 4"}); });
  std::vector<Frame> frames;
  read_frames(path, frames);
  writer.join();
  BOOST_TEST((frames.size() == 1 && frames[0].ids.size() == 2));
}

BOOST_AUTO_TEST_CASE(columns_of_values_that_cannot_be_used_are_named) {
  const std::string text = dump(periodic_box, "id type x y", {"1 1 2 2", "2 O 3 3"});
  check_error([&] { frames_of(text, "c_pe"); }, {"trajectory:9", "\"c_pe\"", "id, type, x, y"});
  check_error([&] { frames_of(text, "type"); }, {"trajectory:11", "\"O\"", "number"});
}
