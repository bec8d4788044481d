// Trajectories: the same particles written in every way that files know must be read as the same frames.
#define BOOST_TEST_MODULE trajectory
#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <random>

#include "fixture.hpp"
#include "trajectory_text.hpp"

using namespace vorocl;
using namespace vorocl::command;

namespace {

std::mt19937 random_bits(1);

double uniform(double low, double high) {
  return std::uniform_real_distribution<double>(low, high)(random_bits);
}

/// A particle by its place in the cell, from 0 to 1 along each edge, and how often it has left the cell.
struct Particle {
  std::uint32_t id;
  double s;
  double t;
  int turns_x;
  int turns_y;
};

/// A cell with the edges (length_x, 0) and (tilt, length_y).
struct Parallelogram {
  double low_x;
  double low_y;
  double length_x;
  double length_y;
  double tilt;

  Point at(double s, double t) const { return {low_x + s * length_x + t * tilt, low_y + t * length_y}; }

  std::string title(const std::string& kind, const std::string& flags) const {
    if (kind == "edges") {
      return fmt::format("abc origin {}\n{} 0 0 {}\n{} {} 0 {}\n0 0 1 -0.5", flags, length_x, low_x, tilt,
                         length_y, low_y);
    }
    const std::string bounds_x =
        fmt::format("{} {}", low_x + std::min(0.0, tilt), low_x + length_x + std::max(0.0, tilt));
    if (kind == "tilt") {
      return fmt::format("xy xz yz {}\n{} {}\n{} {} 0\n-0.5 0.5 0", flags, bounds_x, tilt, low_y,
                         low_y + length_y);
    }
    return fmt::format("{}\n{}\n{} {}\n-0.5 0.5", flags, bounds_x, low_y, low_y + length_y);
  }
};

std::vector<Particle> random_particles(std::size_t count) {
  std::vector<Particle> particles;
  std::uint32_t id = 0;
  for (std::size_t i = 0; i < count; ++i) {
    id += 1 + static_cast<std::uint32_t>(random_bits() % 5);
    particles.push_back({id, uniform(0.001, 0.999), uniform(0.001, 0.999),
                         static_cast<int>(random_bits() % 7) - 3, static_cast<int>(random_bits() % 7) - 3});
  }
  return particles;
}

/// The pair of columns that a dialect has, for one particle.
std::string coordinates(const std::string& dialect, const Parallelogram& cell, const Particle& p) {
  const bool unwrapped = dialect == "xu" || dialect == "xsu";
  const double s = p.s + (unwrapped ? p.turns_x : 0);
  const double t = p.t + (unwrapped ? p.turns_y : 0);
  if (dialect == "xs" || dialect == "xsu") return fmt::format("{:.17g} {:.17e}", s, t);
  const Point position = cell.at(s, t);
  return fmt::format("{:.17g} {:.17e}", position.x, position.y);
}

std::string write(const std::string& dialect, const std::string& kind, const Parallelogram& cell,
                  std::vector<Particle> particles) {
  std::shuffle(particles.begin(), particles.end(), random_bits);
  const auto rows = transformed(particles, [&](const Particle& p) {
    return fmt::format("  Ar {}   0.25 {} ", coordinates(dialect, cell, p), p.id);
  });
  const std::string y_name = "y" + dialect.substr(1);
  return dump(cell.title(kind, "pp pp pp"), "element " + dialect + " " + y_name + " vx id", rows);
}

/// How far apart two positions are across the sides of a rectangle.
double gap(double a, double b, double length) { return std::abs(std::remainder(a - b, length)); }

/// The frame must hold these particles at their ids, in the rectangle that the cell fills.
void check_frame(const Frame& frame, const Parallelogram& cell, const std::vector<Particle>& particles) {
  BOOST_REQUIRE_EQUAL(frame.ids.size(), particles.size());
  BOOST_REQUIRE(frame.box.has_value());
  BOOST_TEST(frame.box->x0 == cell.low_x, boost::test_tools::tolerance(1e-12));
  BOOST_TEST(frame.box->x1 == cell.low_x + cell.length_x, boost::test_tools::tolerance(1e-12));
  BOOST_TEST(frame.box->y1 == cell.low_y + cell.length_y, boost::test_tools::tolerance(1e-12));
  BOOST_TEST(frame.box->tilt == cell.tilt);
  for (std::size_t i = 0; i < particles.size(); ++i) {
    BOOST_TEST(frame.ids[i] == particles[i].id);
    const Point expected = cell.at(particles[i].s, particles[i].t);
    const Point position = frame.positions[i];
    BOOST_TEST(gap(position.x, expected.x, cell.length_x) < 1e-10);
    BOOST_TEST(std::abs(position.y - expected.y) < 1e-10);
    BOOST_TEST((position.x >= frame.box->x0 && position.x < frame.box->x1));
    BOOST_TEST((position.y >= frame.box->y0 && position.y < frame.box->y1));
  }
}

void check_samples(const std::string& name, std::size_t frame_count, std::size_t count,
                   std::int64_t first_step, Point first_of_id_1) {
  std::vector<Frame> frames;
  read_frames(VOROCL_SAMPLES "/" + name, frames);
  BOOST_REQUIRE_EQUAL(frames.size(), frame_count);
  BOOST_TEST(frames[0].timestep.value() == first_step);
  BOOST_TEST(frames[0].positions[0].x == first_of_id_1.x);
  BOOST_TEST(frames[0].positions[0].y == first_of_id_1.y);
  for (const Frame& frame : frames) {
    BOOST_REQUIRE_EQUAL(frame.ids.size(), count);
    BOOST_TEST((frame.box->periodic_x && frame.box->periodic_y && frame.box->tilt == 0));
    for (std::size_t i = 0; i < count; ++i) BOOST_REQUIRE_EQUAL(frame.ids[i], i + 1);
  }
}

}  // namespace

BOOST_AUTO_TEST_CASE(every_dialect_gives_the_same_frame) {
  for (int run = 0; run < 20; ++run) {
    const Parallelogram cell{uniform(-50, 50), uniform(-50, 50), uniform(1, 100), uniform(1, 100), 0};
    const auto particles = random_particles(static_cast<std::size_t>(run));
    for (const char* dialect : {"x", "xs", "xu", "xsu"}) {
      for (const char* kind : {"plain", "tilt", "edges"}) {
        BOOST_TEST_CONTEXT(dialect << ", " << kind) {
          const auto frames = frames_of(write(dialect, kind, cell, particles));
          BOOST_REQUIRE_EQUAL(frames.size(), 1u);
          check_frame(frames[0], cell, particles);
        }
      }
    }
  }
}

BOOST_AUTO_TEST_CASE(a_tilted_cell_fills_its_rectangle) {
  for (int run = 0; run < 20; ++run) {
    const double length = uniform(1, 100);
    const Parallelogram cell{uniform(-50, 50), uniform(-50, 50), length, uniform(1, 100),
                             uniform(-1, 1) * length};
    const auto particles = random_particles(50);
    for (const char* dialect : {"x", "xs", "xu", "xsu"}) {
      for (const char* kind : {"tilt", "edges"}) {
        BOOST_TEST_CONTEXT(dialect << ", " << kind << ", tilt " << cell.tilt) {
          check_frame(frames_of(write(dialect, kind, cell, particles)).at(0), cell, particles);
        }
      }
    }
  }
}

BOOST_AUTO_TEST_CASE(a_flip_of_the_tilt_moves_nothing) {
  // The same lattice, told as a cell that leans right and, after the flip, as one that leans left.
  const std::vector<std::string> rows = {"1 1 1", "2 9.5 9", "3 12 8"};
  const auto right = frames_of(dump("xy xz yz pp pp pp\n0 15 5\n0 10 0\n-1 1 0", "id x y", rows)).at(0);
  const auto left = frames_of(dump("xy xz yz pp pp pp\n-5 10 -5\n0 10 0\n-1 1 0", "id x y", rows)).at(0);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    BOOST_TEST(right.positions[i].x == left.positions[i].x);
    BOOST_TEST(right.positions[i].y == left.positions[i].y);
  }
  BOOST_TEST(right.positions[2].x == 2);
}

BOOST_AUTO_TEST_CASE(particles_outside_a_periodic_box_are_wrapped) {
  const auto frame =
      frames_of(dump(periodic_box, "x y", {"-0.03 5", "10.03 5", "10 0", "5 -25", "-1e-30 1e9"})).at(0);
  const Point expected[] = {{9.97, 5}, {0.03, 5}, {0, 0}, {5, 5}, {0, 0}};
  for (std::size_t i = 0; i < 5; ++i) {
    BOOST_TEST(frame.positions[i].x == expected[i].x, boost::test_tools::tolerance(1e-12));
    BOOST_TEST(frame.positions[i].y == expected[i].y, boost::test_tools::tolerance(1e-12));
  }
}

BOOST_AUTO_TEST_CASE(only_sides_that_are_shrink_wrapped_grow) {
  for (const char* flags : {"ss ms pp", "mm sm pp", ""}) {
    const std::string box = std::string(flags) + "\n0 10\n0 10\n-1 1";
    const auto frames = frames_of(dump(box, "x y", {"-1 3", "12 -2", "3 10.5"}) + dump(box, "x y", {"4 4"}));
    const Box grown = frames.at(0).box.value();
    BOOST_TEST((grown.x0 == -1 && grown.x1 == 12 && grown.y0 == -2 && grown.y1 == 10.5));
    BOOST_TEST((!grown.periodic_x && !grown.periodic_y));
    BOOST_TEST(frames[0].positions[1].x == 12);
    BOOST_TEST((frames.at(1).box->x0 == 0 && frames[1].box->x1 == 10));  // each frame has its own
  }
  // Scaled positions are in lengths of the file's box, not of the grown one.
  const auto scaled = frames_of(dump("fs pp pp\n0 10\n0 10\n-1 1", "xs ys", {"2 1.5", "0.5 0.5"})).at(0);
  BOOST_TEST((scaled.box->x0 == 0 && scaled.box->x1 == 20 && scaled.box->y1 == 10));
  BOOST_TEST((scaled.positions[0].x == 20 && scaled.positions[0].y == 5));
  BOOST_TEST((scaled.positions[1].x == 5 && scaled.positions[1].y == 5));
}

BOOST_AUTO_TEST_CASE(a_tilt_that_is_rounding_error_is_none) {
  const auto frame =
      frames_of(dump("xy xz yz ff pp pp\n0 10 1e-15\n0 10 1e-15\n-1 1 0", "x y", {"1 12"})).at(0);
  BOOST_TEST((frame.box->tilt == 0 && frame.positions[0].x == 1 && frame.positions[0].y == 2));
}

BOOST_AUTO_TEST_CASE(a_wall_is_as_exact_as_the_positions) {
  // In six digits a particle on the wall is printed beyond it.
  const std::string box = "ff ff pp\n-66.66666666 66.66666666\n0 1\n-1 1";
  const auto frame = frames_of(dump(box, "x y", {"66.6667 0", "-66.6667 1"})).at(0);
  BOOST_TEST((frame.positions[0].x == 66.66666666 && frame.positions[1].x == -66.66666666));
  BOOST_TEST((frame.box->x0 == -66.66666666 && frame.box->x1 == 66.66666666));
  check_error(
      [&] {
        frames_of(dump(box, "x y", {"0 0", "66.6668 0"}));
      },
      {":11: ", "particle 1", "66.6668", "outside the fixed wall"});
}

BOOST_AUTO_TEST_CASE(ids_sort_the_rows_and_rows_are_the_ids_where_there_are_none) {
  const auto with =
      frames_of(dump(periodic_box, "type y x id", {"1 2 1 4294967294", "1 4 3 0", "2 6 5 17"})).at(0);
  BOOST_TEST(with.ids == (std::vector<std::uint32_t>{0, 17, 4294967294u}), boost::test_tools::per_element());
  BOOST_TEST((with.positions[0].x == 3 && with.positions[0].y == 4 && with.positions[2].x == 1));
  const auto without = frames_of(dump(periodic_box, "x y", {"3 1", "2 1", "1 1"})).at(0);
  BOOST_TEST(without.ids == (std::vector<std::uint32_t>{0, 1, 2}), boost::test_tools::per_element());
  BOOST_TEST(without.positions[0].x == 3);
}

BOOST_AUTO_TEST_CASE(many_rows_in_any_order_are_sorted_with_all_that_they_hold) {
  for (const std::uint32_t greatest : {300u, 70'000u, 4'294'967'294u}) {
    std::map<std::uint32_t, int> by_id;
    while (by_id.size() < 200) {
      by_id.emplace(static_cast<std::uint32_t>(uniform(0, greatest)), static_cast<int>(by_id.size()));
    }
    std::vector<std::string> rows;
    for (const auto& [id, number] : by_id)
      rows.push_back(fmt::format("{} 7 {} {}", number, id, number / 100.0));
    std::shuffle(rows.begin(), rows.end(), random_bits);
    const Frame frame = frames_of(dump(periodic_box, "n y id x", rows), "n").at(0);
    BOOST_REQUIRE_EQUAL(frame.ids.size(), by_id.size());
    std::size_t i = 0;
    for (const auto& [id, number] : by_id) {
      BOOST_TEST((frame.ids[i] == id && frame.values.numbers[i] == number &&
                  frame.positions[i].x == number / 100.0));
      ++i;
    }
  }
}

BOOST_AUTO_TEST_CASE(boxes_can_be_read_without_the_particles) {
  const std::string grown_box = "ss ff pp\n0 10\n0 10\n-0.5 0.5";
  const std::string text = dump(periodic_box, "id x y", {"2 1 1", "1 2 2"}) +
                           dump(grown_box, "id x y", {"2 -3 1", "1 12 2"}) +
                           dump(walled_box, "id x y", {"7 3 3"}) + dump(periodic_box, "id x y", {});
  const auto all = frames_of(text), boxes = frames_of(text, "", Wanted::box);
  BOOST_REQUIRE_EQUAL(boxes.size(), all.size());
  for (std::size_t i = 0; i < all.size(); ++i) {
    const Box &box = *boxes[i].box, &same = *all[i].box;
    BOOST_TEST((box.x0 == same.x0 && box.y0 == same.y0 && box.x1 == same.x1 && box.y1 == same.y1));
  }
  BOOST_TEST(boxes[0].positions.empty());
  BOOST_TEST(boxes[1].box->x0 == -3);
  // Rows that the box does not depend on are not looked at; they must be there.
  const std::string bad = dump(periodic_box, "id x y", {"1 x", "1 1"});
  BOOST_TEST(frames_of(bad + text, "", Wanted::box).size() == 5u);
  check_error([&] { frames_of(bad.substr(0, bad.size() - 4), "", Wanted::box); }, {":10: ", "cut off"});
  check_error([&] { frames_of(bad + "2 2 2\n" + text, "", Wanted::box); }, {":12: ", "more atoms"});
  const std::string lattice = "2\nLattice=\"4 0 0 0 5 0 0 0 1\"\nH 9 9 9\nH\n", plain = "1\n\nH 1 2 3\n";
  const auto xyz = frames_of(lattice + plain + lattice, "", Wanted::box);
  BOOST_REQUIRE_EQUAL(xyz.size(), 3u);
  BOOST_TEST(
      (xyz[0].box->x1 == 4 && xyz[0].ids.empty() && xyz[1].positions.size() == 1 && xyz[2].box->y1 == 5));
}

BOOST_AUTO_TEST_CASE(headers_vary) {
  std::string text = dump(periodic_box, "id x y", {"2 +3 4e0", "1\t1.5E+00\t.5   "},
                          "ITEM: UNITS\nlj\nITEM: TIME\n0.5\nITEM: TIMESTEP\n100\n") +
                     dump("pp ff pp\n-1 1\n2 3\n0 0", "y x", {}, "ITEM: TIME\n0.6\nITEM: TIMESTEP\n200\n") +
                     dump(periodic_box, "x y", {"1 2"}, "ITEM: TIMESTEP\n100\n") + "\n \n";
  std::string with_returns;
  for (const char c : text) with_returns += c == '\n' ? std::string("\r\n") : std::string(1, c);
  const std::string without_last_feed = text.substr(0, text.find_last_not_of(" \n") + 1);
  for (const std::string& variant : {text, with_returns, without_last_feed, "\xef\xbb\xbf" + text}) {
    const auto frames = frames_of(variant);
    BOOST_REQUIRE_EQUAL(frames.size(), 3u);
    BOOST_TEST((frames[0].timestep == 100 && frames[1].timestep == 200 && frames[2].timestep == 100));
    BOOST_TEST((frames[0].positions[0].x == 1.5 && frames[0].positions[0].y == 0.5 &&
                frames[0].positions[1].x == 3));
    BOOST_TEST((frames[1].ids.empty() && frames[1].positions.empty()));
    BOOST_TEST((frames[1].box->x0 == -1 && frames[1].box->periodic_x && !frames[1].box->periodic_y));
    BOOST_TEST(frames[2].positions[0].y == 2);
  }
}

BOOST_AUTO_TEST_CASE(the_samples_are_read) {
  check_samples("lj-melt.lammpstrj", 15, 2000, 7000, {45.8917, 51.8435});
  check_samples("lj-clusters.lammpstrj", 10, 3000, 25000, {1.84021, 150.006});
}

BOOST_AUTO_TEST_CASE(a_column_of_values_follows_the_particles) {
  const std::string text =
      dump(periodic_box, "c_pe id x y f[2]", {"-1.5 7 1 1 10", "nan 3 2 2 20", "4e2 5 3 3 30"}) +
      dump(periodic_box, "x y id c_pe f[2]", {"1 1 9 0.25 -1"});
  const auto energies = frames_of(text, "c_pe");
  BOOST_REQUIRE(energies.size() == 2u);
  BOOST_TEST((energies[0].ids == std::vector<std::uint32_t>{3, 5, 7}));
  BOOST_REQUIRE(energies[0].values.numbers.size() == 3u);
  BOOST_TEST((std::isnan(energies[0].values.numbers[0]) && energies[0].values.numbers[1] == 400 &&
              energies[0].values.numbers[2] == -1.5));
  BOOST_TEST((energies[1].values.numbers == std::vector<double>{0.25}));
  BOOST_TEST((frames_of(text, "f[2]")[0].values.numbers == std::vector<double>{20, 30, 10}));
  BOOST_TEST((frames_of(text, "id")[0].values.numbers == std::vector<double>{3, 5, 7}));
  BOOST_TEST(frames_of(text)[0].values.numbers.empty());
}
